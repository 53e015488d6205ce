// OpenDevices.h - opens the devices of a bench and adds the data sheet figures of their oscilloscope.
//
// The built-in profiles (resources/instruments) state the accuracy of an instrument that identifies its maker and
// model. Keys in the device's address override single figures. Profiles do not apply to a simulated oscilloscope, which
// states its own figures, nor to a folder of captures, because the instrument that made them is not known (hazard H9).
//
// Thread-safety: as Registry.
#pragma once

#include "core/devices/Registry.h"

namespace tacto {

/// Errors: as Registry::open() and shippedInstruments().
[[nodiscard]] Result<DeviceSet> openDevices(Registry& registry, std::span<const DeviceUri> uris,
                                            const std::set<Role>& needed, const OpenContext& context);

/// Checks addresses while no device may be touched: simulated devices, recordings and captures are opened and closed
/// again; of other devices only what the address states of their accuracy is read. May read files: not for a window's
/// thread. Errors: as Registry::open(), but not for a scheme that is unknown.
[[nodiscard]] Result<void> checkAddresses(std::span<const DeviceUri> uris);

/// Adds the profile of `devices.oscilloscope` for figures that are not stated yet. openDevices() calls this.
[[nodiscard]] Result<void> addInstrumentProfile(DeviceSet& devices);

}  // namespace tacto
