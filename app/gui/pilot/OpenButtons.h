// OpenButtons.h - game pads and foot switches that are open, and what they say, brought to the window's thread.
//
// A press is told once, with the moment at which its report came. What must not wait for the window's thread is told on
// the device's as well, before.
//
// Thread-safety: the GUI thread.
#pragma once

#include <QObject>
#include <map>
#include <memory>

#include "app/gui/theme/ConfirmButton.h"
#include "core/devices/ButtonDevice.h"

namespace tacto::gui {

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
    /// All, or the one of this identity.
    void close();
    void close(const std::string& identity);

signals:
    void moved(const std::string& identity, std::size_t button, bool down, tacto::gui::SteadyTime at);
    void plugged(const std::string& identity, bool there);

private:
    struct Open {
        quint64 number = 0;  ///< what an earlier one of this identity said is late
        std::unique_ptr<ButtonDevice> device;
    };
    [[nodiscard]] bool isOpen(const std::string& identity, quint64 number) const;
    std::shared_ptr<const ButtonDevices> devices_;
    quint64 number_ = 0;
    std::map<std::string, Open> open_;  ///< by identity
};

}  // namespace tacto::gui
