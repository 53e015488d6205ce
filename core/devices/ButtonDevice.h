// ButtonDevice.h - game pads and foot switches: devices with buttons, each serving one person of a pilot session.
//
// Thread-safety: ButtonDevices from any thread; a listener runs on the device's own thread and must not block.
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
    std::string address;               ///< valid while it is plugged in: "/dev/hidraw3"
    std::string identity;              ///< stays the same when it is plugged in again: "046d:c216", "046d:c216 17"
    std::string name;                  ///< as the device states it
    std::vector<std::string> buttons;  ///< button numbers: "1", "2"; "2-1" on a second pad in one device
    std::string obstacle;              ///< one sentence: why it cannot be used and what helps; empty if usable
    bool hasSerial = false;            ///< true: only this device has the identity; false: all of its model share it

    bool operator==(const ButtonDeviceInfo&) const = default;
};

struct ButtonPress {
    std::size_t button = 0;  ///< index in ButtonDeviceInfo::buttons
    bool down = false;       ///< true: pressed; false: released. A held button is reported once
    std::chrono::steady_clock::time_point at;
};

struct ButtonListener {
    std::function<void(const ButtonPress& press)> moved;
    /// Called with false after the device was unplugged, with true once it is plugged in again. No release is reported
    /// for a button that was down when the device was unplugged.
    std::function<void(bool there)> plugged;
};

/// An open device. Destruction closes it, within 50 ms; the listener is not called afterwards. After being unplugged,
/// the device opens again by itself once it is plugged in.
class ButtonDevice {
public:
    virtual ~ButtonDevice() = default;
};

class ButtonDevices {
public:
    virtual ~ButtonDevices() = default;
    /// Returns all devices that are plugged in, including unusable ones.
    [[nodiscard]] virtual std::vector<ButtonDeviceInfo> list() const = 0;
    /// Errors: NotFound if the device is no longer plugged in; Io (not permitted), Unsupported and ParseError with the
    /// sentence in ButtonDeviceInfo::obstacle.
    [[nodiscard]] virtual Result<std::unique_ptr<ButtonDevice>> open(const ButtonDeviceInfo& info,
                                                                     ButtonListener listener) const = 0;
};

}  // namespace tacto
