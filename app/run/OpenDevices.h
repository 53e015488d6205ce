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

/// Adds the profile of `devices.oscilloscope` for figures that are not stated yet. openDevices() calls this.
[[nodiscard]] Result<void> addInstrumentProfile(DeviceSet& devices);

}  // namespace tacto
