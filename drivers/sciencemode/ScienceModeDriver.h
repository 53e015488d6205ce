// ScienceModeDriver.h - opens ScienceMode4 stimulators (Hasomed P24, RehaMove3).
//
//   sciencemode:                                    the only one that answers; several are refused
//   sciencemode:P24-000123                          by the device's identity, or by its USB serial number
//   sciencemode:1-4.2                               by its USB socket
//   sciencemode:?channel=2&connector=green          channel 0 to 3 of connector yellow or green (default 0, yellow)
//   sciencemode:?measure=current                    the read-back gives the amplitude, not |Z| (default voltage)
//   sciencemode:?voltage=60                         high voltage 30, 60, 90, 120 or 150 V (default: the device's)
//   sciencemode:?tty=/dev/pts/3                     through a terminal
//   sciencemode:?tty=/dev/pts/3&emulated=yes        an emulated device; its results are marked as simulated
//
// Thread-safety: as Driver.
#pragma once

#include <memory>

#include "core/devices/Driver.h"
#include "core/devices/TransportPorts.h"
#include "drivers/sciencemode/ScienceModeStimulator.h"

namespace tacto {

/// If `ports` is null, only `tty=` opens a device.
[[nodiscard]] std::unique_ptr<Driver> makeScienceModeDriver(std::shared_ptr<TransportPorts> ports);

namespace sciencemode {

/// A device's answers about its identity and state.
struct Sighting {
    Identification identification;
    std::string place;  ///< the socket or terminal at which it answered
    StimStatusAck status;
    bool simulated = false;  ///< as stated in the address
};

/// Asks the device that `uri` names without changing its output (opening a device ends its output). `ports` may be
/// null. Errors: InvalidArgument for another scheme or a parameter that is not accepted; NotFound, Io, Device, Timeout
/// as for opening.
[[nodiscard]] Result<Sighting> lookAt(const DeviceUri& uri, TransportPorts* ports, const Clock& clock);

}  // namespace sciencemode

}  // namespace tacto
