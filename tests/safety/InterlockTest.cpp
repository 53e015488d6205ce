#include <algorithm>
#include <array>
#include <gtest/gtest.h>
#include <limits>
#include <random>
#include <set>
#include <thread>

#include "core/safety/Interlock.h"
#include "tests/support/Refused.h"

namespace tacto {

namespace {
using namespace std::chrono_literals;
using State = InterlockState;
using test::refusedSaying;

ArmingEvidence goodEvidence(Instant at = 0s) {
    ArmingEvidence e;
    e.limitsLoaded = e.deviceIdentified = e.operatorConfirmed = true;
    e.impedance = Ohms(1000);
    e.impedanceLow = Ohms(800);
    e.impedanceHigh = Ohms(1200);
    e.impedanceAt = at;
    return e;
}

/// Brings a new interlock into a state by legal transitions.
void bringTo(Interlock& lock, State state) {
    if (state == State::Disconnected) return;
    ASSERT_TRUE(lock.connect());
    if (state == State::Faulted) return lock.fault(FaultCause::OpenElectrode, "open");
    if (state == State::Disarmed) return;
    const auto ticket = lock.requestArming(0s);
    ASSERT_TRUE(ticket);
    ASSERT_TRUE(lock.confirmArming(*ticket, 0s));
    if (state == State::Checking) return;
    ASSERT_TRUE(lock.arm(goodEvidence(), 0s));
    if (state == State::Armed) return;
    ASSERT_TRUE(lock.beginDelivery());
    if (state == State::Paused) {
        ASSERT_TRUE(lock.pause());
    }
    ASSERT_EQ(lock.state(), state);
}

constexpr std::array kAll{State::Disconnected, State::Disarmed, State::Checking, State::Armed,
                          State::Delivering,   State::Paused,   State::Faulted};
}  // namespace

TEST(Interlock, OnlyTheListedTransitionsAreLegal) {
    RecordProperty("hazard", "H12");
    struct Move {
        const char* name;
        bool (*go)(Interlock&);
        std::vector<std::pair<State, State>> legal;
    };
    const std::vector<Move> moves{
        {"connect", [](Interlock& l) { return l.connect().has_value(); }, {{State::Disconnected, State::Disarmed}}},
        {"disconnect",
         [](Interlock& l) { return l.disconnect().has_value(); },
         {{State::Disarmed, State::Disconnected}}},
        {"request", [](Interlock& l) { return l.requestArming(0s).has_value(); }, {{State::Disarmed, State::Disarmed}}},
        {"arm", [](Interlock& l) { return l.arm(goodEvidence(), 0s).has_value(); }, {{State::Checking, State::Armed}}},
        {"deliver",
         [](Interlock& l) { return l.beginDelivery().has_value(); },
         {{State::Armed, State::Delivering}, {State::Delivering, State::Delivering}}},
        {"pause", [](Interlock& l) { return l.pause().has_value(); }, {{State::Delivering, State::Paused}}},
        {"resume", [](Interlock& l) { return l.resume().has_value(); }, {{State::Paused, State::Delivering}}},
        {"reset",
         [](Interlock& l) {
             l.causeGone(FaultCause::OpenElectrode);
             return l.reset().has_value();
         },
         {{State::Faulted, State::Disarmed}}},
    };
    for (const auto& move : moves) {
        for (const State from : kAll) {
            Interlock lock;
            bringTo(lock, from);
            State to = from;
            bool legal = false;
            for (const auto& [a, b] : move.legal) {
                if (a == from) {
                    to = b;
                    legal = true;
                }
            }
            EXPECT_EQ(move.go(lock), legal) << move.name << " from " << nameOf(from);
            EXPECT_EQ(lock.state(), to) << move.name << " from " << nameOf(from);
        }
    }
}

TEST(Interlock, DisarmWorksFromEverywhereAndLeavesAFaultLatched) {
    RecordProperty("hazard", "H2");
    for (const State from : kAll) {
        Interlock lock;
        bringTo(lock, from);
        lock.disarm("Esc");
        const bool output =
            from == State::Checking || from == State::Armed || from == State::Delivering || from == State::Paused;
        EXPECT_EQ(lock.state(), output ? State::Disarmed : from) << nameOf(from);
        EXPECT_EQ(lock.reason().view() == "Esc", output);
        EXPECT_FALSE(lock.mayDeliver());
        EXPECT_FALSE(lock.mayCheck());
    }
}

TEST(Interlock, TheCodeOfAFaultIsThatOfItsFirstReason) {
    RecordProperty("hazard", "H2");
    for (int i = 0; i < kFaultCauseCount; ++i) {
        const auto cause = static_cast<FaultCause>(i);
        const bool late =
            cause == FaultCause::StatusMissing || cause == FaultCause::LoopSilent || cause == FaultCause::StaleSensor;
        Interlock lock;
        bringTo(lock, State::Delivering);
        lock.fault(cause, "first");
        EXPECT_EQ(lock.faultCode(), late ? ErrorCode::Timeout : ErrorCode::Device) << nameOf(cause);
        lock.fault(FaultCause::LoopSilent, "then");
        lock.fault(FaultCause::NetCharge, "and then");
        EXPECT_EQ(lock.faultCode(), late ? ErrorCode::Timeout : ErrorCode::Device) << nameOf(cause);
    }
    Interlock lock;
    bringTo(lock, State::Delivering);
    lock.fault(FaultCause::DeviceFault, "it did not answer", ErrorCode::Timeout);
    EXPECT_EQ(lock.faultCode(), ErrorCode::Timeout);
    lock.causeGone(FaultCause::DeviceFault);
    ASSERT_TRUE(lock.reset());
    lock.fault(FaultCause::DeviceFault, "it was not written", ErrorCode::Io);
    EXPECT_EQ(lock.faultCode(), ErrorCode::Device) << "no other code tells of a fault";
}

TEST(Interlock, FaultLatchesFromEverywhereAndNeedsItsCausesGone) {
    RecordProperty("hazard", "H2");
    for (const State from : kAll) {
        Interlock lock;
        bringTo(lock, from);
        if (from == State::Faulted) lock.causeGone(FaultCause::OpenElectrode);
        lock.fault(FaultCause::StatusMissing, "no status");
        lock.fault(FaultCause::ShortElectrode, "shorted as well");
        EXPECT_EQ(lock.state(), State::Faulted) << nameOf(from);
        EXPECT_EQ(lock.reason().view(), from == State::Faulted ? "open" : "no status") << "the first reason is kept";
        lock.disarm("operator");
        EXPECT_FALSE(lock.reset());
        lock.causeGone(FaultCause::StatusMissing);
        EXPECT_THAT(lock.reset(), refusedSaying("shorted electrode"));
        EXPECT_TRUE(lock.causePersists(FaultCause::ShortElectrode));
        EXPECT_EQ(lock.state(), State::Faulted) << "a cause that goes does not leave the fault";
        lock.causeGone(FaultCause::ShortElectrode);
        EXPECT_EQ(lock.state(), State::Faulted);
        EXPECT_TRUE(lock.reset());
        EXPECT_EQ(lock.state(), State::Disarmed);
        EXPECT_TRUE(lock.reason().empty());
    }
}

TEST(Interlock, NoLesserCauseHidesAGraverOne) {
    RecordProperty("hazard", "H1");
    constexpr std::array kGravestFirst{FaultCause::StuckOn, FaultCause::LimitBroken, FaultCause::NetCharge,
                                       FaultCause::Internal};
    std::mt19937 random(173);
    for (int round = 0; round < 2000; ++round) {
        Interlock lock;
        bringTo(lock, State::Delivering);
        EXPECT_EQ(lock.cause(), std::nullopt);
        std::set<FaultCause> came;
        for (int left = std::uniform_int_distribution(1, 5)(random); left > 0; --left) {
            const auto cause = FaultCause(std::uniform_int_distribution(0, kFaultCauseCount - 1)(random));
            lock.fault(cause, "why");
            came.insert(cause);
            const auto grave = std::ranges::find_if(kGravestFirst, [&](auto each) { return came.contains(each); });
            const auto shown = grave == kGravestFirst.end() ? *came.begin() : *grave;
            ASSERT_EQ(lock.cause(), shown) << nameOf(*lock.cause());
            ASSERT_THAT(lock.reset(), refusedSaying(std::string(nameOf(shown))));
        }
    }
}

TEST(Interlock, NoCauseThatComesWhileAFaultIsLeftIsLost) {
    RecordProperty("hazard", "H2");
    for (int before = 0; before < kFaultCauseCount; ++before) {
        for (int after = 0; after < kFaultCauseCount; ++after) {
            const auto first = FaultCause(before), then = FaultCause(after);
            Interlock lock;
            bringTo(lock, State::Delivering);
            lock.fault(first, "first");
            auto seen = lock.causesCame();
            lock.fault(then, "then");
            EXPECT_THAT(lock.reset(seen), refusedSaying(std::string(nameOf(then)))) << nameOf(first);
            seen.all = lock.causesCame().all;  // looked into once more
            const bool known = before == after && !graveCause(bitOf(then));
            EXPECT_EQ(lock.reset(seen).has_value(), known) << nameOf(first) << ", " << nameOf(then);
            EXPECT_EQ(lock.state() == State::Faulted, !known);
            EXPECT_TRUE(known || lock.causePersists(then));
        }
    }
}

TEST(Interlock, ARefusedResetNamesTheCauseThatCameAgain) {
    RecordProperty("hazard", "H2");
    Interlock lock;
    bringTo(lock, State::Delivering);
    lock.fault(FaultCause::StaleSensor, "first");
    lock.fault(FaultCause::OpenElectrode, "second");
    const auto seen = lock.causesCame();
    lock.fault(FaultCause::StaleSensor, "again");
    EXPECT_THAT(lock.reset(seen), refusedSaying("the fault came again meanwhile, stale sensor"));
    lock.fault(FaultCause::DeviceLost, "third");
    lock.fault(FaultCause::StaleSensor, "again");
    EXPECT_THAT(lock.reset(seen), refusedSaying("another cause of the fault came meanwhile, device lost"));
}

TEST(Interlock, NoCauseOfAnotherThreadIsLostWhileAFaultIsLeft) {
    RecordProperty("hazard", "H2");
    Interlock lock;
    ASSERT_TRUE(lock.connect());
    constexpr int kEach = 5000;
    const auto come = [&lock](FaultCause cause) {
        for (int k = 0; k < kEach; ++k) {
            lock.fault(cause, "why");
            if (k % 7 == 0) std::this_thread::yield();
        }
    };
    std::thread limits(come, FaultCause::LimitBroken), stuck(come, FaultCause::StuckOn);
    std::uint64_t left = 0;
    int resets = 0, refusals = 0;
    const auto leave = [&] {
        const auto seen = lock.causesCame();
        if (lock.state() != State::Faulted) return;
        std::this_thread::yield();
        const bool reset = lock.reset(seen, ResetBy::SafetyCheck).has_value();
        ++(reset ? resets : refusals);
        if (reset) left = seen.news;
    };
    while (lock.causesCame().all < 2 * kEach) leave();
    limits.join();
    stuck.join();
    EXPECT_EQ(lock.causesCame().news, 2U * kEach) << "a grave cause that comes again counts again";
    EXPECT_EQ(lock.state() == State::Faulted, left < 2U * kEach) << resets << " resets, " << refusals << " refusals";
    leave();
    EXPECT_EQ(lock.state(), State::Disarmed);
    EXPECT_EQ(left, 2U * kEach);
}

TEST(Interlock, ALostDeviceComesBackDisconnected) {
    Interlock lock;
    bringTo(lock, State::Delivering);
    lock.fault(FaultCause::DeviceLost, "unplugged");
    lock.causeGone(FaultCause::DeviceLost);
    EXPECT_TRUE(lock.reset());
    EXPECT_EQ(lock.state(), State::Disconnected);
}

TEST(Interlock, CheckingTakesTwoStepsThatBelongTogether) {
    RecordProperty("hazard", "H12");
    Interlock lock;
    bringTo(lock, State::Disarmed);
    EXPECT_FALSE(lock.confirmArming(0, 0s)) << "no first step";
    EXPECT_FALSE(lock.confirmArming(1, 0s));
    auto ticket = lock.requestArming(10s);
    EXPECT_FALSE(lock.confirmArming(*ticket, 40s + 1ns)) << "too late";
    EXPECT_FALSE(lock.confirmArming(*ticket, 11s)) << "used";
    ticket = lock.requestArming(50s);
    lock.disarm("stop");
    EXPECT_FALSE(lock.confirmArming(*ticket, 51s)) << "a stop came between";
    ticket = lock.requestArming(60s);
    const auto newer = lock.requestArming(61s);
    EXPECT_FALSE(lock.confirmArming(*ticket, 62s)) << "a newer request stands";
    ticket = lock.requestArming(63s);
    EXPECT_NE(*ticket, *newer);
    EXPECT_TRUE(lock.confirmArming(*ticket, 63s));
    EXPECT_EQ(lock.state(), State::Checking);
    EXPECT_TRUE(lock.mayCheck());
    EXPECT_FALSE(lock.mayDeliver());
}

TEST(Interlock, ArmingNeedsAllOfItsEvidence) {
    RecordProperty("hazard", "H12");
    const auto refused = [](auto spoil, const std::string& words, Instant now = 0s) {
        Interlock lock;
        bringTo(lock, State::Checking);
        ArmingEvidence evidence = goodEvidence();
        spoil(evidence);
        EXPECT_THAT(lock.arm(evidence, now), refusedSaying(words)) << words;
        EXPECT_EQ(lock.state(), State::Checking);
    };
    refused([](auto& e) { e = ArmingEvidence{}; }, "no limit set");
    refused([](auto& e) { e.limitsLoaded = false; }, "no limit set");
    refused([](auto& e) { e.deviceIdentified = false; }, "not identified");
    refused([](auto& e) { e.operatorConfirmed = false; }, "operator");
    refused([](auto& e) { e.impedance.reset(); }, "no impedance");
    refused(
        [](auto& e) {
            e.impedance.reset();
            e.declaredLoadConfirmed = true;
        },
        "no impedance");
    refused(
        [](auto& e) {
            e.impedance.reset();
            e.readsBack = false;
        },
        "not confirmed");
    refused([](auto& e) { e.impedance = Ohms(799); }, "799 ohm");
    refused([](auto& e) { e.impedance = Ohms(std::numeric_limits<double>::quiet_NaN()); }, "nan ohm");
    refused([](auto& e) { e.impedance = Ohms(std::numeric_limits<double>::infinity()); }, "inf ohm");
    refused([](auto&) {}, "at most 5 s", 5s + 1ns);
    refused([](auto& e) { e.impedanceAt = 1s; }, "at most 5 s");
    // A measured impedance is judged, whatever load was declared.
    refused(
        [](auto& e) {
            e.readsBack = false;
            e.declaredLoadConfirmed = true;
            e.impedance = Ohms(1);
        },
        "1 ohm");
}

TEST(Interlock, DeclaredLoadStandsInWhereNothingReadsBackAndAMassagerNeedsNone) {
    for (const bool massager : {false, true}) {
        Interlock lock;
        bringTo(lock, State::Checking);
        ArmingEvidence evidence = goodEvidence();
        evidence.impedance.reset();
        evidence.readsBack = false;
        evidence.declaredLoadConfirmed = !massager;
        evidence.needsImpedance = !massager;
        EXPECT_TRUE(lock.arm(evidence, 0s));
    }
}

TEST(Interlock, StopWinsAgainstALoopThatDelivers) {
    RecordProperty("hazard", "H2");
    Interlock lock;
    bringTo(lock, State::Armed);
    std::atomic<bool> stopped{false};
    std::thread loop([&] {
        while (!stopped.load()) {
            (void)lock.beginDelivery();
            (void)lock.pause();
            (void)lock.resume();
            (void)lock.reason();
        }
    });
    std::this_thread::yield();
    lock.disarm("stop");
    EXPECT_EQ(lock.state(), State::Disarmed);
    stopped = true;
    loop.join();
    EXPECT_EQ(lock.state(), State::Disarmed) << "the loop cannot take it back";
}

TEST(Interlock, NamesEveryStateAndCause) {
    EXPECT_EQ(nameOf(State::Disconnected), "disconnected");
    EXPECT_EQ(nameOf(State::Faulted), "faulted");
    EXPECT_EQ(nameOf(FaultCause::DeviceLost), "device lost");
    EXPECT_EQ(nameOf(FaultCause::Internal), "internal error");
}

}  // namespace tacto
