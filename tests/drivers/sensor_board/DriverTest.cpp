// Which board a URI opens: found by serial number, parameters checked, obstacles reported.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "drivers/sensor_board/SensorBoardDriver.h"
#include "tests/drivers/sensor_board/SensorBoardBench.h"
#include "tests/support/Refused.h"

namespace tacto::test {
namespace {

using namespace sensorboard;
using testing::HasSubstr;

/// Ports with several emulated boards, one that may not be opened, and a terminal.
class Ports final : public SensorBoardPorts {
public:
    explicit Ports(VirtualClock& clock) {
        for (const char* serial : {"TSB-1", "TSB-2"}) {
            EmulatedBoardSettings settings;
            settings.serial = serial;
            lines.push_back(
                std::make_shared<EmulatedBoardLine>(clock, &clock, settings, std::make_unique<CountingSignal>()));
        }
    }
    std::vector<TransportPort> list() const override {
        std::vector<TransportPort> found = extra;
        for (const auto& line : lines) {
            for (auto& port : line->list()) {
                port.place = fmt::format("1-{}", found.size() + 1);
                if (port.serial == hideSerial) port.serial.clear();
                found.push_back(port);
            }
        }
        return found;
    }
    Result<std::unique_ptr<Transport>> open(const TransportPort& port) override {
        ++opened;
        return lines[port.serial == "TSB-1" ? 0 : 1]->connect();
    }
    Result<std::unique_ptr<Transport>> openTerminal(const std::string& path) override {
        terminal = path;
        return lines[1]->connect();
    }

    std::vector<std::shared_ptr<EmulatedBoardLine>> lines;
    std::vector<TransportPort> extra;
    std::string terminal;
    std::string hideSerial;  ///< the board without a serial number in its USB descriptor
    int opened = 0;
};

class SensorBoardDriverTest : public testing::Test {
protected:
    Result<void> open(const std::string& text) {
        const auto uri = DeviceUri::parse(text);
        EXPECT_TRUE(uri.has_value());
        return driver_->open(*uri, {}, {clock_}, devices_);
    }

    VirtualClock clock_;
    std::shared_ptr<Ports> ports_ = std::make_shared<Ports>(clock_);
    std::unique_ptr<Driver> driver_ = makeSensorBoardDriver(ports_);
    DeviceSet devices_;
};

TEST_F(SensorBoardDriverTest, ListsWhatIsPluggedInWithWhatIsInTheWay) {
    ports_->extra.push_back({"TSB-9", "1-4", "USB device 1209:0001 may not be opened: run ./dev install-rules"});
    const auto found = driver_->list();
    ASSERT_EQ(found.size(), 3U);
    EXPECT_EQ(found[0].uri, "sensor:TSB-9");
    EXPECT_THAT(found[0].obstacle, HasSubstr("install-rules"));
    EXPECT_EQ(found[1].obstacle, "");
    EXPECT_EQ(found[1].uri, "sensor:TSB-1");
    EXPECT_EQ(found[1].role, Role::Sensor);
    EXPECT_FALSE(driver_->runsOnVirtualClock());
    EXPECT_EQ(driver_->scheme(), "sensor");
}

TEST_F(SensorBoardDriverTest, OpensTheFirstThatAnswersOrTheOneNamed) {
    RecordProperty("hazard", "H4");
    ASSERT_TRUE(open("sensor:").has_value());
    EXPECT_EQ(devices_.sensor->identity().serial, "TSB-1");
    devices_.sensor.reset();
    ASSERT_TRUE(open("sensor:TSB-2").has_value());
    EXPECT_EQ(devices_.sensor->identity().serial, "TSB-2");
    EXPECT_EQ(devices_.sensor->identity().uri, "sensor:TSB-2");
    EXPECT_FALSE(devices_.sensor->identity().simulated);
}

TEST_F(SensorBoardDriverTest, EachOfTwoIsListedWithAnAddressThatOpensItAndNoOther) {
    RecordProperty("hazard", "H4");
    ports_->hideSerial = "TSB-2";
    const auto found = driver_->list();
    ASSERT_EQ(found.size(), 2U);
    EXPECT_EQ(found[0].uri, "sensor:TSB-1");
    const auto place = ports_->list()[1].place;
    EXPECT_EQ(found[1].uri, "sensor:" + place);
    ASSERT_TRUE(open(found[1].uri).has_value());
    EXPECT_EQ(devices_.sensor->identity().serial, "TSB-2");
    EXPECT_EQ(ports_->opened, 1);
    devices_.sensor.reset();
    // The board itself states its serial number when asked.
    ASSERT_TRUE(open("sensor:TSB-2").has_value());
    EXPECT_EQ(devices_.sensor->identity().serial, "TSB-2");
    EXPECT_EQ(ports_->opened, 2);
}

TEST_F(SensorBoardDriverTest, PassesOverABoardThatMayNotBeOpened) {
    ports_->extra.push_back({"TSB-9", "1-4", "it may not be opened: run ./dev install-rules"});
    ASSERT_TRUE(open("sensor:").has_value());
    EXPECT_EQ(devices_.sensor->identity().serial, "TSB-1");
    devices_.sensor.reset();
    EXPECT_THAT(open("sensor:TSB-9"), refused(ErrorCode::Io, "install-rules"));
}

TEST_F(SensorBoardDriverTest, WhatIsNotThereIsNotFound) {
    EXPECT_THAT(
        open("sensor:TSB-3"),
        refused(ErrorCode::NotFound, "no such sensor board is plugged in (USB 1209:0001 \"Tactoscope sensor board\")"));
    EXPECT_EQ(ports_->opened, 0);
}

TEST_F(SensorBoardDriverTest, ReadsItsParameters) {
    ASSERT_TRUE(open("sensor:?rate=2kHz&slowrate=100").has_value());
    EXPECT_EQ(devices_.sensor->streams()[0].rate_hz, 2000);
    EXPECT_EQ(devices_.sensor->streams()[1].rate_hz, 100);
    devices_.sensor.reset();
    ASSERT_TRUE(open("sensor:?tty=/dev/pts/7").has_value());
    EXPECT_EQ(ports_->terminal, "/dev/pts/7");
    EXPECT_EQ(devices_.sensor->identity().serial, "TSB-2");
}

TEST_F(SensorBoardDriverTest, RefusesParametersThatItDoesNotTake) {
    for (const auto& [uri, expected] : {std::pair{"sensor:?rate=50", "rate=50 is not accepted: 100 Hz to 20 kHz"},
                                        {"sensor:?rate=nan", "100 Hz to 20 kHz"},
                                        {"sensor:?slowrate=5", "slowrate=5 is not accepted: 20 Hz to 2 kHz"},
                                        {"sensor:?tty=", "a terminal's path, as /dev/ttyACM0"},
                                        {"sensor:?encodes=yes", "encodes=yes is not accepted: no, shown or drives"},
                                        {"sensor:?speed=1", "it takes rate, slowrate, emulated, encodes, tty"},
                                        {"sensor:?rate=2000&rate=1000", "rate is given twice"}}) {
        EXPECT_THAT(open(uri), refused(ErrorCode::InvalidArgument, expected)) << uri;
    }
    EXPECT_EQ(ports_->opened, 0);
}

TEST_F(SensorBoardDriverTest, ABenchHasOneSensor) {
    ASSERT_TRUE(open("sensor:").has_value());
    EXPECT_THAT(open("sensor:TSB-2"), refusedSaying("a sensor is open already"));
}

}  // namespace
}  // namespace tacto::test
