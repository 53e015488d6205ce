#include "core/devices/Registry.h"

#include <algorithm>
#include <iterator>

#include "core/devices/DeviceUri.h"

namespace tacto {

Registry::Registry(std::vector<std::unique_ptr<Driver>> drivers) : drivers_(std::move(drivers)) {}

std::vector<DeviceIdentity> Registry::list() const {
    std::vector<DeviceIdentity> all;
    for (const auto& driver : drivers_) {
        auto found = driver->list();
        all.insert(all.end(), std::make_move_iterator(found.begin()), std::make_move_iterator(found.end()));
    }
    return all;
}

Result<Driver*> Registry::driverFor(const DeviceUri& uri) const {
    std::string known;
    for (const auto& driver : drivers_) {
        if (driver->scheme() == uri.scheme) return driver.get();
        known += fmt::format("{}{}:", known.empty() ? "" : ", ", driver->scheme());
    }
    return fail(ErrorCode::NotFound, "no driver for device \"{}\": this program opens {}", uri.text(), known);
}

Result<bool> Registry::allVirtual(std::span<const DeviceUri> uris) const {
    for (const auto& uri : uris) {
        const auto driver = driverFor(uri);
        if (!driver) return failure(driver);
        if (!(*driver)->runsOnVirtualClock()) return false;
    }
    return true;
}

Result<DeviceSet> Registry::open(std::span<const DeviceUri> uris, const std::set<Role>& needed,
                                 const OpenContext& context) {
    DeviceSet devices;
    std::vector<DeviceUri> order(uris.begin(), uris.end());
    std::ranges::stable_partition(order, [](const DeviceUri& uri) { return !uri.path.empty(); });
    const auto stopped = [&devices] {
        if (devices.stimulator) devices.stimulator->forceOff();
        if (devices.massager) devices.massager->forceOff();
        return fail(ErrorCode::Stopped, "stopped while devices were opening: nothing was delivered");
    };
    if (context.stopped()) return stopped();
    for (auto& uri : order) {
        const auto driver = driverFor(uri);
        if (!driver) return failure(driver);
        const auto given = uri.parameters;
        const auto stated = takeStatement(uri);
        if (!stated) return failure(stated);
        const bool hadScope = devices.has(Role::Oscilloscope);
        const auto opened = (*driver)->open(uri, needed, context, devices);
        if (context.stopped()) return stopped();
        if (!opened) return failure(opened);
        if (!*stated) continue;
        if (hadScope || !devices.has(Role::Oscilloscope)) {
            return invalid("device \"{}\" is not an oscilloscope; its address states how accurate one is", uri.text());
        }
        devices.scopeStatement = **stated;
        std::ranges::copy_if(given, std::back_inserter(devices.scopeKeys),
                             [](const auto& parameter) { return statesAccuracy(parameter.first); });
    }
    for (const auto role : needed) {
        if (devices.has(role)) continue;
        return fail(ErrorCode::NotFound, "no {} is open: add --device sim: or the URI of one (tactoscope-cli devices)",
                    nameOf(role));
    }
    return devices;
}

}  // namespace tacto
