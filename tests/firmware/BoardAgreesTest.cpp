// The board of BoardOnQemuTest.cpp, judged by what it says on its line (`sensor compare`).
#include <gtest/gtest.h>
#include <thread>

#include "app/run/EncoderComparison.h"
#include "core/devices/Device.h"
#include "drivers/sensor_board/UsbSensorBoards.h"
#include "tests/firmware/BoardAtTerminal.h"
#include "tests/firmware/ProfileOnQemu.h"
#include "tests/support/InTime.h"
#include "tests/support/Limits.h"

namespace tacto::test {
namespace {

using namespace sensorboard;

/// Opens a board by its path, as the programs do.
Result<DeviceSet> openedAt(const std::string& path, const std::string& more, const Clock& clock) {
    // Keeps the computer's own USB out of this test.
    const auto driver = makeSensorBoardDriver(
        makeUsbSensorBoards([] { return fail(ErrorCode::Io, "no USB here"); }, sciencemode::TtyTransport::open));
    DeviceSet devices;
    const auto uri = DeviceUri::parse("sensor:?emulated=yes&tty=" + path + more);
    if (const auto opened = driver->open(*uri, {}, {clock}, devices); !opened) return failure(opened);
    return devices;
}

}  // namespace

TEST(BoardOnQemu, AgreesWithTheBenchThroughItsLine) {
    if (std::string_view(TACTO_WHOLE_BOARD).empty()) GTEST_SKIP() << kNoBoard;
    RecordProperty("hazard", "H1");
    // A computer with too much to do loses something of a line in real time; then another board is tried.
    for (int attempt = 0; attempt < 5; ++attempt) {
        const QemuAtTerminal board;
        const SteadyClock clock;
        const auto devices = openedAt(board.path(), "&encodes=shown", clock);
        ASSERT_IN_TIME(devices) << devices.error().message;
        Profile profile;
        profile.encoding = encodingOnQemu();
        const auto comparison =
            EncoderComparison::create(*devices->sensor, profile, outputOnQemu(), limitSets(), clock);
        ASSERT_TRUE(comparison) << comparison.error().message;
        const auto end = std::chrono::steady_clock::now() + std::chrono::seconds(20);
        while ((*comparison)->board().trains.size() < 4 && std::chrono::steady_clock::now() < end) {
            std::this_thread::sleep_for(EncoderComparison::kTurn);
            ASSERT_IN_TIME((*comparison)->turn());
        }
        const auto found = (*comparison)->agreement();
        if (found.lost != 0 || found.trains < 3) continue;
        EXPECT_TRUE(found.holds()) << found.unlike << "; R " << found.maxR << ", P " << found.maxP << ", onset "
                                   << found.maxOnset_s << " s, amplitude " << found.maxAmplitude;
        return;
    }
    EXPECT_IN_TIME(false) << "something was lost each time";
}

}  // namespace tacto::test
