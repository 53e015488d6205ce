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
#include <string>
#include <vector>

#include "core/devices/Driver.h"
#include "core/devices/Transport.h"

namespace tacto {

/// A place where such a device may be: the id 0483:5740 is any STM32 serial port's.
struct ScienceModePort {
    std::string serial;    ///< USB serial number; may be empty
    std::string place;     ///< which socket, for messages and where there is no serial number
    std::string obstacle;  ///< why it cannot be opened and what helps; empty where it can
};

/// Where such devices are looked for: USB in programs, anything in tests. One caller at a time, whichever thread: after
/// an unplug the session's thread looks again.
class ScienceModePorts {
public:
    virtual ~ScienceModePorts() = default;
    [[nodiscard]] virtual std::vector<ScienceModePort> list() const = 0;
    /// Errors: as the transport's own.
    [[nodiscard]] virtual Result<std::unique_ptr<Transport>> open(const ScienceModePort& port) = 0;
};

/// `ports` may be null: then only `tty=` opens anything.
[[nodiscard]] std::unique_ptr<Driver> makeScienceModeDriver(std::shared_ptr<ScienceModePorts> ports);

}  // namespace tacto
