// PluggedButtons.h - game pads and pedals that a test can plug in and press.
//
// Thread-safety: any thread.
#pragma once

#include <algorithm>
#include <map>
#include <mutex>
#include <vector>

#include "core/devices/ButtonDevice.h"

namespace tacto::test {

class PluggedButtons final : public ButtonDevices {
public:
    static ButtonDeviceInfo pad(const std::string& name, std::size_t buttons = 12) {
        ButtonDeviceInfo info{"/dev/" + name, name, name, {}, {}, false};
        for (std::size_t i = 1; i <= buttons; ++i) info.buttons.push_back(std::to_string(i));
        return info;
    }
    void set(std::vector<ButtonDeviceInfo> plugged) {
        const std::scoped_lock lock(mutex_);
        plugged_ = std::move(plugged);
    }
    /// Does nothing unless a program has the device open. `button` counts from 1.
    void press(const std::string& name, std::size_t button, bool down = true,
               std::chrono::steady_clock::time_point at = std::chrono::steady_clock::now()) const {
        const std::scoped_lock lock(mutex_);
        for (const auto& [number, one] : listeners_) {
            if (one.name == name) one.listener.moved({button - 1, down, at});
        }
    }
    void plug(const std::string& name, bool there) const {
        const std::scoped_lock lock(mutex_);
        for (const auto& [number, one] : listeners_) {
            if (one.name == name) one.listener.plugged(there);
        }
    }
    [[nodiscard]] std::size_t open(const std::string& name) const {
        const std::scoped_lock lock(mutex_);
        return std::size_t(
            std::ranges::count_if(listeners_, [&](const auto& each) { return each.second.name == name; }));
    }

    std::vector<ButtonDeviceInfo> list() const override {
        const std::scoped_lock lock(mutex_);
        return plugged_;
    }
    Result<std::unique_ptr<ButtonDevice>> open(const ButtonDeviceInfo& info, ButtonListener listener) const override {
        const std::scoped_lock lock(mutex_);
        const auto found = std::ranges::find(plugged_, info.identity, &ButtonDeviceInfo::identity);
        if (found == plugged_.end()) return fail(ErrorCode::NotFound, "{} is not plugged in any more.", info.name);
        if (!found->obstacle.empty()) return fail(ErrorCode::Unsupported, "{}", found->obstacle);
        listeners_[++number_] = {info.identity, std::move(listener)};
        return std::make_unique<Open>(*this, number_);
    }

private:
    struct Open final : ButtonDevice {
        Open(const PluggedButtons& from, int number) : from_(from), number_(number) {}
        ~Open() override {
            const std::scoped_lock lock(from_.mutex_);
            from_.listeners_.erase(number_);
        }
        const PluggedButtons& from_;
        const int number_;
    };
    struct Listens {
        std::string name;
        ButtonListener listener;
    };
    mutable std::mutex mutex_;
    std::vector<ButtonDeviceInfo> plugged_;
    mutable std::map<int, Listens> listeners_;
    mutable int number_ = 0;
};

}  // namespace tacto::test
