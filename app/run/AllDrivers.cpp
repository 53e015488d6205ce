#include "app/run/AllDrivers.h"

#include "app/run/CaptureFormatsList.h"
#include "app/scripting/engine/ProtocolLibrary.h"
#include "drivers/hid_input/HidInput.h"
#include "drivers/hid_massager/HidDriver.h"
#include "drivers/pulsepal/PulsePalDriver.h"
#include "drivers/replay/ReplayDrivers.h"
#include "drivers/sciencemode/ScienceModeDriver.h"
#include "drivers/sciencemode/TtyTransport.h"
#include "drivers/sensor_board/SimulatedBoard.h"
#include "drivers/sensor_board/UsbSensorBoards.h"
#include "drivers/sigrok/driver/SigrokDriver.h"
#include "drivers/simulated/SimulatedDriver.h"
#include "drivers/usb/UsbPorts.h"

namespace tacto {

namespace {
const UsbProduct kScienceMode{0x0483, 0x5740};  // shared by all STM32 serial ports: the device is asked
const UsbProduct kPulsePal{kPulsePalVendor, kPulsePalProduct};
}  // namespace

std::function<Registry()> allDrivers() {
    return [usb = makeUsbProvider()] {
        std::vector<std::unique_ptr<Driver>> drivers;
        drivers.push_back(makeSimulatedDriver(
            SimulatedBoards{sensorboard::SimulatedBoard::isOwn, sensorboard::SimulatedBoard::open}));
        drivers.push_back(makeRecordingDriver());
        drivers.push_back(makeCaptureDriver(captureFormats()));
        drivers.push_back(makeSigrokDriver(usb));
        drivers.push_back(makeScienceModeDriver(makeUsbPorts(usb, {kScienceMode}, {})));
        drivers.push_back(makePulsePalDriver(makeUsbPorts(usb, {kPulsePal}, {.dataTerminalReady = true})));
        drivers.push_back(makeSensorBoardDriver(makeUsbSensorBoards(usb, sciencemode::TtyTransport::open)));
        if (const auto resources = resourcesFolder()) {
            drivers.push_back(hid::makeHidDriver(hid::systemHid(*resources / "massagers", usb)));
        }
        return Registry(std::move(drivers));
    };
}

std::shared_ptr<TransportPorts> scienceModePorts() { return makeUsbPorts(makeUsbProvider(), {kScienceMode}, {}); }

std::shared_ptr<const ButtonDevices> buttonDevices() { return hid::systemHidInput(); }

std::shared_ptr<SensorBoardPorts> sensorBoardPorts() {
    return makeUsbSensorBoards(makeUsbProvider(), sciencemode::TtyTransport::open);
}

}  // namespace tacto
