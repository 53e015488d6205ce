#include "drivers/pulsepal/PulsePalDriver.h"

#include <algorithm>

#include "core/base/Text.h"
#include "drivers/pulsepal/PulsePalStimulator.h"

namespace tacto {
namespace pulsepal {
namespace {

/// What the device is called by: its serial number, or the socket it is in.
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
        const auto all = ports_->list();
        for (const auto& port : all) {
            DeviceIdentity identity{
                "pulsepal:" + addressOf(port, all), Role::Stimulator, "Pulse Pal 2", port.serial, {}, false};
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
        itself.path = addressOf(*port, ports_->list());
        auto opened =
            PulsePalStimulator::open(connectTo(itself.path), itself.text(), port->serial, *channel, context.clock);
        if (!opened) return fail(opened.error().code, "device \"{}\": {}", uri.text(), opened.error().message);
        into.stimulator = std::move(*opened);
        return {};
    }

private:
    Result<TransportPort> portOf(const DeviceUri& uri) const {
        const auto all = ports_->list();
        auto found = uri.path.empty() ? all : portsNamed(uri.path, all);
        if (found.size() == 1) return std::move(found.front());
        if (found.empty()) {
            return fail(ErrorCode::NotFound, "device \"{}\": no such Pulse Pal 2 is plugged in (USB {:04x}:{:04x})",
                        uri.text(), kPulsePalVendor, kPulsePalProduct);
        }
        return fail(ErrorCode::InvalidArgument, "device \"{}\" could be {}: name one", uri.text(),
                    choiceOf("pulsepal", found, all));
    }

    /// Opens the port that was opened before: by serial number wherever it is plugged in now, else in its place.
    Connect connectTo(const std::string& address) const {
        return [ports = ports_, address]() -> Result<std::unique_ptr<Transport>> {
            const auto found = portsNamed(address, ports->list());
            if (found.size() != 1) return fail(ErrorCode::NotFound, "Pulse Pal {} is not plugged in", address);
            if (!found.front().obstacle.empty()) return fail(ErrorCode::Io, "{}", found.front().obstacle);
            return ports->open(found.front());
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
