// HidPort.h - exchanges reports with one open device: a HID device through hidapi, a device driven by a control
// request, or a fake in tests. Destruction closes the device.
//
// Thread-safety: write(), feature() and read() one caller at a time; stopNow() any thread at any time, even during
// write().
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

    /// Sends an output report, with its number in byte 0 (0 if the device has none), and waits until the device has it,
    /// at most as long as the system allows (hidraw: 5 s). Returns how many bytes of `report` the device took. Errors:
    /// Device (gone, refused); Timeout if the system gave up waiting.
    [[nodiscard]] virtual Result<std::size_t> write(std::span<const std::uint8_t> report) = 0;

    /// Reads the feature report with the number in byte 0 of `report`; returns its size in bytes, byte 0 included.
    /// Errors: Device; Unsupported if the device has no feature reports.
    [[nodiscard]] virtual Result<std::size_t> feature(std::span<std::uint8_t> report) = 0;

    /// Waits at most `wait` for an input report. Returns its bytes, cut to the size of `report`, as the device sent
    /// them (with the number first if reports are numbered), or 0 if none came. Errors: Device (gone); Unsupported if
    /// the device has no input reports.
    [[nodiscard]] virtual Result<std::size_t> read(std::span<std::uint8_t> report, std::chrono::milliseconds wait) {
        static_cast<void>(report);
        static_cast<void>(wait);
        return fail(ErrorCode::Unsupported, "this device sends no input reports");
    }

    /// Starts a watchdog that sends `stop`, the device's stop report, if this program cannot. On an error, which is a
    /// sentence saying so, the device must not be driven.
    [[nodiscard]] virtual Result<std::unique_ptr<Watchdog>> watch(std::span<const std::uint8_t> stop) = 0;

    /// Sends the stop without waiting or allocating, if the system can do that. Returns false if it cannot; then the
    /// stop report must be written.
    [[nodiscard]] virtual bool stopNow() noexcept { return false; }
};

/// Opens the device; called again to reconnect to the same device. Errors: NotFound, Io (not permitted), Device.
using OpenPort = std::function<Result<std::unique_ptr<HidPort>>()>;

}  // namespace tacto::hid
