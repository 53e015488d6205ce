// HidMassager on a fake port, on the steady clock with its own thread: every situation in which it must stop, and the
// difference between a slow and a broken device.
#include <future>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <thread>

#include "drivers/hid_massager/HidMassager.h"
#include "tests/drivers/hid_massager/FakeHid.h"
#include "tests/support/Allocations.h"
#include "tests/support/FailsInTime.h"
#include "tests/support/InTime.h"
#include "tests/support/Refused.h"

namespace tacto::test {
namespace {

using hid::HidMassager;
using testing::HasSubstr;

const Bytes kOn{5, 1, 0, 0, 255, 255, 0, 0};
const Bytes kOff{5, 1, 0, 0, 0, 0, 0, 0};

class HidMassagerTest : public testing::Test {
protected:
    void open(hid::VibrationReports reports = padReports()) {
        auto opened = HidMassager::open([this] { return device.open(); }, identity, std::move(reports), clock);
        ASSERT_IN_TIME(opened);
        massager = std::move(*opened);
    }
    ApprovedBurst approved(double intensity = 1, Seconds duration = Seconds(1)) {
        auto approval = gate.approve(VibrationBurst{intensity, duration});
        EXPECT_TRUE(approval);
        return std::move(*approval);
    }
    Result<void> vibrate(Seconds duration = Seconds(1)) { return massager->vibrate(approved(1, duration)); }

    const SteadyClock clock;
    SafetyGate gate{clock};
    FakeHidDevice device{clock, {0x1234, 0x5678, "S", "Pad", "/dev/hidraw0", 0, true}, outputDescriptor(5, 8)};
    const DeviceIdentity identity{"hid:1234:5678", Role::Massager, "Pad", "S", {}, false};
    std::unique_ptr<HidMassager> massager;
};

TEST_F(HidMassagerTest, OpeningStopsFirst) {
    RecordProperty("hazard", "H2");
    open();
    ASSERT_EQ(device.writes().size(), 1u);
    EXPECT_EQ(device.last(), kOff);
    EXPECT_FALSE(massager->vibrating());
}

TEST_F(HidMassagerTest, ItsStepIsThatOfTheFieldThatTakesTheFewestValues) {
    RecordProperty("hazard", "H4");
    open();
    EXPECT_DOUBLE_EQ(massager->step(), 1.0 / 255);
    auto coarse = padReports();
    coarse.fields.back().max = coarse.fields.back().min + 4;
    massager.reset();
    open(std::move(coarse));
    EXPECT_DOUBLE_EQ(massager->step(), 0.25);
}

TEST_F(HidMassagerTest, ADeviceThatTakesNoStopIsNotOpened) {
    RecordProperty("hazard", "H2");
    device.refuse(true);
    EXPECT_THAT(HidMassager::open([this] { return device.open(); }, identity, padReports(), clock),
                refused(ErrorCode::Device));
    EXPECT_EQ(device.openNow(), 0);
}

TEST_F(HidMassagerTest, WithoutAWatchdogNothingIsWrittenButTheStop) {
    RecordProperty("hazard", "H2");
    device.refuseWatch(true);
    EXPECT_THAT(HidMassager::open([this] { return device.open(); }, identity, padReports(), clock),
                refusedSaying(testing::AllOf(HasSubstr("Pad"), HasSubstr("not driven"))));
    ASSERT_FALSE(device.writes().empty());
    for (const auto& write : device.writes()) EXPECT_EQ(write.bytes, kOff);
    device.refuseWatch(false);
    open();
    EXPECT_EQ(device.watchedStop(), kOff);
    device.refuseWatch(true);  // the watchdog has ended
    const auto before = device.writes().size();
    EXPECT_THAT(vibrate(), refused(ErrorCode::Device, "is not driven: its watchdog has ended"));
    ASSERT_IN_TIME(device.waitForWrites(before + 1));
    EXPECT_EQ(device.last(), kOff);
    device.refuseWatch(false);
    EXPECT_IN_TIME(vibrate());  // this starts another watchdog
}

TEST_F(HidMassagerTest, TheWatchdogIsToldThatOutputIsOnUntilTheDeviceTookItsStop) {
    RecordProperty("hazard", "H2");
    open();
    EXPECT_EQ(device.beats(), 0);
    ASSERT_IN_TIME(vibrate(Seconds(0.3)));
    EXPECT_FALSE(device.watchRests());
    ASSERT_IN_TIME(device.waitForWrites(3));
    EXPECT_IN_TIME(device.beats() >= 4);  // one every 50 ms
    massager->forceOff();
    ASSERT_IN_TIME(device.waitForWrites(4));
    massager.reset();
    EXPECT_TRUE(device.watchRests());
}

TEST_F(HidMassagerTest, AWatchdogThatEndsOrFallsSilentInABurstEndsTheBurstAndItIsSaidWhich) {
    RecordProperty("hazard", "H2");
    open();
    const auto endsTheBurst = [this](ErrorCode code, const char* why) {
        const Instant since = clock.now();
        EXPECT_IN_TIME(device.waitForLast(kOff));
        EXPECT_IN_TIME(toSeconds(clock.now() - since) <= 0.5);
        EXPECT_THAT(vibrate(), refused(code, why));
    };
    ASSERT_IN_TIME(vibrate(Seconds(1)));
    device.refuseWatch(true);
    endsTheBurst(ErrorCode::Device, "Pad was stopped: its watchdog has ended");
    device.refuseWatch(false);
    ASSERT_IN_TIME(vibrate(Seconds(1)));  // this starts another watchdog
    device.silenceWatch(true);
    endsTheBurst(ErrorCode::Timeout, "Pad was stopped: its watchdog has not answered for 500 ms");
}

TEST_F(HidMassagerTest, ABurstIsAsLongAsItWasApproved) {
    open();
    ASSERT_IN_TIME(vibrate(Seconds(0.1)));
    EXPECT_IN_TIME(device.last() == kOn);
    ASSERT_IN_TIME(device.waitForWrites(3));
    const auto writes = device.writes();
    EXPECT_EQ(writes[2].bytes, kOff);
    const double lasted = toSeconds(writes[2].at - writes[1].at);
    EXPECT_GE(lasted, 0.1 - 1e-6);
    EXPECT_IN_TIME(lasted <= 0.2);  // allows for a busy computer
}

TEST_F(HidMassagerTest, KeepAliveRepeatsTheBurst) {
    open(padReports(Seconds(0.02)));
    ASSERT_IN_TIME(vibrate(Seconds(0.1)));
    ASSERT_IN_TIME(device.waitForLast(kOff));
    const auto writes = device.writes();
    EXPECT_IN_TIME(writes.size() >= 4u);
    for (std::size_t i = 1; i + 1 < writes.size(); ++i) EXPECT_EQ(writes[i].bytes, kOn);
}

TEST_F(HidMassagerTest, ForceOffSendsTheStopFromAnyThreadAtOnce) {
    RecordProperty("hazard", "H2");
    open();
    ASSERT_IN_TIME(vibrate());
    const Instant before = clock.now();
    std::async(std::launch::async, [&] { massager->forceOff(); }).get();
    ASSERT_IN_TIME(device.waitForWrites(3));
    EXPECT_EQ(device.last(), kOff);
    EXPECT_IN_TIME(toSeconds(device.writes()[2].at - before) <= 0.1);
    EXPECT_FALSE(massager->vibrating());
}

TEST_F(HidMassagerTest, AStopIsWithTheDeviceInLessThanTenMilliseconds) {
    RecordProperty("hazard", "H2");
    open();
    std::vector<double> stops, bursts;
    for (int i = 0; i < 200; ++i) {
        const Instant asked = clock.now();
        ASSERT_IN_TIME(vibrate());
        bursts.push_back(toSeconds(device.writes().back().at - asked));
        const auto before = device.writes().size();
        const Instant called = clock.now();
        massager->forceOff();
        ASSERT_IN_TIME(device.waitForWrites(before + 1));
        ASSERT_EQ(device.last(), kOff);
        stops.push_back(toSeconds(device.writes().back().at - called));
    }
    std::ranges::sort(stops);
    std::ranges::sort(bursts);
    RecordProperty("stop_median_us", static_cast<int>(stops[100] * 1e6));
    RecordProperty("stop_p99_us", static_cast<int>(stops[197] * 1e6));
    RecordProperty("burst_median_us", static_cast<int>(bursts[100] * 1e6));
    EXPECT_IN_TIME(stops[197] <= 0.01);
}

TEST_F(HidMassagerTest, ForceOffNeitherAllocatesNorWaitsForAWriteThatIsUnderWay) {
    RecordProperty("hazard", "H2");
    if (!countsAllocations()) GTEST_SKIP() << kNotCounted;
    open();
    device.hold(true);
    auto late = std::async(std::launch::async, [&] { return vibrate(); });
    ASSERT_IN_TIME(device.waitForHeld());
    const auto before = allocationsOfThisThread();
    massager->forceOff();
    massager->forceOff();
    EXPECT_EQ(allocationsOfThisThread(), before);
    EXPECT_EQ(device.writes().size(), 1u);  // forceOff() returned before the write ended
    device.hold(false);
    static_cast<void>(late.get());
    EXPECT_IN_TIME(device.waitForLast(kOff));
}

TEST_F(HidMassagerTest, APortThatCanStopAtOnceIsAskedTo) {
    RecordProperty("hazard", "H2");
    open();
    const Bytes urgent{0, 0};
    device.setUrgentStop(urgent);
    device.hold(true);
    auto late = std::async(std::launch::async, [&] { return vibrate(); });
    ASSERT_IN_TIME(device.waitForHeld());
    massager->forceOff();
    EXPECT_EQ(device.last(), urgent);  // although the previous write is held
    device.hold(false);
    static_cast<void>(late.get());
    EXPECT_IN_TIME(device.waitForLast(kOff));
}

TEST_F(HidMassagerTest, ASlowDeviceIsATimeoutAndItsBurstIsStopped) {
    RecordProperty("hazard", "H2");
    open();
    device.hold(true);
    EXPECT_THAT(vibrate(), refused(ErrorCode::Timeout, "50 ms"));
    EXPECT_THAT(vibrate(), refused(ErrorCode::Timeout, "before"));
    device.hold(false);
    ASSERT_IN_TIME(device.waitForWrites(3));
    EXPECT_EQ(device.writes()[1].bytes, kOn);  // the write that was held
    EXPECT_EQ(device.writes()[2].bytes, kOff);
    EXPECT_IN_TIME(vibrate());  // a slow device is not a broken one
    EXPECT_EQ(device.openings(), 1);
}

TEST_F(HidMassagerTest, AShortWriteIsAFaultAndStopped) {
    RecordProperty("hazard", "H2");
    open();
    device.takeOnly(3);
    const auto cut = vibrate();
    ASSERT_FALSE(cut);
    ASSERT_CODE_IN_TIME(cut.error().code, ErrorCode::Device);
    EXPECT_THAT(cut.error().message, testing::AllOf(HasSubstr("3 bytes"), HasSubstr("8 were expected")));
    ASSERT_IN_TIME(device.waitForWrites(2));
    EXPECT_EQ(device.last(), kOff);
    EXPECT_IN_TIME(vibrate());
    EXPECT_EQ(device.openings(), 2);  // opened again after the fault
}

TEST_F(HidMassagerTest, ARefusedReportIsAFaultAndTheStopIsTriedUntilItIsTaken) {
    RecordProperty("hazard", "H2");
    open();
    device.refuse(true);
    const auto refused = vibrate();
    ASSERT_FALSE(refused);
    ASSERT_CODE_IN_TIME(refused.error().code, ErrorCode::Device);
    EXPECT_THAT(refused.error().message, testing::AllOf(HasSubstr("Pad"), HasSubstr("refused")));
    device.refuse(false);
    ASSERT_IN_TIME(device.waitForWrites(2));
    EXPECT_EQ(device.last(), kOff);
}

TEST_F(HidMassagerTest, AStopThatFailsBetweenCallsIsReportedOnceAndSentWhenItCan) {
    RecordProperty("hazard", "H2");
    open();
    ASSERT_IN_TIME(vibrate(Seconds(0.02)));
    const int before = device.attempts();
    device.refuse(true);
    const auto deadline = std::chrono::steady_clock::now() + std::chrono::seconds(5);
    while (device.attempts() < before + 2 && std::chrono::steady_clock::now() < deadline) std::this_thread::yield();
    ASSERT_IN_TIME(device.attempts() >= before + 2);  // retried without a call
    const auto told = vibrate();
    ASSERT_FALSE(told);
    EXPECT_CODE_IN_TIME(told.error().code, ErrorCode::Device);
    device.refuse(false);
    ASSERT_IN_TIME(device.waitForLast(kOff));
    EXPECT_IN_TIME(vibrate());
}

TEST_F(HidMassagerTest, ABurstThatWaitsBehindAStopThatFailsIsToldWhy) {
    RecordProperty("hazard", "H2");
    open();
    device.hold(true);
    massager->forceOff();
    ASSERT_IN_TIME(device.waitForHeld());
    auto behind = std::async(std::launch::async, [&] { return vibrate(); });
    device.refuse(true);
    device.hold(false);
    const auto told = behind.get();
    ASSERT_FALSE(told);
    EXPECT_CODE_IN_TIME(told.error().code, ErrorCode::Device);
    device.refuse(false);
    EXPECT_IN_TIME(device.waitForLast(kOff));
}

TEST_F(HidMassagerTest, UnpluggedInABurstIsAFaultAndThePluggedInDeviceServesAgain) {
    RecordProperty("hazard", "H2");
    open();
    ASSERT_IN_TIME(vibrate());
    device.unplug();
    const auto gone = vibrate();
    ASSERT_FALSE(gone);
    EXPECT_CODE_IN_TIME(gone.error().code, ErrorCode::Device);
    EXPECT_THAT(vibrate(), refusedSaying("could not be opened again"));
    device.plug();
    EXPECT_IN_TIME(vibrate());
    const auto writes = device.writes();
    ASSERT_GE(writes.size(), 4u);
    EXPECT_EQ(writes[writes.size() - 2].bytes, kOff);  // stopped before it may vibrate again
    EXPECT_EQ(writes.back().bytes, kOn);
    EXPECT_EQ(device.openNow(), 1);
}

TEST_F(HidMassagerTest, ClosingInABurstStops) {
    RecordProperty("hazard", "H2");
    open();
    ASSERT_IN_TIME(vibrate());
    massager.reset();
    EXPECT_EQ(device.last(), kOff);
    EXPECT_EQ(device.openNow(), 0);
}

TEST_F(HidMassagerTest, ClosingWhileABurstIsUnderWayStopsBehindIt) {
    RecordProperty("hazard", "H2");
    open();
    device.hold(true);
    ASSERT_FALSE(vibrate());  // slow, and still running
    auto closing = std::async(std::launch::async, [&] { massager.reset(); });
    ASSERT_IN_TIME(device.waitForHeld());
    device.hold(false);
    closing.get();
    EXPECT_EQ(device.last(), kOff);
}

TEST_F(HidMassagerTest, ClosingADeviceThatIsGoneEnds) {
    open();
    ASSERT_IN_TIME(vibrate());
    device.unplug();
    massager.reset();
    EXPECT_EQ(device.openNow(), 0);
}

TEST_F(HidMassagerTest, AStopBetweenApprovalAndWriteLeavesNothingVibrating) {
    RecordProperty("hazard", "H2");
    open();
    std::atomic<bool> done{false};
    std::thread stopper([&] {
        while (!done) massager->forceOff();
    });
    int vibrated = 0;
    for (int i = 0; i < 50; ++i) {
        if (vibrate(Seconds(1))) ++vibrated;
    }
    done = true;
    stopper.join();
    massager->forceOff();
    RecordProperty("vibrated", vibrated);
    EXPECT_IN_TIME(vibrated >= 1) << "each was refused: there was nothing to stop";
    EXPECT_IN_TIME(device.waitForLast(kOff));
    EXPECT_FALSE(massager->vibrating());
}

TEST_F(HidMassagerTest, ReportsThatCannotBeAreRefusedBeforeAnythingIsOpened) {
    auto reports = padReports();
    reports.fields.clear();
    EXPECT_FALSE(HidMassager::open([this] { return device.open(); }, identity, reports, clock));
    EXPECT_EQ(device.openings(), 0);
}

TEST(HidMassagerVirtual, ServedByItsOwnerItKeepsTimeExactly) {
    VirtualClock clock;
    SafetyGate gate(clock);
    FakeHidDevice device(clock, {}, {});
    auto opened =
        accepted(HidMassager::open([&] { return device.open(); }, {}, padReports(Seconds(0), Seconds(0.01)), clock));
    auto& massager = *opened;
    clock.advanceTo(std::chrono::milliseconds(100));
    auto burst = gate.approve(VibrationBurst{1, Seconds(0.1)});
    ASSERT_TRUE(massager.vibrate(std::move(*burst)));
    EXPECT_EQ(massager.serve(clock.now()), Instant(std::chrono::milliseconds(200)));
    clock.advanceTo(std::chrono::milliseconds(199));
    massager.serve(clock.now());
    EXPECT_EQ(device.last(), kOn);
    clock.advanceTo(std::chrono::milliseconds(200));
    EXPECT_EQ(massager.serve(clock.now()), Instant::max());
    EXPECT_EQ(device.last(), kOff);
    EXPECT_EQ(device.writes().back().at, Instant(std::chrono::milliseconds(200)));
}

}  // namespace
}  // namespace tacto::test
