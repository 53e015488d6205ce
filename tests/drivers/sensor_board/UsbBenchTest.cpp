// A bench with a sensor board over the real libusb, in real time: losses are counted, shown and recorded; unplugging
// the board ends the output, and the board returns after a reset.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "drivers/sensor_board/UsbSensorBoards.h"
#include "drivers/simulated/SimulatedDriver.h"
#include "tests/drivers/UsbBench.h"
#include "tests/drivers/sensor_board/BoardOnUsb.h"
#include "tests/support/Refused.h"

namespace tacto::test {
namespace {

using namespace std::chrono_literals;
using sensorboard::FingerSignal;
using testing::HasSubstr;

sensorboard::EmulatedBoardSettings boardNamed(const std::string& serial) {
    sensorboard::EmulatedBoardSettings settings;
    settings.serial = serial;
    return settings;
}

class SensorBoardBenchOnUsb : public UsbBench {
protected:
    [[nodiscard]] Registry registry() override {
        std::vector<std::unique_ptr<Driver>> drivers;
        drivers.push_back(makeSimulatedDriver());
        drivers.push_back(makeSensorBoardDriver(makeUsbSensorBoards(usb_, nullptr)));
        return Registry(std::move(drivers));
    }
    [[nodiscard]] bool present() {
        const auto devices = registry().list();
        return std::ranges::any_of(devices, [](const auto& device) { return device.uri == "sensor:TSB-0001"; });
    }
    void open() {
        ASSERT_IN_TIME(comes([&] { return present(); }));
        UsbBench::open({*DeviceUri::parse("sensor:"), *DeviceUri::parse("sim:")}, {Role::Sensor, Role::Stimulator});
    }
    void deliver() {
        ASSERT_IN_TIME(arm());
        ASSERT_IN_TIME(bench_->drive(DriveSource::Manual, 0.5, 1));
        ASSERT_IN_TIME(comes([&] { return bench_->telemetry().trainsDelivered > 0; }));
    }
    /// Closes the bench and returns the bodies of all events of a kind.
    [[nodiscard]] std::vector<nlohmann::json> eventsOf(const std::string& kind) {
        bench_.reset();
        EXPECT_TRUE(session_->close());
        const auto reader = SessionReader::open(file());
        EXPECT_TRUE(reader);
        std::vector<nlohmann::json> found;
        const auto events = reader->events();
        EXPECT_TRUE(events);
        for (const auto& event : *events) {
            if (event.name == kind) found.push_back(event.body);
        }
        return found;
    }
    [[nodiscard]] double reported(std::string_view key) const {
        const auto report = bench_->deviceReport(Role::Sensor);
        if (!report) return std::nan("");
        for (const auto& row : report->rows()) {
            if (row.key == key) return row.value;
        }
        return std::nan("");
    }

    BoardOnUsb device_{bed_, *clock_, boardNamed("TSB-0001"), BoardInterface::Serial, 1, [](Instant now) {
                           return std::make_unique<FingerSignal>(sim::FingerSettings{}, now);
                       }};
};

TEST_F(SensorBoardBenchOnUsb, WhatIsLostIsCountedInTheStreamsAndKeptInTheSession) {
    RecordProperty("hazard", "H7");
    open();
    ASSERT_IN_TIME(comes([&] { return reported("samples") > 500; }));
    ASSERT_IN_TIME(bench_->telemetry().gaps == 0U);  // a computer that stalls would lose samples itself
    device_.inspect([](auto& board, Instant) { board.dropNext(0); });
    ASSERT_IN_TIME(comes([&] { return bench_->telemetry().gaps == 1; })) << "a gap is never bridged";
    EXPECT_IN_TIME(reported("frames_lost") == 1);
    EXPECT_IN_TIME(reported("samples_lost") == 32);
    // The control loop checks every 100 ms.
    ASSERT_IN_TIME(bench_->wait(Seconds(0.3)));

    const auto reports = eventsOf("device report");
    ASSERT_IN_TIME(reports.size() == 2U) << "when it happened, and at the end";
    EXPECT_THAT(reports[0]["text"].get<std::string>(), HasSubstr("lost"));
    EXPECT_IN_TIME(reports[0]["samples_lost"] == 32);
    EXPECT_IN_TIME(reports[1]["samples_lost"] == 32);
    EXPECT_IN_TIME(reports[1]["gaps"] == 1);
    EXPECT_EQ(reports[1]["crc_errors"], 0);
    EXPECT_TRUE(reports[1].contains("drift_ppm"));
    EXPECT_GT(reports[1]["samples"], reports[0]["samples"]);
}

TEST_F(SensorBoardBenchOnUsb, ALineThatGoesOnLosingDoesNotFillTheSession) {
    open();
    device_.inspect([](auto& board, Instant) { board.spoil({.drop = 0.3, .flip = 0.3}); });
    ASSERT_IN_TIME(comes([&] { return reported("crc_errors") > 20; }));
    ASSERT_IN_TIME(bench_->wait(Seconds(1)));
    const auto reports = eventsOf("device report");
    ASSERT_IN_TIME(reports.size() == 2U);
    EXPECT_GT(reports[1]["crc_errors"], reports[0]["crc_errors"]);
}

TEST_F(SensorBoardBenchOnUsb, UnpluggedItEndsTheOutputAndPluggedInAgainItIsFoundAfterAReset) {
    RecordProperty("hazard", "H2");
    open();
    deliver();
    device_.unplug();
    ASSERT_IN_TIME(comes([&] { return bench_->telemetry().state == InterlockState::Faulted; }));
    const std::string reason(bench_->telemetry().reason.view());
    ASSERT_IN_TIME(reason.find("fingertip sensor failed") != std::string::npos) << reason;
    const auto delivered = bench_->telemetry().trainsDelivered;
    const auto waited = bench_->wait(Seconds(1));
    ASSERT_FALSE(waited);
    EXPECT_EQ(bench_->telemetry().trainsDelivered, delivered);
    EXPECT_THAT(bench_->resetFault(), refusedSaying("no such sensor board is plugged in"));
    EXPECT_IN_TIME(bench_->telemetry().state == InterlockState::Faulted);

    const double before = reported("samples");
    device_.plug();
    ASSERT_IN_TIME(comes([&] { return present(); }));
    std::this_thread::sleep_for(300ms);
    EXPECT_IN_TIME(bench_->telemetry().state == InterlockState::Faulted) << "nothing goes on by itself";
    const auto reset = bench_->resetFault();
    ASSERT_IN_TIME(reset);
    EXPECT_IN_TIME(bench_->telemetry().state == InterlockState::Disarmed);
    ASSERT_IN_TIME(comes([&] { return reported("samples") > before + 500; })) << "and its report goes on counting";
    EXPECT_IN_TIME(comes([&] { return bench_->telemetry().sensorAge_s < 0.1; }));
    deliver();

    const auto faults = eventsOf("fault");
    ASSERT_IN_TIME(faults.size() == 1U);
    const auto verified = accepted(verifySession(file()));
    EXPECT_EQ(verified.status, SessionStatus::Intact);
}

TEST_F(SensorBoardBenchOnUsb, AnotherBoardInItsPlaceIsNotTaken) {
    RecordProperty("hazard", "H4");
    open();
    device_.unplug();
    ASSERT_IN_TIME(comes([&] { return bench_->telemetry().state == InterlockState::Faulted; }));
    BoardOnUsb other(bed_, *clock_, boardNamed("TSB-0002"), BoardInterface::Serial, 2);
    ASSERT_IN_TIME(comes([&] { return registry().list().size() > 1; }));
    EXPECT_THAT(bench_->resetFault(), refusedSaying("sensor:TSB-0001"));
    EXPECT_FALSE(other.inspect([](auto& board, Instant) { return board.running(); }));
}

}  // namespace
}  // namespace tacto::test
