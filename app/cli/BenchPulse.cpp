#include "app/cli/BenchPulse.h"

#include <thread>

#include "core/base/QuantityText.h"
#include "core/bench/delivery/DeliveryJudge.h"
#include "core/safety/TrainCheck.h"
#include "drivers/sciencemode/ReadBack.h"

namespace tacto::cli {

namespace {

GateSetup setupFor(const PulseOrder& order, const SourceTraits& source) {
    GateSetup setup;
    setup.source = source;
    setup.load = LoadRange::declared(order.load);
    setup.limits = order.limits;
    setup.ceilings = order.ceilings;
    setup.electrodeArea = order.electrodeArea;
    setup.check = order.pulse;  // the same shape as the pulse, so that |Z| is comparable; the amplitude fits the source
    return setup;
}

std::string ohmText(Ohms value) { return scaledText(value.value(), "ohm", 4); }

}  // namespace

BenchPulse::BenchPulse(PulseOrder order, GateSetup setup, sciencemode::ScienceModeStimulator& device,
                       const Clock& clock)
    : order_(std::move(order)),
      setup_(std::move(setup)),
      device_(device),
      clock_(clock),
      gate_(clock),
      session_(device, gate_, heartbeat_, clock, {}) {}

Result<std::unique_ptr<BenchPulse>> BenchPulse::create(PulseOrder order, sciencemode::ScienceModeStimulator& device,
                                                       const Clock& clock) {
    auto setup = setupFor(order, device.traits());
    std::unique_ptr<BenchPulse> made(new BenchPulse(std::move(order), std::move(setup), device, clock));
    const auto& identity = device.identity();
    if (!identity.simulated) {
        auto record = takeUpUnit(identity, unitFolders(), clock, SystemTime::real(), made->gate_);
        if (!record) return failure(record);
        made->record_ = std::move(*record);
    }
    if (auto configured = made->gate_.configure(made->setup_); !configured) return failure(configured);
    if (auto connected = made->interlock_.connect(); !connected) return failure(connected);
    if (made->record_) made->interlock_.keepFaultsIn(*made->record_);
    if (auto left = made->leaveFault(); !left) return failure(left);
    return made;
}

/// Asks the device whether the cause is gone; the check pulse finds causes that the device cannot see.
Result<void> BenchPulse::leaveFault() {
    if (interlock_.state() != InterlockState::Faulted) return {};
    if (!order_.resetFault) {
        return fail(ErrorCode::NotArmed,
                    "the stimulator is in a fault, {}. {} Fix the cause, then reset the fault: run again "
                    "with --reset-fault",
                    interlock_.reason().view(), outputAfter(interlock_.cause()));
    }
    const auto seen = interlock_.causesCame();
    if (auto may = interlock_.mayReset(); !may) return may;
    session_.forceOff();
    const auto status = device_.status();
    if (!status) return fail(ErrorCode::NotArmed, "not reset: {}", status.error().message);
    if (status->delivering) return fail(ErrorCode::NotArmed, "not reset: the stimulator still delivers");
    if (auto reset = interlock_.reset(seen); !reset) return reset;
    // After a run that lost its device, the interlock is disconnected.
    return interlock_.state() == InterlockState::Disconnected ? interlock_.connect() : Result<void>{};
}

BenchPulse::~BenchPulse() { stop(); }

void BenchPulse::stop() noexcept {
    stopped_ = true;
    interlock_.disarm("stopped");  // disarms before the approvals become void; see send()
    gate_.latchStop();
    session_.forceOff();
}

TrainRequest BenchPulse::requestNow() const noexcept {
    TrainRequest request;
    request.train = order_.pulse;
    request.onset = clock_.now();
    return request;
}

Result<void> BenchPulse::request() {
    // A separate gate: an approval that is never delivered would otherwise stay in the exposure of the real gate.
    SafetyGate preview(clock_);
    if (auto configured = preview.configure(setup_); !configured) return configured;
    if (const auto check = preview.approveCheck(clock_.now()); !check) return failure(check);
    if (const auto pulse = preview.approve(requestNow()); !pulse) return failure(pulse);
    const auto ticket = interlock_.requestArming(clock_.now());
    if (!ticket) return failure(ticket);
    ticket_ = *ticket;
    return {};
}

Result<PulseOutcome> BenchPulse::deliver() {
    // If the unit's past is unknown, nothing is approved before quietUntil().
    while (!stopped_ && record_ && clock_.now() < record_->quietUntil())
        std::this_thread::sleep_for(std::chrono::milliseconds(20));
    if (stopped_) return fail(ErrorCode::Stopped, "stopped: nothing was delivered");
    if (auto confirmed = interlock_.confirmArming(ticket_, clock_.now()); !confirmed) return failure(confirmed);
    PulseOutcome outcome;
    auto check = send(gate_.approveCheck(clock_.now()), true, setup_.source.checkCurrent);
    if (!check) return failure(check);
    outcome.check = *check;
    judge(outcome.check, true, outcome);
    if (outcome.verdict == "pass") {
        if (auto armed = arm(outcome.check); !armed) return failure(armed);
        auto pulse = send(gate_.approve(requestNow()), false, std::get<Milliamps>(order_.pulse.amplitude));
        if (!pulse) return failure(pulse);
        outcome.pulse = *pulse;
        judge(*outcome.pulse, false, outcome);
    }
    interlock_.disarm("the pulse was delivered");
    session_.forceOff();
    return outcome;
}

Result<void> BenchPulse::arm(const PulseFinding& check) {
    const Instant now = clock_.now();
    if (auto updated = gate_.updateImpedance(*check.impedance, now); !updated) return updated;
    ArmingEvidence evidence;
    evidence.limitsLoaded = !setup_.limits.empty();
    evidence.deviceIdentified = !device_.identity().serial.empty();
    evidence.operatorConfirmed = true;
    evidence.readsBack = setup_.source.readsBack;
    evidence.impedance = check.impedance;
    evidence.impedanceLow = expected().low;
    evidence.impedanceHigh = expected().high;
    evidence.impedanceAt = now;
    if (auto armed = interlock_.arm(evidence, now); !armed) return armed;
    return interlock_.beginDelivery();
}

Result<PulseFinding> BenchPulse::send(Result<ApprovedTrain> approved, bool isCheck, Milliamps current) {
    if (!approved) return failure(approved);
    // stop() disarms before it voids approvals, so after an approval was voided the interlock is disarmed here.
    if (!(isCheck ? interlock_.mayCheck() : interlock_.mayDeliver())) {
        return fail(ErrorCode::Stopped, "stopped. Output is off.");
    }
    session_.post(std::move(*approved), clock_.now(), isCheck);
    const TrainReport reported = report();
    // Every return runs the destructor, which switches off; if the device failed, the session has switched off already.
    if (stopped_) return fail(ErrorCode::Stopped, "stopped. Output is off.");
    if (reported.outcome == TrainOutcome::Voided) {
        return fail(ErrorCode::Timeout,
                    "the approval expired before the pulse was written, and it was not sent: the machine is too busy");
    }
    if (reported.outcome != TrainOutcome::Delivered) {
        const bool silent = reported.outcome == TrainOutcome::LoopSilent;
        const auto code = silent ? ErrorCode::Timeout : reported.code;
        interlock_.fault(silent ? FaultCause::LoopSilent : FaultCause::DeviceFault, reported.error.view(), code);
        return fail(code, "{}", reported.error.view());
    }
    const auto judgement = judgeTrain(OutputMode::BenchLoad, readBackOf(reported), reported.end, reported.statusAt);
    const bool isElectrode = judgement.finding == TrainFinding::Open || judgement.finding == TrainFinding::Short;
    if (judgement.stops() && !isElectrode) {
        const auto cause = causeOf(judgement.finding);
        interlock_.fault(cause, judgement.reason.view());
        return fail(codeOf(cause), "{}", judgement.reason.view());
    }
    auto reading = device_.lastReading();
    return PulseFinding{current, reported.electrode, reading.impedance, reading.samples};
}

/// Runs the session until it has an answer; the session limits every wait.
TrainReport BenchPulse::report() {
    constexpr Instant kBeatEvery = std::chrono::milliseconds(5);
    heartbeat_.revive(clock_.elapsed());  // nothing beats between two pulses, so approvals expire
    for (;;) {
        const Instant now = clock_.now();
        if (!heartbeat_.beat(clock_.elapsed())) {
            gate_.latchStop();
            session_.forceOff();
            TrainReport silent;
            silent.outcome = TrainOutcome::LoopSilent;
            silent.onset = silent.statusAt = now;
            silent.error = std::string_view("this program stood still for more than 100 ms");
            return silent;
        }
        const Instant next = session_.serve(now);
        if (const auto made = session_.takeReport()) return *made;
        const Instant left = std::min(next, now + kBeatEvery) - clock_.now();
        if (left.count() > 0) std::this_thread::sleep_for(left);
    }
}

BenchPulse::Expected BenchPulse::expected() const noexcept {
    const auto leading = segmentsOf(order_.pulse, setup_.source.gap).items[0];
    return {effectiveImpedance(setup_.load.min, leading), effectiveImpedance(setup_.load.nominal, leading),
            effectiveImpedance(setup_.load.max, leading)};
}

void BenchPulse::judge(const PulseFinding& finding, bool isCheck, PulseOutcome& into) const {
    const auto what = isCheck ? fmt::format("check pulse of {:g} mA", finding.current.value()) : std::string("pulse");
    const char* consequence = isCheck ? "; the pulse was not sent" : "";
    const auto say = [&](const char* verdict, std::string reason) {
        into.verdict = verdict;
        into.reasons.push_back(std::move(reason) + consequence);
    };
    if (finding.electrode == ElectrodeState::Open) {
        return say("fail", fmt::format("open: the {} found no path for its current", what));
    }
    if (finding.electrode == ElectrodeState::Short) {
        return say("fail", fmt::format("short: the {} found less than {}", what, ohmText(sciencemode::kTouching)));
    }
    if (!finding.impedance) {
        return say("indeterminate", fmt::format("impedance not evaluated: the {} was not read back", what));
    }
    const auto range = expected();
    const double ohm = finding.impedance->value();
    if (ohm >= range.low.value() && ohm <= range.high.value()) {
        into.verdict = "pass";
        return;
    }
    const Ohms digit(sciencemode::kSampleUnit / (finding.current.value() * 1e-3));
    say("fail", fmt::format("mismatch: the {} found {} (one digit of the read-back is {}); {} to {} is accepted for {}",
                            what, ohmText(*finding.impedance), ohmText(digit), ohmText(range.low), ohmText(range.high),
                            order_.load.text()));
}

}  // namespace tacto::cli
