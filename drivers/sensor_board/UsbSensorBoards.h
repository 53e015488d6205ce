// UsbSensorBoards.h - finds plugged-in sensor boards by VID:PID and product string, over libusb.
//
// Thread-safety: as SensorBoardPorts.
#pragma once

#include <functional>
#include <memory>

#include "drivers/sensor_board/SensorBoardDriver.h"
#include "drivers/usb/UsbProvider.h"

namespace tacto {

/// Opens a terminal for `tty=`; may be null.
using OpenTerminal = std::function<Result<std::unique_ptr<Transport>>(const std::string& path)>;

/// If USB does not start (in a container), only `tty=` opens a board.
[[nodiscard]] std::shared_ptr<SensorBoardPorts> makeUsbSensorBoards(UsbProvider usb, OpenTerminal openTerminal);

}  // namespace tacto
