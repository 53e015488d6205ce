// DeviceRows.h - rows of a form: the device that a session delivers with, of those that are plugged in, and with a
// massager the sensor board on its motor.
//
// The gates of a study (pilot.md, section 3) decide what may deliver: the simulated bench for a virtual participant and
// in a rehearsal; a device for a person, in a rehearsal a massager alone.
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
    /// fields() are to be shown in `form` before anything else is called. `watch` outlives them.
    DeviceRows(FieldForm& form, const DeviceWatch& watch);
    [[nodiscard]] std::vector<FormField> fields() const;
    /// Afresh: for a person, or for a virtual participant.
    void offer(const StudySettings& study, bool person);
    /// None while one is missing.
    [[nodiscard]] std::vector<DeviceUri> chosen() const;
    /// Why none is chosen, a sentence; empty where one is.
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
    bool simulated_ = false;  ///< the simulated bench is offered
    bool plugged_ = false;    ///< devices are
};

}  // namespace tacto::gui
