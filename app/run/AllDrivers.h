// AllDrivers.h - every driver of the programs, in the one place that names them. All share one USB context.
//
// Thread-safety: the maker may be called from any thread; each registry has one caller.
#pragma once

#include <functional>

#include "core/devices/ButtonDevice.h"
#include "core/devices/Registry.h"
#include "core/devices/TransportPorts.h"

namespace tacto {

class SensorBoardPorts;

/// Registries of everything this version can open.
[[nodiscard]] std::function<Registry()> allDrivers();

/// The sockets that may hold a ScienceMode stimulator, for looking at one without opening it as a device.
[[nodiscard]] std::shared_ptr<TransportPorts> scienceModePorts();

/// Game pads and foot switches.
[[nodiscard]] std::shared_ptr<const ButtonDevices> buttonDevices();

/// Finds where sensor boards may be, for looking at one without a bench.
[[nodiscard]] std::shared_ptr<SensorBoardPorts> sensorBoardPorts();

}  // namespace tacto
