// UsbInbox.h - what comes from a bulk IN endpoint: several transfers in flight at all times, one packet each, so that
// a device that ends on a full packet is heard at once; and a bounded ring for what arrived. Inside drivers/usb only.
//
// Thread-safety: read() and close() one thread; dropped() any.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "core/base/Result.h"
#include "drivers/usb/ByteRing.h"
#include "drivers/usb/UsbDevice.h"
#include "drivers/usb/UsbLine.h"

namespace tacto {

class UsbOutbox;

class UsbInbox {
public:
    /// All references outlive the inbox. `transfers` and `ringBytes` as in UsbBulkOptions.
    UsbInbox(UsbDevice& device, UsbLine& line, UsbOutbox& outbox, const UsbBulkPair& pair, std::size_t transfers,
             std::size_t ringBytes);
    ~UsbInbox();
    UsbInbox(const UsbInbox&) = delete;
    UsbInbox& operator=(const UsbInbox&) = delete;

    /// Puts all transfers under way. Errors: Device; Io.
    [[nodiscard]] Result<void> start();
    /// Reads like Transport::read(). After a failed transfer the endpoint is cleared and started again, and the failure
    /// is reported once. Tends the outbox while it waits.
    [[nodiscard]] Result<std::size_t> read(std::span<std::uint8_t> into, Seconds timeout);
    [[nodiscard]] std::uint64_t dropped() const noexcept;
    /// Ends all transfers.
    void close() noexcept;

private:
    struct Callbacks;
    struct Slot {
        UsbInbox* inbox = nullptr;
        UsbTransferPtr transfer;
        std::vector<std::uint8_t> bytes;
        bool flying = false;
    };
    [[nodiscard]] bool anyFlying() const noexcept;
    void cancelAll() noexcept;
    [[nodiscard]] Result<void> startLocked();
    [[nodiscard]] Error recover(std::unique_lock<std::mutex>& lock);

    UsbDevice& device_;
    UsbLine& line_;
    UsbOutbox& outbox_;
    const std::uint8_t endpoint_;

    // The line's lock guards all below.
    std::vector<Slot> slots_;  // never resized after construction
    ByteRing arrived_;
    int failure_ = 0;  // the status of the first transfer that failed; 0: none
    bool closed_ = false;
};

}  // namespace tacto
