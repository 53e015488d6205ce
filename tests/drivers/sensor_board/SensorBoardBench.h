// SensorBoardBench.h - the fixture of these tests: an emulated board on a virtual clock, and the driver's device on it.
//
// Thread-safety: the test's own thread.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "drivers/sensor_board/SensorBoard.h"
#include "tests/support/emulated/sensor_board/EmulatedBoardLine.h"

namespace tacto::test {

class SensorBoardBench {
public:
    /// Without a signal the board counts (CountingSignal).
    explicit SensorBoardBench(sensorboard::EmulatedBoardSettings settings = {},
                              std::unique_ptr<sensorboard::BoardSignal> signal = nullptr);

    /// Opens the board; if that fails, so does the test, with the reason.
    void open(const SensorBoardSettings& settings = {});
    /// Opens the board and runs it for `duration` without faults.
    void openFor(Seconds duration);
    [[nodiscard]] Result<std::unique_ptr<SensorBoard>> tryOpen(const SensorBoardSettings& settings = {});
    /// Lets time pass and reads every `step` into `blocks`. Returns the first error.
    Result<void> run(Seconds duration, Seconds step = Seconds(0.002));

    VirtualClock clock;
    std::shared_ptr<sensorboard::EmulatedBoardLine> line;
    std::unique_ptr<SensorBoard> board;
    std::vector<SampleBlock> blocks;
};

/// Returns the step of a CountingSignal from an acceleration sample.
[[nodiscard]] std::int64_t stepOf(const SampleBlock& acceleration, std::size_t sample);

}  // namespace tacto::test
