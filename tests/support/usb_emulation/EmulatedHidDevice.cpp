#include "tests/support/usb_emulation/EmulatedHidDevice.h"

#include <algorithm>
#include <cerrno>
#include <condition_variable>
#include <cstring>
#include <fmt/format.h>
#include <linux/hidraw.h>
#include <map>
#include <mutex>
#include <stdexcept>
#include <sys/ioctl.h>
#include <umockdev.h>
#include <utility>

#include "tests/support/usb_emulation/HidrawNode.h"
#include "tests/support/usb_emulation/Published.h"

namespace tacto::test {

namespace {

constexpr auto kPatience = std::chrono::seconds(5);
constexpr long kRealRead = -100;  // umockdev: let the read() through to the FIFO
constexpr std::uint8_t kInput = 0x81;
// HID 1.11, sections 7.1 and 7.2.
constexpr std::uint8_t kGetReport = 1;
constexpr std::uint8_t kSetReport = 9;
constexpr std::uint8_t kSetIdle = 10;
constexpr unsigned kFeature = 3;

/// Whether the descriptor has a Report ID item (HID 1.11, section 6.2.2).
bool numbersReports(std::span<const std::uint8_t> descriptor) {
    constexpr std::uint8_t kReportId = 0x84;
    for (std::size_t at = 0; at < descriptor.size();) {
        if ((descriptor[at] & 0xFC) == kReportId) return true;
        const std::size_t size = descriptor[at] & 3U;
        at += 1 + (size == 3 ? 4 : size);
    }
    return false;
}

void check(GError* error) {
    if (error == nullptr) return;
    const std::string text = error->message;
    g_error_free(error);
    throw std::runtime_error("plugging in an emulated HID device: " + text);
}

}  // namespace

struct EmulatedHidDevice::Emulation {
    Emulation(UsbTestbed& bed, std::uint16_t vendorId, std::uint16_t productId, std::string serialNumber,
              UsbBytes reportDescriptor, HidBehaviour behaves, int port)
        : testbed(bed),
          vendor(vendorId),
          product(productId),
          serial(std::move(serialNumber)),
          descriptor(std::move(reportDescriptor)),
          numbered(numbersReports(descriptor)),
          behaviour(std::move(behaves)),
          node(fmt::format("/dev/hidraw{}", port - 1)),
          minor(port - 1),
          handler(umockdev_ioctl_base_new()),
          usb(bed, hidDevice(vendor, product, serial, descriptor.size()),
              {[this](auto bytes) { return fromUsb(bytes); },
               [this](const auto& setup, auto data) { return request(setup, data); }},
              port, false) {
        const auto on = [this](const char* signal, auto callback) {
            g_signal_connect(handler, signal, reinterpret_cast<GCallback>(callback), this);
        };
        on("handle-ioctl", &Emulation::onIoctl);
        on("handle-read", &Emulation::onRead);
        on("handle-write", &Emulation::onWrite);
        on("client-connected", &Emulation::onConnected);
        on("client-vanished", &Emulation::onVanished);
    }
    ~Emulation() {
        takeOver();
        g_object_unref(handler);
    }
    Emulation(const Emulation&) = delete;
    Emulation& operator=(const Emulation&) = delete;

    static gboolean onIoctl(UMockdevIoctlBase*, UMockdevIoctlClient* client, gpointer user);
    static gboolean onRead(UMockdevIoctlBase*, UMockdevIoctlClient* client, gpointer user);
    static gboolean onWrite(UMockdevIoctlBase*, UMockdevIoctlClient* client, gpointer user);
    static void onConnected(UMockdevIoctlBase*, UMockdevIoctlClient*, gpointer user);
    static void onVanished(UMockdevIoctlBase*, UMockdevIoctlClient* client, gpointer user);

    [[nodiscard]] std::string hidFolder() const {
        return fmt::format("{}/{}:1.0/0003:{:04X}:{:04X}.0001", usb.sysfs(), usb.socket(), vendor, product);
    }
    long ioctl(UMockdevIoctlClient* client, int& error);
    void write(UMockdevIoctlClient* client);
    std::vector<UsbBytes> take(std::span<const std::uint8_t> report);
    UsbBytes fromUsb(std::span<const std::uint8_t> report);
    std::optional<UsbBytes> request(const UsbSetup& setup, std::span<const std::uint8_t> data);
    void setFeature(std::span<const std::uint8_t> report, std::uint8_t number);
    std::optional<UsbBytes> getFeature(std::uint8_t number);
    void releaseHeld();

    UsbTestbed& testbed;
    const std::uint16_t vendor;
    const std::uint16_t product;
    const std::string serial;
    const UsbBytes descriptor;
    const bool numbered;
    const HidBehaviour behaviour;
    const std::string node;
    const int minor;
    UMockdevIoctlBase* const handler;

    mutable std::mutex mutex;  // guards all below but usb
    mutable std::condition_variable changed;
    std::unique_ptr<HidrawNode> fifo;  // null: unplugged
    int readers = 0;
    std::vector<UsbBytes> reports;
    std::vector<UsbBytes> set;
    std::map<std::uint8_t, UsbBytes> features;
    std::optional<std::size_t> takeOnly;
    int writeError = 0;
    bool held = false;
    std::vector<UMockdevIoctlClient*> waiting;  // referenced

    EmulatedUsbDevice usb;
};

// hidraw ----------------------------------------------------------------------------------------------------------

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
        // Both start with the report's number, 0 where reports have none.
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
    // Byte 0 is the report's number; it goes over the wire only where reports have one.
    const auto answers = take(numbered ? bytes : bytes.subspan(std::min<std::size_t>(1, bytes.size())));
    {
        const std::lock_guard lock(mutex);
        for (const auto& answer : answers) {
            if (fifo && readers > 0) (void)fifo->put(answer);  // a full one drops, as the kernel's
        }
    }
    publish();
    umockdev_ioctl_client_complete(client, taken, 0);
}

// Both ways in ----------------------------------------------------------------------------------------------------

std::vector<UsbBytes> EmulatedHidDevice::Emulation::take(std::span<const std::uint8_t> report) {
    {
        const std::lock_guard lock(mutex);
        reports.emplace_back(report.begin(), report.end());
        changed.notify_all();
    }
    return behaviour.onReport ? behaviour.onReport(report) : std::vector<UsbBytes>{};
}

UsbBytes EmulatedHidDevice::Emulation::fromUsb(std::span<const std::uint8_t> report) {
    for (const auto& answer : take(report)) usb.send(kInput, answer);
    return {};
}

std::optional<UsbBytes> EmulatedHidDevice::Emulation::request(const UsbSetup& setup,
                                                              std::span<const std::uint8_t> data) {
    constexpr std::uint8_t kToInterface = 0x21;
    constexpr std::uint8_t kFromInterface = 0xA1;
    const auto number = static_cast<std::uint8_t>(setup.value & 0xFF);
    const unsigned kind = setup.value >> 8;
    if (setup.type == kToInterface && setup.request == kSetIdle) return UsbBytes{};
    if (setup.type == kToInterface && setup.request == kSetReport) {
        if (kind == kFeature)
            setFeature(data, number);
        else
            for (const auto& answer : take(data)) usb.send(kInput, answer);
        return UsbBytes{};
    }
    if (setup.type == kFromInterface && setup.request == kGetReport && kind == kFeature) return getFeature(number);
    constexpr unsigned kReportDescriptor = 0x22;
    if (setup.type == 0x81 && setup.request == 6 && kind == kReportDescriptor) {
        return UsbBytes(descriptor.begin(),
                        descriptor.begin() + std::min<std::ptrdiff_t>(std::ssize(descriptor), setup.length));
    }
    return std::nullopt;
}

void EmulatedHidDevice::Emulation::setFeature(std::span<const std::uint8_t> report, std::uint8_t number) {
    const std::lock_guard lock(mutex);
    features[number].assign(report.begin(), report.end());
    set.emplace_back(report.begin(), report.end());
    changed.notify_all();
}

std::optional<UsbBytes> EmulatedHidDevice::Emulation::getFeature(std::uint8_t number) {
    if (behaviour.onFeature) {
        if (auto report = behaviour.onFeature(number)) return report;
    }
    const std::lock_guard lock(mutex);
    const auto known = features.find(number);
    if (known == features.end()) return std::nullopt;
    return known->second;
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

// What a test calls -----------------------------------------------------------------------------------------------

EmulatedHidDevice::EmulatedHidDevice(UsbTestbed& testbed, std::uint16_t vendor, std::uint16_t product,
                                     std::string serial, UsbBytes reportDescriptor, HidBehaviour behaviour, int port)
    : emulation_(std::make_unique<Emulation>(testbed, vendor, product, std::move(serial), std::move(reportDescriptor),
                                             std::move(behaviour), port)) {
    plug();
}

EmulatedHidDevice::~EmulatedHidDevice() { unplug(); }

void EmulatedHidDevice::plug() {
    auto& e = *emulation_;
    {
        const std::lock_guard lock(e.mutex);
        if (e.fifo) return;
        e.fifo = std::make_unique<HidrawNode>(e.testbed.root() / e.node.substr(1));
        e.readers = 0;
    }
    auto* bed = e.testbed.get();
    GError* error = nullptr;
    publish();
    umockdev_testbed_attach_ioctl(bed, e.node.c_str(), e.handler, &error);
    check(error);
    e.usb.plug();
    const auto add = [&](const std::string& text) {
        umockdev_testbed_add_from_string(bed, text.c_str(), &error);
        check(error);
    };
    const auto hid = e.hidFolder();
    add(
        fmt::format("P: {}/{}:1.0\nE: SUBSYSTEM=usb\nE: DEVTYPE=usb_interface\nE: DRIVER=usbhid\nE: INTERFACE=3/0/0\n"
                    "A: bInterfaceNumber=00\\n\n",
                    e.usb.sysfs().substr(4), e.usb.socket()));
    add(
        fmt::format("P: {}\nE: SUBSYSTEM=hid\nE: DRIVER=hid-generic\nE: HID_ID=0003:{:08X}:{:08X}\n"
                    "E: HID_NAME=Acme Loopback HID\nE: HID_UNIQ={}\nE: HID_PHYS=usb-0/input0\n",
                    hid.substr(4), e.vendor, e.product, e.serial));
    auto descriptor = e.descriptor;
    umockdev_testbed_set_attribute_binary(bed, hid.c_str(), "report_descriptor", descriptor.data(),
                                          static_cast<int>(descriptor.size()));
    add(
        fmt::format("P: {}/hidraw/{}\nE: SUBSYSTEM=hidraw\nE: DEVNAME={}\nE: MAJOR=240\nE: MINOR={}\n"
                    "L: device=../../../0003:{:04X}:{:04X}.0001\n",
                    hid.substr(4), e.node.substr(5), e.node, e.minor, e.vendor, e.product));
}

void EmulatedHidDevice::unplug() {
    auto& e = *emulation_;
    std::unique_ptr<HidrawNode> fifo;
    {
        const std::lock_guard lock(e.mutex);
        if (!e.fifo) return;
        fifo = std::move(e.fifo);
        constexpr std::uint8_t kWake[] = {0};  // whoever waits in poll() reads, and read() says EIO
        (void)fifo->put(kWake);
        e.changed.notify_all();
    }
    e.releaseHeld();
    fifo.reset();
    auto* bed = e.testbed.get();
    umockdev_testbed_detach_ioctl(bed, e.node.c_str(), nullptr);
    const auto hid = e.hidFolder();
    const auto raw = hid + "/hidraw/" + e.node.substr(5);
    umockdev_testbed_uevent(bed, raw.c_str(), "remove");
    for (const auto& folder : {raw, hid, e.usb.sysfs() + "/" + e.usb.socket() + ":1.0"}) {
        umockdev_testbed_remove_device(bed, folder.c_str());
    }
    e.usb.unplug();
}

void EmulatedHidDevice::send(std::span<const std::uint8_t> report) {
    auto& e = *emulation_;
    if (!e.usb.kernelDriverBound()) {
        e.usb.send(kInput, report);
        return;
    }
    const std::lock_guard lock(e.mutex);
    if (e.fifo && e.readers > 0) (void)e.fifo->put(report);
}

void EmulatedHidDevice::takeOnly(std::size_t bytes) {
    const std::lock_guard lock(emulation_->mutex);
    emulation_->takeOnly = bytes;
}

void EmulatedHidDevice::refuseWrites(int error) {
    const std::lock_guard lock(emulation_->mutex);
    emulation_->writeError = error;
}

void EmulatedHidDevice::hold(bool held) {
    {
        const std::lock_guard lock(emulation_->mutex);
        emulation_->held = held;
    }
    if (!held) emulation_->releaseHeld();
}

std::vector<UsbBytes> EmulatedHidDevice::waitForReports(std::size_t count) const {
    std::unique_lock lock(emulation_->mutex);
    emulation_->changed.wait_for(lock, kPatience, [&] { return emulation_->reports.size() >= count; });
    return emulation_->reports;
}

std::vector<UsbBytes> EmulatedHidDevice::featuresSet() const {
    const std::lock_guard lock(emulation_->mutex);
    return emulation_->set;
}

EmulatedUsbDevice& EmulatedHidDevice::usb() noexcept { return emulation_->usb; }

}  // namespace tacto::test
