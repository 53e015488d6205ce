// SessionInputs.h - the game pads and foot switches of a session: passes each press to the one person to whom the
// device is assigned, and reports an unplugged device.
//
// Only the assigned devices are open, so no other device can answer. The output is switched off on the device's own
// thread, which does not wait for the window's thread or its painting. Signals to update the windows follow.
#pragma once

#include <QObject>
#include <functional>
#include <map>
#include <memory>
#include <set>
#include <vector>

#include "app/gui/pilot/ButtonUse.h"
#include "app/gui/theme/ConfirmButton.h"
#include "core/devices/ButtonDevice.h"

namespace tacto::gui {

/// Open game pads and foot switches, with their events passed to the window's thread. A press is reported once, with
/// the time at which it arrived. Urgent events are first reported on the device's own thread.
class OpenButtons final : public QObject {
    Q_OBJECT
public:
    explicit OpenButtons(QObject* parent = nullptr);
    ~OpenButtons() override;
    /// Sets the source from which devices are opened from now on; null if there are none.
    void setDevices(std::shared_ptr<const ButtonDevices> devices);
    [[nodiscard]] const std::shared_ptr<const ButtonDevices>& devices() const { return devices_; }
    /// `atOnce` is called on the device's own thread before the signals, and not after close(). Errors: as
    /// ButtonDevices::open(). A device that is already open stays open.
    [[nodiscard]] Result<void> open(const ButtonDeviceInfo& info, const ButtonListener& atOnce = {});
    /// Closes all devices, or the one with this identity.
    void close();
    void close(const std::string& identity);

signals:
    void moved(const std::string& identity, std::size_t button, bool down, tacto::gui::SteadyTime at);
    void plugged(const std::string& identity, bool there);

private:
    struct Open {
        quint64 number = 0;  ///< messages with an earlier number are outdated
        std::unique_ptr<ButtonDevice> device;
    };
    [[nodiscard]] bool isOpen(const std::string& identity, quint64 number) const;
    std::shared_ptr<const ButtonDevices> devices_;
    quint64 number_ = 0;
    std::map<std::string, Open> open_;  ///< by device identity
};

/// Callbacks on a device's own thread, each called before the signal of the same event; none may block. `code` as in
/// SessionInputs::participantMoved.
struct InputsAtOnce {
    std::function<void(PromptTo whose)> stop;  ///< called when that person's STOP went down
    std::function<void(int code)> letGo;       ///< called when one of the participant's hold buttons came up
    /// Called when one of the participant's hold buttons went down, or came up (then after letGo).
    std::function<void(int code, bool down, SteadyTime at)> heldMoved;
    std::function<void(const std::string& which)> lost;  ///< an assigned device was unplugged; `which` as gone()
};

class SessionInputs final : public QObject {
    Q_OBJECT
public:
    explicit SessionInputs(QObject* parent = nullptr);
    /// Opens all devices or none; returns a sentence that says why not. Refuses a device that is given twice.
    [[nodiscard]] QString begin(const std::shared_ptr<const ButtonDevices>& devices,
                                const std::vector<SeatedDevice>& seats, const InputsAtOnce& atOnce);
    /// Closes all devices; `atOnce` is not called after this returns.
    void end();
    [[nodiscard]] ButtonLabels labels() const { return labelsOf(seats_); }
    /// Returns the largest n for which the participant's devices can give all answers 1 to n.
    [[nodiscard]] int participantAnswers() const;
    /// Returns half a sentence that names the unplugged devices; empty if there are none.
    [[nodiscard]] QString gone() const;

signals:
    /// `code` identifies the button. Emitted also for events that `atOnce` has already reported.
    void participantMoved(int code, const tacto::gui::ButtonUse& use, bool down, tacto::gui::SteadyTime at);
    void operatorPressed(const tacto::gui::ButtonUse& use);  ///< also if `atOnce` has reported the event
    void lost();                                             ///< an assigned device was unplugged: gone() names it
    void back();

private:
    void move(const std::string& identity, std::size_t button, bool down, SteadyTime at);
    void plug(const std::string& identity, bool there);
    OpenButtons open_;
    std::vector<SeatedDevice> seats_;
    std::set<std::string> gone_;
};

}  // namespace tacto::gui
