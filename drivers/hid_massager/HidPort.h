// HidPort.h - reports to and from one open device: a HID device through hidapi, a device that is driven by a control
// request, a fake in tests. Destruction closes.
//
// Thread-safety: write(), feature() and read() one caller at a time; stopNow() any thread, at any moment, also while
// write() waits.
#pragma once

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <span>

#include "drivers/hid_massager/Watchdog.h"

namespace tacto::hid {

class HidPort {
public:
    virtual ~HidPort() = default;

    /// Sends an output report, its number in byte 0 (0: the device has none), and waits until the device has it, as
    /// long as the system lets it (hidraw: 5 s). Returns how many bytes of `report` it took. Errors: Device (gone,
    /// refused); Timeout where the system gave up waiting.
    [[nodiscard]] virtual Result<std::size_t> write(std::span<const std::uint8_t> report) = 0;

    /// Fetches the feature report with the number in byte 0 of `report`; returns its bytes, byte 0 included. Errors:
    /// Device; Unsupported where there are no feature reports.
    [[nodiscard]] virtual Result<std::size_t> feature(std::span<std::uint8_t> report) = 0;

    /// Waits for an input report, at most so long; returns its bytes, cut to the size of `report`, as the device sent
    /// them: with its number in front where reports are numbered. 0: none came. Errors: Device (gone); Unsupported
    /// where there are none.
    [[nodiscard]] virtual Result<std::size_t> read(std::span<std::uint8_t> report, std::chrono::milliseconds wait) {
        static_cast<void>(report);
        static_cast<void>(wait);
        return fail(ErrorCode::Unsupported, "this device sends no input reports");
    }

    /// Starts what sends `stop`, the device's stop report, when this program cannot. Errors: the device must not be
    /// driven; a sentence that says so.
    [[nodiscard]] virtual Result<std::unique_ptr<Watchdog>> watch(std::span<const std::uint8_t> stop) = 0;

    /// Sends the stop without waiting and without allocating, where the system can do that; false where it cannot,
    /// and then the stop report must be written.
    [[nodiscard]] virtual bool stopNow() noexcept { return false; }
};

/// Makes a fresh port to the same device; called again to reconnect. Errors: NotFound, Io (not permitted), Device.
using OpenPort = std::function<Result<std::unique_ptr<HidPort>>()>;

}  // namespace tacto::hid
