#include <cmath>
#include <csignal>
#include <deque>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include "tests/safety/UnitRecordFixture.h"
#include "tests/support/Allocations.h"
#include "tests/support/Refused.h"

namespace tacto::test {

using testing::HasSubstr;

TEST_F(UnitRecordFile, FourRunsInARowKeepTheLimitTogether) {
    RecordProperty("hazard", "H1");
    std::deque<Instant> delivered;
    for (int k = 0; k < 12; ++k) {
        const auto one = run();
        for (int asked = 0; asked < 10; ++asked) {
            if (one->ask()) delivered.push_back(time_.now);
            one->pass(0.05);
        }
        time_.now += toInstant(0.3);  // time between two programs
    }
    double worst_mA = 0;
    for (const Instant first : delivered) {
        double squares = 0;
        for (const Instant at : delivered)
            squares +=
                at >= first && at - first < std::chrono::seconds(5) ? 0.5 * 0.5 * 0.4e-3 : 0;  // 40 V into 80 ohm
        worst_mA = std::max(worst_mA, 1e3 * std::sqrt(squares / 5));
    }
    EXPECT_LT(worst_mA, 10);
    EXPECT_GE(delivered.size(), 5U) << "and the limit was met more than once";
}

TEST_F(UnitRecordFile, ABenchThatIsOpenedAgainStartsFromWhatWasDelivered) {
    RecordProperty("hazard", "H1");
    auto first = run();
    EXPECT_EQ(approvedAtOnce(*first), 4);
    first.reset();
    auto second = run();
    EXPECT_THAT(second->ask(), refusedSaying("with the 4 trains before it"));
    second->pass(5.2);
    EXPECT_EQ(approvedAtOnce(*second), 4);
    // Another unit has received nothing.
    VirtualClock clock;
    auto other = accepted(UnitRecord::open(folders(), "sciencemode 1235", clock, time_));
    ExposureMeter meter;
    (void)other->replay(meter);
    EXPECT_EQ(meter.size(), 0U);
}

TEST_F(UnitRecordFile, AComputerThatSleptKnowsWhenItDelivered) {
    RecordProperty("hazard", "H1");
    auto first = run();
    time_.now += std::chrono::hours(2);  // the program's clock does not advance meanwhile
    EXPECT_EQ(approvedAtOnce(*first), 4);
    first.reset();
    EXPECT_EQ(approvedAtOnce(*run()), 0) << "two hours of sleep do not make a train of just now an old one";
}

TEST_F(UnitRecordFile, WhatIsLeftOnTheLoadIsFoundByTheNextRun) {
    RecordProperty("hazard", "H1");
    GateSetup floating = benchSetup(Load::skin(Ohms(300), Ohms(100'000), Nanofarads(2000)));
    floating.source.gap = GapState::HighImpedance;
    PulseTrain train = volts(40);
    train.shape = PulseShape::Monophasic;
    {
        Run one(*this, floating);
        ASSERT_TRUE(one.gate.approve({train, Seconds(10), one.clock.now()}));
    }
    floating.limits = {limitsOf({rowFor(Quantity::PeakCurrent, 180)})};
    train.polarity = Polarity::Negative;
    Run two(*this, floating);
    EXPECT_FALSE(two.gate.approve({train, Seconds(10), two.clock.now()}));
    two.pass(3);
    EXPECT_TRUE(two.gate.approve({train, Seconds(10), two.clock.now()}));
}

TEST_F(UnitRecordFile, AProgramThatIsKilledAfterAnApprovalHasBookedIt) {
    RecordProperty("hazard", "H1");
    const auto child = ::fork();
    ASSERT_GE(child, 0);
    if (child == 0) {
        SteadyClock clock;
        auto record = UnitRecord::open(folders(), kUnit, clock);
        SafetyGate gate(clock);
        if (record) gate.continueFrom(**record);
        if (!record || !gate.configure(strongSetup())) ::_exit(1);
        for (int k = 0; k < 4; ++k) {
            if (!gate.approve({volts(40), Seconds(10), clock.now()})) ::_exit(2);
        }
        ::raise(SIGKILL);  // killed before any train was delivered
    }
    int status = 0;
    ASSERT_EQ(::waitpid(child, &status, 0), child);
    ASSERT_TRUE(WIFSIGNALED(status)) << WEXITSTATUS(status);
    SteadyClock clock;
    auto record = UnitRecord::open(folders(), kUnit, clock);
    ASSERT_TRUE(record) << "the lock of a dead process is gone: " << record.error().message;
    EXPECT_TRUE((*record)->whyQuiet().empty()) << (*record)->whyQuiet();
    SafetyGate gate(clock);
    gate.continueFrom(**record);
    ASSERT_TRUE(gate.configure(strongSetup()));
    EXPECT_THAT(gate.approve({volts(40), Seconds(10), clock.now()}), refusedSaying("with the 4 trains before it"));
}

TEST_F(UnitRecordFile, AUnitWhosePastIsNotKnownRests) {
    RecordProperty("hazard", "H1");
    const auto expectRest = [&](const char* why, double atLeast_s = 7.9) {
        auto unsure = run();
        ASSERT_TRUE(unsure->record);
        EXPECT_THAT(std::string(unsure->record->whyQuiet()), HasSubstr(why));
        EXPECT_THAT(unsure->ask(), refused(ErrorCode::LimitExceeded, "is not known"));
        EXPECT_FALSE(unsure->gate.approveCheck(unsure->clock.now())) << "not even a check";
        unsure->pass(atLeast_s);
        EXPECT_FALSE(unsure->ask());
        unsure->pass(0.2);
        EXPECT_TRUE(unsure->ask());
    };
    const auto soundOne = [&] {
        time_.now += std::chrono::seconds(20);
        auto made = run();
        EXPECT_TRUE(made->ask());
        return std::filesystem::file_size(file());
    };
    const auto size = soundOne();
    spoil(size / 2);  // damages a slot that was never written
    expectRest("incomplete");
    soundOne();
    spoil(16);
    expectRest("damaged");
    soundOne();
    std::filesystem::resize_file(file(), size / 2);
    expectRest("damaged");
    soundOne();
    time_.now -= std::chrono::minutes(10);
    expectRest("not come");
    // The program ends and starts again during the rest, which continues.
    soundOne();
    spoil(16);
    (void)run();
    time_.now += std::chrono::seconds(3);
    expectRest("did not know it either", 4.8);
}

TEST_F(UnitRecordFile, IsNoLinkToAnotherFile) {
    RecordProperty("hazard", "H8");
    ASSERT_TRUE(run()->ask());
    const auto record = file();
    const ScratchDir other;
    const auto evidence = other.write("evidence.tacto", "a session");
    for (const bool hard : {false, true}) {
        std::filesystem::remove(record);
        if (hard)
            std::filesystem::create_hard_link(evidence, record);
        else
            std::filesystem::create_symlink(evidence, record);
        VirtualClock clock;
        EXPECT_THAT(UnitRecord::open(folders(), kUnit, clock, time_), refused(ErrorCode::Io)) << hard;
        EXPECT_EQ(std::filesystem::file_size(evidence), 9U) << "it was written over";
    }
}

TEST_F(UnitRecordFile, ADamagedFaultIsAFaultThatASafetyCheckResets) {
    RecordProperty("hazard", "H1");
    for (const bool internal : {false, true}) {
        {
            const auto before = run();
            before->record->keepFault(internal ? FaultCause::Internal : FaultCause::OpenElectrode, "as it was");
        }
        if (!internal) std::filesystem::resize_file(file(), 64);
        const auto found = run();
        Interlock interlock;
        ASSERT_TRUE(interlock.connect());
        interlock.keepFaultsIn(*found->record);
        EXPECT_EQ(interlock.state(), InterlockState::Faulted);
        EXPECT_FALSE(interlock.causePersists(FaultCause::Internal)) << "only in the program that had it";
        EXPECT_TRUE(interlock.causePersists(FaultCause::DeviceFault));
        interlock.causeGone(FaultCause::DeviceFault);
        EXPECT_FALSE(interlock.reset()) << "not by hand: its cause is not known";
        EXPECT_TRUE(interlock.reset(interlock.causesCame(), ResetBy::SafetyCheck));
        EXPECT_FALSE(found->record->fault());
        found->record->clearFault();
    }
}

TEST_F(UnitRecordFile, AnotherStartOfTheComputerIsLongAgoOnlyWhenTheWallClockSaysSo) {
    RecordProperty("hazard", "H1");
    const auto restsAfter = [&](std::string id, int wall_s) {
        time_.id = "boot-1";
        time_.now = std::chrono::hours(1);
        std::filesystem::remove_all(folder_.path());
        emptyClaims();
        EXPECT_TRUE(run()->ask());
        emptyClaims();
        time_.id = std::move(id);
        time_.now = std::chrono::seconds(15);
        time_.walls += std::chrono::seconds(wall_s);
        return !run()->ask().has_value();
    };
    EXPECT_FALSE(restsAfter("boot-2", 61));
    EXPECT_TRUE(restsAfter("boot-2", 59));
    EXPECT_TRUE(restsAfter("boot-2", -3600)) << "a wall clock that was set back";
    EXPECT_TRUE(restsAfter("", 1)) << "which start of the computer this is, is not known";
    EXPECT_FALSE(restsAfter("", 61));
}

TEST_F(UnitRecordFile, HoldsAsManyTrainsAsTheMeterAndTheNewest) {
    auto busy = run();
    BookedTrain train;
    train.overRange.in5s.currentSquared_A2s = 1;
    for (std::size_t k = 0; k < UnitRecord::kTrains + 10; ++k) {
        train.earliest = train.latest = busy->clock.now();
        train.hz = static_cast<double>(k);
        busy->record->book(train, {});
    }
    busy.reset();
    VirtualClock clock;
    auto record = accepted(UnitRecord::open(folders(), kUnit, clock, time_));
    ExposureMeter meter;
    (void)record->replay(meter);
    EXPECT_EQ(meter.size(), UnitRecord::kTrains);
    const auto sums = meter.couldShare(Seconds(5), clock.now());
    EXPECT_DOUBLE_EQ(sums.overRange.currentSquared_A2s, static_cast<double>(UnitRecord::kTrains));
    EXPECT_DOUBLE_EQ(sums.lowestHz, 10) << "the oldest were overwritten";
}

TEST_F(UnitRecordFile, BookingDoesNotAllocate) {
    if (!countsAllocations()) GTEST_SKIP() << kNotCounted;
    auto running = run();
    const auto before = allocationsOfThisThread();
    ASSERT_TRUE(running->ask());
    running->record->keepFault(FaultCause::OpenElectrode, "the electrode is open");
    running->record->clearFault();
    EXPECT_EQ(allocationsOfThisThread(), before);
}

TEST_F(UnitRecordFile, AFaultStaysWithTheUnitUntilItIsReset) {
    RecordProperty("hazard", "H3");
    {
        auto one = run();
        Interlock interlock;
        ASSERT_TRUE(interlock.connect());
        interlock.keepFaultsIn(*one->record);
        EXPECT_EQ(interlock.state(), InterlockState::Disarmed);
        interlock.fault(FaultCause::OpenElectrode, "the electrode is open: it lifted, or its lead is off");
        interlock.fault(FaultCause::DeviceLost, "and then it was unplugged");
    }
    {
        auto two = run();
        Interlock interlock;
        ASSERT_TRUE(interlock.connect());
        interlock.keepFaultsIn(*two->record);
        EXPECT_EQ(interlock.state(), InterlockState::Faulted);
        EXPECT_THAT(std::string(interlock.reason().view()), HasSubstr("left by an earlier run: the electrode is open"));
        EXPECT_TRUE(interlock.causePersists(FaultCause::OpenElectrode));
        EXPECT_TRUE(interlock.causePersists(FaultCause::DeviceLost));
        EXPECT_FALSE(interlock.reset()) << "its causes are looked at again first";
        interlock.causeGone(FaultCause::OpenElectrode);
        interlock.causeGone(FaultCause::DeviceLost);
        ASSERT_TRUE(interlock.reset());
        EXPECT_EQ(interlock.state(), InterlockState::Disarmed) << "the unit was opened: it is not lost";
    }
    EXPECT_FALSE(run()->record->fault());
    // A damaged record must not report that all is well.
    run()->record->keepFault(FaultCause::NetCharge, "net charge");
    std::filesystem::resize_file(file(), 400);
    const auto unsure = run();
    const auto fault = unsure->record->fault();
    ASSERT_TRUE(fault);
    EXPECT_THAT(std::string(fault->reason.view()), HasSubstr("is not known"));
}

// Which program may drive a unit, and which record knows the unit's past: several programs, accounts, data folders and
// copies.

using testing::HasSubstr;

TEST_F(UnitRecordFile, AGraveFaultStaysOnDiskThroughItsSafetyCheck) {
    RecordProperty("hazard", "H2");
    std::mt19937 random(49);
    run()->record->keepFault(FaultCause::LimitBroken, "44 V were measured");
    for (int kills = 0; kills < 40; ++kills) {
        const auto check = run();
        Interlock interlock;
        ASSERT_TRUE(interlock.connect());
        interlock.keepFaultsIn(*check->record);
        ASSERT_TRUE(interlock.reset(interlock.causesCame(), ResetBy::SafetyCheck));
        EXPECT_FALSE(interlock.unitFault());
        for (int trips = std::uniform_int_distribution(0, 3)(random); trips > 0; --trips) {
            const auto provoked = trips % 2 == 0 ? FaultCause::OpenElectrode : FaultCause::LoopSilent;
            interlock.fault(provoked, "provoked");
            ASSERT_EQ(interlock.unitFault()->causes, bitOf(provoked)) << "the check knows what it provoked";
            if (trips == 1 && kills % 2 == 0) break;  // killed while it is faulted
            ASSERT_TRUE(interlock.reset(interlock.causesCame()));
        }
        // What a kill leaves is what the file has.
        ScratchDir other;
        std::filesystem::copy(folder_.path(), other.path(), std::filesystem::copy_options::recursive);
        ScratchDir claims;
        const auto left =
            accepted(UnitRecord::open({other.path(), claims.path()}, kUnit, check->clock, time_))->fault();
        ASSERT_TRUE(left) << kills;
        EXPECT_EQ(graveCause(left->causes), FaultCause::LimitBroken);
        EXPECT_EQ(left->reason.view(), "44 V were measured");
    }
    run()->record->clearFault();
    EXPECT_FALSE(run()->record->fault()) << "after a pass";
}

class UnitClaim : public UnitRecordFile {};

TEST_F(UnitClaim, OneUnitIsDrivenByOneProgram) {
    RecordProperty("hazard", "H1");
    auto first = run();
    VirtualClock clock;
    EXPECT_THAT(UnitRecord::open(folders(), kUnit, clock, time_),
                refused(ErrorCode::Device,
                        testing::AllOf(HasSubstr(fmt::format("(process {})", ::getpid())), HasSubstr(kUnit))));
    first.reset();
    EXPECT_TRUE(UnitRecord::open(folders(), kUnit, clock, time_));
}

TEST_F(UnitClaim, OnlyTheLastRecordOfAUnitOnThisComputerKnowsItsPast) {
    RecordProperty("hazard", "H1");
    const ScratchDir other;
    // The records of two accounts or data folders that have both existed for a long time.
    const auto drive = [&](const std::filesystem::path& records, std::size_t expected, const char* why) {
        const VirtualClock clock;
        SafetyGate gate(clock);
        const auto record = accepted(UnitRecord::open({records, claims_.path()}, kUnit, clock, time_));
        EXPECT_THAT(std::string(record->whyQuiet()), HasSubstr(why));
        gate.continueFrom(*record);
        ASSERT_TRUE(gate.configure(strongSetup()));
        std::size_t approved = 0;
        while (approved < 100 && gate.approve({volts(40), Seconds(10), clock.now()})) ++approved;
        EXPECT_EQ(approved, expected);
        EXPECT_EQ(gate.approveCheck(clock.now()).has_value(), std::string_view(why).empty()) << "not even a check";
    };
    drive(folder_.path(), 4, "");
    time_.now += std::chrono::seconds(20);
    drive(other.path(), 0, "from another record");
    time_.now += std::chrono::seconds(20);
    drive(other.path(), 4, "");
    drive(folder_.path(), 0, "from another record");
    time_.now += std::chrono::seconds(3);
    drive(folder_.path(), 0, "did not know it either");
    time_.now += std::chrono::seconds(6);
    drive(folder_.path(), 4, "");
    drive(folder_.path() / "a new one", 0, "from another record");
    time_.now += std::chrono::seconds(20);
    drive(folder_.path() / "a new one", 4, "");
    std::filesystem::remove_all(folder_.path() / "a new one");
    drive(folder_.path() / "a new one", 0, "from another record");
}

TEST_F(UnitClaim, ACopyOfARecordIsAnotherRecord) {
    RecordProperty("hazard", "H1");
    const ScratchDir copy;
    const auto from = [&](const std::filesystem::path& records) {
        const VirtualClock clock;
        SafetyGate gate(clock);
        const auto record = UnitRecord::open({records, claims_.path()}, kUnit, clock, time_).value();
        gate.continueFrom(*record);
        EXPECT_TRUE(gate.configure(strongSetup()));
        std::size_t approved = 0;
        while (approved < 100 && gate.approve({volts(40), Seconds(10), clock.now()})) ++approved;
        return approved;
    };
    EXPECT_EQ(from(folder_.path()), 4U);
    std::filesystem::copy(folder_.path(), copy.path(), std::filesystem::copy_options::recursive);
    time_.now += std::chrono::seconds(20);
    EXPECT_EQ(from(folder_.path()), 4U);
    EXPECT_EQ(from(copy.path()), 0U) << "it knows nothing of the last four";
    time_.now += std::chrono::seconds(20);
    EXPECT_EQ(from(copy.path()), 4U);
    EXPECT_EQ(from(folder_.path()), 0U);
}

TEST_F(UnitClaim, AFaultIsFoundInAnEarlierCopyOfTheRecordToo) {
    RecordProperty("hazard", "H3");
    const ScratchDir copy;
    const VirtualClock clock;
    { const auto before = run(); }
    std::filesystem::copy(folder_.path(), copy.path(), std::filesystem::copy_options::recursive);
    run()->record->keepFault(FaultCause::OpenElectrode, "the electrode is open");
    EXPECT_TRUE(UnitRecord::open({copy.path(), claims_.path()}, kUnit, clock, time_).value()->fault());
}

TEST_F(UnitClaim, WithoutAPlaceForClaimsAUnitAlwaysRests) {
    RecordProperty("hazard", "H1");
    const ScratchDir other;
    const auto rests = [&](const std::filesystem::path& claims) {
        const VirtualClock clock;
        const auto record = UnitRecord::open({folder_.path(), claims}, kUnit, clock, time_);
        if (!record) return record.error().message;
        time_.now += std::chrono::seconds(20);
        return std::string((*record)->whyQuiet());
    };
    EXPECT_EQ(rests(claims_.path()), "");
    EXPECT_EQ(rests(claims_.path()), "");
    EXPECT_THAT(rests(claims_.path() / "none"), HasSubstr("no place"));
    const auto claim = std::filesystem::directory_iterator(claims_.path())->path();
    EXPECT_EQ(std::filesystem::status(claim).permissions(), std::filesystem::perms(0666)) << "for every account";
    const auto evidence = other.write("evidence.tacto", "a session");
    std::filesystem::remove(claim);
    std::filesystem::create_symlink(evidence, claim);
    EXPECT_THAT(rests(claims_.path()), HasSubstr("no place"));
    EXPECT_EQ(std::filesystem::file_size(evidence), 9U) << "it was written over";
    std::filesystem::remove(claim);
    EXPECT_EQ(rests(claims_.path()), "") << "the computer was started";
    std::filesystem::resize_file(claim, 3);
    EXPECT_THAT(rests(claims_.path()), HasSubstr("from another record")) << "a damaged claim belongs to no program";
    EXPECT_EQ(rests(claims_.path()), "");
}

TEST_F(UnitClaim, TwoAccountsNeverDriveOneUnitAtOnce) {
    RecordProperty("hazard", "H1");
    const ScratchDir other;
    const auto first = run();
    const VirtualClock clock;
    EXPECT_THAT(UnitRecord::open({other.path(), claims_.path()}, kUnit, clock, time_),
                refused(ErrorCode::Device, fmt::format("(process {})", ::getpid())));
}

TEST_F(UnitClaim, AFaultIsFoundFromEveryAccount) {
    RecordProperty("hazard", "H3");
    const ScratchDir other;
    const VirtualClock clock;
    const auto elsewhere = [&] {
        return UnitRecord::open({other.path(), claims_.path()}, kUnit, clock, time_).value();
    };
    run()->record->keepFault(FaultCause::OpenElectrode, "the electrode is open");
    const auto fault = elsewhere()->fault();
    ASSERT_TRUE(fault);
    EXPECT_THAT(std::string(fault->reason.view()), HasSubstr("of another account or data folder"));
    elsewhere()->clearFault();
    EXPECT_FALSE(elsewhere()->fault());
    EXPECT_THAT(std::string(run()->record->fault().value().reason.view()), HasSubstr("the electrode is open"))
        << "a record forgets nothing that it saw itself";
}

}  // namespace tacto::test
