#include "app/run/OpenDevices.h"

#include "app/run/Shipped.h"
#include "core/devices/Device.h"

namespace tacto {

Result<void> addInstrumentProfile(DeviceSet& devices) {
    if (!devices.oscilloscope) return {};
    const auto& identity = devices.oscilloscope->identity();
    const bool replayed = dynamic_cast<const ReplayedDevice*>(devices.oscilloscope.get()) != nullptr;
    if (identity.simulated || replayed) return {};
    const auto profiles = shippedInstruments();
    if (!profiles) return failure(profiles);
    devices.scopeStatement = merged(statementOf(*profiles, identity.name), devices.scopeStatement);
    return {};
}

Result<DeviceSet> openDevices(Registry& registry, std::span<const DeviceUri> uris, const std::set<Role>& needed,
                              const OpenContext& context) {
    auto devices = registry.open(uris, needed, context);
    if (!devices) return devices;
    if (const auto added = addInstrumentProfile(*devices); !added) return failure(added);
    return devices;
}

}  // namespace tacto
