// OpenDevices.h - opens the devices of a bench and adds what the data sheet of their oscilloscope states.
//
// The built-in profiles (resources/instruments) say how accurate an instrument is that names itself by maker and model.
// Keys of the device's address override them, figure by figure. A simulated oscilloscope states its own figures, and a
// folder of captures does not say which instrument wrote them: profiles apply to neither (hazard H9).
//
// Thread-safety: as Registry.
#pragma once

#include "core/devices/Registry.h"

namespace tacto {

/// Errors: as Registry::open() and shippedInstruments().
[[nodiscard]] Result<DeviceSet> openDevices(Registry& registry, std::span<const DeviceUri> uris,
                                            const std::set<Role>& needed, const OpenContext& context);

/// Adds the profile of `devices.oscilloscope` below what is stated already. openDevices() calls it.
[[nodiscard]] Result<void> addInstrumentProfile(DeviceSet& devices);

}  // namespace tacto
