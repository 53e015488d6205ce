// ScienceModeDriver.h - opens ScienceMode4 stimulators (Hasomed P24, RehaMove3).
//
//   sciencemode:                                    the one that answers; several that do are refused
//   sciencemode:P24-000123                          by the device's identity, or by its USB serial number
//   sciencemode:1-4.2                               by its USB socket
//   sciencemode:?channel=2&connector=green          channel 0 to 3 of connector yellow or green (0, yellow)
//   sciencemode:?measure=current                    the read-back gives the amplitude in place of |Z| (voltage)
//   sciencemode:?voltage=60                         high-voltage level 30, 60, 90, 120 or 150 V (the device's own)
//   sciencemode:?tty=/dev/pts/3                     through a terminal
//   sciencemode:?tty=/dev/pts/3&emulated=yes        an emulated device, whose results are marked as simulated
//
// Thread-safety: as Driver.
#pragma once

#include <memory>

#include "core/devices/Driver.h"
#include "core/devices/TransportPorts.h"
#include "drivers/sciencemode/ScienceModeStimulator.h"

namespace tacto {

/// `ports` may be null: then only `tty=` opens anything.
[[nodiscard]] std::unique_ptr<Driver> makeScienceModeDriver(std::shared_ptr<TransportPorts> ports);

namespace sciencemode {

/// A device that was asked who and how it is, and nothing else.
struct Sighting {
    Identification identification;
    std::string place;  ///< the socket or the terminal behind which it answered
    StimStatusAck status;
    bool simulated = false;  ///< as the address says
};

/// Looks at the device that `uri` names and changes nothing about what it does: opening one ends that. `ports` may be
/// null. Errors: InvalidArgument for another scheme or a parameter that is not accepted; NotFound, Io, Device, Timeout
/// as opening it.
[[nodiscard]] Result<Sighting> lookAt(const DeviceUri& uri, TransportPorts* ports, const Clock& clock);

}  // namespace sciencemode

}  // namespace tacto
