// DeviceRows.h - form rows to choose the connected device that a session delivers with and, for a massager, the sensor
// board on its motor.
//
// The rules of a study (pilot.md, section 3) decide what may deliver: for a virtual participant and in a rehearsal the
// simulated bench; for a person a real device, but in a rehearsal only a massager.
#pragma once

#include <QComboBox>
#include <vector>

#include "app/gui/controller/DeviceWatch.h"
#include "app/gui/theme/FieldForm.h"
#include "core/study/StudySettings.h"

namespace tacto::gui {

class DeviceRows final : public QObject {
    Q_OBJECT
public:
    /// Show fields() in `form` before any other call. `watch` must outlive these rows.
    DeviceRows(FieldForm& form, const DeviceWatch& watch);
    [[nodiscard]] std::vector<FormField> fields() const;
    /// Lists the devices anew, for a person or for a virtual participant.
    void offer(const StudySettings& study, bool person);
    /// Returns the chosen devices; none while one is missing.
    [[nodiscard]] std::vector<DeviceUri> chosen() const;
    /// Returns a sentence that says why no device is chosen; empty if one is chosen.
    [[nodiscard]] QString missing() const;

signals:
    void changed();

private:
    void list();
    void judge();

    FieldForm& form_;
    const DeviceWatch& watch_;
    QComboBox* delivers_;
    QComboBox* looks_;
    std::vector<DeviceIdentity> listed_;
    Role role_ = Role::Stimulator;
    bool simulated_ = false;  ///< true if the simulated bench is offered
    bool plugged_ = false;    ///< true if connected devices are offered
};

}  // namespace tacto::gui
