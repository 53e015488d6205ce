// Error limits of core/measure over the grid of MeasurementGrid.h. Each limit is 1.5 to 2 times the value that
// measurement_table shows, so that this test fails if the errors increase.
#include <gtest/gtest.h>

#include "tests/measure/MeasurementGrid.h"

namespace tacto::test {
namespace {

constexpr int kSeeds = 6;

void expectAllFound(const GridPoint& point, const GridResult& r) {
    EXPECT_EQ(r.missed, 0) << describe(point);
    EXPECT_EQ(r.flagged, 0) << describe(point);
    EXPECT_EQ(r.invented, 0) << describe(point);
    EXPECT_EQ(r.silent, 0) << describe(point);
}

double noiseOf(const GridPoint& point) { return std::pow(10, -point.snr_db / 20); }

TEST(MeasurementGrid, AboveTwentyTwoDecibelNoPulseIsMissedOrInvented) {
    RecordProperty("hazard", "H9");
    for (const auto shape : {PulseShape::Monophasic, PulseShape::Symmetric, PulseShape::Exponential}) {
        for (const double perPhase : {12.0, 20.0, 100.0, 1000.0}) {
            for (const double snr : {60.0, 40.0, 30.0, 26.0, 23.0}) {
                const GridPoint point{.shape = shape, .perPhase = perPhase, .snr_db = snr};
                expectAllFound(point, measureGridPoint(point, kSeeds));
            }
        }
    }
}

TEST(MeasurementGrid, WhiteNoiseMovesFiguresByWhatItsMeansAllow) {
    for (const auto shape : {PulseShape::Monophasic, PulseShape::Symmetric}) {
        for (const double perPhase : {20.0, 100.0, 1000.0}) {
            for (const double snr : {60.0, 40.0, 26.0}) {
                const GridPoint point{.shape = shape, .perPhase = perPhase, .snr_db = snr};
                const auto r = measureGridPoint(point, kSeeds);
                SCOPED_TRACE(describe(point));
                const double mean = noiseOf(point) / std::sqrt(0.6 * perPhase);
                // An edge lasts 2 of the 200 µs, and at least one sample.
                const double edge = noiseOf(point) * std::max(1.0, 0.01 * perPhase);
                EXPECT_LT(r.amplitude.sd, 1.5 * mean);
                EXPECT_LT(std::abs(r.amplitude.mean), mean);
                EXPECT_LT(r.width.sd, 2.5 * edge);
                EXPECT_LT(std::abs(r.width.mean), edge);
                EXPECT_LT(r.interval.sd, 2.5 * edge);
                EXPECT_LT(std::abs(r.interval.mean), edge);
                EXPECT_LT(r.charge.sd, 2 * mean);
                EXPECT_LT(std::abs(r.charge.mean), mean);
                if (shape == PulseShape::Monophasic) continue;
                EXPECT_LT(r.gap.sd, 2.5 * edge);
                EXPECT_LT(r.imbalance.max, 8 * mean);
            }
        }
    }
}

TEST(MeasurementGrid, TheStatedUncertaintyCoversNineteenReadingsOfTwenty) {
    RecordProperty("hazard", "H9");
    int amplitude = 0, width = 0, charge = 0, gap = 0, imbalance = 0, n = 0, nGap = 0;
    for (const auto shape : {PulseShape::Monophasic, PulseShape::Symmetric, PulseShape::Recharge}) {
        for (const double perPhase : {12.0, 20.0, 100.0, 1000.0}) {
            for (const double snr : {60.0, 40.0, 26.0}) {
                if (shape == PulseShape::Recharge && snr < 40) continue;
                const auto r = measureGridPoint({.shape = shape, .perPhase = perPhase, .snr_db = snr}, kSeeds);
                amplitude += r.beyondAmplitude;
                width += r.beyondWidth;
                charge += r.beyondCharge;
                gap += r.beyondGap;
                imbalance += r.beyondImbalance;
                n += static_cast<int>(r.amplitude.n);
                nGap += static_cast<int>(r.gap.n);
            }
        }
    }
    ASSERT_GT(n, 500);
    EXPECT_LT(amplitude, 0.05 * n);
    EXPECT_LT(width, 0.05 * n);
    EXPECT_LT(charge, 0.05 * n);
    EXPECT_LT(gap, 0.05 * nGap);
    EXPECT_LT(imbalance, 0.05 * nGap);
}

TEST(MeasurementGrid, NoiseAboveTheLimitIsAveragedWherePhasesAreLongEnough) {
    for (const auto& [perPhase, snr] : {std::pair{100.0, 18.0}, {100.0, 15.0}, {1000.0, 14.0}, {1000.0, 8.0}}) {
        for (const auto shape : {PulseShape::Monophasic, PulseShape::Symmetric}) {
            const GridPoint point{.shape = shape, .perPhase = perPhase, .snr_db = snr};
            const auto r = measureGridPoint(point, kSeeds);
            expectAllFound(point, r);
            EXPECT_EQ(r.warned, kSeeds) << describe(point) << ": that samples were averaged is said";
            EXPECT_LT(r.amplitude.sd, 1.6 * noiseOf(point) / std::sqrt(0.6 * perPhase)) << describe(point);
            EXPECT_LT(std::abs(r.amplitude.mean), 0.01) << describe(point);
        }
    }
}

TEST(MeasurementGrid, WhatCannotBeKnownIsSaid) {
    RecordProperty("hazard", "H9");
    for (const auto shape : {PulseShape::Monophasic, PulseShape::Symmetric, PulseShape::Recharge,
                             PulseShape::Exponential, PulseShape::Logic}) {
        for (const double perPhase : {6.0, 8.0, 20.0, 100.0}) {
            for (const double snr : {40.0, 22.0, 18.0, 14.0, 8.0, 2.0, -6.0}) {
                const GridPoint point{.shape = shape, .perPhase = perPhase, .snr_db = snr};
                const auto r = measureGridPoint(point, kSeeds);
                EXPECT_EQ(r.silent, 0) << describe(point);
                if (perPhase < 10) {
                    EXPECT_EQ(r.amplitude.n, 0U) << describe(point);
                    EXPECT_EQ(r.warned, kSeeds) << describe(point);
                }
                if (snr < 18 && shape != PulseShape::Logic) {
                    EXPECT_EQ(r.warned, kSeeds) << describe(point);
                }
            }
        }
    }
}

TEST(MeasurementGrid, AShallowSlowRechargeIsFoundInNoiseTenTimesLessDeep) {
    RecordProperty("hazard", "H5");
    for (const auto& [perPhase, snr] : {std::pair{20.0, 40.0}, {100.0, 40.0}, {100.0, 34.0}, {1000.0, 30.0}}) {
        const GridPoint point{.shape = PulseShape::Recharge, .perPhase = perPhase, .snr_db = snr};
        const auto r = measureGridPoint(point, kSeeds);
        expectAllFound(point, r);
        EXPECT_EQ(r.gap.n, r.amplitude.n) << describe(point);
        EXPECT_LT(std::abs(r.amplitude.mean), 0.003) << describe(point);
        EXPECT_LT(r.imbalance.max, 0.04) << describe(point);
    }
}

TEST(MeasurementGrid, EightBitsCostHalfAStep) {
    for (const auto shape : {PulseShape::Monophasic, PulseShape::Symmetric}) {
        for (const double share : {0.9, 0.5, 0.2}) {
            for (const double perPhase : {20.0, 100.0}) {
                for (const double snr : {100.0, 50.0}) {
                    const GridPoint point{.shape = shape, .perPhase = perPhase, .snr_db = snr, .rangeShare = share};
                    const auto r = measureGridPoint(point, kSeeds);
                    expectAllFound(point, r);
                    const double step = 2 / share / 256;
                    EXPECT_LT(std::abs(r.amplitude.mean), 0.51 * step) << describe(point);
                    EXPECT_LT(std::abs(r.charge.mean), 0.51 * step) << describe(point);
                    EXPECT_LT(std::abs(r.width.mean), 0.1) << describe(point);
                    if (shape == PulseShape::Symmetric) {
                        EXPECT_LT(r.imbalance.max, step) << describe(point);
                    }
                }
            }
        }
    }
}

TEST(MeasurementGrid, RingingIsNeitherAPhaseNorAmplitude) {
    RecordProperty("hazard", "H9");
    for (const auto shape : {PulseShape::Monophasic, PulseShape::Symmetric, PulseShape::Recharge}) {
        for (const double ringing : {0.05, 0.1, 0.2, 0.3}) {
            for (const double perPhase : {30.0, 100.0, 1000.0}) {
                const GridPoint point{.shape = shape, .perPhase = perPhase, .snr_db = 46, .ringing = ringing};
                const auto r = measureGridPoint(point, kSeeds);
                expectAllFound(point, r);
                EXPECT_LT(std::abs(r.amplitude.mean), 0.001) << describe(point);
                EXPECT_LT(std::abs(r.charge.mean), 0.001) << describe(point);
                EXPECT_LT(std::abs(r.width.mean), 0.05) << describe(point);
                if (shape == PulseShape::Recharge) {
                    EXPECT_EQ(r.gap.n, r.amplitude.n) << describe(point);
                }
            }
        }
    }
}

TEST(MeasurementGrid, ADriftOfTheBaselineIsFollowedAndSaid) {
    for (const auto shape : {PulseShape::Monophasic, PulseShape::Symmetric}) {
        std::vector<GridPoint> points;
        for (const double share : {0.02, 0.1, 0.3, 1.0})
            points.push_back({.shape = shape, .snr_db = 46, .slope = share});
        for (const double share : {0.02, 0.1}) {
            points.push_back({.shape = shape, .snr_db = 46, .hum = share});
            points.push_back({.shape = shape, .snr_db = 46, .hum = share, .interval = 100});
        }
        for (const auto& point : points) {
            const auto r = measureGridPoint(point, kSeeds);
            expectAllFound(point, r);
            EXPECT_EQ(r.warned, kSeeds) << describe(point);
            EXPECT_LT(std::abs(r.amplitude.mean), 0.006) << describe(point);
            EXPECT_LT(r.amplitude.sd, 0.006) << describe(point);
        }
    }
    // An offset is not a drift and causes no warning.
    const GridPoint offset{.snr_db = 46, .offset = 1};
    EXPECT_EQ(measureGridPoint(offset, kSeeds).warned, 0);
}

TEST(MeasurementGrid, AMovingBaselineThatCannotBeFollowedIsSaid) {
    RecordProperty("hazard", "H9");
    for (const auto shape : {PulseShape::Monophasic, PulseShape::Symmetric, PulseShape::Recharge}) {
        for (const double share : {0.1, 0.3, 1.0}) {
            for (const double interval : {20.0, 100.0}) {
                const GridPoint point{.shape = shape, .snr_db = 46, .hum = share, .interval = interval};
                const auto r = measureGridPoint(point, kSeeds);
                EXPECT_EQ(r.silent, 0) << describe(point);
                EXPECT_EQ(r.warned, kSeeds) << describe(point);
            }
        }
    }
}

TEST(MeasurementGrid, DutyAndPolarityDoNotMatter) {
    for (const int polarity : {1, -1}) {
        for (const double interval : {2.0, 4.0, 100.0, 10'000.0}) {
            for (const auto shape : {PulseShape::Monophasic, PulseShape::Symmetric}) {
                if (shape == PulseShape::Symmetric && interval < 4) continue;
                const GridPoint point{.shape = shape,
                                      .perPhase = interval > 1000 ? 20.0 : 50.0,
                                      .snr_db = 40,
                                      .interval = interval,
                                      .pulses = interval > 1000 ? 2 : 6,
                                      .polarity = polarity};
                const auto r = measureGridPoint(point, interval > 1000 ? 2 : kSeeds);
                expectAllFound(point, r);
                EXPECT_LT(std::abs(r.amplitude.mean), 0.004) << describe(point);
                EXPECT_LT(std::abs(r.interval.mean), 0.02) << describe(point);
            }
        }
    }
}

}  // namespace
}  // namespace tacto::test
