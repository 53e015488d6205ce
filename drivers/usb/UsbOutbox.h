// UsbOutbox.h - sends to one device: transfers that the caller waits for, and an urgent one without a wait. Uses a bulk
// OUT endpoint, or the control endpoint (the bytes are then a SETUP packet). For drivers/usb only.
//
// The urgent transfer is allocated once. sendUrgent() submits it in the caller's thread, so that it is in the kernel's
// queue before sendUrgent() returns: after the running transfer, before all later ones. While the urgent transfer is
// itself running, the newest message is kept, and the event thread sends it as soon as the transfer has ended; send()
// waits until then. (On Linux, libusb allocates a small block for each submission; if malloc fails, the message is kept
// too, and send(), read() or the next sendUrgent() sends it.)
//
// Thread-safety: one thread calls send(), tend() and close(); any thread calls sendUrgent() and delivered().
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
    /// Limit in bytes for one send(); usbfs shares 16 MiB among all devices.
    static constexpr std::size_t kMaxSend = 65536;

    /// `endpoint` 0 is the control endpoint. Both references must outlive the outbox.
    UsbOutbox(UsbDevice& device, UsbLine& line, std::uint8_t endpoint);
    ~UsbOutbox();
    UsbOutbox(const UsbOutbox&) = delete;
    UsbOutbox& operator=(const UsbOutbox&) = delete;

    /// Sends one transfer. Errors: InvalidArgument (nothing or too much to send, timeout); Timeout (the rest was
    /// cancelled); Device (gone, stalled, took fewer bytes). A stall is cleared, so that the next send() can succeed.
    [[nodiscard]] Result<void> send(std::span<const std::uint8_t> bytes, Seconds timeout);
    /// Takes 1 to Transport::kMaxUrgent bytes; any other number is a programming error, and nothing is sent.
    void sendUrgent(std::span<const std::uint8_t> bytes) noexcept;
    /// Returns how many urgent messages the device took.
    [[nodiscard]] std::uint64_t delivered() const noexcept;
    /// Returns when the last send() had been handed to libusb completely.
    [[nodiscard]] std::chrono::steady_clock::time_point submittedAt() const noexcept;

    /// Clears a stall and sends an urgent message that waits for it. Needs the line's lock, and releases it meanwhile.
    /// Called only once per driver call, so that a device that always stalls cannot block the driver.
    void tend(std::unique_lock<std::mutex>& lock);
    [[nodiscard]] bool wantsTending() const noexcept;

    /// Gives an urgent message a short time to leave, then ends all transfers. Nothing is sent afterwards.
    void close() noexcept;

private:
    struct Callbacks;
    void submitUrgent() noexcept;
    void fill(libusb_transfer* transfer, std::span<std::uint8_t> buffer, bool urgent) noexcept;

    UsbDevice& device_;
    UsbLine& line_;
    const std::uint8_t endpoint_;

    // The line's mutex guards everything below.
    UsbTransferPtr sending_;
    std::vector<std::uint8_t> sent_;  // the bytes that sending_ points to
    bool sendingNow_ = false;
    int sendingStatus_ = 0;
    std::size_t sendingTaken_ = 0;
    std::chrono::steady_clock::time_point submittedAt_{};

    UsbTransferPtr urgent_;
    std::array<std::uint8_t, Transport::kMaxUrgent> urgentBytes_{};  // the bytes that urgent_ points to
    std::array<std::uint8_t, Transport::kMaxUrgent> next_{};         // the next message to send
    std::size_t urgentLength_ = 0;
    std::size_t nextLength_ = 0;  // 0: no message waits
    bool urgentNow_ = false;
    std::uint64_t delivered_ = 0;
    bool closed_ = false;
};

}  // namespace tacto
