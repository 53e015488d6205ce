#include "app/run/OpenDevices.h"

#include "app/run/CaptureFormatsList.h"
#include "app/run/Shipped.h"
#include "core/base/Clock.h"
#include "core/devices/Device.h"
#include "drivers/replay/ReplayDrivers.h"
#include "drivers/simulated/SimulatedDriver.h"

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

Result<void> checkAddresses(std::span<const DeviceUri> uris) {
    std::vector<std::unique_ptr<Driver>> drivers;
    drivers.push_back(makeSimulatedDriver());
    drivers.push_back(makeRecordingDriver());
    drivers.push_back(makeCaptureDriver(captureFormats()));
    Registry registry(std::move(drivers));
    std::vector<DeviceUri> harmless;
    for (auto uri : uris) {
        if (registry.allVirtual({&uri, 1})) {
            harmless.push_back(std::move(uri));
        } else if (const auto stated = takeStatement(uri); !stated) {
            return failure(stated);
        }
    }
    const VirtualClock clock;
    const auto opened = registry.open(harmless, {}, {.clock = clock});
    return opened ? Result<void>() : failure(opened);
}

}  // namespace tacto
