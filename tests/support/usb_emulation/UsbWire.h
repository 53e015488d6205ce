// UsbWire.h - the endpoints of one emulated device and the URBs that wait at them: the work of the host controller and
// the kernel's usbfs between an ioctl and the device. Packets keep their sizes as on a bus: an IN transfer ends with a
// short packet or a full buffer, and a packet larger than the rest of the buffer is an overflow.
//
// Thread-safety: none; EmulatedUsbDevice locks.
#pragma once

#include <cstdint>
#include <deque>
#include <map>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "tests/support/usb_emulation/UsbDescription.h"

struct _UMockdevIoctlData;
struct usbdevfs_urb;

namespace tacto::test {

struct ReleaseIoctlData {
    void operator()(_UMockdevIoctlData* data) const noexcept;
};
using IoctlData = std::unique_ptr<_UMockdevIoctlData, ReleaseIoctlData>;

/// One URB as the client submitted it, in the emulator's own memory.
struct Urb {
    IoctlData data;
    const void* owner = nullptr;  ///< the open file that submitted it and will reap it
    std::size_t filled = 0;       ///< bytes of an IN transfer received so far
    [[nodiscard]] usbdevfs_urb& get() const noexcept;
    [[nodiscard]] std::span<std::uint8_t> buffer() const noexcept;
};

class UsbWire {
public:
    explicit UsbWire(std::map<std::uint8_t, EndpointFacts> endpoints);

    /// Queues `bytes` of the device for the host, split into packets; `end` adds an empty packet after a full last one.
    void queue(std::uint8_t endpoint, std::span<const std::uint8_t> bytes, bool end);
    /// Queues one packet of any size without splitting it.
    void queuePacket(std::uint8_t endpoint, std::span<const std::uint8_t> packet);

    void setHalted(std::uint8_t endpoint, bool halted);
    /// While held, the endpoint answers nothing (NAK), and transfers wait.
    void setHeld(std::uint8_t endpoint, bool held);
    /// Makes the next OUT transfer end after this many bytes.
    void takeOnly(std::uint8_t endpoint, std::size_t bytes);
    /// True if an OUT transfer would be accepted now.
    [[nodiscard]] bool takes(std::uint8_t endpoint) const;

    [[nodiscard]] bool knows(std::uint8_t endpoint) const noexcept { return facts_.contains(endpoint); }
    [[nodiscard]] std::uint8_t interfaceOf(std::uint8_t endpoint) const { return facts_.at(endpoint).interface; }

    /// Accepts a bulk or interrupt URB.
    void submit(Urb urb);
    /// Cancels an URB if it still waits; it then ends as cancelled.
    [[nodiscard]] bool discard(std::uintptr_t clientAddress);
    /// Ends an URB that need not wait, as in a control transfer. `actual` is counted as in usbfs.
    void finish(Urb urb, int status, std::size_t actual);
    /// Ends all waiting URBs with -ESHUTDOWN.
    void disconnect();

    /// Moves packets into waiting URBs, and returns the next OUT transfer for the device, if there is one.
    struct OutTransfer {
        std::uint8_t endpoint = 0;
        std::vector<std::uint8_t> bytes;
    };
    [[nodiscard]] std::optional<OutTransfer> advance();

    [[nodiscard]] bool canReap() const noexcept { return !done_.empty(); }
    /// Returns the oldest finished URB of an open file, if there is one.
    [[nodiscard]] std::optional<Urb> reap(const void* owner);
    /// Drops the URBs of an open file that was closed.
    void forget(const void* owner);
    [[nodiscard]] std::size_t waitingAt(std::uint8_t endpoint) const;
    [[nodiscard]] std::uint64_t finished() const noexcept { return finished_; }

private:
    struct Endpoint {
        std::deque<std::vector<std::uint8_t>> packets;
        std::deque<Urb> waiting;
        bool halted = false;
        bool held = false;
        std::optional<std::size_t> takeOnly;
    };
    void fill(Endpoint& endpoint);
    void finishFront(Endpoint& endpoint, int status, std::size_t actual);

    std::map<std::uint8_t, EndpointFacts> facts_;
    std::map<std::uint8_t, Endpoint> endpoints_;
    std::deque<Urb> done_;
    std::uint64_t finished_ = 0;
};

}  // namespace tacto::test
