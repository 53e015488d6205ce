#include <algorithm>
#include <cerrno>
#include <cstring>
#include <linux/hidraw.h>
#include <sys/ioctl.h>
#include <utility>

#include "tests/support/usb_emulation/HidEmulation.h"
#include "tests/support/usb_emulation/Published.h"

namespace tacto::test {

namespace {

constexpr long kRealRead = -100;  // tells umockdev to pass the read() on to the FIFO

}  // namespace

gboolean EmulatedHidDevice::Emulation::onIoctl(UMockdevIoctlBase*, UMockdevIoctlClient* client, gpointer user) {
    int error = 0;
    const long result = seen<Emulation>(user).ioctl(client, error);
    publish();
    umockdev_ioctl_client_complete(client, result, error);
    return TRUE;
}

gboolean EmulatedHidDevice::Emulation::onRead(UMockdevIoctlBase*, UMockdevIoctlClient* client, gpointer user) {
    auto& self = seen<Emulation>(user);
    bool there = false;
    {
        const std::lock_guard lock(self.mutex);
        there = self.fifo != nullptr;
    }
    umockdev_ioctl_client_complete(client, there ? kRealRead : -1, there ? 0 : EIO);
    return TRUE;
}

gboolean EmulatedHidDevice::Emulation::onWrite(UMockdevIoctlBase*, UMockdevIoctlClient* client, gpointer user) {
    auto& self = seen<Emulation>(user);
    {
        const std::lock_guard lock(self.mutex);
        if (self.held && self.fifo) {
            g_object_ref(client);
            self.waiting.push_back(client);
            self.changed.notify_all();
            return TRUE;
        }
    }
    self.write(client);
    return TRUE;
}

void EmulatedHidDevice::Emulation::onConnected(UMockdevIoctlBase*, UMockdevIoctlClient*, gpointer user) {
    auto& self = seen<Emulation>(user);
    const std::lock_guard lock(self.mutex);
    ++self.readers;
}

void EmulatedHidDevice::Emulation::onVanished(UMockdevIoctlBase*, UMockdevIoctlClient* client, gpointer user) {
    auto& self = seen<Emulation>(user);
    const std::lock_guard lock(self.mutex);
    if (std::erase(self.waiting, client) > 0) g_object_unref(client);
    if (--self.readers == 0 && self.fifo) self.fifo->drain();
}

long EmulatedHidDevice::Emulation::ioctl(UMockdevIoctlClient* client, int& error) {
    const auto request = umockdev_ioctl_client_get_request(client);
    const std::size_t length = _IOC_SIZE(request);
    const auto refuse = [&error](int code) {
        error = code;
        return -1L;
    };
    {
        const std::lock_guard lock(mutex);
        if (!fifo) return refuse(ENODEV);
    }
    auto* data = umockdev_ioctl_data_resolve(umockdev_ioctl_client_get_arg(client), 0, length, nullptr);
    const std::unique_ptr<UMockdevIoctlData, void (*)(gpointer)> release(data, &g_object_unref);
    const std::span<std::uint8_t> bytes{data->data, length};
    const auto put = [&](std::span<const std::uint8_t> content) {
        const std::size_t taken = std::min(content.size(), bytes.size());
        std::copy_n(content.begin(), taken, bytes.begin());
        return static_cast<long>(taken);
    };
    switch (_IOC_NR(request)) {
        case _IOC_NR(HIDIOCGRDESCSIZE): {
            const int size = static_cast<int>(descriptor.size());
            std::memcpy(bytes.data(), &size, sizeof size);
            return 0;
        }
        case _IOC_NR(HIDIOCGRDESC): {
            auto& wanted = *reinterpret_cast<hidraw_report_descriptor*>(bytes.data());
            std::copy_n(descriptor.begin(), std::min<std::size_t>(descriptor.size(), wanted.size), wanted.value);
            return 0;
        }
        case _IOC_NR(HIDIOCGRAWINFO): {
            constexpr unsigned kBusUsb = 3;
            const hidraw_devinfo info{kBusUsb, static_cast<__s16>(vendor), static_cast<__s16>(product)};
            std::memcpy(bytes.data(), &info, sizeof info);
            return 0;
        }
        case _IOC_NR(HIDIOCGRAWNAME(0)): {
            constexpr std::string_view kName = "Acme Loopback HID";
            return put({reinterpret_cast<const std::uint8_t*>(kName.data()), kName.size() + 1});
        }
        // Both requests begin with the report's number, 0 if reports have none.
        case _IOC_NR(HIDIOCSFEATURE(0)):
            setFeature(numbered ? bytes : bytes.subspan(1), bytes[0]);
            return static_cast<long>(length);
        case _IOC_NR(HIDIOCGFEATURE(0)): {
            auto report = getFeature(bytes[0]);
            if (!report) return refuse(EPIPE);
            if (!numbered) report->insert(report->begin(), std::uint8_t{0});
            return put(*report);
        }
        default:
            return refuse(EINVAL);
    }
}

void EmulatedHidDevice::Emulation::write(UMockdevIoctlClient* client) {
    const auto* argument = umockdev_ioctl_client_get_arg(client);
    std::span<const std::uint8_t> bytes{argument->data, static_cast<std::size_t>(argument->data_len)};
    int error = 0;
    long taken = static_cast<long>(bytes.size());
    {
        const std::lock_guard lock(mutex);
        error = fifo ? writeError : EIO;
        if (takeOnly) taken = static_cast<long>(std::min(*takeOnly, bytes.size()));
        takeOnly.reset();
    }
    if (error != 0) {
        publish();
        umockdev_ioctl_client_complete(client, -1, error);
        return;
    }
    // Byte 0 is the report's number; it is sent over the bus only if reports have one.
    const auto answers = take(numbered ? bytes : bytes.subspan(std::min<std::size_t>(1, bytes.size())));
    {
        const std::lock_guard lock(mutex);
        for (const auto& answer : answers) {
            if (fifo && readers > 0) (void)fifo->put(answer);  // a full FIFO drops the report, as the kernel does
        }
    }
    publish();
    umockdev_ioctl_client_complete(client, taken, 0);
}

void EmulatedHidDevice::Emulation::releaseHeld() {
    std::vector<UMockdevIoctlClient*> clients;
    {
        const std::lock_guard lock(mutex);
        clients = std::exchange(waiting, {});
    }
    for (auto* client : clients) {
        write(client);
        g_object_unref(client);
    }
}

}  // namespace tacto::test
