#include "drivers/pulsepal/PulsePalDriver.h"

#include <algorithm>

#include "core/base/Text.h"
#include "drivers/pulsepal/PulsePalStimulator.h"

namespace tacto {
namespace pulsepal {
namespace {

/// What the device is called by: its serial number, or the socket it is in.
std::string nameOf(const TransportPort& port) { return port.serial.empty() ? port.place : port.serial; }

Result<int> channelOf(const DeviceUri& uri) {
    int channel = 1;
    bool given = false;
    for (const auto& [key, value] : uri.parameters) {
        if (key != "channel") {
            return fail(ErrorCode::InvalidArgument,
                        "device \"{}\": there is no parameter \"{}\" (={}): it takes channel", uri.text(), key, value);
        }
        const auto number = parseNumber(value);
        const auto isOne = [&](int one) { return number && *number == one; };
        if (given || !(isOne(1) || isOne(2) || isOne(3) || isOne(4))) {
            return fail(ErrorCode::InvalidArgument, "device \"{}\": channel={} is not accepted: 1, 2, 3 or 4, once",
                        uri.text(), value);
        }
        given = true;
        channel = static_cast<int>(*number);
    }
    return channel;
}

class PulsePalDriver final : public Driver {
public:
    explicit PulsePalDriver(std::shared_ptr<TransportPorts> ports) : ports_(std::move(ports)) {}

    std::string_view scheme() const noexcept override { return "pulsepal"; }
    bool runsOnVirtualClock() const noexcept override { return false; }

    std::vector<DeviceIdentity> list() const override {
        std::vector<DeviceIdentity> found;
        for (const auto& port : ports_->list()) {
            DeviceIdentity identity{
                "pulsepal:" + nameOf(port), Role::Stimulator, "Pulse Pal 2", port.serial, {}, false};
            identity.obstacle = port.obstacle;
            found.push_back(std::move(identity));
        }
        return found;
    }

    Result<void> open(const DeviceUri& uri, const std::set<Role>& /*wanted*/, const OpenContext& context,
                      DeviceSet& into) override {
        if (into.has(Role::Stimulator)) {
            return fail(ErrorCode::InvalidArgument,
                        "device \"{}\": a stimulator is open already, and a bench has one of each", uri.text());
        }
        const auto channel = channelOf(uri);
        if (!channel) return failure(channel);
        const auto port = portOf(uri);
        if (!port) return failure(port);
        if (!port->obstacle.empty()) return fail(ErrorCode::Io, "device \"{}\": {}", uri.text(), port->obstacle);
        auto itself = uri;
        itself.path = nameOf(*port);
        auto opened = PulsePalStimulator::open(connectTo(*port), itself.text(), port->serial, *channel, context.clock);
        if (!opened) return fail(opened.error().code, "device \"{}\": {}", uri.text(), opened.error().message);
        into.stimulator = std::move(*opened);
        return {};
    }

private:
    Result<TransportPort> portOf(const DeviceUri& uri) const {
        auto all = ports_->list();
        if (!uri.path.empty()) std::erase_if(all, [&](const auto& port) { return nameOf(port) != uri.path; });
        if (all.size() == 1) return std::move(all.front());
        if (all.empty()) {
            return fail(ErrorCode::NotFound, "device \"{}\": no such Pulse Pal 2 is plugged in (USB {:04x}:{:04x})",
                        uri.text(), kPulsePalVendor, kPulsePalProduct);
        }
        std::vector<std::string> names;
        for (const auto& port : all) names.push_back("pulsepal:" + nameOf(port));
        return fail(ErrorCode::InvalidArgument, "device \"{}\" could be {}: name one", uri.text(),
                    fmt::join(names, " or "));
    }

    /// Opens the port that was opened before, wherever it is plugged in now.
    Connect connectTo(const TransportPort& wanted) const {
        return [ports = ports_, wanted]() -> Result<std::unique_ptr<Transport>> {
            const auto all = ports->list();
            const auto found =
                std::ranges::find_if(all, [&](const auto& port) { return nameOf(port) == nameOf(wanted); });
            if (found == all.end()) {
                return fail(ErrorCode::NotFound, "Pulse Pal {} is not plugged in", nameOf(wanted));
            }
            if (!found->obstacle.empty()) return fail(ErrorCode::Io, "{}", found->obstacle);
            return ports->open(*found);
        };
    }

    const std::shared_ptr<TransportPorts> ports_;
};

}  // namespace
}  // namespace pulsepal

std::unique_ptr<Driver> makePulsePalDriver(std::shared_ptr<TransportPorts> ports) {
    return std::make_unique<pulsepal::PulsePalDriver>(std::move(ports));
}

}  // namespace tacto
