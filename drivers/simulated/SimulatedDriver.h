// SimulatedDriver.h - the digital twin: a finger on a material, a stimulator with flaws, its load, an oscilloscope on
// that load and a massager; all use one seed and the clock they are given.
//
//   sim:                                                   every wanted role that has no device yet
//   sim:finger?material=P120&speed=50mm/s&force=1.5N       one stroke after another on sandpaper
//   sim:stimulator?mode=current&gain=1.02&load=500ohm&fault=open@12s
//   sim:oscilloscope?bits=12&noise=2mV
//   sim:massager
//   sim:finger?on=motor                                    the sensor, fastened to the massager's motor
//   sim:board?material=P120                                the finger on a sensor board that encodes by itself
//
// Devices opened into one DeviceSet share one world: the oscilloscope sees what the stimulator drives. The load is
// OpenContext::declaredLoad unless `load=` gives another. The same seed and the same calls at the same times give the
// same bytes, however often the devices are read. An unknown key is refused with the list of known keys.
//
// With a simulated finger that is not on the motor, the set also gets a SurfacePresenter; with a simulated stimulator,
// a LoadFitter.
//
// Thread-safety: as Driver.
#pragma once

#include <memory>
#include <optional>

#include "core/devices/Driver.h"

namespace tacto {

/// How the sensors of a simulated finger are put on a board that encodes by itself: sim:board.
struct SimulatedBoards {
    bool (*isOwn)(std::string_view key);  ///< true for a key of the board's address; the rest are the finger's
    Result<std::unique_ptr<TactileSensor>> (*open)(std::unique_ptr<TactileSensor> finger, const DeviceUri& uri,
                                                   const Clock& clock);
};

/// Makes the driver of the scheme "sim". Works with the virtual and the steady clock. Without `boards` there is no
/// sim:board.
[[nodiscard]] std::unique_ptr<Driver> makeSimulatedDriver(std::optional<SimulatedBoards> boards = {});

}  // namespace tacto
