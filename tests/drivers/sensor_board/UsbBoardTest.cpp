// Sensor boards over the real libusb, on the emulated bus, in real time.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/devices/Device.h"
#include "drivers/sensor_board/UsbSensorBoards.h"
#include "tests/drivers/sensor_board/BoardOnUsb.h"
#include "tests/drivers/sensor_board/SensorBoardBench.h"
#include "tests/support/Comes.h"
#include "tests/support/FailsInTime.h"
#include "tests/support/InTime.h"
#include "tests/support/Refused.h"

namespace tacto::test {
namespace {

using namespace sensorboard;
using namespace std::chrono_literals;
using testing::HasSubstr;

EmulatedBoardSettings settingsFor(const std::string& serial) {
    EmulatedBoardSettings settings;
    settings.serial = serial;
    return settings;
}

/// Returns NaN if there is no such row.
double valueOf(const DeviceReport& report, std::string_view key) {
    for (const auto& row : report.rows()) {
        if (row.key == key) return row.value;
    }
    return std::nan("");
}

class SensorBoardOnUsb : public testing::Test {
protected:
    Result<void> open(const std::string& text) {
        devices_ = {};
        return driver_->open(*DeviceUri::parse(text), {}, {clock_}, devices_);
    }
    [[nodiscard]] bool listed(std::size_t boards) {
        return comes([&] { return driver_->list().size() == boards; });
    }
    /// Reads every 2 ms, as a session does, for at most `time`. Returns the first error.
    Result<void> readFor(std::chrono::milliseconds time) {
        blocks_.resize(devices_.sensor->streams().size());
        const auto end = std::chrono::steady_clock::now() + time;
        while (std::chrono::steady_clock::now() < end) {
            std::this_thread::sleep_for(2ms);
            if (auto read = devices_.sensor->read(blocks_); !read) return read;
        }
        return {};
    }

    UsbTestbed bed_;
    SteadyClock clock_;
    std::unique_ptr<Driver> driver_ = makeSensorBoardDriver(makeUsbSensorBoards(makeUsbProvider(), nullptr));
    DeviceSet devices_;
    std::vector<SampleBlock> blocks_;
};

TEST_F(SensorBoardOnUsb, IsFoundAndOpenedBySerialNumberWhicheverInterfaceItShows) {
    RecordProperty("hazard", "H4");
    BoardOnUsb serial(bed_, clock_, settingsFor("TSB-0001"), BoardInterface::Serial, 1);
    BoardOnUsb vendor(bed_, clock_, settingsFor("TSB-0002"), BoardInterface::Vendor, 2);
    ASSERT_IN_TIME(listed(2));
    for (const char* number : {"TSB-0002", "TSB-0001"}) {
        const auto opened = open(std::string("sensor:") + number);
        ASSERT_IN_TIME(opened);
        EXPECT_EQ(devices_.sensor->identity().serial, number);
        ASSERT_IN_TIME(readFor(300ms));
        EXPECT_IN_TIME(blocks_[0].samples() > 400U);
        // The last read may have ended between the two streams' blocks of two samples each.
        EXPECT_NEAR(static_cast<double>(blocks_[1].samples()), static_cast<double>(blocks_[2].samples()), 2);
        for (auto& block : blocks_) block.clear();
    }
}

TEST_F(SensorBoardOnUsb, ADeviceOfThePrivateTestNumberThatIsNoBoardIsLeftAlone) {
    RecordProperty("hazard", "H4");
    auto other = boardDescription(BoardInterface::Serial, "X-1");
    other.name = "A lamp";
    EmulatedUsbDevice lamp(bed_, other, {});
    BoardOnUsb board(bed_, clock_, settingsFor("TSB-0001"), BoardInterface::Serial, 2);
    ASSERT_IN_TIME(listed(1));
    ASSERT_IN_TIME(open("sensor:"));
    EXPECT_TRUE(lamp.waitForReceived(0).empty());
    EXPECT_FALSE(open("sensor:X-1"));
}

TEST_F(SensorBoardOnUsb, TenSecondsOfAllStreamsLoseNothing) {
    RecordProperty("hazard", "H7");
    auto settings = settingsFor("TSB-0001");
    settings.drift_ppm = 50;
    BoardOnUsb board(bed_, clock_, settings);
    ASSERT_IN_TIME(listed(1));
    ASSERT_IN_TIME(open("sensor:"));
    const auto read = readFor(10s);
    ASSERT_IN_TIME(read);
    EXPECT_IN_TIME(blocks_[0].samples() >= 39'000U);
    EXPECT_IN_TIME(blocks_[1].samples() >= 1'950U);
    for (std::size_t i = 0; i < blocks_[0].samples(); ++i) {
        ASSERT_IN_TIME(stepOf(blocks_[0], i) == static_cast<std::int64_t>(i)) << "the first that is missing";
    }
    const auto report = dynamic_cast<ReportingDevice&>(*devices_.sensor).deviceReport();
    EXPECT_IN_TIME(report.losses == 0U);
    const double uncertainty = valueOf(report, "drift_uncertainty_ppm");
    EXPECT_NEAR(valueOf(report, "drift_ppm"), 50, 3 * uncertainty);
    // Measured between the first and last of the quickest messages; on a busy computer they may be close together.
    EXPECT_IN_TIME(valueOf(report, "drift_span_s") > 1);
    EXPECT_LT(valueOf(report, "drift_span_s"), 11);
    EXPECT_IN_TIME(valueOf(report, "delay_most_s") < 0.05);
    RecordProperty("drift_ppm", std::to_string(valueOf(report, "drift_ppm")));
    RecordProperty("uncertainty_ppm", std::to_string(uncertainty));
}

TEST_F(SensorBoardOnUsb, UnpluggedInMidStreamIsAnErrorAndPluggedInAgainItOpensByItsIdentity) {
    RecordProperty("hazard", "H7");
    BoardOnUsb board(bed_, clock_, settingsFor("TSB-0001"));
    ASSERT_IN_TIME(listed(1));
    ASSERT_IN_TIME(open("sensor:TSB-0001"));
    ASSERT_IN_TIME(readFor(200ms));
    const auto begin = clock_.now();
    board.unplug();
    const auto gone = readFor(5s);
    ASSERT_FALSE(gone);
    EXPECT_IN_TIME(clock_.now() - begin < 1s);
    EXPECT_CODE_IN_TIME(gone.error().code, ErrorCode::Device);
    EXPECT_THAT(gone.error().message, HasSubstr("emulated sensor board"));
    EXPECT_IN_TIME(listed(0));

    board.plug();
    ASSERT_IN_TIME(listed(1));
    const auto again = open("sensor:TSB-0001");
    ASSERT_IN_TIME(again);
    blocks_.clear();
    ASSERT_IN_TIME(readFor(200ms));
    EXPECT_IN_TIME(blocks_[0].samples() > 300U);
}

TEST_F(SensorBoardOnUsb, ABoardThatTalksGarbageIsRefusedInTimeAndNotWaitedFor) {
    RecordProperty("hazard", "H10");
    BoardOnUsb board(bed_, clock_, settingsFor("TSB-0001"));
    ASSERT_IN_TIME(listed(1));
    ASSERT_IN_TIME(open("sensor:"));
    ASSERT_IN_TIME(readFor(100ms));
    board.inspect([](auto& b, Instant) { b.talkGarbage(true); });
    auto begin = clock_.now();
    const auto noise = readFor(5s);
    ASSERT_FALSE(noise);
    EXPECT_IN_TIME(clock_.now() - begin < 3s);
    EXPECT_THAT(noise.error().message, HasSubstr("garbage"));

    begin = clock_.now();
    const auto refused = open("sensor:");
    ASSERT_FALSE(refused);
    EXPECT_IN_TIME(clock_.now() - begin < 3s);
    EXPECT_THAT(refused.error().message, HasSubstr("garbage"));

    board.inspect([](auto& b, Instant) { b.talkGarbage(false); });
    const auto well = open("sensor:");
    EXPECT_IN_TIME(well);
}

TEST_F(SensorBoardOnUsb, ADeviceThatAnswersNothingIsRefusedInTime) {
    RecordProperty("hazard", "H10");
    BoardOnUsb board(bed_, clock_, settingsFor("TSB-0001"));
    board.inspect([](auto& b, Instant) { b.fallSilent(); });
    ASSERT_IN_TIME(listed(1));
    const auto begin = clock_.now();
    const auto refused = open("sensor:");
    ASSERT_FALSE(refused);
    EXPECT_IN_TIME(clock_.now() - begin < 3s);
    EXPECT_EQ(refused.error().code, ErrorCode::Timeout);
}

TEST_F(SensorBoardOnUsb, OneThatMayNotBeOpenedIsListedWithWhatHelps) {
    BoardOnUsb board(bed_, clock_, settingsFor("TSB-0001"));
    board.usb().permit(false);
    ASSERT_IN_TIME(listed(1));
    const UnprivilegedUser user(bed_);
    const auto found = driver_->list();
    ASSERT_EQ(found.size(), 1U);
    EXPECT_THAT(found[0].obstacle, HasSubstr("install-rules"));
    EXPECT_THAT(open("sensor:TSB-0001"), refused(ErrorCode::Io, "install-rules"));
}

}  // namespace
}  // namespace tacto::test
