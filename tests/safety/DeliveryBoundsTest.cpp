#include <cmath>
#include <gtest/gtest.h>

#include "core/base/Statistics.h"
#include "core/safety/DeliveryBounds.h"

namespace tacto {
namespace {

/// Expects the bounds of a quantity programmed to 10, and the bounds at 0.
void expectBounds(const QuantityBounds& bounds, double least, double most) {
    EXPECT_NEAR(bounds.least(10), least, 1e-12);
    EXPECT_NEAR(bounds.most(10), most, 1e-12);
    EXPECT_EQ(bounds.least(0), 0);
    EXPECT_EQ(bounds.most(0), 0) << "an output that is programmed to 0 is off";
    EXPECT_TRUE(std::isnan(bounds.most(kNaN))) << "and NaN is not lost on the way";
    EXPECT_TRUE(std::isnan(bounds.least(kNaN)));
}

}  // namespace

TEST(DeliveryBounds, AreTheStatedAccuracyWithoutACalibration) {
    RecordProperty("hazard", "H1");
    expectBounds({{}, false, Spread{0.01, 0.2}}, 9.7, 10.3);
    expectBounds({{}, true, Spread{0, 0}}, 10, 10);
    expectBounds({{}, false, {}}, 9.5, 10.5);
}

TEST(DeliveryBounds, AreTheLineItsUncertaintyAndItsResidualWhereACalibrationHolds) {
    RecordProperty("hazard", "H1");
    // Programmed to 10 V: the line gives 10.9 V, ± 1 % and ± 0.05 V.
    const CalibrationLine strong{1.1, -0.1, 5, 40, Spread{0.01, 0.05}};
    expectBounds({strong, true, {}}, 10, 10.9 * 1.01 + 0.05);
    const CalibrationLine weak{0.9, 0, 5, 40, Spread{0.01, 0.05}};
    expectBounds({weak, true, {}}, 9 * 0.99 - 0.05, 10);
    const CalibrationLine unknown{1, 0, 5, 40};
    expectBounds({unknown, true, {}}, 9.5, 10.5);
}

TEST(DeliveryBounds, AreTheWiderOfBothWhereAnOldCalibrationIsLeftAside) {
    RecordProperty("hazard", "H1");
    const CalibrationLine strong{1.1, 0, 5, 40, Spread{0.01, 0}};
    expectBounds({strong, false, Spread{0.02, 0}}, 9.8, 11.11);
    expectBounds({strong, false, {}}, 9.5, 11.11);
    const CalibrationLine weak{0.9, 0, 5, 40, Spread{0.01, 0}};
    expectBounds({weak, false, {}}, 8.91, 10.5);
}

TEST(DeliveryBounds, ACalibrationIsNeverNarrowerThanItself) {
    RecordProperty("hazard", "H1");
    // For any line: the largest value that may come out, including its uncertainty U, is at least the largest value
    // that an uncalibrated source with that U may deliver.
    for (const double gain : {0.85, 0.99993, 1.0, 1.15}) {
        for (const double u : {0.0, 0.008, 0.05}) {
            const CalibrationLine line{gain, 0, 5, 40, Spread{u, 0}};
            const QuantityBounds calibrated(line, true, {}), plain({}, false, Spread{u, 0});
            for (const double command : {5.0, 17.0, 40.0}) {
                EXPECT_GE(calibrated.most(line.programmedFor(command)), plain.most(command) * (1 - 1e-12))
                    << gain << ' ' << u;
            }
        }
    }
}

TEST(DeliveryBounds, KeepsATimeWithoutSpreadToTheLastBit) {
    const QuantityBounds exact({}, false, Spread{});
    for (const double us : {199.0, 200.1, 1e5 / 3}) {
        EXPECT_EQ(exact.times(Micros(us)).least, Micros(us));
        EXPECT_EQ(exact.times(Micros(us)).most, Micros(us));
    }
    const CalibrationLine longer{0.99, 3e-6, 200e-6, 400e-6, Spread{}};
    const auto range = QuantityBounds(longer, true, {}).times(Micros(250));
    EXPECT_NEAR(range.most.count(), 250.5, 1e-9);
    EXPECT_EQ(range.least, Micros(250)) << "what is programmed lies inside the bounds";
}

TEST(DeliveryBounds, AWindowLastsLongerByAClockThatIsSlow) {
    RecordProperty("hazard", "H1");
    EXPECT_NEAR(QuantityBounds({}, false, {}).leastRatio(0.5), 0.95, 1e-12);
    EXPECT_EQ(QuantityBounds({}, false, Spread{}).leastRatio(0.5), 1);
    const CalibrationLine slow{0.9, 0, 0.5, 2, Spread{0.01, 0}};
    EXPECT_NEAR(QuantityBounds(slow, true, {}).leastRatio(0.5), 0.891, 1e-12);
    const CalibrationLine shifted{1, -0.1, 0.5, 2, Spread{}};
    EXPECT_NEAR(QuantityBounds(shifted, true, {}).leastRatio(2), 0.8, 1e-12) << "at its worst in the range";
    EXPECT_GT(QuantityBounds(shifted, true, {}).leastRatio(0.05), 0) << "no window lasts for ever";
}

}  // namespace tacto
