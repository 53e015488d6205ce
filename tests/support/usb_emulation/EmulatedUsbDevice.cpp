#include "tests/support/usb_emulation/EmulatedUsbDevice.h"

#include <algorithm>
#include <cerrno>
#include <condition_variable>
#include <cstring>
#include <fmt/format.h>
#include <linux/usbdevice_fs.h>
#include <map>
#include <mutex>
#include <set>
#include <stdexcept>
#include <sys/ioctl.h>
#include <umockdev.h>
#include <utility>

#include "tests/support/usb_emulation/Published.h"
#include "tests/support/usb_emulation/UsbNode.h"
#include "tests/support/usb_emulation/UsbWire.h"

namespace tacto::test {

namespace {

constexpr auto kPatience = std::chrono::seconds(5);
constexpr std::size_t kSetupSize = 8;
constexpr std::uint8_t kInput = 0x80;
constexpr std::uint8_t kTypeMask = 0x60;  // 0: a standard request

void check(GError* error, const char* what) {
    if (error == nullptr) return;
    const std::string text = fmt::format("{}: {}", what, error->message);
    g_error_free(error);
    throw std::runtime_error(text);
}

UsbSetup setupFrom(std::span<const std::uint8_t> b) {
    const auto word = [&](std::size_t at) { return static_cast<std::uint16_t>(b[at] | b[at + 1] << 8); };
    return {b[0], b[1], word(2), word(4), word(6)};
}

IoctlData resolve(UMockdevIoctlData* parent, std::size_t offset, std::size_t length) {
    return IoctlData(umockdev_ioctl_data_resolve(parent, offset, length, nullptr));
}

template <class T>
T& as(const IoctlData& data) {
    return *reinterpret_cast<T*>(data->data);
}

/// What an ioctl is answered with.
struct Answer {
    long result = 0;
    int error = 0;
};
Answer refuse(int error) { return {-1, error}; }

}  // namespace

struct EmulatedUsbDevice::Emulation {
    Emulation(UsbTestbed& bed, UsbDescription described, UsbBehaviour behaves, int port)
        : testbed(bed),
          description(std::move(described)),
          behaviour(std::move(behaves)),
          socket(fmt::format("1-{}", port)),
          sysfs(fmt::format("/sys/devices/pci0000:00/usb1/{}", socket)),
          wire(endpointsOf(description)),
          handler(umockdev_ioctl_base_new()) {
        g_signal_connect(handler, "handle-ioctl", reinterpret_cast<GCallback>(&Emulation::onIoctl), this);
        g_signal_connect(handler, "client-connected", reinterpret_cast<GCallback>(&Emulation::onConnected), this);
        g_signal_connect(handler, "client-vanished", reinterpret_cast<GCallback>(&Emulation::onVanished), this);
    }
    ~Emulation() {
        takeOver();
        g_object_unref(handler);
    }
    Emulation(const Emulation&) = delete;
    Emulation& operator=(const Emulation&) = delete;

    static gboolean onIoctl(UMockdevIoctlBase* /*base*/, UMockdevIoctlClient* client, gpointer user);
    static void onConnected(UMockdevIoctlBase* /*base*/, UMockdevIoctlClient* client, gpointer user);
    static void onVanished(UMockdevIoctlBase* /*base*/, UMockdevIoctlClient* client, gpointer user);

    Answer ioctl(std::unique_lock<std::mutex>& lock, UMockdevIoctlClient* client);
    Answer submit(std::unique_lock<std::mutex>& lock, UMockdevIoctlData* argument, const void* client);
    Answer claim(unsigned interface, const void* client);
    Answer driverIoctl(UMockdevIoctlData* argument);
    Answer clearHalt(unsigned endpoint);
    void control(std::unique_lock<std::mutex>& lock, Urb urb);
    std::optional<UsbBytes> standard(const UsbSetup& setup) const;
    /// Moves what can move; calls the device with the lock let go.
    void pump(std::unique_lock<std::mutex>& lock);
    void showReapable() {
        if (node) node->setReapable(wire.canReap());
        changed.notify_all();
    }

    UsbTestbed& testbed;
    const UsbDescription description;
    const UsbBehaviour behaviour;
    const std::string socket;
    const std::string sysfs;

    mutable std::mutex mutex;  // guards all below
    mutable std::condition_variable changed;
    UsbWire wire;
    UMockdevIoctlBase* const handler;
    std::unique_ptr<UsbNode> node;  // null: unplugged
    std::string path;               // of the node, as "/dev/bus/usb/001/002"
    unsigned mode = 0666;
    bool kernelBound = false;
    std::set<const void*> connected;  // open files of this plug-in; those of an earlier one stay dead
    std::map<unsigned, const void*> claims;
    std::set<unsigned> elsewhere;
    bool controlHeld = false;
    bool pumping = false;
    std::vector<Urb> heldControls;
    std::vector<UsbBytes> received;
    std::vector<UsbSetup> requests;
    int cleared = 0;
};

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

Answer EmulatedUsbDevice::Emulation::ioctl(std::unique_lock<std::mutex>& lock, UMockdevIoctlClient* client) {
    const auto request = umockdev_ioctl_client_get_request(client);
    const IoctlData argument(umockdev_ioctl_client_get_arg(client));
    g_object_ref(argument.get());  // get_arg lends
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
            auto& asked = as<usbdevfs_getdriver>(data);
            const bool held =
                std::ranges::find(description.kernelInterfaces, asked.interface) != description.kernelInterfaces.end();
            if (!kernelBound || !held) return refuse(ENODATA);
            std::strncpy(asked.driver, description.kernelDriver.c_str(), sizeof asked.driver - 1);
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

Answer EmulatedUsbDevice::Emulation::claim(unsigned interface, const void* client) {
    const auto& held = description.kernelInterfaces;
    const auto byKernel = kernelBound && std::ranges::find(held, interface) != held.end();
    if (byKernel || elsewhere.contains(interface)) return refuse(EBUSY);
    const auto [claimed, fresh] = claims.emplace(interface, client);
    return fresh || claimed->second == client ? Answer{} : refuse(EBUSY);
}

Answer EmulatedUsbDevice::Emulation::driverIoctl(UMockdevIoctlData* argument) {
    const auto data = resolve(argument, 0, sizeof(usbdevfs_ioctl));
    const auto& held = description.kernelInterfaces;
    switch (as<usbdevfs_ioctl>(data).ioctl_code) {
        case USBDEVFS_DISCONNECT:
            if (!kernelBound) return refuse(ENODATA);
            kernelBound = false;
            return {};
        case USBDEVFS_CONNECT:
            // A driver of several interfaces binds through its first, and needs all of them.
            if (kernelBound || held.empty() || held.front() != as<usbdevfs_ioctl>(data).ifno) return {};
            if (std::ranges::any_of(held, [&](unsigned interface) { return claims.contains(interface); })) {
                return refuse(EBUSY);
            }
            kernelBound = true;
            return {1, 0};
        default:
            return refuse(ENOTTY);
    }
}

Answer EmulatedUsbDevice::Emulation::clearHalt(unsigned endpoint) {
    const auto address = static_cast<std::uint8_t>(endpoint);
    if (!wire.knows(address)) return refuse(ENOENT);
    wire.setHalted(address, false);
    ++cleared;
    changed.notify_all();
    return {};
}

Answer EmulatedUsbDevice::Emulation::submit(std::unique_lock<std::mutex>& lock, UMockdevIoctlData* argument,
                                            const void* client) {
    Urb urb{resolve(argument, 0, sizeof(usbdevfs_urb)), client};
    const auto length = static_cast<std::size_t>(std::max(urb.get().buffer_length, 0));
    // The URB's data keep the buffer's; writing to one reaches the client when the URB is reaped.
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

void EmulatedUsbDevice::Emulation::control(std::unique_lock<std::mutex>& lock, Urb urb) {
    const auto buffer = urb.buffer();
    const auto setup = setupFrom(buffer);
    const bool input = (setup.type & kInput) != 0;
    const auto data = buffer.subspan(kSetupSize, std::min<std::size_t>(buffer.size() - kSetupSize, setup.length));
    std::optional<UsbBytes> answer;
    if ((setup.type & kTypeMask) == 0 && (setup.type & 0x1F) == 0) {
        answer = standard(setup);
    } else {
        requests.push_back(setup);
        if (behaviour.onRequest) {
            lock.unlock();
            answer = behaviour.onRequest(setup, input ? std::span<std::uint8_t>{} : data);
            lock.lock();
        } else if (!input) {
            answer.emplace();
        }
    }
    if (!answer) {
        wire.finish(std::move(urb), -EPIPE, 0);
    } else if (!input) {
        wire.finish(std::move(urb), 0, data.size());
    } else {
        const std::size_t taken = std::min(answer->size(), data.size());
        std::copy_n(answer->begin(), taken, data.begin());
        // More than was asked for is babble on the bus.
        const int status = answer->size() > data.size() ? -EOVERFLOW : 0;
        wire.finish(std::move(urb), status, taken);
    }
}

std::optional<UsbBytes> EmulatedUsbDevice::Emulation::standard(const UsbSetup& setup) const {
    constexpr std::uint8_t kGetDescriptor = 6;
    if (setup.type != kInput || setup.request != kGetDescriptor) return std::nullopt;
    const auto upTo = [&](UsbBytes bytes) {
        bytes.resize(std::min<std::size_t>(bytes.size(), setup.length));
        return bytes;
    };
    switch (setup.value >> 8) {
        case 1:
            return upTo(description.deviceDescriptor());
        case 2:
            return upTo(description.configuration);
        case 3:
            break;
        default:
            return std::nullopt;
    }
    const std::string* texts[] = {nullptr, &description.maker, &description.name, &description.serial};
    const std::size_t index = setup.value & 0xFF;
    if (index == 0) return upTo({4, 3, 9, 4});  // English (United States)
    if (index >= std::size(texts)) return std::nullopt;
    UsbBytes text{static_cast<std::uint8_t>(2 + 2 * texts[index]->size()), 3};
    for (const char c : *texts[index]) {
        text.push_back(static_cast<std::uint8_t>(c));
        text.push_back(0);
    }
    return upTo(std::move(text));
}

void EmulatedUsbDevice::Emulation::pump(std::unique_lock<std::mutex>& lock) {
    if (pumping) return;  // whoever is at it goes on until nothing moves
    pumping = true;
    while (auto transfer = wire.advance()) {
        received.push_back(transfer->bytes);
        if (!behaviour.onBytes) continue;
        showReapable();
        lock.unlock();
        const auto answer = behaviour.onBytes(transfer->bytes);
        lock.lock();
        const auto back = static_cast<std::uint8_t>(transfer->endpoint | kInput);
        if (node && !answer.empty() && wire.knows(back)) wire.queue(back, answer, false);
    }
    pumping = false;
    showReapable();
}

EmulatedUsbDevice::EmulatedUsbDevice(UsbTestbed& testbed, UsbDescription description, UsbBehaviour behaviour, int port,
                                     bool plugged)
    : emulation_(std::make_unique<Emulation>(testbed, std::move(description), std::move(behaviour), port)) {
    if (plugged) plug();
}

EmulatedUsbDevice::~EmulatedUsbDevice() { unplug(); }

void EmulatedUsbDevice::plug() {
    auto& e = *emulation_;
    const auto address = e.testbed.nextAddress();
    {
        const std::lock_guard lock(e.mutex);
        if (e.node) return;
        e.wire = UsbWire(endpointsOf(e.description));
        e.claims.clear();
        e.kernelBound = !e.description.kernelInterfaces.empty();
        e.path = fmt::format("/dev/bus/usb/001/{:03}", address);
        e.node = std::make_unique<UsbNode>(e.testbed.root() / e.path.substr(1), e.mode);
    }
    GError* error = nullptr;
    publish();
    umockdev_testbed_attach_ioctl(e.testbed.get(), e.path.c_str(), e.handler, &error);
    check(error, "attaching an emulated USB device");
    const auto& d = e.description;
    std::string descriptors;
    for (const auto byte : d.deviceDescriptor()) descriptors += fmt::format("{:02X}", byte);
    for (const auto byte : d.configuration) descriptors += fmt::format("{:02X}", byte);
    const auto text = fmt::format(
        "P: {}\nE: SUBSYSTEM=usb\nE: DEVTYPE=usb_device\nE: DRIVER=usb\nE: BUSNUM=001\nE: DEVNUM={:03}\n"
        "E: DEVNAME={}\nE: MAJOR=189\nE: MINOR={}\nE: PRODUCT={:x}/{:x}/100\nA: busnum=1\\n\nA: devnum={}\\n\n"
        "A: speed={}\\n\nA: bConfigurationValue=1\\n\nA: idVendor={:04x}\\n\nA: idProduct={:04x}\\n\n"
        "A: manufacturer={}\\n\nA: product={}\\n\nA: serial={}\\n\nH: descriptors={}\n",
        e.sysfs.substr(4), address, e.path, address - 1, d.vendor, d.product, address, d.speed_mbit, d.vendor,
        d.product, d.maker, d.name, d.serial, descriptors);
    umockdev_testbed_add_from_string(e.testbed.get(), text.c_str(), &error);
    check(error, "plugging in an emulated USB device");
}

void EmulatedUsbDevice::unplug() {
    auto& e = *emulation_;
    std::unique_ptr<UsbNode> node;
    {
        const std::lock_guard lock(e.mutex);
        if (!e.node) return;
        node = std::move(e.node);
        for (auto& urb : e.heldControls) e.wire.finish(std::move(urb), -ESHUTDOWN, 0);
        e.heldControls.clear();
        e.wire.disconnect();
        e.connected.clear();
        e.claims.clear();
        e.kernelBound = false;
        e.changed.notify_all();
    }
    node.reset();
    umockdev_testbed_detach_ioctl(e.testbed.get(), e.path.c_str(), nullptr);
    umockdev_testbed_uevent(e.testbed.get(), e.sysfs.c_str(), "remove");
    umockdev_testbed_remove_device(e.testbed.get(), e.sysfs.c_str());
}

std::string EmulatedUsbDevice::socket() const { return emulation_->socket; }
std::string EmulatedUsbDevice::sysfs() const { return emulation_->sysfs; }

void EmulatedUsbDevice::send(std::uint8_t endpoint, std::span<const std::uint8_t> bytes, bool end) {
    std::unique_lock lock(emulation_->mutex);
    if (!emulation_->node) return;
    emulation_->wire.queue(endpoint, bytes, end);
    emulation_->pump(lock);
}

void EmulatedUsbDevice::sendPacket(std::uint8_t endpoint, std::span<const std::uint8_t> packet) {
    std::unique_lock lock(emulation_->mutex);
    if (!emulation_->node) return;
    emulation_->wire.queuePacket(endpoint, packet);
    emulation_->pump(lock);
}

void EmulatedUsbDevice::stall(std::uint8_t endpoint) {
    std::unique_lock lock(emulation_->mutex);
    emulation_->wire.setHalted(endpoint, true);
    emulation_->pump(lock);
}

void EmulatedUsbDevice::hold(std::uint8_t endpoint, bool held) {
    auto& e = *emulation_;
    std::unique_lock lock(e.mutex);
    if (endpoint != 0) {
        e.wire.setHeld(endpoint, held);
    } else {
        e.controlHeld = held;
        if (!held) {
            for (auto& urb : std::exchange(e.heldControls, {})) e.control(lock, std::move(urb));
        }
    }
    e.pump(lock);
}

void EmulatedUsbDevice::takeOnly(std::uint8_t endpoint, std::size_t bytes) {
    const std::lock_guard lock(emulation_->mutex);
    emulation_->wire.takeOnly(endpoint, bytes);
}

void EmulatedUsbDevice::permit(bool permitted) {
    const std::lock_guard lock(emulation_->mutex);
    emulation_->mode = permitted ? 0666 : 0;
    if (emulation_->node) emulation_->node->setMode(emulation_->mode);
}

void EmulatedUsbDevice::claimElsewhere(std::uint8_t interface) {
    const std::lock_guard lock(emulation_->mutex);
    emulation_->kernelBound = false;
    emulation_->elsewhere.insert(interface);
}

bool EmulatedUsbDevice::waitForWaiting(std::uint8_t endpoint, std::size_t transfers) const {
    auto& e = *emulation_;
    std::unique_lock lock(e.mutex);
    return e.changed.wait_for(lock, kPatience, [&] {
        return (endpoint == 0 ? e.heldControls.size() : e.wire.waitingAt(endpoint)) >= transfers;
    });
}

std::vector<UsbBytes> EmulatedUsbDevice::waitForReceived(std::size_t transfers) const {
    std::unique_lock lock(emulation_->mutex);
    emulation_->changed.wait_for(lock, kPatience, [&] { return emulation_->received.size() >= transfers; });
    return emulation_->received;
}

std::vector<UsbSetup> EmulatedUsbDevice::requests() const {
    const std::lock_guard lock(emulation_->mutex);
    return emulation_->requests;
}

bool EmulatedUsbDevice::kernelDriverBound() const {
    const std::lock_guard lock(emulation_->mutex);
    return emulation_->kernelBound;
}

int EmulatedUsbDevice::cleared() const {
    const std::lock_guard lock(emulation_->mutex);
    return emulation_->cleared;
}

}  // namespace tacto::test
