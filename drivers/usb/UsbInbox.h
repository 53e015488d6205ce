// UsbInbox.h - receives from a bulk IN endpoint: several one-packet transfers are always in flight, so that even a
// message that ends with a full packet arrives at once; a bounded ring stores the bytes. For drivers/usb only.
//
// Thread-safety: one thread calls read() and close(); any thread may call dropped().
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
    /// All references must outlive the inbox. `transfers` and `ringBytes` are as in UsbBulkOptions.
    UsbInbox(UsbDevice& device, UsbLine& line, UsbOutbox& outbox, const UsbBulkPair& pair, std::size_t transfers,
             std::size_t ringBytes);
    ~UsbInbox();
    UsbInbox(const UsbInbox&) = delete;
    UsbInbox& operator=(const UsbInbox&) = delete;

    /// Submits all transfers. Errors: Device; Io.
    [[nodiscard]] Result<void> start();
    /// Reads like Transport::read(). After a failed transfer it clears and restarts the endpoint, and reports the
    /// failure once. While it waits, it also calls the outbox's tend().
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

    // The line's mutex guards everything below.
    std::vector<Slot> slots_;  // never resized after construction
    ByteRing arrived_;
    int failure_ = 0;  // status of the first failed transfer; 0: none
    bool closed_ = false;
};

}  // namespace tacto
