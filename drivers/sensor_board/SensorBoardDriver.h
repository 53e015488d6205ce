// SensorBoardDriver.h - opens sensor boards.
//
//   sensor:                          the first board that answers
//   sensor:TSB-0001                  by serial number
//   sensor:1-4.2                     by its USB socket
//   sensor:?rate=2kHz&slowrate=100   acceleration at 2 kHz, taxels and force at 100 Hz, if the board can
//   sensor:?encodes=drives           the board encodes and its trains are played; shown: they are only shown
//   sensor:?tty=/dev/pts/3           through a terminal device
//   sensor:?tty=/dev/pts/3&emulated=yes  an emulated board; its results are marked as simulated
//
// Thread-safety: as Driver.
#pragma once

#include <memory>
#include <string>

#include "core/devices/Driver.h"
#include "core/devices/TransportPorts.h"

namespace tacto {

class SensorBoard;

/// The number that pid.codes reserves for private tests, and the product string that tells our boards from other
/// devices with that number (PROTOCOL.md, section 1).
inline constexpr std::uint16_t kSensorBoardVendor = 0x1209;
inline constexpr std::uint16_t kSensorBoardProduct = 0x0001;
inline constexpr const char* kSensorBoardName = "Tactoscope sensor board";

/// Looks for boards: in programs on USB (UsbSensorBoards.h), in tests anywhere.
class SensorBoardPorts : public TransportPorts {
public:
    /// Opens the terminal of `tty=`. Errors: Unsupported if these ports have no terminals; as the transport's own.
    [[nodiscard]] virtual Result<std::unique_ptr<Transport>> openTerminal(const std::string& path) = 0;
};

/// Opens the board that `uri` names without a driver, to inspect it. `clock` outlives the board. Errors:
/// InvalidArgument (a parameter); NotFound; as SensorBoard::open().
[[nodiscard]] Result<std::unique_ptr<SensorBoard>> openSensorBoard(const std::shared_ptr<SensorBoardPorts>& ports,
                                                                   const DeviceUri& uri, const Clock& clock);

/// Makes the driver of the scheme "sensor". Its boards are Reconnecting and report on themselves. Errors of its open():
/// as openSensorBoard().
[[nodiscard]] std::unique_ptr<Driver> makeSensorBoardDriver(std::shared_ptr<SensorBoardPorts> ports);

}  // namespace tacto
