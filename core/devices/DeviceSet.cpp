#include "core/devices/DeviceSet.h"

namespace tacto {

bool DeviceSet::has(Role role) const noexcept {
    switch (role) {
        case Role::Sensor:
            return sensor != nullptr;
        case Role::Stimulator:
            return stimulator != nullptr;
        case Role::Oscilloscope:
            return oscilloscope != nullptr;
        case Role::Massager:
            return massager != nullptr;
    }
    return false;
}

Result<void> DeviceSet::checkFree(Role role, const DeviceUri& uri) const {
    if (!has(role)) return {};
    return uri.refuse(ErrorCode::InvalidArgument, "{} {} is open already, and a bench has one of each",
                      role == Role::Oscilloscope ? "an" : "a", nameOf(role));
}

std::vector<DeviceIdentity> DeviceSet::identities() const {
    std::vector<DeviceIdentity> found;
    const Device* all[] = {sensor.get(), stimulator.get(), oscilloscope.get(), massager.get()};
    for (const auto* device : all) {
        if (device == nullptr) continue;
        auto& identity = found.emplace_back(device->identity());
        if (device != oscilloscope.get() || scopeKeys.empty()) continue;
        auto address = DeviceUri::parse(identity.uri);
        if (!address) continue;
        address->parameters.insert(address->parameters.end(), scopeKeys.begin(), scopeKeys.end());
        identity.uri = address->text();
    }
    return found;
}

}  // namespace tacto
