#include "drivers/hid_massager/HidapiBackend.h"

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <mutex>
#include <unistd.h>

#include "drivers/hid_massager/HidapiCalls.h"
#include "drivers/hid_massager/WatchdogProcess.h"
#include "drivers/system/FileHolders.h"
#include "drivers/system/KernelNodes.h"
#include "drivers/system/Permission.h"

namespace tacto::hid {

namespace {

constexpr std::size_t kMaxText = 126;  // characters of a USB string descriptor: (255 - 2) / 2

/// A device's own text: untrusted, and other alphabets are not worth a conversion.
std::string plain(const wchar_t* text) {
    std::string out;
    for (; text != nullptr && *text != L'\0' && out.size() < kMaxText; ++text) {
        out += *text >= L' ' && *text <= L'~' ? static_cast<char>(*text) : '?';
    }
    return out;
}

/// The first report descriptor that the kernel read from the device: HID interface folders lie below `folder`.
Result<std::vector<std::uint8_t>> readDescriptor(const std::filesystem::path& folder, const std::string& label) {
    std::error_code error;
    auto file = folder / "report_descriptor";
    if (!std::filesystem::exists(file, error)) {
        for (std::filesystem::directory_iterator at(folder, error), end; !error && at != end; at.increment(error)) {
            if (std::error_code none; std::filesystem::exists(at->path() / "report_descriptor", none)) {
                file = at->path() / "report_descriptor";
            }
        }
    }
    std::ifstream in(file, std::ios::binary);
    if (!in) {
        return fail(ErrorCode::NotFound, "{}: the system shows no report descriptor at {}", label, folder.string());
    }
    std::vector<std::uint8_t> bytes(kMaxDescriptor + 1);  // one more, so that too long is seen
    in.read(reinterpret_cast<char*>(bytes.data()), static_cast<std::streamsize>(bytes.size()));
    if (in.bad()) return fail(ErrorCode::Io, "{}: its report descriptor cannot be read", label);
    bytes.resize(static_cast<std::size_t>(in.gcount()));
    return bytes;
}

std::string lineOf(const std::filesystem::path& file) {
    std::ifstream in(file);
    std::string line;
    std::getline(in, line);
    return line;
}

/// The first interrupt OUT endpoint of an interface, as hidapi chooses it, in the descriptors that the kernel read; 0
/// where it has none.
std::uint8_t interruptOut(const std::filesystem::path& descriptors, std::uint8_t interface) {
    constexpr std::uint8_t kInterface = 4;
    constexpr std::uint8_t kEndpoint = 5;
    constexpr std::uint8_t kInput = 0x80;
    constexpr std::uint8_t kTypeMask = 3;
    constexpr std::uint8_t kInterrupt = 3;
    std::ifstream in(descriptors, std::ios::binary);
    const std::vector<char> bytes{std::istreambuf_iterator<char>(in), {}};
    const auto at = [&](std::size_t i) { return static_cast<std::uint8_t>(bytes[i]); };
    bool ours = false;
    for (std::size_t i = 0; i + 3 < bytes.size() && at(i) >= 4 && i + at(i) <= bytes.size(); i += at(i)) {
        if (at(i + 1) == kInterface) ours = at(i + 2) == interface;
        if (ours && at(i + 1) == kEndpoint && (at(i + 2) & kInput) == 0 && (at(i + 3) & kTypeMask) == kInterrupt) {
            return at(i + 2);
        }
    }
    return 0;
}

/// hid_write() of the libusb backend: the interrupt endpoint, or SET_REPORT where there is none (HID 1.11, 7.2.2).
StopWay usbStopWay(const std::string& path, std::string node, std::span<const std::uint8_t> stop) {
    constexpr std::uint8_t kToInterface = 0x21;
    constexpr std::uint8_t kSetReport = 9;
    constexpr std::uint8_t kOutput = 2;
    StopWay way;
    way.kind = StopWay::Kind::Usb;
    way.node = std::move(node);
    const auto dot = path.rfind('.');  // "1-4.2:1.0" is configuration 1, interface 0
    if (dot != std::string::npos)
        way.interface = static_cast<std::uint8_t>(std::strtoul(path.c_str() + dot + 1, nullptr, 16));
    const auto sys = std::filesystem::path("/sys/bus/usb/devices") / path.substr(0, path.find(':'));
    way.endpoint = interruptOut(sys / "descriptors", way.interface);
    // A device without report numbers is not sent the 0 in front.
    const auto bytes = stop.subspan(stop[0] == 0 ? 1 : 0);
    way.bytes.assign(bytes.begin(), bytes.end());
    if (way.endpoint == 0) {
        way.setup = {kToInterface,
                     kSetReport,
                     stop[0],
                     kOutput,
                     way.interface,
                     0,
                     static_cast<std::uint8_t>(bytes.size()),
                     static_cast<std::uint8_t>(bytes.size() >> 8)};
    }
    return way;
}

class HidapiPort final : public HidPort {
public:
    using MakeStopWay = std::function<StopWay(std::span<const std::uint8_t>)>;

    HidapiPort(const HidapiCalls& calls, hid_device* device, std::string label, MakeStopWay stopWay)
        : calls_(calls), device_(device), label_(std::move(label)), stopWay_(std::move(stopWay)) {}
    ~HidapiPort() override { calls_.close(device_); }
    HidapiPort(const HidapiPort&) = delete;
    HidapiPort& operator=(const HidapiPort&) = delete;

    Result<std::size_t> write(std::span<const std::uint8_t> report) override {
        const int taken = calls_.write(device_, report.data(), report.size());
        if (taken < 0) return wrong("writing");
        return static_cast<std::size_t>(taken);
    }

    Result<std::size_t> feature(std::span<std::uint8_t> report) override {
        const int came = calls_.getFeature(device_, report.data(), report.size());
        if (came < 0) return wrong("reading a feature report");
        return std::min(static_cast<std::size_t>(came), report.size());
    }

    Result<std::unique_ptr<Watchdog>> watch(std::span<const std::uint8_t> stop) override {
        return WatchdogProcess::start(stopWay_(stop));
    }

private:
    tl::unexpected<Error> wrong(const char* what) const {
        return fail(ErrorCode::Device, "{}: {} failed: {}", label_, what, plain(calls_.error(device_)));
    }

    const HidapiCalls& calls_;
    hid_device* const device_;
    const std::string label_;
    const MakeStopWay stopWay_;
};

class HidapiBackend final : public HidBackend {
public:
    HidapiBackend(std::string_view name, const HidapiCalls& calls, bool isHidraw)
        : name_(name), calls_(calls), isHidraw_(isHidraw) {}

    std::string_view name() const noexcept override { return name_; }

    std::vector<HidDeviceInfo> devices() const override {
        const std::scoped_lock lock(hidapi_);
        std::vector<HidDeviceInfo> found;
        auto* const list = calls_.enumerate(0, 0);
        for (const auto* at = list; at != nullptr; at = at->next) {
            HidDeviceInfo info;
            info.vendor = at->vendor_id;
            info.product = at->product_id;
            info.serial = plain(at->serial_number);
            info.name = plain(at->product_string);
            info.path = at->path == nullptr ? "" : at->path;
            info.usage = usageOf(at->usage_page, at->usage);
            info.permitted = access(nodeOf(info).c_str(), R_OK | W_OK) == 0;
            found.push_back(std::move(info));
        }
        calls_.freeEnumeration(list);
        return found;
    }

    Result<std::vector<std::uint8_t>> descriptor(const HidDeviceInfo& info) const override {
        const std::filesystem::path sys("/sys");
        if (isHidraw_) {
            const auto node = std::filesystem::path(info.path).filename();
            return readDescriptor(sys / "class" / "hidraw" / node / "device", info.label());
        }
        return readDescriptor(sys / "bus" / "usb" / "devices" / info.path, info.label());
    }

    Result<std::unique_ptr<HidPort>> open(const HidDeviceInfo& info) const override {
        if (!info.permitted) return fail(ErrorCode::Io, "{}", info.obstacle());
        if (!isHidraw_) {
            // hidapi takes the device from the kernel's driver, and so from a program that uses it through that.
            for (const auto& node : kernelNodesOf(socketOf(info))) {
                const auto holders = holdersOf(node);
                if (holders.empty()) continue;
                return fail(ErrorCode::Io, "{} is held by {} through {}; close that program first", info.label(),
                            textOf(holders), node.string());
            }
        }
        const std::scoped_lock lock(hidapi_);
        auto* const device = calls_.openPath(info.path.c_str());
        if (device == nullptr) {
            const auto holders = isHidraw_ ? std::vector<FileHolder>{} : holdersOf(nodeOf(info));
            if (!holders.empty()) {
                return fail(ErrorCode::Io, "{} is held by {}; close that program first", info.label(), textOf(holders));
            }
            return fail(ErrorCode::Io, "{} could not be opened with {}: {}", info.label(), name_,
                        plain(calls_.error(nullptr)));
        }
        HidapiPort::MakeStopWay stopWay;
        if (isHidraw_) {
            stopWay = [path = info.path](std::span<const std::uint8_t> stop) {
                StopWay way;
                way.node = path;
                way.bytes.assign(stop.begin(), stop.end());
                return way;
            };
        } else {
            stopWay = [path = info.path, node = nodeOf(info)](std::span<const std::uint8_t> stop) {
                return usbStopWay(path, node, stop);
            };
        }
        return std::make_unique<HidapiPort>(calls_, device, info.label(), std::move(stopWay));
    }

private:
    /// "1-4.2:1.0" is an interface of the device "1-4.2".
    static std::string socketOf(const HidDeviceInfo& info) { return info.path.substr(0, info.path.find(':')); }

    /// The file whose permissions count.
    std::string nodeOf(const HidDeviceInfo& info) const {
        if (isHidraw_) return info.path;
        const auto device = std::filesystem::path("/sys/bus/usb/devices") / socketOf(info);
        const auto bus = lineOf(device / "busnum");
        const auto number = lineOf(device / "devnum");
        if (bus.empty() || number.empty() || bus.size() > 3 || number.size() > 3) return "/nowhere";
        return fmt::format("/dev/bus/usb/{:0>3}/{:0>3}", bus, number);
    }

    const std::string_view name_;
    const HidapiCalls& calls_;
    const bool isHidraw_;
    mutable std::mutex hidapi_;  // it keeps its last error in a global
};

}  // namespace

std::string HidDeviceInfo::label() const {
    auto text = fmt::format("HID device {:04x}:{:04x} at {}", vendor, product, path);
    if (!serial.empty()) text += fmt::format(" (serial {})", serial);
    return text;
}

std::string HidDeviceInfo::obstacle() const {
    if (permitted) return {};
    // Whether the shipped rules name it or not: with its number the command is right for every device.
    const auto number = fmt::format("{:04x}:{:04x}", vendor, product);
    return fmt::format("{} is there, but this user may not open it: {}", label(), permissionAdvice(number));
}

std::shared_ptr<const HidBackend> hidrawBackend() {
    static const auto backend = std::make_shared<HidapiBackend>("hidraw", hidrawCalls(), true);
    return backend;
}

std::shared_ptr<const HidBackend> libusbHidBackend() {
    static const auto backend = std::make_shared<HidapiBackend>("libusb", libusbCalls(), false);
    return backend;
}

}  // namespace tacto::hid
