#include "tests/drivers/hid_massager/FakeHid.h"

namespace tacto::test {

namespace {
constexpr auto kLong = std::chrono::seconds(5);
}

class FakeWatchdog final : public hid::Watchdog {
public:
    explicit FakeWatchdog(FakeHidDevice& device) : device_(device) {}
    hid::WatchdogState beat() noexcept override {
        const std::scoped_lock lock(device_.mutex_);
        ++device_.beats_;
        device_.resting_ = false;
        if (device_.watchRefused_) return hid::WatchdogState::Ended;
        return device_.watchSilent_ ? hid::WatchdogState::Silent : hid::WatchdogState::Watching;
    }
    void rest() noexcept override {
        const std::scoped_lock lock(device_.mutex_);
        device_.resting_ = true;
    }

private:
    FakeHidDevice& device_;
};

class FakeHidPort final : public hid::HidPort {
public:
    FakeHidPort(FakeHidDevice& device, std::uint64_t session) : device_(device), session_(session) {}
    ~FakeHidPort() override {
        const std::scoped_lock lock(device_.mutex_);
        --device_.openNow_;
    }

    Result<std::size_t> write(std::span<const std::uint8_t> report) override {
        std::unique_lock lock(device_.mutex_);
        ++device_.attempts_;
        ++device_.waiting_;
        device_.changed_.notify_all();
        device_.changed_.wait(lock, [&] { return !device_.held_ || !there(); });
        --device_.waiting_;
        if (!there()) return fail(ErrorCode::Device, "the fake device is unplugged");
        if (device_.refused_) return fail(ErrorCode::Device, "the fake device refused");
        if (device_.takeOnly_) return *std::exchange(device_.takeOnly_, std::nullopt);
        device_.writes_.push_back({device_.clock_.now(), Bytes(report.begin(), report.end())});
        device_.changed_.notify_all();
        return report.size();
    }

    Result<std::size_t> feature(std::span<std::uint8_t> report) override {
        const std::scoped_lock lock(device_.mutex_);
        if (!there()) return fail(ErrorCode::Device, "the fake device is unplugged");
        if (device_.feature_.empty() || report.empty() || device_.feature_[0] != report[0]) {
            return fail(ErrorCode::Device, "the fake device has no feature report {}", report.empty() ? 0 : report[0]);
        }
        const auto size = std::min(report.size(), device_.feature_.size());
        std::copy_n(device_.feature_.begin(), size, report.begin());
        return size;
    }

    Result<std::size_t> read(std::span<std::uint8_t> report, std::chrono::milliseconds wait) override {
        std::unique_lock lock(device_.mutex_);
        device_.changed_.wait_for(lock, wait, [&] { return !device_.sent_.empty() || !there(); });
        if (!there()) return fail(ErrorCode::Device, "the fake device is unplugged");
        if (device_.sent_.empty()) return std::size_t{0};
        const auto sent = std::move(device_.sent_.front());
        device_.sent_.pop_front();
        const auto size = std::min(report.size(), sent.size());
        std::copy_n(sent.begin(), size, report.begin());
        return size;
    }

    Result<std::unique_ptr<hid::Watchdog>> watch(std::span<const std::uint8_t> stop) override {
        const std::scoped_lock lock(device_.mutex_);
        if (device_.watchRefused_) return fail(ErrorCode::Io, "the massager is not driven: no watchdog");
        device_.watchedStop_.assign(stop.begin(), stop.end());
        return std::make_unique<FakeWatchdog>(device_);
    }

    bool stopNow() noexcept override {
        const std::scoped_lock lock(device_.mutex_);
        if (device_.urgentStop_.empty() || !there()) return false;
        device_.writes_.push_back({device_.clock_.now(), device_.urgentStop_});
        device_.changed_.notify_all();
        return true;
    }

private:
    bool there() const noexcept { return device_.plugged_ && device_.session_ == session_; }
    FakeHidDevice& device_;
    const std::uint64_t session_;
};

FakeHidDevice::FakeHidDevice(const Clock& clock, hid::HidDeviceInfo info, Bytes descriptor)
    : clock_(clock), info_(std::move(info)), descriptor_(std::move(descriptor)) {}

#define CHANGE(what)                     \
    const std::scoped_lock lock(mutex_); \
    what;                                \
    changed_.notify_all()

void FakeHidDevice::unplug() { CHANGE((plugged_ = false, sent_.clear())); }
void FakeHidDevice::send(Bytes report) { CHANGE(sent_.push_back(std::move(report))); }
void FakeHidDevice::plug() { CHANGE((plugged_ = true, ++session_)); }
void FakeHidDevice::hold(bool held) { CHANGE(held_ = held); }
void FakeHidDevice::takeOnly(std::size_t bytes) { CHANGE(takeOnly_ = bytes); }
void FakeHidDevice::refuse(bool refused) { CHANGE(refused_ = refused); }
void FakeHidDevice::setFeature(Bytes report) { CHANGE(feature_ = std::move(report)); }
void FakeHidDevice::setDescriptor(Bytes descriptor) { CHANGE(descriptor_ = std::move(descriptor)); }
void FakeHidDevice::setPermitted(bool permitted) { CHANGE(info_.permitted = permitted); }
void FakeHidDevice::refuseWatch(bool refused) { CHANGE(watchRefused_ = refused); }
void FakeHidDevice::setUrgentStop(Bytes report) { CHANGE(urgentStop_ = std::move(report)); }
#undef CHANGE

std::vector<FakeHidDevice::Write> FakeHidDevice::writes() const { return locked(writes_); }

Bytes FakeHidDevice::last() const {
    const std::scoped_lock lock(mutex_);
    return writes_.empty() ? Bytes{} : writes_.back().bytes;
}

bool FakeHidDevice::waitForWrites(std::size_t count) const {
    std::unique_lock lock(mutex_);
    return changed_.wait_for(lock, kLong, [&] { return writes_.size() >= count; });
}

bool FakeHidDevice::waitForHeld() const {
    std::unique_lock lock(mutex_);
    return changed_.wait_for(lock, kLong, [&] { return held_ && waiting_ > 0; });
}

bool FakeHidDevice::waitForLast(const Bytes& report) const {
    std::unique_lock lock(mutex_);
    return changed_.wait_for(lock, kLong, [&] { return !writes_.empty() && writes_.back().bytes == report; });
}

void FakeHidDevice::silenceWatch(bool silent) {
    const std::scoped_lock lock(mutex_);
    watchSilent_ = silent;
}

int FakeHidDevice::beats() const { return locked(beats_); }
bool FakeHidDevice::watchRests() const { return locked(resting_); }
Bytes FakeHidDevice::watchedStop() const { return locked(watchedStop_); }
int FakeHidDevice::attempts() const { return locked(attempts_); }
int FakeHidDevice::openings() const { return locked(openings_); }
int FakeHidDevice::openNow() const { return locked(openNow_); }
bool FakeHidDevice::plugged() const { return locked(plugged_); }
hid::HidDeviceInfo FakeHidDevice::info() const { return locked(info_); }
Bytes FakeHidDevice::descriptor() const { return locked(descriptor_); }

Result<std::unique_ptr<hid::HidPort>> FakeHidDevice::open() {
    const std::scoped_lock lock(mutex_);
    if (!plugged_) return fail(ErrorCode::NotFound, "the fake device is not plugged in");
    ++openings_;
    ++openNow_;
    return std::make_unique<FakeHidPort>(*this, session_);
}

std::vector<hid::HidDeviceInfo> FakeHidBackend::devices() const {
    std::vector<hid::HidDeviceInfo> found;
    for (const auto& device : plugged) {
        if (device->plugged()) found.push_back(device->info());
    }
    return found;
}

Result<std::vector<std::uint8_t>> FakeHidBackend::descriptor(const hid::HidDeviceInfo& info) const {
    for (const auto& device : plugged) {
        if (device->plugged() && device->info().path == info.path) return device->descriptor();
    }
    return fail(ErrorCode::NotFound, "{} is gone", info.label());
}

Result<std::unique_ptr<hid::HidPort>> FakeHidBackend::open(const hid::HidDeviceInfo& info) const {
    for (const auto& device : plugged) {
        if (device->plugged() && device->info().path == info.path) return device->open();
    }
    return fail(ErrorCode::NotFound, "{} is gone", info.label());
}

Bytes outputDescriptor(std::uint8_t number, std::size_t length) {
    const auto count = static_cast<std::uint8_t>(length - 1);
    return {0x05, 0x01, 0x09, 0x05, 0xA1, 0x01, 0x85, number, 0x06,  0x00, 0xFF, 0x09, 0x20,
            0x15, 0x00, 0x26, 0xFF, 0x00, 0x75, 0x08, 0x95,   count, 0x91, 0x02, 0xC0};
}

Bytes hapticDescriptor(const Bytes& moreControls) {
    Bytes bytes{
        0x05, 0x0E,                                                        // usage page Haptics
        0x09, 0x01,                                                        // SimpleHapticController
        0xA1, 0x01,                                                        // application collection
        0x85, 0x02,                                                        //   report 2
        0x09, 0x10, 0xA1, 0x02,                                            //   WaveformList, logical
        0x05, 0x0A,                                                        //     page Ordinals
        0x19, 0x03, 0x29, 0x04,                                            //     3, 4
        0x16, 0x03, 0x10,                                                  //     logical 0x1003 ...
        0x26, 0xFF, 0x2F,                                                  //     ... to 0x2FFF
        0x75, 0x10, 0x95, 0x02,                                            //     2 × 16 bits
        0xB1, 0x02,                                                        //     feature
        0xC0,                                                              //   end
        0x05, 0x0E, 0x09, 0x11, 0xA1, 0x02,                                //   DurationList
        0x05, 0x0A, 0x19, 0x03, 0x29, 0x04,                                //
        0x15, 0x00, 0x26, 0xE8, 0x03, 0x75, 0x10, 0x95, 0x02, 0xB1, 0x02,  //     0 to 1000 ms
        0xC0,                                                              //   end
        0x05, 0x0E,                                                        //   page Haptics
        0x85, 0x01,                                                        //   report 1
        0x09, 0x23, 0x15, 0x00, 0x27, 0xFF, 0xFF, 0x00, 0x00, 0x75, 0x10, 0x95, 0x01, 0x91, 0x02,  // intensity u16
        0x09, 0x21, 0x15, 0x01, 0x25, 0x04, 0x75, 0x08, 0x95, 0x01, 0x91, 0x02,                    // manual trigger u8
        0x09, 0x24, 0x15, 0x00, 0x26, 0xFF, 0x00, 0x75, 0x08, 0x95, 0x01, 0x91, 0x02,              // repeat count u8
    };
    bytes.insert(bytes.end(), moreControls.begin(), moreControls.end());
    bytes.push_back(0xC0);
    return bytes;
}

hid::VibrationReports padReports(Seconds keepAlive, Seconds shortestWrite) {
    hid::VibrationReports reports;
    reports.start = {5, 1, 0, 0, 0, 0, 0, 0};
    reports.stop = reports.start;
    reports.fields = {{32, 8, hid::ByteOrder::Little, 0, 255, hid::VibrationRole::Weak},
                      {40, 8, hid::ByteOrder::Little, 0, 255, hid::VibrationRole::Strong}};
    reports.keepAlive = keepAlive;
    reports.shortestWrite = shortestWrite;
    return reports;
}

}  // namespace tacto::test
