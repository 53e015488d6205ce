#include "drivers/pulsepal/PulsePalDriver.h"

#include "core/devices/DeviceUri.h"
#include "drivers/pulsepal/PulsePalStimulator.h"

namespace tacto {
namespace pulsepal {
namespace {

class PulsePalDriver final : public Driver {
public:
    explicit PulsePalDriver(std::shared_ptr<TransportPorts> ports) : ports_(std::move(ports)) {}

    std::string_view scheme() const noexcept override { return "pulsepal"; }
    bool runsOnVirtualClock() const noexcept override { return false; }

    std::vector<DeviceIdentity> list() const override {
        return identitiesAt(*ports_, "pulsepal", Role::Stimulator, "Pulse Pal 2");
    }

    Result<void> open(const DeviceUri& uri, const std::set<Role>& /*wanted*/, const OpenContext& context,
                      DeviceSet& into) override {
        if (auto free = into.checkFree(Role::Stimulator, uri); !free) return free;
        UriParameters from(uri);
        const int channel = from.integer("channel", 1, 1, 4);
        if (auto read = from.finish(); !read) return read;
        const auto port = portOf(uri);
        if (!port) return failure(port);
        if (!port->obstacle.empty()) return uri.refuse(ErrorCode::Io, "{}", port->obstacle);
        auto itself = uri;
        itself.path = addressOf(*port, ports_->list());
        auto opened = PulsePalStimulator::open(connectTo(ports_, itself.path, "Pulse Pal"), itself.text(), port->serial,
                                               channel, context.clock);
        if (!opened) return uri.refuse(opened.error());
        into.stimulator = std::move(*opened);
        return {};
    }

private:
    Result<TransportPort> portOf(const DeviceUri& uri) const {
        const auto all = ports_->list();
        auto found = uri.path.empty() ? all : portsNamed(uri.path, all);
        if (found.size() == 1) return std::move(found.front());
        if (!found.empty()) return uri.refuseChoice(addressesOf("pulsepal", found, all));
        return uri.refuse(ErrorCode::NotFound, "no such Pulse Pal 2 is plugged in (USB {:04x}:{:04x})", kPulsePalVendor,
                          kPulsePalProduct);
    }

    const std::shared_ptr<TransportPorts> ports_;
};

}  // namespace
}  // namespace pulsepal

std::unique_ptr<Driver> makePulsePalDriver(std::shared_ptr<TransportPorts> ports) {
    return std::make_unique<pulsepal::PulsePalDriver>(std::move(ports));
}

}  // namespace tacto
