#include "drivers/hid_massager/HidapiBackend.h"

#include <filesystem>
#include <fstream>
#include <hidapi/hidapi.h>
#include <mutex>
#include <unistd.h>

#include "drivers/hid_massager/WatchdogProcess.h"
#include "drivers/system/Permission.h"

namespace tacto::hid {

namespace {

constexpr std::size_t kMaxText = 126;  // characters of a USB string descriptor: (255 - 2) / 2

/// Turns a device's own text, which is untrusted, into ASCII; other alphabets are not worth a conversion.
std::string plain(const wchar_t* text) {
    std::string out;
    for (; text != nullptr && *text != L'\0' && out.size() < kMaxText; ++text) {
        out += *text >= L' ' && *text <= L'~' ? static_cast<char>(*text) : '?';
    }
    return out;
}

class HidapiPort final : public HidPort {
public:
    HidapiPort(hid_device* device, std::string path, std::string label)
        : device_(device), path_(std::move(path)), label_(std::move(label)) {}
    ~HidapiPort() override { hid_close(device_); }
    HidapiPort(const HidapiPort&) = delete;
    HidapiPort& operator=(const HidapiPort&) = delete;

    Result<std::size_t> write(std::span<const std::uint8_t> report) override {
        const int taken = hid_write(device_, report.data(), report.size());
        if (taken < 0) return wrong("writing");
        return static_cast<std::size_t>(taken);
    }

    Result<std::size_t> feature(std::span<std::uint8_t> report) override {
        const int came = hid_get_feature_report(device_, report.data(), report.size());
        if (came < 0) return wrong("reading a feature report");
        return std::min(static_cast<std::size_t>(came), report.size());
    }

    Result<std::size_t> read(std::span<std::uint8_t> report, std::chrono::milliseconds wait) override {
        const int came = hid_read_timeout(device_, report.data(), report.size(), static_cast<int>(wait.count()));
        if (came < 0) return wrong("reading an input report");
        return std::min(static_cast<std::size_t>(came), report.size());
    }

    Result<std::unique_ptr<Watchdog>> watch(std::span<const std::uint8_t> stop) override {
        StopWay way;
        way.node = path_;
        way.bytes.assign(stop.begin(), stop.end());
        return WatchdogProcess::start(way);
    }

private:
    tl::unexpected<Error> wrong(const char* what) const {
        return fail(ErrorCode::Device, "{}: {} failed: {}", label_, what, plain(hid_error(device_)));
    }

    hid_device* const device_;
    const std::string path_;
    const std::string label_;
};

class HidapiBackend final : public HidBackend {
public:
    std::vector<HidDeviceInfo> devices() const override {
        const std::scoped_lock lock(hidapi_);
        std::vector<HidDeviceInfo> found;
        auto* const list = hid_enumerate(0, 0);
        for (const auto* at = list; at != nullptr; at = at->next) {
            HidDeviceInfo info;
            info.vendor = at->vendor_id;
            info.product = at->product_id;
            info.serial = plain(at->serial_number);
            info.name = plain(at->product_string);
            info.path = at->path == nullptr ? "" : at->path;
            info.usage = usageOf(at->usage_page, at->usage);
            info.permitted = access(info.path.c_str(), R_OK | W_OK) == 0;
            found.push_back(std::move(info));
        }
        hid_free_enumeration(list);
        return found;
    }

    /// The descriptor that the kernel read from the device.
    Result<std::vector<std::uint8_t>> descriptor(const HidDeviceInfo& info) const override {
        const auto file = std::filesystem::path("/sys/class/hidraw") / std::filesystem::path(info.path).filename() /
                          "device" / "report_descriptor";
        std::ifstream in(file, std::ios::binary);
        if (!in) {
            return fail(ErrorCode::NotFound, "{}: the system shows no report descriptor at {}", info.label(),
                        file.string());
        }
        std::vector<std::uint8_t> bytes(kMaxDescriptor + 1);  // one byte more, so that a longer one is seen
        in.read(reinterpret_cast<char*>(bytes.data()), static_cast<std::streamsize>(bytes.size()));
        if (in.bad()) return fail(ErrorCode::Io, "{}: its report descriptor cannot be read", info.label());
        bytes.resize(static_cast<std::size_t>(in.gcount()));
        return bytes;
    }

    Result<std::unique_ptr<HidPort>> open(const HidDeviceInfo& info) const override {
        if (!info.permitted) return fail(ErrorCode::Io, "{}", info.obstacle());
        const std::scoped_lock lock(hidapi_);
        auto* const device = hid_open_path(info.path.c_str());
        if (device == nullptr) {
            return fail(ErrorCode::Io, "{} could not be opened: {}", info.label(), plain(hid_error(nullptr)));
        }
        return std::make_unique<HidapiPort>(device, info.path, info.label());
    }

private:
    mutable std::mutex hidapi_;  // hidapi keeps its last error in a global
};

}  // namespace

std::string HidDeviceInfo::label() const {
    auto text = fmt::format("HID device {:04x}:{:04x} at {}", vendor, product, path);
    if (!serial.empty()) text += fmt::format(" (serial {})", serial);
    return text;
}

std::string HidDeviceInfo::obstacle() const {
    if (permitted) return {};
    // The command is right for every device, as it has the device's number, whether the shipped rules name it or not.
    const auto number = fmt::format("{:04x}:{:04x}", vendor, product);
    return fmt::format("{} is there, but this user may not open it: {}", label(), permissionAdvice(number));
}

std::shared_ptr<const HidBackend> hidapiBackend() {
    static const auto backend = std::make_shared<HidapiBackend>();
    return backend;
}

}  // namespace tacto::hid
