// SessionInputs.h - the game pads and foot switches of a session: each press goes to the one person whom its device is
// assigned to, and one that is unplugged is told.
//
// No other device is open, so none answers. The output is switched off on the device's own thread, which waits neither
// for the window's thread nor for its painting. The signals follow, for what the windows show.
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

/// Game pads and foot switches that are open, and what they say, brought to the window's thread.
/// A press is told once, with the moment at which its report came. What must not wait for the window's thread is told
/// on the device's as well, before.
class OpenButtons final : public QObject {
    Q_OBJECT
public:
    explicit OpenButtons(QObject* parent = nullptr);
    ~OpenButtons() override;
    /// Sets where devices are opened from now on; null: there are none.
    void setDevices(std::shared_ptr<const ButtonDevices> devices);
    [[nodiscard]] const std::shared_ptr<const ButtonDevices>& devices() const { return devices_; }
    /// `atOnce` is called on the device's own thread, before the signals are, and not after close().
    /// Errors: as ButtonDevices::open(). One that is open stays so.
    [[nodiscard]] Result<void> open(const ButtonDeviceInfo& info, const ButtonListener& atOnce = {});
    /// Closes all devices, or the one with this identity.
    void close();
    void close(const std::string& identity);

signals:
    void moved(const std::string& identity, std::size_t button, bool down, tacto::gui::SteadyTime at);
    void plugged(const std::string& identity, bool there);

private:
    struct Open {
        quint64 number = 0;  ///< late messages come from an earlier number of this identity
        std::unique_ptr<ButtonDevice> device;
    };
    [[nodiscard]] bool isOpen(const std::string& identity, quint64 number) const;
    std::shared_ptr<const ButtonDevices> devices_;
    quint64 number_ = 0;
    std::map<std::string, Open> open_;  ///< by identity
};

/// Called on a device's own thread, each before the signal of the same event; none may block. `code` as in
/// SessionInputs::participantMoved.
struct InputsAtOnce {
    std::function<void(PromptTo whose)> stop;  ///< called when that person's STOP went down
    std::function<void(int code)> letGo;       ///< a button of the participant's that holds came up
    /// A button of the participant's that holds came up, after letGo, or went down.
    std::function<void(int code, bool down, SteadyTime at)> heldMoved;
    std::function<void(const std::string& which)> lost;  ///< an assigned device was unplugged, as gone() says it
};

class SessionInputs final : public QObject {
    Q_OBJECT
public:
    explicit SessionInputs(QObject* parent = nullptr);
    /// Opens all, or none; why not, a sentence. A device that is given twice is refused: it is one person's.
    [[nodiscard]] QString begin(const std::shared_ptr<const ButtonDevices>& devices,
                                const std::vector<SeatedDevice>& seats, const InputsAtOnce& atOnce);
    /// `atOnce` is not called any more once this returns.
    void end();
    [[nodiscard]] ButtonLabels labels() const { return labelsOf(seats_); }
    /// How many answers, from 1, the participant's devices reach.
    [[nodiscard]] int participantAnswers() const;
    /// Which devices are unplugged, half a sentence; empty for none.
    [[nodiscard]] QString gone() const;

signals:
    /// `code`: the same for the same button. Also of what `atOnce` was told.
    void participantMoved(int code, const tacto::gui::ButtonUse& use, bool down, tacto::gui::SteadyTime at);
    void operatorPressed(const tacto::gui::ButtonUse& use);  ///< likewise
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
