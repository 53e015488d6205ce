// UsbLine.h - what the transfers of one open device share: a lock, a signal, and whether the device is still there.
// Inside drivers/usb only.
//
// Callbacks run on the event thread, take `mutex`, note what happened and notify. The lock is held for a submission
// or a copy at most, never while something is waited for, so that a stop passes through at once. libusb_open(),
// libusb_close() and the synchronous calls are never made under it: libusb holds locks of theirs in callbacks.
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
    bool gone = false;       ///< unplugged; nothing is submitted any more
    bool outHalted = false;  ///< the OUT endpoint stalled and must be cleared by the device's own thread

    /// Submits with `mutex` held. Returns libusb's code, 0 for done; notes an unplugged device.
    [[nodiscard]] int submit(libusb_transfer* transfer) noexcept;
};

struct FreeTransfer {
    void operator()(libusb_transfer* transfer) const noexcept;
};
using UsbTransferPtr = std::unique_ptr<libusb_transfer, FreeTransfer>;

/// Now plus `timeout`; nothing for one that is not 0 to 3600 s.
[[nodiscard]] std::optional<std::chrono::steady_clock::time_point> deadlineAfter(Seconds timeout) noexcept;

/// The range in the answer to a refused time-out.
inline constexpr const char* kTimeoutRange = "0 to 3600 s was expected";

}  // namespace tacto
