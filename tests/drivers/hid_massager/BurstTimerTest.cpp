// BurstTimer: what is written and when, to the nanosecond.
#include <gtest/gtest.h>

#include "drivers/hid_massager/BurstTimer.h"

namespace tacto::test {
namespace {

using hid::BurstTimer;
using hid::HidWrite;
using std::chrono::milliseconds;

void expectDue(const BurstTimer& timer, HidWrite what, Instant at) {
    EXPECT_EQ(static_cast<int>(timer.next().what), static_cast<int>(what));
    EXPECT_EQ(timer.next().at, at);
}

TEST(BurstTimer, ABurstIsDueAtOnceAndItsStopAfterItsDuration) {
    BurstTimer timer(Seconds(0), Seconds(0));
    expectDue(timer, HidWrite::Nothing, Instant::max());
    timer.askBurst(milliseconds(100));
    expectDue(timer, HidWrite::Burst, Instant(0));
    timer.wrote(HidWrite::Burst, milliseconds(1000), milliseconds(1002), true);
    EXPECT_TRUE(timer.vibrating());
    expectDue(timer, HidWrite::Stop, milliseconds(1102));
    timer.wrote(HidWrite::Stop, milliseconds(1102), milliseconds(1103), true);
    EXPECT_FALSE(timer.vibrating());
    expectDue(timer, HidWrite::Nothing, Instant::max());
}

TEST(BurstTimer, KeepAliveRepeatsTheBurstAndDoesNotMakeItLonger) {
    BurstTimer timer(Seconds(0.04), Seconds(0));
    timer.askBurst(milliseconds(100));
    timer.wrote(HidWrite::Burst, milliseconds(0), milliseconds(1), true);
    expectDue(timer, HidWrite::Repeat, milliseconds(41));
    timer.wrote(HidWrite::Repeat, milliseconds(41), milliseconds(42), true);
    expectDue(timer, HidWrite::Repeat, milliseconds(82));
    timer.wrote(HidWrite::Repeat, milliseconds(82), milliseconds(83), true);
    expectDue(timer, HidWrite::Stop, milliseconds(101));
}

TEST(BurstTimer, BurstsKeepTheShortestIntervalAndAStopDoesNotWaitForItButIsRepeated) {
    RecordProperty("hazard", "H2");
    BurstTimer timer(Seconds(0), Seconds(0.01));
    timer.askBurst(milliseconds(100));
    timer.wrote(HidWrite::Burst, milliseconds(50), milliseconds(51), true);
    timer.askBurst(milliseconds(100));
    expectDue(timer, HidWrite::Burst, milliseconds(61));
    timer.askStop();
    expectDue(timer, HidWrite::Stop, Instant(0));
    timer.wrote(HidWrite::Stop, milliseconds(52), milliseconds(53), true);
    EXPECT_FALSE(timer.stopDue());
    expectDue(timer, HidWrite::Stop, milliseconds(63));
    timer.wrote(HidWrite::Stop, milliseconds(63), milliseconds(64), true);
    expectDue(timer, HidWrite::Nothing, Instant::max());
}

TEST(BurstTimer, ANewBurstMakesTheRepeatedStopNeedless) {
    BurstTimer timer(Seconds(0), Seconds(0.01));
    timer.askStop();
    timer.wrote(HidWrite::Stop, milliseconds(20), milliseconds(20), true);
    timer.askStop();
    timer.wrote(HidWrite::Stop, milliseconds(21), milliseconds(21), true);
    timer.askBurst(milliseconds(100));
    expectDue(timer, HidWrite::Burst, milliseconds(31));
    timer.wrote(HidWrite::Burst, milliseconds(31), milliseconds(31), true);
    expectDue(timer, HidWrite::Stop, milliseconds(131));
}

TEST(BurstTimer, AStopThatFailedIsTriedAgainBeforeAnythingElse) {
    RecordProperty("hazard", "H2");
    BurstTimer timer(Seconds(0), Seconds(0));
    timer.askStop();
    timer.wrote(HidWrite::Stop, milliseconds(1), milliseconds(2), false);
    EXPECT_TRUE(timer.stopDue());
    expectDue(timer, HidWrite::Stop, milliseconds(52));
    timer.askBurst(milliseconds(10));
    expectDue(timer, HidWrite::Stop, milliseconds(52));
    timer.wrote(HidWrite::Stop, milliseconds(52), milliseconds(53), true);
    expectDue(timer, HidWrite::Burst, milliseconds(53));
}

TEST(BurstTimer, ABurstThatFailedOrWasOvertakenIsStopped) {
    RecordProperty("hazard", "H2");
    BurstTimer timer(Seconds(0), Seconds(0));
    timer.askBurst(milliseconds(100));
    timer.wrote(HidWrite::Burst, milliseconds(1), milliseconds(2), false);
    expectDue(timer, HidWrite::Stop, Instant(0));
    timer.wrote(HidWrite::Stop, milliseconds(2), milliseconds(2), true);

    timer.askBurst(milliseconds(100));
    timer.askStop();  // the stop comes while the burst is being written
    timer.wrote(HidWrite::Burst, milliseconds(3), milliseconds(4), true);
    EXPECT_FALSE(timer.vibrating());
    expectDue(timer, HidWrite::Stop, Instant(0));
}

}  // namespace
}  // namespace tacto::test
