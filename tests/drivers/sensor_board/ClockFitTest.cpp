// Maps the board's clock to the session's: the drift is found with an honest uncertainty; stamps are never early.
#include <cmath>
#include <gtest/gtest.h>
#include <numbers>

#include "core/base/Random.h"
#include "drivers/sensor_board/ClockFit.h"

namespace tacto::test {
namespace {

using sensorboard::ClockFit;

/// A board that sends a message every 4 ms, over a line with delays.
class Line {
public:
    double drift_ppm = 0;
    double wander_ppm = 0;  // slow drift, as with temperature, with a period of 20 minutes
    double least_s = 0.3e-3;
    double mean_s = 1e-3;
    double poll_s = 0;  // interval at which the host reads, a little irregular
    Random random{7, "line"};

    /// Returns the board's time at the true time `t_s`.
    [[nodiscard]] std::uint64_t board_us(double t_s) const {
        const double w = 2 * std::numbers::pi / 1200;
        const double wandered = wander_ppm * 1e-6 * (1 - std::cos(w * t_s)) / w;
        return 77'000'000 + static_cast<std::uint64_t>((t_s * (1 + drift_ppm * 1e-6) + wandered) * 1e6);
    }
    [[nodiscard]] double arrival_s(double t_s) {
        const double arrived = t_s + least_s - mean_s * std::log(1 - random.uniform());
        if (poll_s == 0) return arrived;
        while (nextPoll_ < arrived) nextPoll_ += poll_s * (1 + 0.05 * random.uniform());
        return nextPoll_;
    }
    /// Runs from `begin_s` to `end_s`; calls `look(t, board_us, arrival)` after each message.
    template <class Look>
    void run(ClockFit& fit, double begin_s, double end_s, Look&& look) {
        double last = 0;
        for (auto i = std::llround(begin_s * 250); i < std::llround(end_s * 250); ++i) {
            const double t = static_cast<double>(i) / 250;
            last = std::max(last, arrival_s(t));  // keeps the order
            fit.observe(board_us(t), toInstant(last));
            look(t, board_us(t), last);
        }
    }
    void run(ClockFit& fit, double begin_s, double end_s) {
        run(fit, begin_s, end_s, [](double, std::uint64_t, double) {});
    }

private:
    double nextPoll_ = 0;
};

TEST(SensorBoardClock, FindsTheDriftOfTenMinutesWithinOnePartPerMillion) {
    RecordProperty("hazard", "H7");
    for (const double drift : {-200.0, -50.0, 0.0, 50.0, 200.0}) {
        Line line;
        line.drift_ppm = drift;
        ClockFit fit;
        line.run(fit, 0, 600);
        const auto& report = fit.report();
        ASSERT_TRUE(report.drift_ppm.has_value());
        EXPECT_NEAR(*report.drift_ppm, drift, 1);
        EXPECT_LE(std::abs(*report.drift_ppm - drift), *report.uncertainty_ppm + 0.001) << "the stated uncertainty";
        EXPECT_LT(*report.uncertainty_ppm, 1);
        EXPECT_GT(report.span_s, 300);
    }
}

TEST(SensorBoardClock, FindsItThroughAHostThatLooksEveryTwoMilliseconds) {
    Line line;
    line.drift_ppm = 50;
    line.mean_s = 20e-6;
    line.poll_s = 2e-3;
    ClockFit fit;
    line.run(fit, 0, 600);
    EXPECT_NEAR(fit.report().drift_ppm.value(), 50, 1);
    EXPECT_LE(std::abs(*fit.report().drift_ppm - 50), *fit.report().uncertainty_ppm);
}

TEST(SensorBoardClock, StatedUncertaintyHoldsAndShrinks) {
    int within = 0, all = 0;
    for (std::uint64_t seed = 1; seed <= 20; ++seed) {
        Line line;
        line.drift_ppm = 30;
        line.random = Random(seed, "line");
        ClockFit fit;
        double before = std::numeric_limits<double>::infinity();
        double at = 0;
        for (const double until : {20.0, 60.0, 300.0}) {
            line.run(fit, at, until);
            at = until;
            const double stated = fit.report().uncertainty_ppm.value();
            EXPECT_LT(stated, before);
            before = stated;
            ++all;
            within += std::abs(*fit.report().drift_ppm - 30) <= stated ? 1 : 0;
        }
    }
    EXPECT_GE(within, all * 95 / 100) << "of " << all;
}

TEST(SensorBoardClock, KnowsNoDriftBeforeItHasSeenEnough) {
    Line line;
    line.drift_ppm = 50;
    ClockFit fit;
    line.run(fit, 0, 1.9);
    EXPECT_FALSE(fit.report().drift_ppm.has_value());
    line.run(fit, 1.9, 2.5);
    ASSERT_TRUE(fit.report().drift_ppm.has_value());
    EXPECT_GT(*fit.report().uncertainty_ppm, 1) << "and says how little it knows";
}

TEST(SensorBoardClock, StampsAreNeverAheadOfTheirArrival) {
    RecordProperty("hazard", "H7");
    for (const double drift : {-300.0, 300.0}) {
        Line line;
        line.drift_ppm = drift;
        ClockFit fit;
        line.run(fit, 0, 120, [&](double, std::uint64_t board, double arrival) {
            ASSERT_LE(fit.toSession(static_cast<double>(board)), arrival + 1e-9);
        });
    }
}

TEST(SensorBoardClock, StampsAreLateByTheShortestDelayLessTheMargin) {
    RecordProperty("hazard", "H7");
    Line line;
    line.drift_ppm = 50;
    line.least_s = 2e-3;
    ClockFit fit;
    line.run(fit, 0, 30);
    double worst = 0;
    line.run(fit, 30, 600, [&](double t, std::uint64_t board, double) {
        worst = std::max(worst, std::abs(fit.toSession(static_cast<double>(board)) - t - 2e-3 + ClockFit::kMargin_s));
    });
    EXPECT_LT(worst, 0.1e-3);
}

TEST(SensorBoardClock, FollowsACrystalThatWarmsUp) {
    Line line;
    line.drift_ppm = 20;
    line.wander_ppm = 2;
    ClockFit fit;
    line.run(fit, 0, 30);
    double worst = 0;
    line.run(fit, 30, 3600, [&](double t, std::uint64_t board, double) {
        worst = std::max(worst,
                         std::abs(fit.toSession(static_cast<double>(board)) - t - line.least_s + ClockFit::kMargin_s));
    });
    EXPECT_LT(worst, 0.5e-3);
}

TEST(SensorBoardClock, AStalledHostMovesNothing) {
    RecordProperty("hazard", "H7");
    Line line;
    line.drift_ppm = 50;
    ClockFit fit;
    line.run(fit, 0, 60);
    const auto before = *fit.report().drift_ppm;
    line.least_s = 3;  // nothing is read for 3 s at a time
    line.run(fit, 60, 63);
    line.least_s = 0.3e-3;
    line.run(fit, 63, 100);
    EXPECT_NEAR(*fit.report().drift_ppm, before, 1);
    EXPECT_EQ(fit.report().steps, 0U);
    EXPECT_NEAR(fit.toSession(static_cast<double>(line.board_us(100))), 100 + line.least_s - ClockFit::kMargin_s,
                0.1e-3);
}

TEST(SensorBoardClock, SamplesStayEvenlySpacedWhileItLearns) {
    RecordProperty("hazard", "H7");
    Line line;
    line.drift_ppm = -80;
    line.mean_s = 3e-3;  // large delays, so that much must be corrected
    ClockFit fit;
    double last = 0;
    line.run(fit, 0, 60, [&](double t, std::uint64_t board, double) {
        if (t < 1) return;
        // Sixteen samples at 4 kHz before each message.
        const double begin = fit.toSession(static_cast<double>(board) - 4000);
        const double end = fit.toSession(static_cast<double>(board));
        ASSERT_NEAR(end - begin, 4e-3, 4e-3 * 0.011) << t;
        if (last != 0) {
            ASSERT_NEAR(begin, last, 125e-6) << "half a sample, at " << t;
        }
        last = end;
    });
}

TEST(SensorBoardClock, SeesAClockThatJumpedAhead) {
    Line line;
    ClockFit fit;
    line.run(fit, 0, 5);
    EXPECT_LT(fit.early_s(line.board_us(5), toInstant(5 + line.least_s)), 1e-3);
    EXPECT_NEAR(fit.early_s(line.board_us(5) + 2'000'000, toInstant(5 + line.least_s)), 2, 0.01);
}

}  // namespace
}  // namespace tacto::test
