// UsbOutbox.h - what goes to one device: a transfer that is waited for, and an urgent one that is not.
// Over a bulk OUT endpoint, or over the control endpoint (then the bytes are a SETUP packet). Inside drivers/usb only.
//
// The urgent transfer is made once. It is submitted in its caller's thread, so that it stands in the kernel's queue
// before sendUrgent() returns: behind what is under way, ahead of all that is sent later. While it is itself under
// way, the newest message is remembered and goes out from the event thread as soon as it has ended; send() holds back
// until then. (libusb's Linux part takes one small block from malloc for each submission; if there is none, the
// message is remembered too and send(), read() or the next sendUrgent() sends it.)
//
// Thread-safety: send(), tend() and close() one thread; sendUrgent() and delivered() any.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "core/base/Result.h"
#include "core/devices/TransportPorts.h"
#include "drivers/usb/UsbDevice.h"
#include "drivers/usb/UsbLine.h"

namespace tacto {

class UsbOutbox {
public:
    /// The most that one send() takes; usbfs lends 16 MiB to all devices together.
    static constexpr std::size_t kMaxSend = 65536;

    /// `endpoint` 0 is the control endpoint. Both references outlive the outbox.
    UsbOutbox(UsbDevice& device, UsbLine& line, std::uint8_t endpoint);
    ~UsbOutbox();
    UsbOutbox(const UsbOutbox&) = delete;
    UsbOutbox& operator=(const UsbOutbox&) = delete;

    /// One transfer. Errors: InvalidArgument (nothing or too much to send, time-out); Timeout (the rest was cancelled);
    /// Device (gone, stalled, took fewer bytes). A stall is cleared, so that the next send() has a chance.
    [[nodiscard]] Result<void> send(std::span<const std::uint8_t> bytes, Seconds timeout);
    /// 1 to Transport::kMaxUrgent bytes; others are a mistake of the program and are not sent.
    void sendUrgent(std::span<const std::uint8_t> bytes) noexcept;
    /// Urgent messages that the device took.
    [[nodiscard]] std::uint64_t delivered() const noexcept;
    /// When the last send() had been handed to libusb as a whole.
    [[nodiscard]] std::chrono::steady_clock::time_point submittedAt() const noexcept;

    /// Called with the line's lock held: clears a stall and sends an urgent message that waits for it. Lets the lock go
    /// meanwhile. Once per call of a driver, so that a device that always stalls cannot keep it.
    void tend(std::unique_lock<std::mutex>& lock);
    [[nodiscard]] bool wantsTending() const noexcept;

    /// Gives an urgent message a moment to leave, then ends all transfers. Nothing is sent after.
    void close() noexcept;

private:
    struct Callbacks;
    void submitUrgent() noexcept;
    void fill(libusb_transfer* transfer, std::span<std::uint8_t> buffer, bool urgent) noexcept;

    UsbDevice& device_;
    UsbLine& line_;
    const std::uint8_t endpoint_;

    // The line's lock guards all below.
    UsbTransferPtr sending_;
    std::vector<std::uint8_t> sent_;  // the bytes that sending_ refers to
    bool sendingNow_ = false;
    int sendingStatus_ = 0;
    std::size_t sendingTaken_ = 0;
    std::chrono::steady_clock::time_point submittedAt_{};

    UsbTransferPtr urgent_;
    std::array<std::uint8_t, Transport::kMaxUrgent> urgentBytes_{};  // the bytes that urgent_ refers to
    std::array<std::uint8_t, Transport::kMaxUrgent> next_{};         // the message that goes out after it
    std::size_t urgentLength_ = 0;
    std::size_t nextLength_ = 0;  // 0: nothing waits
    bool urgentNow_ = false;
    std::uint64_t delivered_ = 0;
    bool closed_ = false;
};

}  // namespace tacto
