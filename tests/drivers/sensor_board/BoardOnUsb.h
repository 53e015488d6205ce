// BoardOnUsb.h - the emulated sensor board plugged into the emulated bus.
//
// Thread-safety: as DeviceOnUsb.
#pragma once

#include "drivers/sensor_board/SensorBoardDriver.h"
#include "tests/drivers/sensor_board/BoardOnPty.h"
#include "tests/support/usb_emulation/DeviceOnUsb.h"

namespace tacto::test {

/// The kind of interface with the two endpoints; PROTOCOL.md, section 1, allows both kinds.
enum class BoardInterface { Serial, Vendor };

/// Returns a board's descriptors, with the product string that identifies boards.
[[nodiscard]] inline UsbDescription boardDescription(BoardInterface kind, const std::string& serial) {
    auto made = kind == BoardInterface::Serial ? cdcAcmDevice(kSensorBoardVendor, kSensorBoardProduct, serial)
                                               : vendorDevice(kSensorBoardVendor, kSensorBoardProduct, serial);
    made.name = kSensorBoardName;
    return made;
}

class BoardOnUsb : public DeviceOnUsb<sensorboard::EmulatedBoard> {
public:
    BoardOnUsb(UsbTestbed& bed, const Clock& clock, const sensorboard::EmulatedBoardSettings& settings = {},
               BoardInterface kind = BoardInterface::Serial, int port = 1, MakeSignal signal = {})
        : DeviceOnUsb(bed, clock, boardDescription(kind, settings.serial), poweredBoard(settings, std::move(signal)),
                      port, kBoardRest) {}
};

}  // namespace tacto::test
