#include "drivers/hid_input/HidInput.h"

#include <algorithm>
#include <condition_variable>
#include <mutex>
#include <set>
#include <thread>

#include "drivers/hid_input/HidButtons.h"
#include "drivers/hid_massager/HidapiBackend.h"

namespace tacto::hid {

namespace {

constexpr std::chrono::milliseconds kReadWait{20};    // closing may take this long too
constexpr std::chrono::milliseconds kLookAgain{200};  // interval of looking for a device that was unplugged
constexpr Usage kKeyboard = usageOf(0x01, 0x06), kKeypad = usageOf(0x01, 0x07);

std::string identityOf(const HidDeviceInfo& info) {
    auto identity = fmt::format("{:04x}:{:04x}", info.vendor, info.product);
    if (!info.serial.empty()) identity += " " + info.serial;
    return identity;
}

bool types(const HidDescriptor& descriptor) {
    return std::ranges::any_of(descriptor.collections,
                               [](const HidCollection& one) { return one.usage == kKeyboard || one.usage == kKeypad; });
}

struct Found {
    HidDeviceInfo hid;
    ButtonDeviceInfo shown;
    std::vector<std::uint8_t> descriptor;
};

/// Returns a sentence with the device's name and why it cannot be used.
std::string cannot(const HidDeviceInfo& info, const std::string& why) {
    return fmt::format("{} cannot answer: {}.", info.label(), why);
}

std::vector<Found> look(const HidBackend& backend) {
    std::vector<Found> all;
    std::set<std::string> seen;
    for (auto& info : backend.devices()) {
        const bool claims = isButtonUsage(info.usage);
        if (!claims && seen.contains(info.path)) continue;
        if (std::ranges::any_of(all, [&](const auto& one) { return one.hid.path == info.path; })) continue;
        seen.insert(info.path);
        Found one;
        one.shown.address = info.path;
        one.shown.identity = identityOf(info);
        one.shown.hasSerial = !info.serial.empty();
        one.shown.name = info.name.empty() ? "HID device" : info.name;
        auto bytes = backend.descriptor(info);
        const auto parsed = bytes ? parseHidDescriptor(*bytes) : Result<HidDescriptor>(failure(bytes));
        if (!parsed) {
            if (!claims) continue;
            one.shown.obstacle = cannot(info, parsed.error().message);
        } else {
            if (!hasButtonUsage(*parsed) || types(*parsed)) continue;
            auto buttons = HidButtons::of(*parsed);
            if (buttons)
                one.shown.buttons = buttons->labels();
            else
                one.shown.obstacle = cannot(info, buttons.error().message);
            one.descriptor = std::move(*bytes);
        }
        if (one.shown.obstacle.empty()) one.shown.obstacle = info.obstacle();
        one.hid = std::move(info);
        all.push_back(std::move(one));
    }
    for (auto& one : all) {
        const auto twins =
            std::ranges::count_if(all, [&](const auto& other) { return other.shown.identity == one.shown.identity; });
        if (twins > 1 && one.shown.obstacle.empty())
            one.shown.obstacle = fmt::format(
                "{} devices are {} and nothing tells them apart when one is plugged in again; one of them is accepted.",
                twins, one.shown.identity);
    }
    return all;
}

class OpenInput final : public ButtonDevice {
public:
    OpenInput(std::shared_ptr<const HidBackend> backend, Found found, HidButtons buttons, std::unique_ptr<HidPort> port,
              ButtonListener listener)
        : backend_(std::move(backend)),
          found_(std::move(found)),
          buttons_(std::move(buttons)),
          port_(std::move(port)),
          listener_(std::move(listener)),
          thread_([this] { work(); }) {}

    ~OpenInput() override {
        {
            const std::scoped_lock lock(mutex_);
            closing_ = true;
        }
        wake_.notify_all();
        thread_.join();
    }
    OpenInput(const OpenInput&) = delete;
    OpenInput& operator=(const OpenInput&) = delete;

private:
    bool closing() {
        const std::scoped_lock lock(mutex_);
        return closing_;
    }

    void work() {
        std::vector<std::uint8_t> report(buttons_.longest() + 1);  // one byte more, to detect a report that is too long
        while (!closing()) {
            if (!port_) {
                openAgain();
                continue;
            }
            const auto came = port_->read(report, kReadWait);
            const auto at = std::chrono::steady_clock::now();
            if (!came) {
                port_.reset();
                buttons_.forget();
                listener_.plugged(false);
                for (const auto& one : look(*backend_)) {
                    if (one.shown.identity == found_.shown.identity && one.hid.path != path_)
                        others_.insert(one.hid.path);
                }
                continue;
            }
            for (const auto& change : buttons_.read(std::span(report).first(*came)))
                listener_.moved({change.button, change.down, at});
        }
    }

    void openAgain() {
        {
            std::unique_lock lock(mutex_);
            if (wake_.wait_for(lock, kLookAgain, [this] { return closing_; })) return;
        }
        const auto there = look(*backend_);
        std::erase_if(others_, [&](const std::string& path) {
            return std::ranges::none_of(there, [&](const Found& one) { return one.hid.path == path; });
        });
        for (const auto& one : there) {
            if (one.shown.identity != found_.shown.identity || !one.shown.obstacle.empty()) continue;
            if (one.descriptor != found_.descriptor || others_.contains(one.hid.path)) continue;
            auto port = backend_->open(one.hid);
            if (!port) return;
            port_ = std::move(*port);
            path_ = one.hid.path;
            listener_.plugged(true);
            return;
        }
    }

    const std::shared_ptr<const HidBackend> backend_;
    const Found found_;
    HidButtons buttons_;                  // only thread_ uses it
    std::unique_ptr<HidPort> port_;       // only thread_ uses it; null while the device is unplugged
    std::string path_ = found_.hid.path;  // only thread_ uses it; the device's present or last path
    std::set<std::string> others_;        // only thread_ uses it; similar devices that were there before ours went
    const ButtonListener listener_;
    std::mutex mutex_;
    std::condition_variable wake_;
    bool closing_ = false;  // guarded by mutex_
    std::thread thread_;    // declared last: starts when everything else is ready
};

class HidInput final : public ButtonDevices {
public:
    explicit HidInput(std::shared_ptr<const HidBackend> backend) : backend_(std::move(backend)) {}

    std::vector<ButtonDeviceInfo> list() const override {
        std::vector<ButtonDeviceInfo> all;
        for (auto& one : look(*backend_)) all.push_back(std::move(one.shown));
        return all;
    }

    Result<std::unique_ptr<ButtonDevice>> open(const ButtonDeviceInfo& info, ButtonListener listener) const override {
        for (auto& one : look(*backend_)) {
            if (one.shown.address != info.address || one.shown.identity != info.identity) continue;
            if (!one.shown.obstacle.empty()) return fail(ErrorCode::Unsupported, "{}", one.shown.obstacle);
            if (one.shown.buttons != info.buttons)
                return fail(ErrorCode::Unsupported, "{} has other buttons than before; choose it again.",
                            one.hid.label());
            const auto parsed = parseHidDescriptor(one.descriptor);
            if (!parsed) return failure(parsed);
            auto buttons = HidButtons::of(*parsed);
            if (!buttons) return failure(buttons);
            auto port = backend_->open(one.hid);
            if (!port) return failure(port);
            return std::make_unique<OpenInput>(backend_, std::move(one), std::move(*buttons), std::move(*port),
                                               std::move(listener));
        }
        return fail(ErrorCode::NotFound, "{} ({}) is not plugged in any more.", info.name, info.identity);
    }

private:
    const std::shared_ptr<const HidBackend> backend_;
};

}  // namespace

std::shared_ptr<const ButtonDevices> makeHidInput(std::shared_ptr<const HidBackend> backend) {
    return std::make_shared<HidInput>(std::move(backend));
}

std::shared_ptr<const ButtonDevices> systemHidInput() { return makeHidInput(hidapiBackend()); }

}  // namespace tacto::hid
