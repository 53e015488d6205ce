#include "tests/support/usb_emulation/UsbWire.h"

#include <algorithm>
#include <cerrno>
#include <linux/usbdevice_fs.h>
#include <umockdev.h>
#include <utility>

namespace tacto::test {

namespace {
constexpr std::uint8_t kInput = 0x80;  // bit that marks an endpoint address as input
}

void ReleaseIoctlData::operator()(_UMockdevIoctlData* data) const noexcept { g_object_unref(data); }

usbdevfs_urb& Urb::get() const noexcept { return *reinterpret_cast<usbdevfs_urb*>(data->data); }

std::span<std::uint8_t> Urb::buffer() const noexcept {
    auto& urb = get();
    return {static_cast<std::uint8_t*>(urb.buffer), static_cast<std::size_t>(std::max(urb.buffer_length, 0))};
}

UsbWire::UsbWire(std::map<std::uint8_t, EndpointFacts> endpoints) : facts_(std::move(endpoints)) {
    for (const auto& [address, fact] : facts_) endpoints_[address];
}

void UsbWire::queue(std::uint8_t endpoint, std::span<const std::uint8_t> bytes, bool end) {
    const std::size_t packet = facts_.at(endpoint).packet;
    const bool full = bytes.size() % packet == 0;
    while (!bytes.empty()) {
        const auto one = bytes.first(std::min(packet, bytes.size()));
        queuePacket(endpoint, one);
        bytes = bytes.subspan(one.size());
    }
    if (end && full) queuePacket(endpoint, {});
}

void UsbWire::queuePacket(std::uint8_t endpoint, std::span<const std::uint8_t> packet) {
    endpoints_.at(endpoint).packets.emplace_back(packet.begin(), packet.end());
}

void UsbWire::setHalted(std::uint8_t endpoint, bool halted) { endpoints_.at(endpoint).halted = halted; }
void UsbWire::setHeld(std::uint8_t endpoint, bool held) { endpoints_.at(endpoint).held = held; }
void UsbWire::takeOnly(std::uint8_t endpoint, std::size_t bytes) { endpoints_.at(endpoint).takeOnly = bytes; }

bool UsbWire::takes(std::uint8_t endpoint) const {
    const auto& at = endpoints_.at(endpoint);
    return !at.held && !at.halted && at.waiting.empty();
}

void UsbWire::submit(Urb urb) {
    auto& endpoint = endpoints_.at(urb.get().endpoint);
    endpoint.waiting.push_back(std::move(urb));
}

void UsbWire::finish(Urb urb, int status, std::size_t actual) {
    urb.get().status = status;
    urb.get().actual_length = static_cast<int>(actual);
    done_.push_back(std::move(urb));
    ++finished_;
}

void UsbWire::finishFront(Endpoint& endpoint, int status, std::size_t actual) {
    Urb urb = std::move(endpoint.waiting.front());
    endpoint.waiting.pop_front();
    finish(std::move(urb), status, actual);
}

bool UsbWire::discard(std::uintptr_t clientAddress) {
    for (auto& [address, endpoint] : endpoints_) {
        const auto found = std::ranges::find_if(endpoint.waiting,
                                                [&](const Urb& urb) { return urb.data->client_addr == clientAddress; });
        if (found == endpoint.waiting.end()) continue;
        Urb urb = std::move(*found);
        endpoint.waiting.erase(found);
        const auto filled = urb.filled;
        finish(std::move(urb), -ENOENT, filled);
        return true;
    }
    return false;
}

void UsbWire::disconnect() {
    for (auto& [address, endpoint] : endpoints_) {
        while (!endpoint.waiting.empty()) finishFront(endpoint, -ESHUTDOWN, endpoint.waiting.front().filled);
    }
}

/// Moves packets into waiting URBs of an IN endpoint.
void UsbWire::fill(Endpoint& endpoint) {
    while (!endpoint.waiting.empty() && !endpoint.packets.empty()) {
        Urb& urb = endpoint.waiting.front();
        const auto room = urb.buffer().subspan(urb.filled);
        const auto packet = std::move(endpoint.packets.front());
        endpoint.packets.pop_front();
        const std::size_t fits = std::min(packet.size(), room.size());
        std::copy_n(packet.begin(), fits, room.begin());
        urb.filled += fits;
        if (packet.size() > room.size()) {
            finishFront(endpoint, -EOVERFLOW, urb.filled);
        } else if (packet.size() < facts_.at(urb.get().endpoint).packet || fits == room.size()) {
            finishFront(endpoint, 0, urb.filled);
        }
    }
}

std::optional<UsbWire::OutTransfer> UsbWire::advance() {
    for (auto& [address, endpoint] : endpoints_) {
        if (endpoint.halted) {
            while (!endpoint.waiting.empty()) finishFront(endpoint, -EPIPE, endpoint.waiting.front().filled);
        }
        if (endpoint.held) continue;
        if ((address & kInput) != 0) {
            fill(endpoint);
        } else if (!endpoint.waiting.empty()) {
            const auto sent = endpoint.waiting.front().buffer();
            const auto taken = sent.first(std::min(sent.size(), endpoint.takeOnly.value_or(sent.size())));
            endpoint.takeOnly.reset();
            OutTransfer transfer{address, {taken.begin(), taken.end()}};
            finishFront(endpoint, 0, taken.size());
            return transfer;
        }
    }
    return std::nullopt;
}

std::optional<Urb> UsbWire::reap(const void* owner) {
    const auto found = std::ranges::find(done_, owner, &Urb::owner);
    if (found == done_.end()) return std::nullopt;
    Urb urb = std::move(*found);
    done_.erase(found);
    return urb;
}

void UsbWire::forget(const void* owner) {
    const auto ours = [&](const Urb& urb) { return urb.owner == owner; };
    std::erase_if(done_, ours);
    for (auto& [address, endpoint] : endpoints_) std::erase_if(endpoint.waiting, ours);
}

std::size_t UsbWire::waitingAt(std::uint8_t endpoint) const { return endpoints_.at(endpoint).waiting.size(); }

}  // namespace tacto::test
