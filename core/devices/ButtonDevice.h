// ButtonDevice.h - game pads and foot switches: devices with buttons, each serving one person of a pilot session.
//
// Thread-safety: ButtonDevices from any thread; a listener is called on the device's own thread and must not block.
#pragma once

#include <chrono>
#include <cstddef>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "core/base/Result.h"

namespace tacto {

struct ButtonDeviceInfo {
    std::string address;               ///< the address while it is plugged in: "/dev/hidraw3"
    std::string identity;              ///< the identity after it was plugged in again: "046d:c216", "046d:c216 17"
    std::string name;                  ///< as the device says
    std::vector<std::string> buttons;  ///< the numbers of the buttons: "1", "2"; "2-1" on a second pad in one device
    std::string obstacle;              ///< why it cannot be used, and what helps, a sentence; empty where it can
    bool hasSerial = false;            ///< the identity is this device's alone; else all of its model share it

    bool operator==(const ButtonDeviceInfo&) const = default;
};

struct ButtonPress {
    std::size_t button = 0;  ///< index in ButtonDeviceInfo::buttons
    bool down = false;       ///< the button went down; else it came up. A button that is held is reported once
    std::chrono::steady_clock::time_point at;
};

struct ButtonListener {
    std::function<void(const ButtonPress& press)> moved;
    /// False when the device was unplugged, true when it is plugged in again. A button that was down when the device
    /// was unplugged is not reported to come up.
    std::function<void(bool there)> plugged;
};

/// An open device. Destruction closes it, within 50 ms; the listener is not called afterwards. A device that was
/// unplugged is opened again by itself when it is plugged in again.
class ButtonDevice {
public:
    virtual ~ButtonDevice() = default;
};

class ButtonDevices {
public:
    virtual ~ButtonDevices() = default;
    /// All devices that are plugged in, including those that cannot be used.
    [[nodiscard]] virtual std::vector<ButtonDeviceInfo> list() const = 0;
    /// Errors: NotFound where it is not plugged in any more; Io (not permitted), Unsupported and ParseError with the
    /// sentence of its obstacle.
    [[nodiscard]] virtual Result<std::unique_ptr<ButtonDevice>> open(const ButtonDeviceInfo& info,
                                                                     ButtonListener listener) const = 0;
};

}  // namespace tacto
