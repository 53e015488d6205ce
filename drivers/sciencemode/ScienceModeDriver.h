// ScienceModeDriver.h - opens ScienceMode4 stimulators (Hasomed P24, RehaMove3).
//
//   sciencemode:                                    the first that answers
//   sciencemode:P24-000123                          by the device's identity, or by its USB serial number
//   sciencemode:?channel=2&connector=green          channel 0 to 3 of connector yellow or green (0, yellow)
//   sciencemode:?level=mid                          repeat() is allowed: bench loads only, under heartbeat (low)
//   sciencemode:?measure=current                    the read-back gives the amplitude in place of |Z| (voltage)
//   sciencemode:?voltage=60                         high-voltage level 30, 60, 90, 120 or 150 V (the device's own)
//   sciencemode:?tty=/dev/pts/3                     through a terminal, for a device or an emulated one behind it
//
// Thread-safety: as Driver.
#pragma once

#include <memory>

#include "core/devices/Driver.h"
#include "core/devices/TransportPorts.h"

namespace tacto {

/// `ports` may be null: then only `tty=` opens anything.
[[nodiscard]] std::unique_ptr<Driver> makeScienceModeDriver(std::shared_ptr<TransportPorts> ports);

}  // namespace tacto
