// UsbLine.h - what the transfers of one open device share: a lock, a signal, and whether the device is still there.
// Used only inside drivers/usb.
//
// Callbacks run on the event thread, lock `mutex`, note what happened and notify. `mutex` is held only for a submission
// or a copy, never during a wait, so that a stop passes at once. libusb_open(), libusb_close() and the synchronous
// calls are never made while it is held, because libusb holds locks of its own during callbacks.
//
// Thread-safety: `mutex` guards the rest; callbacks run on the event thread.
#pragma once

#include <chrono>
#include <condition_variable>
#include <memory>
#include <mutex>
#include <optional>

#include "core/base/Units.h"

struct libusb_transfer;

namespace tacto {

struct UsbLine {
    std::mutex mutex;
    std::condition_variable changed;
    bool gone = false;       ///< true once unplugged; then nothing more is submitted
    bool outHalted = false;  ///< true if the OUT endpoint stalled; the device's own thread must clear it

    /// Submits the transfer; needs `mutex` held. Returns libusb's code, 0 for success; sets `gone` if unplugged.
    [[nodiscard]] int submit(libusb_transfer* transfer) noexcept;
};

struct FreeTransfer {
    void operator()(libusb_transfer* transfer) const noexcept;
};
using UsbTransferPtr = std::unique_ptr<libusb_transfer, FreeTransfer>;

/// Returns now plus `timeout`, or nothing if `timeout` is not 0 to 3600 s.
[[nodiscard]] std::optional<std::chrono::steady_clock::time_point> deadlineAfter(Seconds timeout) noexcept;

/// The allowed range, for the error about a refused timeout.
inline constexpr const char* kTimeoutRange = "0 to 3600 s was expected";

}  // namespace tacto
