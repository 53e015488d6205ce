#include <cmath>
#include <gtest/gtest.h>
#include <limits>

#include "core/safety/ExposureMeter.h"
#include "tests/safety/GateFixtures.h"

namespace tacto::test {

namespace {
using namespace std::chrono_literals;

BookedTrain bookedAt(Instant t, double i2 = 1e-6) {
    BookedTrain train;
    train.earliest = t;
    train.latest = t + 110ms;
    train.hz = 2;
    train.overRange.in1s.currentSquared_A2s = train.overRange.in5s.currentSquared_A2s = i2;
    return train;
}
}  // namespace

TEST(ExposureMeter, SumsWhatCanShareAWindow) {
    ExposureMeter meter;
    for (int k = 0; k < 10; ++k) meter.book(bookedAt(500ms * k));
    EXPECT_EQ(meter.couldShare(Seconds(5), 4600ms).trains, 10U);
    // The first train has ended by 0.11 s at the latest: from 5.11 s on no 5 s window holds both it and a new train.
    EXPECT_EQ(meter.couldShare(Seconds(5), 5109ms).trains, 10U);
    EXPECT_EQ(meter.couldShare(Seconds(5), 5110ms).trains, 9U);
    EXPECT_EQ(meter.couldShare(Seconds(1), 4600ms).trains, 3U);
    EXPECT_NEAR(meter.couldShare(Seconds(5), 4600ms).overRange.currentSquared_A2s, 1e-5, 1e-12);
}

TEST(ExposureMeter, ShowsTheLastFiveSecondsByTheirStart) {
    ExposureMeter meter;
    for (int k = 0; k <= 10; ++k) meter.book(bookedAt(500ms * k));
    EXPECT_EQ(meter.booked(Seconds(5), 5s).trains, 10U) << "the train of 5 s ago is over";
    EXPECT_EQ(meter.booked(Seconds(1), 5s).trains, 2U);
}

TEST(ExposureMeter, ForgetsOnlyWhatNoWindowCanTouch) {
    ExposureMeter meter;
    meter.book(bookedAt(0ms));
    meter.forget(5109ms);
    EXPECT_EQ(meter.size(), 1U);
    meter.forget(5110ms);
    EXPECT_EQ(meter.size(), 0U);
}

TEST(ExposureMeter, ByAClockThatIsSlowAWindowReachesFurtherBack) {
    RecordProperty("hazard", "H1");
    ExposureMeter meter;
    meter.book(bookedAt(0ms));
    EXPECT_EQ(meter.couldShare(Seconds(5), 5200ms).trains, 0U);
    EXPECT_EQ(meter.couldShare(Seconds(5), 5200ms, 1.1).trains, 1U);
    EXPECT_EQ(meter.couldShare(Seconds(5), 5610ms, 1.1).trains, 0U);
    meter.forget(5609ms, 1.1);
    EXPECT_EQ(meter.size(), 1U);
    meter.forget(5610ms, 1.1);
    EXPECT_EQ(meter.size(), 0U);
}

TEST(ExposureMeter, AFullMeterSaysSoAndGoesRoundWhenTimePasses) {
    ExposureMeter meter(4);
    for (int k = 0; k < 4; ++k) {
        ASSERT_TRUE(meter.canBook());
        meter.book(bookedAt(1s * k));
    }
    EXPECT_FALSE(meter.canBook());
    meter.forget(6110ms);  // the trains of 0 s and 1 s are gone
    EXPECT_EQ(meter.size(), 2U);
    meter.book(bookedAt(6200ms, 5e-6));
    EXPECT_NEAR(meter.booked(Seconds(5), 6300ms).overRange.currentSquared_A2s, 7e-6, 1e-12);
}

TEST(ExposureMeter, NanIsNotHiddenByLargerValues) {
    ExposureMeter meter;
    BookedTrain train = bookedAt(1s);
    train.overRange.values[indexOf(Quantity::PeakCurrent)] = std::numeric_limits<double>::quiet_NaN();
    meter.book(train);
    meter.book(bookedAt(1s));
    EXPECT_TRUE(std::isnan(meter.largest(Quantity::PeakCurrent, JudgedAt::LoadRange, 1s)));
}

}  // namespace tacto::test
