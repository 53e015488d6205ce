// UsbWire.h - the endpoints of one emulated device and the URBs that wait at them: what the host's controller and the
// kernel's usbfs do between an ioctl and the device. Packets keep the sizes that a bus gives them: an IN transfer ends
// with a short packet or a full buffer, and a packet larger than what is left of the buffer is an overflow.
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

/// One URB as the client submitted it, in the emulator's memory.
struct Urb {
    IoctlData data;
    const void* owner = nullptr;  ///< the open file that submitted it and will reap it
    std::size_t filled = 0;       ///< bytes of an IN transfer that came so far
    [[nodiscard]] usbdevfs_urb& get() const noexcept;
    [[nodiscard]] std::span<std::uint8_t> buffer() const noexcept;
};

class UsbWire {
public:
    explicit UsbWire(std::map<std::uint8_t, EndpointFacts> endpoints);

    /// The device has `bytes` for the host: split into packets; `end` adds an empty one after a full last one.
    void queue(std::uint8_t endpoint, std::span<const std::uint8_t> bytes, bool end);
    /// One packet as it is, whatever its size.
    void queuePacket(std::uint8_t endpoint, std::span<const std::uint8_t> packet);

    void setHalted(std::uint8_t endpoint, bool halted);
    /// While held, the endpoint answers nothing (NAK): transfers wait until it is let go.
    void setHeld(std::uint8_t endpoint, bool held);
    /// The next OUT transfer ends after so many bytes.
    void takeOnly(std::uint8_t endpoint, std::size_t bytes);
    /// Whether an OUT transfer would be taken now.
    [[nodiscard]] bool takes(std::uint8_t endpoint) const;

    [[nodiscard]] bool knows(std::uint8_t endpoint) const noexcept { return facts_.contains(endpoint); }
    [[nodiscard]] std::uint8_t interfaceOf(std::uint8_t endpoint) const { return facts_.at(endpoint).interface; }

    /// A bulk or interrupt URB arrives.
    void submit(Urb urb);
    /// Takes it back, if it still waits: it ends as cancelled.
    [[nodiscard]] bool discard(std::uintptr_t clientAddress);
    /// Ends one that needs no waiting, as a control transfer does. `actual` as usbfs counts.
    void finish(Urb urb, int status, std::size_t actual);
    /// Everything that waits ends with -ESHUTDOWN.
    void disconnect();

    /// Moves packets into waiting URBs, and OUT transfers to the device: the next of those, or nothing.
    struct OutTransfer {
        std::uint8_t endpoint = 0;
        std::vector<std::uint8_t> bytes;
    };
    [[nodiscard]] std::optional<OutTransfer> advance();

    [[nodiscard]] bool canReap() const noexcept { return !done_.empty(); }
    /// The oldest ended URB of an open file, if there is one.
    [[nodiscard]] std::optional<Urb> reap(const void* owner);
    /// The open file was closed: its URBs go with it, unreaped.
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
