// SensorBoardDriver.h - opens sensor boards.
//
//   board:                          the first that answers
//   board:TSB-0001                  by serial number
//   board:?rate=2kHz&slowrate=100   acceleration at 2 kHz, taxels and force at 100 Hz, if the board can
//   board:?tty=/dev/pts/3           through a terminal, for a board on a serial port or an emulated one behind it
//
// Thread-safety: as Driver.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "core/devices/Driver.h"
#include "core/devices/Transport.h"

namespace tacto {

/// pid.codes' number for private tests, and the product string that tells our boards from others that use it
/// (PROTOCOL.md, section 1).
inline constexpr std::uint16_t kSensorBoardVendor = 0x1209;
inline constexpr std::uint16_t kSensorBoardProduct = 0x0001;
inline constexpr const char* kSensorBoardName = "Tactoscope sensor board";

/// A place where a board is.
struct SensorBoardPort {
    std::string serial;    ///< USB serial number, which is the board's
    std::string place;     ///< which socket, for messages and where there is no serial number
    std::string obstacle;  ///< why it cannot be opened and what helps; empty where it can
};

/// Where boards are looked for: USB in programs (UsbSensorBoards.h), anything in tests. One caller at a time.
class SensorBoardPorts {
public:
    virtual ~SensorBoardPorts() = default;
    [[nodiscard]] virtual std::vector<SensorBoardPort> list() const = 0;
    /// Errors: as the transport's own.
    [[nodiscard]] virtual Result<std::unique_ptr<Transport>> open(const SensorBoardPort& port) = 0;
    /// For `tty=`. Errors: Unsupported where these ports know no terminals; as the transport's own.
    [[nodiscard]] virtual Result<std::unique_ptr<Transport>> openTerminal(const std::string& path) = 0;
};

/// The driver of the scheme "board". Errors of its open(): InvalidArgument (a parameter); NotFound; as
/// SensorBoard::open().
[[nodiscard]] std::unique_ptr<Driver> makeSensorBoardDriver(std::shared_ptr<SensorBoardPorts> ports);

}  // namespace tacto
