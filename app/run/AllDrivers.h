// AllDrivers.h - all drivers of the programs, listed in this one place. All drivers share one USB context.
//
// Thread-safety: any thread may call the returned function; each registry has one caller.
#pragma once

#include <functional>

#include "core/devices/ButtonDevice.h"
#include "core/devices/Registry.h"
#include "core/devices/TransportPorts.h"

namespace tacto {

class SensorBoardPorts;

/// Returns a function that makes registries of every device that this version can open.
[[nodiscard]] std::function<Registry()> allDrivers();

/// Returns ports that may have a ScienceMode stimulator, for checking a port without opening a device.
[[nodiscard]] std::shared_ptr<TransportPorts> scienceModePorts();

/// Returns game pads and foot switches.
[[nodiscard]] std::shared_ptr<const ButtonDevices> buttonDevices();

/// Finds ports that may have a sensor board, for checking a board without a bench.
[[nodiscard]] std::shared_ptr<SensorBoardPorts> sensorBoardPorts();

}  // namespace tacto
