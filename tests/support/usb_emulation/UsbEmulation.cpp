#include "tests/support/usb_emulation/UsbEmulation.h"

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <fmt/format.h>
#include <linux/usbdevice_fs.h>
#include <sys/ioctl.h>
#include <utility>

#include "tests/support/usb_emulation/Published.h"

namespace tacto::test {

namespace {

IoctlData resolve(UMockdevIoctlData* parent, std::size_t offset, std::size_t length) {
    return IoctlData(umockdev_ioctl_data_resolve(parent, offset, length, nullptr));
}

template <class T>
T& as(const IoctlData& data) {
    return *reinterpret_cast<T*>(data->data);
}

}  // namespace

EmulatedUsbDevice::Emulation::Emulation(UsbTestbed& bed, UsbDescription described, UsbBehaviour behaves, int port)
    : testbed(bed),
      description(std::move(described)),
      behaviour(std::move(behaves)),
      socket(fmt::format("1-{}", port)),
      sysfs(fmt::format("/sys/devices/pci0000:00/usb1/{}", socket)),
      wire(endpointsOf(description)),
      handler(umockdev_ioctl_base_new()) {}

void EmulatedUsbDevice::Emulation::connectTo(const std::shared_ptr<Emulation>& self) {
    connect(self->handler, "handle-ioctl", reinterpret_cast<GCallback>(&Emulation::onIoctl), self);
    connect(self->handler, "client-connected", reinterpret_cast<GCallback>(&Emulation::onConnected), self);
    connect(self->handler, "client-vanished", reinterpret_cast<GCallback>(&Emulation::onVanished), self);
}

gboolean EmulatedUsbDevice::Emulation::onIoctl(UMockdevIoctlBase*, UMockdevIoctlClient* client, gpointer user) {
    auto& self = seen<Emulation>(user);
    Answer answer;
    {
        std::unique_lock lock(self.mutex);
        answer = self.ioctl(lock, client);
    }
    publish();
    umockdev_ioctl_client_complete(client, answer.result, answer.error);
    return TRUE;
}

void EmulatedUsbDevice::Emulation::onConnected(UMockdevIoctlBase*, UMockdevIoctlClient* client, gpointer user) {
    auto& self = seen<Emulation>(user);
    const std::lock_guard lock(self.mutex);
    self.connected.insert(client);
}

void EmulatedUsbDevice::Emulation::onVanished(UMockdevIoctlBase*, UMockdevIoctlClient* client, gpointer user) {
    auto& self = seen<Emulation>(user);
    const std::lock_guard lock(self.mutex);
    self.connected.erase(client);
    std::erase_if(self.claims, [&](const auto& claim) { return claim.second == client; });
    self.wire.forget(client);
    std::erase_if(self.heldControls, [&](const Urb& urb) { return urb.owner == client; });
    self.showReapable();
}

EmulatedUsbDevice::Emulation::Answer EmulatedUsbDevice::Emulation::ioctl(std::unique_lock<std::mutex>& lock,
                                                                         UMockdevIoctlClient* client) {
    const auto request = umockdev_ioctl_client_get_request(client);
    const IoctlData argument(umockdev_ioctl_client_get_arg(client));
    g_object_ref(argument.get());  // get_arg does not pass on ownership
    const bool reaping =
        request == USBDEVFS_REAPURB || request == USBDEVFS_REAPURBNDELAY || request == USBDEVFS_DISCARDURB;
    if (!connected.contains(client) && !reaping) return refuse(ENODEV);
    const auto number = [&] { return as<unsigned>(resolve(argument.get(), 0, sizeof(unsigned))); };
    switch (request) {
        case USBDEVFS_GET_CAPABILITIES: {
            const auto data = resolve(argument.get(), 0, sizeof(std::uint32_t));
            as<std::uint32_t>(data) = USBDEVFS_CAP_ZERO_PACKET | USBDEVFS_CAP_BULK_CONTINUATION |
                                      USBDEVFS_CAP_NO_PACKET_SIZE_LIM | USBDEVFS_CAP_BULK_SCATTER_GATHER |
                                      USBDEVFS_CAP_REAP_AFTER_DISCONNECT;
            return {};
        }
        case USBDEVFS_GETDRIVER: {
            const auto data = resolve(argument.get(), 0, sizeof(usbdevfs_getdriver));
            const auto& asked = as<usbdevfs_getdriver>(data);
            const bool held =
                std::ranges::find(description.kernelInterfaces, asked.interface) != description.kernelInterfaces.end();
            const bool claimed = claims.contains(asked.interface) || elsewhere.contains(asked.interface);
            if (!claimed && !(kernelBound && held)) return refuse(ENODATA);
            auto driver = claimed ? std::string("usbfs") : description.kernelDriver;
            // The request is declared as input only (_IOW), so its result must be sent back by hand.
            umockdev_ioctl_data_update(data.get(), offsetof(usbdevfs_getdriver, driver),
                                       reinterpret_cast<std::uint8_t*>(driver.data()),
                                       static_cast<int>(driver.size() + 1));
            return {};
        }
        case USBDEVFS_IOCTL:
            return driverIoctl(argument.get());
        case USBDEVFS_CLAIMINTERFACE:
            return claim(number(), client);
        case USBDEVFS_RELEASEINTERFACE:
            return claims.erase(number()) == 1 ? Answer{} : refuse(EINVAL);
        case USBDEVFS_CLEAR_HALT:
            return clearHalt(number());
        case USBDEVFS_SETINTERFACE:
        case USBDEVFS_SETCONFIGURATION:
        case USBDEVFS_RESET:
            return {};
        case USBDEVFS_CONTROL:
            return controlNow(lock, argument.get(), client);
        case USBDEVFS_BULK:
            return bulkNow(lock, argument.get(), client);
        case USBDEVFS_SUBMITURB:
            return submit(lock, argument.get(), client);
        case USBDEVFS_REAPURB:
        case USBDEVFS_REAPURBNDELAY: {
            auto urb = wire.reap(client);
            showReapable();
            if (!urb) return refuse(connected.contains(client) ? EAGAIN : ENODEV);
            const auto pointer = resolve(argument.get(), 0, sizeof(void*));
            umockdev_ioctl_data_set_ptr(pointer.get(), 0, urb->data.get());
            return {};
        }
        case USBDEVFS_DISCARDURB: {
            const auto address = as<std::uintptr_t>(argument);
            const auto held =
                std::ranges::find_if(heldControls, [&](const Urb& urb) { return urb.data->client_addr == address; });
            if (held != heldControls.end()) {
                wire.finish(std::move(*held), -ENOENT, 0);
                heldControls.erase(held);
            } else if (!wire.discard(address)) {
                return refuse(EINVAL);
            }
            showReapable();
            return {};
        }
        default:
            return refuse(ENOTTY);
    }
}

EmulatedUsbDevice::Emulation::Answer EmulatedUsbDevice::Emulation::claim(unsigned interface, const void* client) {
    const auto& held = description.kernelInterfaces;
    const auto byKernel = kernelBound && std::ranges::find(held, interface) != held.end();
    if (byKernel || elsewhere.contains(interface)) return refuse(EBUSY);
    const auto [claimed, fresh] = claims.emplace(interface, client);
    return fresh || claimed->second == client ? Answer{} : refuse(EBUSY);
}

EmulatedUsbDevice::Emulation::Answer EmulatedUsbDevice::Emulation::driverIoctl(UMockdevIoctlData* argument) {
    const auto data = resolve(argument, 0, sizeof(usbdevfs_ioctl));
    const auto& held = description.kernelInterfaces;
    const auto interface = static_cast<unsigned>(as<usbdevfs_ioctl>(data).ifno);
    switch (as<usbdevfs_ioctl>(data).ioctl_code) {
        case USBDEVFS_DISCONNECT:
            // Like the kernel, does not check whose driver it is: this removes a program's claim as well.
            if (claims.erase(interface) + elsewhere.erase(interface) > 0) return {};
            if (!kernelBound) return refuse(ENODATA);
            kernelBound = false;
            return {};
        case USBDEVFS_CONNECT:
            // A driver of several interfaces binds through the first one, and needs all of them.
            if (kernelBound || held.empty() || held.front() != interface) return {};
            if (std::ranges::any_of(held,
                                    [&](unsigned one) { return claims.contains(one) || elsewhere.contains(one); })) {
                return refuse(EBUSY);
            }
            kernelBound = true;
            changed.notify_all();
            return {1, 0};
        default:
            return refuse(ENOTTY);
    }
}

EmulatedUsbDevice::Emulation::Answer EmulatedUsbDevice::Emulation::clearHalt(unsigned endpoint) {
    const auto address = static_cast<std::uint8_t>(endpoint);
    if (!wire.knows(address)) return refuse(ENOENT);
    wire.setHalted(address, false);
    ++cleared;
    changed.notify_all();
    return {};
}

EmulatedUsbDevice::Emulation::Answer EmulatedUsbDevice::Emulation::submit(std::unique_lock<std::mutex>& lock,
                                                                          UMockdevIoctlData* argument,
                                                                          const void* client) {
    Urb urb{resolve(argument, 0, sizeof(usbdevfs_urb)), client};
    const auto length = static_cast<std::size_t>(std::max(urb.get().buffer_length, 0));
    // The URB's data also keep the buffer; bytes written to it reach the client when the URB is reaped.
    if (length > 0) (void)resolve(urb.data.get(), offsetof(usbdevfs_urb, buffer), length);
    if (urb.get().type == USBDEVFS_URB_TYPE_CONTROL) {
        if (length < kSetupSize) return refuse(EINVAL);
        if (controlHeld) {
            heldControls.push_back(std::move(urb));
            changed.notify_all();
        } else {
            control(lock, std::move(urb));
        }
    } else {
        const auto endpoint = urb.get().endpoint;
        if (!wire.knows(endpoint)) return refuse(ENOENT);
        const auto owner = claims.find(wire.interfaceOf(endpoint));
        if (owner == claims.end() || owner->second != client) return refuse(EBUSY);
        wire.submit(std::move(urb));
    }
    pump(lock);
    return {};
}

EmulatedUsbDevice::Emulation::Answer EmulatedUsbDevice::Emulation::bulkNow(std::unique_lock<std::mutex>& lock,
                                                                           UMockdevIoctlData* argument,
                                                                           const void* client) {
    const auto data = resolve(argument, 0, sizeof(usbdevfs_bulktransfer));
    const auto& asked = as<usbdevfs_bulktransfer>(data);
    const auto endpoint = static_cast<std::uint8_t>(asked.ep);
    if (!wire.knows(endpoint)) return refuse(ENOENT);
    if ((endpoint & kInputBit) != 0) return refuse(ENOTTY);  // no test needs input endpoints here
    const auto owner = claims.find(wire.interfaceOf(endpoint));
    if (owner == claims.end() || owner->second != client) return refuse(EBUSY);
    if (!wire.takes(endpoint)) return refuse(ETIMEDOUT);
    const auto bytes = resolve(data.get(), offsetof(usbdevfs_bulktransfer, data), asked.len);
    received.emplace_back(bytes->data, bytes->data + asked.len);
    const auto copy = received.back();
    changed.notify_all();
    if (behaviour.onBytes) {
        lock.unlock();
        static_cast<void>(behaviour.onBytes(copy));
        lock.lock();
    }
    return {static_cast<long>(copy.size()), 0};
}

void EmulatedUsbDevice::Emulation::pump(std::unique_lock<std::mutex>& lock) {
    if (pumping) return;  // the caller that is pumping continues until nothing moves
    pumping = true;
    while (auto transfer = wire.advance()) {
        received.push_back(transfer->bytes);
        if (!behaviour.onBytes) continue;
        showReapable();
        lock.unlock();
        const auto answer = behaviour.onBytes(transfer->bytes);
        lock.lock();
        const auto back = static_cast<std::uint8_t>(transfer->endpoint | kInputBit);
        if (node && !answer.empty() && wire.knows(back)) wire.queue(back, answer, false);
    }
    pumping = false;
    showReapable();
}

}  // namespace tacto::test
