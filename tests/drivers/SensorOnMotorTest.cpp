// The simulated sensor board, fastened to the simulated massager's motor.
#include <cmath>
#include <gtest/gtest.h>

#include "core/safety/SafetyGate.h"
#include "tests/drivers/SimBench.h"

namespace tacto::test {
namespace {

constexpr double kGravity = 9.80665;

struct Board {
    explicit Board(std::vector<const char*> uris) : gate(bench.clock) {
        for (const char* uri : uris) bench.open(uri);
        blocks.resize(bench.devices.sensor->streams().size());
    }
    void read() { EXPECT_TRUE(bench.devices.sensor->read(blocks).has_value()); }
    void waitReading(int steps) {
        for (int i = 0; i < steps; ++i) {
            bench.wait(Seconds(0.005));
            read();
        }
    }
    void vibrate(double intensity) {
        auto burst = gate.approve(VibrationBurst{intensity, Seconds(0.1)});
        EXPECT_TRUE(bench.devices.massager->vibrate(std::move(*burst)).has_value());
    }
    /// Returns the root mean square, without gravity, of the samples from `from` to `until`.
    [[nodiscard]] double strength(double from, double until) const {
        const auto& block = blocks[0];
        double squares = 0, n = 0;
        for (std::size_t i = 0; i < block.samples(); ++i) {
            if (block.t_s[i] < from || block.t_s[i] >= until) continue;
            const double* a = &block.values[3 * i];
            squares += a[0] * a[0] + a[1] * a[1] + (a[2] - kGravity) * (a[2] - kGravity);
            n += 1;
        }
        return std::sqrt(squares / n);
    }
    SimBench bench;
    SafetyGate gate;
    std::vector<SampleBlock> blocks;
};

TEST(SensorOnMotor, FeelsWhatTheMassagerDoesAndNothingElse) {
    Board board({"sim:massager?acceleration=10m/s2", "sim:finger?on=motor&noise=0m/s2"});
    EXPECT_EQ(board.bench.devices.surface, nullptr) << "nothing can be put under it";
    board.waitReading(100);
    EXPECT_LT(board.strength(0, 0.5), 0.01);
    board.vibrate(1);
    board.waitReading(20);
    const double strong = board.strength(0.5, 0.6);
    board.waitReading(100);
    EXPECT_LT(board.strength(0.9, 1.1), 0.05) << "it has run down";
    board.vibrate(0.5);
    board.waitReading(20);
    const double weak = board.strength(1.1, 1.2);
    EXPECT_GT(strong, 2);
    EXPECT_LT(strong, 10 / std::sqrt(2));
    EXPECT_NEAR(strong / weak, 4, 0.6) << "acceleration goes with the square of speed";
}

TEST(SensorOnMotor, ReadingMoreOrLessOftenChangesNothing) {
    const auto samples = [](int steps) {
        Board board({"sim:finger?on=motor", "sim:massager"});
        board.waitReading(20);
        board.vibrate(0.7);
        for (int i = 0; i < 40 / steps; ++i) {
            board.bench.wait(Seconds(0.005 * steps));
            board.read();
        }
        return board.blocks[0].values;
    };
    EXPECT_EQ(samples(1), samples(8));
}

TEST(SensorOnMotor, AStopIsFeltAtOnce) {
    RecordProperty("hazard", "H2");
    Board board({"sim:massager?fault=stuck-on&acceleration=10m/s2", "sim:finger?on=motor"});
    board.waitReading(20);
    board.vibrate(1);
    board.waitReading(100);
    EXPECT_GT(board.strength(0.4, 0.6), 6);
    board.bench.devices.massager->forceOff();
    board.waitReading(100);
    EXPECT_LT(board.strength(0.9, 1.1), 0.2);
}

TEST(SensorOnMotor, WithoutAMotorThereIsGravityAlone) {
    Board board({"sim:finger?on=motor"});
    board.waitReading(100);
    EXPECT_LT(board.strength(0, 0.5), 0.1);
}

}  // namespace
}  // namespace tacto::test
