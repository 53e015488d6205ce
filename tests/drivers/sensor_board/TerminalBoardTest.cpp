// A board on a serial port: an emulated board behind a pseudo-terminal, opened as `sensor:?tty=`, in real time.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/devices/Device.h"
#include "drivers/sciencemode/TtyTransport.h"
#include "drivers/sensor_board/UsbSensorBoards.h"
#include "tests/drivers/sensor_board/BoardOnPty.h"
#include "tests/support/FailsInTime.h"
#include "tests/support/InTime.h"
#include "tests/support/Refused.h"

namespace tacto::test {
namespace {

using namespace std::chrono_literals;
using testing::HasSubstr;

class SensorBoardOnTerminal : public testing::Test {
protected:
    Result<void> open(const std::string& parameters) {
        devices_ = {};
        return driver_->open(*DeviceUri::parse("sensor:" + parameters), {}, {clock_}, devices_);
    }
    /// Reads every 2 ms, as a session does, until `enough` or for 10 s. Returns the first error.
    template <class Enough>
    Result<void> readUntil(Enough enough) {
        blocks_.assign(devices_.sensor->streams().size(), {});
        const auto end = std::chrono::steady_clock::now() + 10s;
        while (!enough() && std::chrono::steady_clock::now() < end) {
            std::this_thread::sleep_for(2ms);
            if (auto read = devices_.sensor->read(blocks_); !read) return read;
        }
        return {};
    }

    SteadyClock clock_;
    // Keeps the computer's own USB out of this test.
    std::unique_ptr<Driver> driver_ = makeSensorBoardDriver(
        makeUsbSensorBoards([] { return fail(ErrorCode::Io, "no USB here"); }, sciencemode::TtyTransport::open));
    DeviceSet devices_;
    std::vector<SampleBlock> blocks_;
};

TEST_F(SensorBoardOnTerminal, IsOpenedByThePathAndStreams) {
    sensorboard::EmulatedBoardSettings settings;
    settings.serial = "TSB-0003";
    BoardOnPty board(clock_, settings);
    const auto opened = open("?rate=2kHz&tty=" + board.path());
    ASSERT_IN_TIME(opened) << opened.error().message;  // the board answers within 0.3 s
    EXPECT_EQ(devices_.sensor->identity().serial, "TSB-0003");
    EXPECT_EQ(devices_.sensor->streams()[0].rate_hz, 2000);
    const auto read = readUntil([&] { return blocks_[0].samples() >= 1000; });
    ASSERT_IN_TIME(read);
    EXPECT_IN_TIME(blocks_[0].samples() >= 1000U);
    EXPECT_IN_TIME(dynamic_cast<ReportingDevice&>(*devices_.sensor).deviceReport().losses == 0U);
    devices_ = {};
    EXPECT_IN_TIME(open("TSB-0003?tty=" + board.path())) << "closed and opened again";
}

TEST_F(SensorBoardOnTerminal, AnotherBoardThanTheOneNamedIsRefused) {
    RecordProperty("hazard", "H4");
    BoardOnPty board(clock_);
    const auto refused = open("TSB-0009?tty=" + board.path());
    ASSERT_FALSE(refused);
    EXPECT_CODE_IN_TIME(refused.error().code, ErrorCode::NotFound);
    EXPECT_THAT(refused.error().message, HasSubstr("its serial number is \"EMU-0001\"; \"TSB-0009\" was expected"));
}

TEST_F(SensorBoardOnTerminal, TheOtherEndGoingIsAnErrorOfRead) {
    RecordProperty("hazard", "H7");
    auto board = std::make_unique<BoardOnPty>(clock_);
    const auto path = board->path();
    ASSERT_IN_TIME(open("?tty=" + path));
    ASSERT_IN_TIME(readUntil([&] { return blocks_[0].samples() >= 200; }));
    board.reset();
    const auto gone = readUntil([] { return false; });
    ASSERT_FALSE(gone);
    EXPECT_CODE_IN_TIME(gone.error().code, ErrorCode::Device);
    EXPECT_THAT(gone.error().message, HasSubstr(path));
}

TEST_F(SensorBoardOnTerminal, WhereNothingIsNothingIsFound) {
    EXPECT_THAT(open("?tty=/dev/pts/98765"), refused(ErrorCode::NotFound));
    EXPECT_TRUE(driver_->list().empty());
}

}  // namespace
}  // namespace tacto::test
