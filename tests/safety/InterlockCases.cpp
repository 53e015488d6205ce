#include <limits>

#include "core/base/Statistics.h"
#include "core/safety/AcceptedLevels.h"
#include "core/safety/Heartbeat.h"
#include "core/safety/Interlock.h"
#include "core/safety/Rules.h"
#include "core/safety/TrainCheck.h"
#include "tests/safety/GateCases.h"
#include "tests/safety/GateFixtures.h"

namespace tacto::test {

using namespace gate;
using namespace std::chrono_literals;

namespace {

template <class T>
bool notArmed(const Result<T>& result, std::string_view words) {
    return refuses(result, ErrorCode::NotArmed, words);
}

ArmingEvidence evidence() {
    ArmingEvidence e;
    e.limitsLoaded = e.deviceIdentified = e.operatorConfirmed = true;
    e.impedance = Ohms(1000);
    e.impedanceLow = Ohms(800);
    e.impedanceHigh = Ohms(1200);
    return e;
}

/// True if an interlock arms with good evidence, but another refuses with these words when one thing is spoilt.
bool refusesToArm(std::string_view words, const std::function<void(ArmingEvidence&)>& spoil, Instant at = 0s) {
    const auto armed = [at](const ArmingEvidence& given) -> Result<void> {
        Interlock lock;
        if (auto connected = lock.connect(); !connected) return connected;
        const auto ticket = lock.requestArming(at);
        if (!ticket) return failure(ticket);
        if (auto confirmed = lock.confirmArming(*ticket, at); !confirmed) return confirmed;
        return lock.arm(given, at);
    };
    ArmingEvidence good = evidence();
    good.impedanceAt = at;
    ArmingEvidence spoilt = good;
    spoil(spoilt);
    return armed(good).has_value() && notArmed(armed(spoilt), words);
}

TrainReadBack goodStatus() {
    TrainReadBack status;
    status.at = 1s + 5ms;
    status.electrode = ElectrodeReading::Ok;
    status.imbalance = 0.002;
    status.imbalanceUncertainty = 0.001;
    return status;
}
/// Returns the finding for a train that ended at 1 s, judged 10 ms later or at `now`.
TrainFinding found(const std::function<void(TrainReadBack&)>& spoil, Instant now = 1s + 10ms) {
    TrainReadBack status = goodStatus();
    spoil(status);
    return judgeTrain(OutputMode::Person, status, 1s, now).finding;
}
}  // namespace

void addInterlockCases(std::vector<GateCase>& cases) {
    const auto add = [&cases](Check check, std::string name, std::function<bool()> holds) {
        cases.push_back({check, std::move(name), std::move(holds)});
    };
    add(InterlockMove, "delivering without being armed", [] {
        Interlock lock;
        return lock.connect().has_value() && notArmed(lock.beginDelivery(), "cannot deliver while disarmed");
    });
    add(ArmRequestState, "arming without a device", [] {
        Interlock lock;
        return notArmed(lock.requestArming(0s), "cannot start arming while disconnected");
    });
    add(ArmConfirmState, "confirming after a fault", [] {
        Interlock lock;
        if (!lock.connect()) return false;
        const auto ticket = lock.requestArming(0s);
        lock.fault(FaultCause::Internal, "a test");
        return ticket.has_value() && notArmed(lock.confirmArming(*ticket, 0s), "cannot confirm arming while faulted");
    });
    add(ArmTicket, "a confirmation that is late, or was stopped", [] {
        const auto confirm = [](Instant at, bool stop, std::uint64_t more) {
            Interlock lock;
            if (auto connected = lock.connect(); !connected) return connected;
            const auto ticket = lock.requestArming(0s);
            if (!ticket) return Result<void>(failure(ticket));
            if (stop) lock.disarm("a stop");
            return lock.confirmArming(*ticket + more, at);
        };
        return confirm(30s, false, 0).has_value() && notArmed(confirm(30s + 1ns, false, 0), "was not requested") &&
               notArmed(confirm(1s, true, 0), "was stopped since") && notArmed(confirm(1s, false, 1), "not requested");
    });
    add(ArmState, "arming without the two steps", [] {
        Interlock lock;
        return lock.connect().has_value() && notArmed(lock.arm(evidence(), 0s), "must be running");
    });
    add(ArmLimits, "arming without limits",
        [] { return refusesToArm("no limit set", [](auto& e) { e.limitsLoaded = false; }); });
    add(ArmIdentity, "arming an unknown device",
        [] { return refusesToArm("not identified", [](auto& e) { e.deviceIdentified = false; }); });
    add(ArmOperator, "arming without the operator",
        [] { return refusesToArm("has not confirmed", [](auto& e) { e.operatorConfirmed = false; }); });
    add(ArmImpedanceMissing, "arming without an impedance", [] {
        return refusesToArm("no impedance was measured", [](auto& e) { e.impedance.reset(); }) &&
               refusesToArm("is not confirmed", [](auto& e) {
                   e.impedance.reset();
                   e.readsBack = false;
               });
    });
    add(ArmImpedanceRange, "arming on a wrong impedance", [] {
        return refusesToArm("is accepted", [](auto& e) { e.impedance = Ohms(799); }) &&
               refusesToArm("is accepted", [](auto& e) { e.impedance = Ohms(1201); }) &&
               refusesToArm("is accepted", [](auto& e) { e.impedance = Ohms(kNaN); });
    });
    add(ArmImpedanceAge, "arming on an old impedance", [] {
        return refusesToArm(
                   "at most 5 s", [](auto& e) { e.impedanceAt = 4999ms; }, 10s) &&
               refusesToArm(
                   "at most 5 s", [](auto& e) { e.impedanceAt = 10s + 1ns; }, 10s);
    });
    add(ResetState, "resetting what is not faulted", [] {
        Interlock lock;
        return lock.connect().has_value() && notArmed(lock.reset(), "nothing to reset");
    });
    add(ResetCause, "resetting while the cause is there", [] {
        Interlock lock;
        if (!lock.connect()) return false;
        lock.fault(FaultCause::ShortElectrode, "a test");
        const bool refused = notArmed(lock.reset(), "persists: shorted electrode");
        lock.causeGone(FaultCause::ShortElectrode);
        return refused && lock.reset().has_value();
    });
    add(ResetSeen, "resetting when a cause has come that nobody saw", [] {
        Interlock lock;
        if (!lock.connect()) return false;
        lock.fault(FaultCause::OpenElectrode, "a test");
        const auto seen = lock.causesCame();
        lock.fault(FaultCause::LimitBroken, "a test");
        const bool refused = notArmed(lock.reset(seen), "came meanwhile, limit broken");
        return refused && lock.reset(lock.causesCame(), ResetBy::SafetyCheck).has_value();
    });
    add(ResetGrave, "resetting by hand after a grave cause", [] {
        for (const auto cause :
             {FaultCause::StuckOn, FaultCause::LimitBroken, FaultCause::NetCharge, FaultCause::Internal}) {
            Interlock lock;
            if (!lock.connect()) return false;
            lock.fault(cause, "a test");
            if (!notArmed(lock.mayReset(), "the safety check first") ||
                !notArmed(lock.reset(lock.causesCame()), "the safety check first") ||
                !lock.reset(lock.causesCame(), ResetBy::SafetyCheck))
                return false;
        }
        return true;
    });

    add(TrainNoStatus, "no status 50 ms after a train", [] {
        return judgeTrain(OutputMode::BenchLoad, {}, 1s, 1s + 50ms).finding == TrainFinding::Pending &&
               judgeTrain(OutputMode::BenchLoad, {}, 1s, 1s + 51ms).finding == TrainFinding::StatusMissing;
    });
    add(TrainGarbage, "an imbalance that is not a number", [] {
        return found([](auto&) {}) == TrainFinding::Ok &&
               found([](auto& s) { s.imbalance = -1; }) == TrainFinding::Garbage &&
               found([](auto& s) { s.imbalanceUncertainty = kNaN; }) == TrainFinding::Garbage;
    });
    add(TrainOpen, "an open electrode",
        [] { return found([](auto& s) { s.electrode = ElectrodeReading::Open; }) == TrainFinding::Open; });
    add(TrainShort, "shorted electrodes",
        [] { return found([](auto& s) { s.electrode = ElectrodeReading::Short; }) == TrainFinding::Short; });
    add(TrainNetCharge, "net charge at a person", [] {
        return found([](auto& s) { s.imbalance = 0.0105; }) == TrainFinding::Ok &&
               found([](auto& s) { s.imbalance = 0.0115; }) == TrainFinding::NetCharge;
    });
    add(TrainStuckOn, "still delivering 50 ms after its end", [] {
        const auto delivering = [](auto& s) {
            s.at = 1s + 49ms;
            s.delivering = true;
        };
        return found(delivering, 1s + 50ms) == TrainFinding::Pending &&
               found(delivering, 1s + 51ms) == TrainFinding::StuckOn;
    });
    add(TrainStatusLate, "a status that came late", [] {
        return found([](auto& s) { s.at = 1s + 50ms; }, 1s + 52ms) == TrainFinding::Ok &&
               found([](auto& s) { s.at = 1s + 51ms; }, 1s + 52ms) == TrainFinding::StatusMissing;
    });
    add(TrainReadEarly, "a status from before the train's end",
        [] { return found([](auto& s) { s.at = 1s - 1ms; }) == TrainFinding::Pending; });
    add(TrainNeverRead, "no other status than that by the deadline",
        [] { return found([](auto& s) { s.at = 1s - 1ms; }, 1s + 51ms) == TrainFinding::StatusMissing; });

    add(HeartSilent, "a loop that was silent for over 100 ms", [] {
        Heartbeat heart;
        (void)heart.beat(1s);
        return heart.alive(1s + 100ms) && !heart.alive(1s + 100ms + 1ns);
    });
    add(HeartNever, "a loop that never ran, or ended", [] {
        Heartbeat heart;
        const Instant never{std::numeric_limits<Instant::rep>::min()};
        const bool dead = !heart.alive(never);
        (void)heart.beat(1s);
        const bool alive = heart.alive(1s);
        heart.end();
        return dead && alive && !heart.alive(never);
    });

    add(HeartLate, "a heart that stood still and beats again by itself", [] {
        Heartbeat heart;
        const bool first = heart.beat(1s) && heart.beat(1s + 100ms);
        const bool refused = !heart.beat(1s + 201ms) && !heart.alive(1s + 201ms);
        heart.revive(1s + 201ms);
        return first && refused && heart.alive(1s + 201ms) && heart.beat(1s + 202ms);
    });

    const auto levels = [] {
        AcceptedLevels made;
        made.begin(Milliamps(5), Milliamps(0.5));
        return made;
    };
    add(LevelInVolts, "a person's level in volts", [=] {
        return levels().permits(milliamps(0.5)).has_value() &&
               refuses(levels().permits(volts(0.1)), ErrorCode::InvalidArgument, "volts were asked for");
    });
    add(LevelDiscomfort, "a level above the discomfort limit", [=] {
        auto one = levels();
        one.reportDiscomfort(Milliamps(0.3));
        return one.permits(milliamps(0.3)).has_value() &&
               refuses(one.permits(milliamps(0.31)), ErrorCode::LimitExceeded, "discomfort limit");
    });
    add(LevelCap, "a level above the study's cap", [] {
        AcceptedLevels one;
        one.begin(Milliamps(5), Milliamps(0.5), Milliamps(0.2));
        return one.permits(milliamps(0.2)).has_value() && one.ceilingFor(milliamps(0.2)) == Milliamps(0.2) &&
               refuses(one.permits(milliamps(0.3)), ErrorCode::LimitExceeded, "the study's cap is 0.2 mA");
    });
    add(LevelRamp, "a level above the ramp",
        [=] { return refuses(levels().permits(milliamps(0.51)), ErrorCode::LimitExceeded, "ramp rule"); });
    add(LevelAccept, "accepting a level that was not permitted", [=] {
        auto one = levels();
        return !one.accept(milliamps(1)) && one.accept(milliamps(0.5)).has_value();
    });
    add(LevelOfPerson, "accepting a level on a bench load", [] {
        Rig rig(benchSetup());
        return notArmed(rig.gate.accept(milliamps(0.1)), "person mode only");
    });
    add(DiscomfortOfPerson, "reporting discomfort on a bench load", [] {
        Rig rig(benchSetup());
        return notArmed(rig.gate.reportDiscomfort(Milliamps(0.1)), "person mode only");
    });
    add(LevelMalformed, "accepting a train that no stimulator could mean", [] {
        Rig rig(personSetup());
        PulseTrain train = milliamps(0.1);
        train.pulses = 0;
        return refuses(rig.gate.accept(train), ErrorCode::InvalidArgument, "pulses");
    });
    add(DiscomfortValue, "a discomfort level that is not a number", [] {
        Rig rig(personSetup());
        return refuses(rig.gate.reportDiscomfort(Milliamps(kNaN)), ErrorCode::InvalidArgument, "not a finite") &&
               refuses(rig.gate.reportDiscomfort(Milliamps(-1)), ErrorCode::InvalidArgument, "not a finite");
    });
}

}  // namespace tacto::test
