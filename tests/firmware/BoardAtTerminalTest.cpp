// Boards on a serial port: the emulated one and the firmware under QEMU, opened as `sensor:?tty=` in real time, pass
// the same tests. Those that need only frames are the protocol's own (BoardConformance.h).
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/devices/Device.h"
#include "drivers/sensor_board/UsbSensorBoards.h"
#include "tests/drivers/conformance/SensorConformance.h"
#include "tests/firmware/BoardAtTerminal.h"
#include "tests/support/FailsInTime.h"
#include "tests/support/InTime.h"

namespace tacto::test {
namespace {

using namespace std::chrono_literals;
using testing::HasSubstr;

struct TerminalKind {
    const char* name;
    const char* serial;
    int rate_hz;
    std::unique_ptr<BoardAtTerminal> (*make)();
};

template <class Board>
std::unique_ptr<BoardAtTerminal> makeBoard() {
    return std::make_unique<Board>();
}

constexpr TerminalKind kEmulated{"Emulated", "EMU-0001", 2000, makeBoard<EmulatedAtTerminal>};
constexpr TerminalKind kOnQemu{"OnQemu", "EMU-MPS2", 4000, makeBoard<QemuAtTerminal>};

/// Those that can be made here.
std::vector<TerminalKind> kinds() {
    if (std::string_view(TACTO_WHOLE_BOARD).empty()) return {kEmulated};
    return {kEmulated, kOnQemu};
}

template <class Kind>
std::string nameOf(const testing::TestParamInfo<Kind>& of) {
    return of.param.name;
}

/// The sensor's driver alone.
class Opened {
public:
    Result<void> open(const std::string& parameters) {
        devices = {};
        return driver->open(*DeviceUri::parse("sensor:" + parameters), {}, {clock}, devices);
    }

    SteadyClock clock;
    // Keeps the computer's own USB out of this test.
    std::unique_ptr<Driver> driver = makeSensorBoardDriver(
        makeUsbSensorBoards([] { return fail(ErrorCode::Io, "no USB here"); }, sciencemode::TtyTransport::open));
    DeviceSet devices;
};

class SensorAtTerminal final : public SensorRig {
public:
    explicit SensorAtTerminal(const TerminalKind& kind) : board_(kind.make()) {
        const auto opened = opened_.open("?tty=" + board_->path());
        EXPECT_IN_TIME(opened);
    }
    TactileSensor& device() override { return *opened_.devices.sensor; }
    const Clock& clock() const override { return opened_.clock; }
    void wait(Seconds duration) override { std::this_thread::sleep_for(duration); }
    bool unplug() override {
        board_.reset();
        // What came before is read first.
        std::vector<SampleBlock> before(device().streams().size());
        for (int looked = 0; looked < 10'000 && device().read(before); ++looked) std::this_thread::sleep_for(1ms);
        return true;
    }

private:
    std::unique_ptr<BoardAtTerminal> board_;
    Opened opened_;
};

std::vector<SensorKind> sensors() {
    std::vector<SensorKind> made;
    for (const auto& kind : kinds())
        made.push_back({kind.name, [kind] { return std::make_unique<SensorAtTerminal>(kind); }});
    return made;
}

std::vector<BoardKind> encodingBoards() {
    std::vector<BoardKind> made;
    if (!std::string_view(TACTO_WHOLE_BOARD).empty())
        made.push_back({kOnQemu.name, [] { return std::make_unique<TerminalRig>(kOnQemu.make()); }});
    return made;
}

INSTANTIATE_TEST_SUITE_P(AtTerminal, SensorConformance, testing::ValuesIn(sensors()), nameOf<SensorKind>);
INSTANTIATE_TEST_SUITE_P(AtTerminal, BoardConformance, testing::ValuesIn(encodingBoards()), nameOf<BoardKind>);
INSTANTIATE_TEST_SUITE_P(AtTerminal, EncodingBoardConformance, testing::ValuesIn(encodingBoards()), nameOf<BoardKind>);

class SensorBoardOnTerminal : public testing::TestWithParam<TerminalKind>, protected Opened {
protected:
    /// Reads every 2 ms, as a session does, until `enough` or for 20 s. Returns the first error.
    template <class Enough>
    Result<void> readUntil(Enough enough) {
        blocks_.assign(devices.sensor->streams().size(), {});
        const auto end = std::chrono::steady_clock::now() + 20s;
        while (!enough() && std::chrono::steady_clock::now() < end) {
            std::this_thread::sleep_for(2ms);
            if (auto read = devices.sensor->read(blocks_); !read) return read;
        }
        return {};
    }

    std::unique_ptr<BoardAtTerminal> board_ = GetParam().make();
    std::vector<SampleBlock> blocks_;
};

TEST_P(SensorBoardOnTerminal, IsOpenedByItsPathAndStreams) {
    const auto& [name, serial, rate_hz, make] = GetParam();
    for (const auto* again : {"", ", closed and opened again"}) {
        const auto opened = open(fmt::format("{}?emulated=yes&rate={}&tty={}", serial, rate_hz, board_->path()));
        ASSERT_IN_TIME(opened) << opened.error().message << again;  // the board answers within 0.3 s
        EXPECT_EQ(devices.sensor->identity().serial, serial);
        EXPECT_TRUE(devices.sensor->identity().simulated);
        EXPECT_EQ(devices.sensor->streams()[0].rate_hz, rate_hz);
        const auto read = readUntil([&] { return blocks_[0].samples() >= 4000; });
        ASSERT_IN_TIME(read);
        EXPECT_IN_TIME(blocks_[0].samples() >= 4000U);
        // On a busy computer QEMU is late with a second's samples, more than its line holds.
        const auto losses = dynamic_cast<ReportingDevice&>(*devices.sensor).deviceReport().losses;
        EXPECT_IN_TIME(losses == 0U || std::string_view(name) == kOnQemu.name);
    }
    const auto refused = open("?rate=3333&tty=" + board_->path());
    ASSERT_FALSE(refused);
    EXPECT_CODE_IN_TIME(refused.error().code, ErrorCode::Device);
    EXPECT_THAT(refused.error().message, HasSubstr("its acceleration stream cannot have 3333 Hz"));
}

TEST_P(SensorBoardOnTerminal, AnotherBoardThanTheOneNamedIsRefused) {
    RecordProperty("hazard", "H4");
    const auto refused = open("TSB-0009?tty=" + board_->path());
    ASSERT_FALSE(refused);
    EXPECT_CODE_IN_TIME(refused.error().code, ErrorCode::NotFound);
    EXPECT_THAT(refused.error().message, HasSubstr("; \"TSB-0009\" was expected"));
}

TEST_P(SensorBoardOnTerminal, IsStoppedWhenItIsClosed) {
    RecordProperty("hazard", "H2");
    ASSERT_IN_TIME(open("?tty=" + board_->path()));
    ASSERT_IN_TIME(readUntil([&] { return blocks_[0].samples() >= 200; }));
    devices = {};
    TerminalRig rig(board_->path());
    PlainHost host(rig);
    const auto status = sensorboard::readStatus(host.ask(sensorboard::Command::GetStatus).frame());
    ASSERT_TRUE(status.has_value());
    EXPECT_FALSE(status->running);
}

TEST_P(SensorBoardOnTerminal, TheOtherEndGoingIsAnErrorOfRead) {
    RecordProperty("hazard", "H7");
    const auto path = board_->path();
    ASSERT_IN_TIME(open("?tty=" + path));
    ASSERT_IN_TIME(readUntil([&] { return blocks_[0].samples() >= 200; }));
    board_.reset();
    const auto gone = readUntil([] { return false; });
    ASSERT_FALSE(gone);
    EXPECT_CODE_IN_TIME(gone.error().code, ErrorCode::Device);
    EXPECT_THAT(gone.error().message, HasSubstr(path));
}

INSTANTIATE_TEST_SUITE_P(AtTerminal, SensorBoardOnTerminal, testing::ValuesIn(kinds()), nameOf<TerminalKind>);

TEST(SensorBoardOnNoTerminal, WhereNothingIsNothingIsFound) {
    Opened opened;
    EXPECT_THAT(opened.open("?tty=/dev/pts/98765"), refused(ErrorCode::NotFound));
    EXPECT_TRUE(opened.driver->list().empty());
}

}  // namespace
}  // namespace tacto::test
