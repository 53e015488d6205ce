// SimulatedDriver.h - the digital twin: a finger on a material, a stimulator with flaws, the load it drives, an
// oscilloscope on that load and a massager, all seeded and all on the clock they are given.
//
//   sim:                                                   every wanted role that is still empty
//   sim:finger?material=P120&speed=50mm/s&force=1.5N       one stroke after another on sandpaper
//   sim:stimulator?mode=current&gain=1.02&load=500ohm&fault=open@12s
//   sim:oscilloscope?bits=12&noise=2mV
//   sim:massager
//   sim:finger?on=motor                                    the sensor board, fastened to the massager's motor
//
// Devices opened into one DeviceSet share one world: the oscilloscope sees what the stimulator drives. The load is
// OpenContext::declaredLoad unless `load=` says otherwise. Same seed and same calls at the same times: same bytes,
// however often the devices are read. Every key is checked; an unknown one is refused with the list of those known.
//
// The set gets a SurfacePresenter with a simulated finger that is not on the motor, and a LoadFitter with a simulated
// stimulator.
//
// Thread-safety: as Driver.
#pragma once

#include <memory>

#include "core/devices/Driver.h"

namespace tacto {

/// The driver of the scheme "sim". Runs on either clock.
[[nodiscard]] std::unique_ptr<Driver> makeSimulatedDriver();

}  // namespace tacto
