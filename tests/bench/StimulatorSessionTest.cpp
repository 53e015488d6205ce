#include <gtest/gtest.h>

#include "core/bench/delivery/StimulatorSession.h"
#include "tests/bench/FakeStimulator.h"
#include "tests/support/Refused.h"

namespace tacto {
namespace {

using namespace std::chrono_literals;
using test::accepted;
using test::FakeStimulator;

class StimulatorSessionTest : public testing::Test {
protected:
    void SetUp() override {
        ASSERT_TRUE(gate_.configure(test::benchSetup(device_.traits_)));
        heartbeat_.beat(clock_.now());
    }
    void post(Instant onset = 0s) {
        PulseTrain train;
        train.amplitude = Volts(10);
        auto approved = accepted(gate_.approve({train, Seconds(1), onset}));
        session_.post(std::move(approved), onset, false);
    }
    void passTo(Instant moment) {
        // Steps like the bench, with the loop alive.
        while (clock_.now() < moment) {
            clock_.advanceTo(std::min(moment, clock_.now() + Instant(1ms)));
            heartbeat_.beat(clock_.now());
            session_.serve(clock_.now());
        }
    }

    VirtualClock clock_;
    SafetyGate gate_{clock_};
    Heartbeat heartbeat_;
    FakeStimulator device_{clock_};
    StimulatorSession session_{device_, gate_, heartbeat_, clock_, {}};
};

TEST_F(StimulatorSessionTest, WritesATrainAtItsOnsetAndReportsAfterItsStatus) {
    post(20ms);
    passTo(19ms);
    EXPECT_EQ(device_.delivered, 0);
    EXPECT_FALSE(session_.idle());
    passTo(20ms);
    EXPECT_EQ(device_.delivered, 1);
    EXPECT_FALSE(session_.takeReport());
    passTo(30ms);
    const auto report = session_.takeReport();
    ASSERT_TRUE(report);
    EXPECT_EQ(report->outcome, TrainOutcome::Delivered);
    EXPECT_EQ(report->onset, Instant(20ms));
    EXPECT_LE(report->statusAt - report->end, Instant(50ms));
    EXPECT_DOUBLE_EQ(report->impedance_ohm, 1000);
    EXPECT_TRUE(session_.idle());
}

TEST_F(StimulatorSessionTest, DeliversNothingThatWasApprovedBeforeAStop) {
    RecordProperty("hazard", "H2");
    post(20ms);
    gate_.latchStop();
    session_.forceOff();
    passTo(50ms);
    EXPECT_EQ(device_.delivered, 0);
    EXPECT_GE(device_.offs, 1);
    const auto report = session_.takeReport();
    ASSERT_TRUE(report);
    EXPECT_EQ(report->outcome, TrainOutcome::Voided);
}

TEST_F(StimulatorSessionTest, DeliversNothingThatExpired) {
    RecordProperty("hazard", "H2");
    post(0ms);
    clock_.advanceTo(101ms);
    heartbeat_.beat(clock_.now());
    session_.serve(clock_.now());
    EXPECT_EQ(device_.delivered, 0);
    EXPECT_EQ(session_.takeReport()->outcome, TrainOutcome::Voided);
}

TEST_F(StimulatorSessionTest, RepeatsForceOffAfterAWriteThatWasInFlight) {
    RecordProperty("hazard", "H2");
    // The stop reaches the device during the write, which would switch the device on again.
    device_.onDeliver = [this] {
        gate_.latchStop();
        session_.forceOff();
    };
    post();
    passTo(1ms);
    EXPECT_EQ(device_.delivered, 1);
    EXPECT_GE(device_.offs, 2);
    EXPECT_FALSE(device_.on);
}

TEST_F(StimulatorSessionTest, SwitchesOffWhenTheLoopIsSilent) {
    RecordProperty("hazard", "H2");
    device_.traits_.deadMan = Seconds(2);
    passTo(200ms);
    EXPECT_EQ(device_.offs, 0);
    EXPECT_EQ(session_.silencedAfter(), 0ms);
    const int kept = device_.keptAlive;
    EXPECT_GE(kept, 1);
    // From here on no thread beats.
    clock_.advanceTo(301ms);
    session_.serve(clock_.now());
    EXPECT_EQ(device_.offs, 1);
    EXPECT_EQ(session_.silencedAfter(), 101ms);
    clock_.advanceTo(5s);
    session_.serve(clock_.now());
    EXPECT_EQ(device_.keptAlive, kept) << "a hung program must not hold off the dead-man switch";
}

TEST_F(StimulatorSessionTest, FeedsTheDeadManSwitchManyTimesWithinItsTime) {
    RecordProperty("hazard", "H2");
    device_.traits_.deadMan = Seconds(2);
    passTo(4s);
    EXPECT_GE(device_.keptAlive, 8);
}

TEST_F(StimulatorSessionTest, ATrainEndsALengthAfterTheDeviceHadBegunIt) {
    RecordProperty("hazard", "H2");
    // A Pulse Pal is programmed for 4 to 36 ms before a train begins; the status deadline must not include this.
    device_.onDeliver = [this] { clock_.advanceTo(clock_.now() + Instant(60ms)); };
    post(10ms);
    passTo(10ms);
    EXPECT_EQ(clock_.now(), Instant(70ms));
    EXPECT_EQ(session_.trainEnd(), Instant(70ms) + Instant(500us)) << "one pulse of two phases and a gap";
    passTo(80ms);
    const auto report = session_.takeReport();
    ASSERT_TRUE(report);
    EXPECT_EQ(report->outcome, TrainOutcome::Delivered);
    EXPECT_EQ(report->onset, Instant(10ms));
    EXPECT_EQ(report->end, Instant(70ms) + Instant(500us));
    EXPECT_LE(report->statusAt - report->end, Instant(10ms));
}

TEST_F(StimulatorSessionTest, ATrainThatSlipsEndsWhenItsDriverSays) {
    RecordProperty("hazard", "H2");
    // The host sends the pulses one by one: in total 300 ms later than planned, but no single pulse is late.
    device_.stillOnUntil = Instant(300ms);
    post();
    passTo(299ms);
    EXPECT_FALSE(session_.takeReport());
    EXPECT_EQ(session_.trainEnd(), Instant(300ms));
    passTo(310ms);
    const auto report = session_.takeReport();
    ASSERT_TRUE(report);
    EXPECT_EQ(report->outcome, TrainOutcome::Delivered);
    EXPECT_FALSE(report->stillDelivering);
    EXPECT_EQ(report->end, Instant(300ms));
}

TEST_F(StimulatorSessionTest, ADeviceThatIsStuckOnIsFoundWithinTheDeadline) {
    RecordProperty("hazard", "H2");
    device_.stillOnUntil = Instant(10s);
    device_.saysWhenItEnds = false;
    post();
    passTo(60ms);
    const auto report = session_.takeReport();
    ASSERT_TRUE(report);
    EXPECT_TRUE(report->stillDelivering);
}

TEST_F(StimulatorSessionTest, ADeviceThatRefusesIsSwitchedOffAndReported) {
    device_.deliverFails = true;
    post();
    passTo(1ms);
    const auto report = session_.takeReport();
    ASSERT_TRUE(report);
    EXPECT_EQ(report->outcome, TrainOutcome::Failed);
    EXPECT_EQ(report->error.view(), "the fake refuses to deliver");
    EXPECT_GE(device_.offs, 1);
}

TEST_F(StimulatorSessionTest, AStatusThatDoesNotComeIsAFailure) {
    RecordProperty("hazard", "H3");
    device_.statusFails = true;
    post();
    passTo(10ms);
    EXPECT_EQ(session_.takeReport()->outcome, TrainOutcome::Failed);
    EXPECT_GE(device_.offs, 1);
}

}  // namespace
}  // namespace tacto
