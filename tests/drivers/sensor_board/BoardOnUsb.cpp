#include "tests/drivers/sensor_board/BoardOnUsb.h"

#include "drivers/sensor_board/SensorBoardDriver.h"

namespace tacto::test {

namespace {
constexpr std::uint8_t kIn = 0x81;
}

UsbDescription boardDescription(BoardInterface kind, const std::string& serial) {
    auto made = kind == BoardInterface::Serial ? cdcAcmDevice(kSensorBoardVendor, kSensorBoardProduct, serial)
                                               : vendorDevice(kSensorBoardVendor, kSensorBoardProduct, serial);
    made.name = kSensorBoardName;
    return made;
}

BoardOnUsb::BoardOnUsb(UsbTestbed& bed, const Clock& clock, sensorboard::EmulatedBoardSettings settings,
                       BoardInterface kind, int port, BoardFeed::MakeSignal signal)
    : feed_(
          clock, settings, [this](auto bytes) { usb_.send(kIn, bytes); }, std::move(signal)),
      usb_(bed, boardDescription(kind, settings.serial),
           {[this](auto bytes) {
                feed_.receive(bytes);
                return UsbBytes{};
            },
            {}},
           port) {}

void BoardOnUsb::unplug() {
    usb_.unplug();
    feed_.power(false);
}

void BoardOnUsb::plug() {
    feed_.power(true);
    usb_.plug();
}

}  // namespace tacto::test
