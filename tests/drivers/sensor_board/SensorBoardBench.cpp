#include "tests/drivers/sensor_board/SensorBoardBench.h"

#include <cmath>
#include <gtest/gtest.h>

#include "tests/support/Refused.h"

namespace tacto::test {

using namespace sensorboard;

SensorBoardBench::SensorBoardBench(EmulatedBoardSettings settings, std::unique_ptr<BoardSignal> signal) {
    clock.advanceTo(std::chrono::seconds(3));
    if (!signal) signal = std::make_unique<CountingSignal>();
    line = std::make_shared<EmulatedBoardLine>(clock, &clock, std::move(settings), std::move(signal));
}

Result<std::unique_ptr<SensorBoard>> SensorBoardBench::tryOpen(const SensorBoardSettings& settings) {
    auto transport = line->connect();
    if (!transport) return failure(transport);
    return SensorBoard::open(std::move(*transport), settings, clock);
}

void SensorBoardBench::open(const SensorBoardSettings& settings) {
    board = accepted(tryOpen(settings));
    blocks.assign(board->streams().size(), {});
}

void SensorBoardBench::openFor(Seconds duration) {
    open();
    accepted(run(duration));
}

Result<void> SensorBoardBench::run(Seconds duration, Seconds step) {
    for (const Instant end = clock.now() + toInstant(duration); clock.now() < end;) {
        clock.advanceTo(clock.now() + toInstant(step));
        if (auto read = board->read(blocks); !read) return read;
    }
    return {};
}

std::int64_t stepOf(const SampleBlock& acceleration, std::size_t sample) {
    const auto count = [&](std::size_t axis) {
        return std::llround(acceleration.values[3 * sample + axis] / CountingSignal::kAcceleration);
    };
    return count(0) + CountingSignal::kModulo * count(1);
}

}  // namespace tacto::test
