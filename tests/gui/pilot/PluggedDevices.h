// PluggedDevices.h - a driver for devices that a test plugs in, with massagers that no gate can tell from real ones.
//
// Thread-safety: Plugs from any thread; PluggedDevices one caller.
#pragma once

#include <algorithm>
#include <memory>
#include <mutex>
#include <vector>

#include "core/devices/Driver.h"
#include "tests/bench/FakeMassager.h"

namespace tacto::test {

class Plugs {
public:
    void set(std::vector<DeviceIdentity> devices) {
        const std::scoped_lock lock(mutex_);
        devices_ = std::move(devices);
    }
    [[nodiscard]] std::vector<DeviceIdentity> all() const {
        const std::scoped_lock lock(mutex_);
        return devices_;
    }

private:
    mutable std::mutex mutex_;
    std::vector<DeviceIdentity> devices_;
};

class PluggedDevices final : public Driver {
public:
    explicit PluggedDevices(std::shared_ptr<const Plugs> plugs) : plugs_(std::move(plugs)) {}
    std::string_view scheme() const noexcept override { return "plugged"; }
    std::vector<DeviceIdentity> list() const override { return plugs_->all(); }
    bool runsOnVirtualClock() const noexcept override { return false; }
    Result<void> open(const DeviceUri& uri, const std::set<Role>&, const OpenContext& context,
                      DeviceSet& into) override {
        for (const auto& device : plugs_->all()) {
            if (device.uri != uri.text() || device.role != Role::Massager) continue;
            into.massager = std::make_unique<FakeMassager>(context.clock, device);
            return {};
        }
        return fail(ErrorCode::NotFound, "no device {} is plugged in", uri.text());
    }

    static DeviceIdentity massager(const std::string& serial) {
        return {"plugged:" + serial, Role::Massager, "haptic pad", serial, "", false};
    }
    static DeviceIdentity board(const std::string& serial) {
        return {"plugged:" + serial, Role::Sensor, "sensor board", serial, "", false};
    }

private:
    std::shared_ptr<const Plugs> plugs_;
};

}  // namespace tacto::test
