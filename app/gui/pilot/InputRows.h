// InputRows.h - form rows for the connected game pads and foot switches: the person each is assigned to, and what each
// button does. A pressed button lights up, so the operator sees that it works and which one it is.
//
// A device keeps its use from the last session of the same study if its serial number identifies it. Without a serial
// number that use is only offered, since the device may be another of the same model.
//
// While the rows are shown, they search for devices and open them, except those of a running session.
#pragma once

#include <QComboBox>
#include <QLabel>
#include <QString>
#include <QTimer>
#include <QVBoxLayout>
#include <QWidget>
#include <map>
#include <optional>
#include <vector>

#include "app/gui/controller/SideWork.h"
#include "app/gui/pilot/ButtonUse.h"
#include "app/gui/pilot/SessionInputs.h"

namespace tacto::gui {

class InputRows final : public QWidget {
    Q_OBJECT
public:
    explicit InputRows(QWidget* parent = nullptr);
    /// Null means that there are no devices.
    void setDevices(std::shared_ptr<const ButtonDevices> devices);
    [[nodiscard]] const std::shared_ptr<const ButtonDevices>& devices() const { return open_.devices(); }
    /// Sets the study's id, or kRehearsals, and forgets what was chosen before.
    void setPlace(const QString& place);
    /// Returns the devices that are assigned to a person and have at least one button in use.
    [[nodiscard]] std::vector<SeatedDevice> seats() const;
    /// Returns a sentence that says why a session cannot begin with these devices; empty if it can.
    [[nodiscard]] QString missing() const;

signals:
    void changed();

protected:
    void showEvent(QShowEvent* event) override;
    void hideEvent(QHideEvent* event) override;

private:
    struct Row {
        SeatedDevice seat;
        bool assigned = false;
        bool there = true;
        std::optional<SeatedDevice> before{};  ///< use of this device, or of one of its model, in the last session
        QString trouble;                       ///< why the device cannot be opened
        QWidget* widget = nullptr;
        std::vector<QLabel*> lamps{};
    };
    void look();
    void list(const std::vector<ButtonDeviceInfo>& found);
    void tryOpen(Row& row);
    void build();
    [[nodiscard]] QWidget* build(Row& row);
    void buildBefore(Row& row, QVBoxLayout& column);
    void seatAsBefore(Row& row);
    void buildButtons(Row& row, QVBoxLayout& column);
    void light(const std::string& identity, std::size_t button, bool down);
    [[nodiscard]] Row* find(const std::string& identity);

    OpenButtons open_;
    SideWork looker_;
    QTimer looking_;
    bool looks_ = false;  ///< looker_ is searching now
    QString place_;
    std::vector<Row> rows_;
    QLabel* none_;
    QVBoxLayout* column_;
};

/// Remembers who used which game pad or foot switch in the last session of a study, and what the buttons did. The
/// user's settings store this under the devices' identities, with nothing about a person. `place`: the study's id, or
/// kRehearsals. Replaces what was remembered for `place` before.
void rememberInputs(const QString& place, const std::vector<SeatedDevice>& seats);
/// Returns the remembered use of this device; nothing if it was not used there, or if its buttons have changed since. A
/// device without a serial number (ButtonDeviceInfo::hasSerial) is treated as any other of its model.
[[nodiscard]] std::optional<SeatedDevice> rememberedInput(const QString& place, const ButtonDeviceInfo& device);

inline constexpr const char* kRehearsals = "rehearsals";

}  // namespace tacto::gui
