#include "core/bench/ControlLoop.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

namespace tacto {

namespace {

constexpr Instant kUnrecorded = std::chrono::seconds(2);
constexpr Instant kSlept = std::chrono::seconds(1);  // a shorter sleep is treated as a silence of the loop

bool mayPutOut(InterlockState state) noexcept {
    return state == InterlockState::Checking || state == InterlockState::Armed || state == InterlockState::Delivering ||
           state == InterlockState::Paused;
}

const SourceTraits& sourceOf(const StimulatorSession* stimulator) noexcept {
    static const SourceTraits kNone;
    return stimulator != nullptr ? stimulator->device().traits() : kNone;
}

}  // namespace

ControlLoop::ControlLoop(Parts parts, std::unique_ptr<FingerInput> finger, std::unique_ptr<TrainPlanner> planner)
    : parts_(std::move(parts)),
      order_(parts_.stops),
      exposure_(parts_.gate),
      planner_(std::move(planner)),
      arming_(parts_.gate, parts_.interlock, load_),
      judge_(parts_.mode, parts_.gate, parts_.interlock, load_, sourceOf(parts_.stimulator)),
      journal_(parts_.recorder, parts_.frameStream, parts_.sensorStreams, parts_.boardStream),
      taps_(parts_.tap),
      finger_(std::move(finger), parts_.sensorReport, journal_, taps_),
      reading_(parts_.stimulator, load_, judge_),
      dispatch_({parts_.gate, parts_.interlock, order_, arming_, load_, judge_, journal_, exposure_, parts_.stimulator,
                 parts_.massager, latest_}) {}

void ControlLoop::arm(ArmCommand command) {
    arming_.expect();
    inbox_.arm(std::move(command));
}

void ControlLoop::present(Presentation presentation) {
    presentation_.expect();
    pausedSince_.store(dispatch_.paused(), std::memory_order_release);
    inbox_.present(std::move(presentation));
}

/// Runs first in a step: a train approved before a silence must not be written after it, whichever thread wakes first.
void ControlLoop::beat(Instant now) noexcept {
    const bool inTime = parts_.heartbeat.beat(parts_.clock.elapsed());
    const Instant asleep = parts_.clock.asleep();
    const Instant slept = asleep - asleepSeen_;
    if (slept > kSlept)
        wakeFromSleep(now, slept);
    else if (!inTime)
        wakeFromSilence(now);
    else
        return;
    asleepSeen_ = asleep;
    parts_.heartbeat.revive(parts_.clock.elapsed());
}

void ControlLoop::wakeFromSilence(Instant now) noexcept {
    if (mayPutOut(parts_.interlock.state()))
        return trip(FaultCause::LoopSilent, "the control loop was silent for more than 100 ms", now);
    parts_.gate.latchStop();
    dispatch_.forceOff();
}

void ControlLoop::wakeFromSleep(Instant now, Instant slept) noexcept {
    std::array<char, 80> why{};
    fmt::format_to_n(why.data(), why.size() - 1, "the computer slept for {:.0f} s", toSeconds(slept));
    endOrder(now, "sleep", why.data());
}

/// Ends the output unless its owner still looks after it and the session is still being recorded.
void ControlLoop::watchOwner(Instant now) noexcept {
    if (!mayPutOut(parts_.interlock.state())) return;
    if ((drive_.source != DriveSource::Off || presentation_.active()) && !order_.attended(now))
        return endOrder(now, "unattended", "the program that ordered the output did not look after it for 2 s");
    if (journal_.standsStillFor() > kUnrecorded)
        endOrder(now, "unrecorded", "the disk stood still for 2 s, and nothing is put out that is not recorded");
}

/// Ends the present order as a stop does.
void ControlLoop::endOrder(Instant now, const char* kind, std::string_view why) noexcept {
    order_.end(why);
    parts_.interlock.disarm(FixedText<159>(why).c_str());
    parts_.gate.latchStop();
    dispatch_.forceOff();
    drive_ = {};
    journal_.orderEnded(now, kind, why);
}

void ControlLoop::beginOrder() noexcept {
    exposure_.beginOrder();
    order_.begin();
}

void ControlLoop::step(Instant now) noexcept {
    beat(now);
    takeCommands(now);
    watchOwner(now);
    noteState(now);
    finger_.read(now, shown_);
    trip(finger_.failure(), now);
    finger_.noteLosses(now);
    judgeReports();
    watchMassager(now);
    if (arming_.checkDue()) postCheckOfArming(now);
    arming_.armOnCapture(now);
    trip(reading_.silence(now), now);
    updateCommand(now);
    levels_.serve(parts_.gate);
    if (presentation_.active())
        goOnPresenting(now);
    else
        sendDue(now);
    if (dispatch_.takeBegan()) seenState_ = InterlockState::Delivering;
    publish(now);
}

void ControlLoop::takeCommands(Instant now) noexcept {
    auto taken = inbox_.take();
    if (!taken) return;
    if (taken->finger) finger_.replace(std::move(*taken->finger));
    if (taken->planner) planner_ = std::move(taken->planner);
    if (taken->drive) {
        drive_ = *taken->drive;
        journal_.drive(now, drive_);
    }
    if (taken->arm) {
        judge_.forgetMeasured();
        presentation_.end(now, PresentationEnd::Stopped, "the output was armed again");
        order_.armFor(taken->arm->asked);
        arming_.begin(std::move(*taken->arm));
        planner_->wantNothing();
    }
    if (taken->presentation) presentation_.begin(std::move(*taken->presentation), *planner_);
    if (taken->confirmed) arming_.confirm(std::move(*taken->confirmed));
    if (taken->load && parts_.stimulator != nullptr)
        trip(judge_.load(*taken->load, dispatch_.mayPost(false), now), now);
    for (const auto& seen : {taken->amplitude, taken->unasked})
        if (seen && parts_.stimulator != nullptr) trip(judge_.amplitude(*seen), now);
}

void ControlLoop::noteState(Instant now) noexcept {
    const auto state = parts_.interlock.state();
    if (state != InterlockState::Disarmed && state != InterlockState::Disconnected) load_.leftAt = now + kPeriod;
    if (state == InterlockState::Faulted) {                      // a later cause may be graver
        shown_.causesCame = parts_.interlock.causesCame().news;  // read first: `fault` covers all that this counts
        if (const auto cause = parts_.interlock.cause()) shown_.fault = cause;
    }
    // What leaves such a fault is the safety check, which is a stimulator's.
    shown_.grave = parts_.stimulator != nullptr ? parts_.interlock.grave() : std::nullopt;
    if (state == seenState_) return;
    const auto before = std::exchange(seenState_, state);
    const bool wasConnected = before != InterlockState::Disconnected;
    const auto reason = parts_.interlock.reason();
    shown_.reason = FixedText<200>(reason.view());
    shown_.fault = parts_.interlock.cause();
    if (state != InterlockState::Delivering || before == InterlockState::Paused)
        journal_.interlock(now, state, reason.view());
    if (wasConnected && (state == InterlockState::Disarmed || state == InterlockState::Faulted)) {
        if (arming_.active()) {
            arming_.finish(fail(state == InterlockState::Faulted ? parts_.interlock.faultCode() : ErrorCode::Stopped,
                                "arming ended: {}", reason.empty() ? nameOf(state) : reason.view()));
        }
        load_.impedance.reset();
        drive_ = {};
        planner_->wantNothing();
    }
}

void ControlLoop::postCheckOfArming(Instant now) noexcept {
    if (parts_.interlock.state() != InterlockState::Checking) {
        return arming_.finish(fail(ErrorCode::Stopped, "arming ended: {}", nameOf(parts_.interlock.state())));
    }
    if (order_.stopped()) return arming_.stop();
    if (parts_.stimulator != nullptr && !parts_.stimulator->idle()) return;  // an earlier train is still being read
    auto check = arming_.checkPulse(now, parts_.stimulator != nullptr);
    if (!check) return;
    if (!dispatch_.mayPost(true)) return arming_.stop();
    dispatch_.postCheck(std::move(*check), now, shown_);
}

void ControlLoop::judgeReports() noexcept {
    if (parts_.stimulator != nullptr) {
        while (const auto report = parts_.stimulator->takeReport()) {
            if (hear(*report)) judge(*report);
        }
    } else if (parts_.massager != nullptr) {
        while (const auto report = parts_.massager->takeReport()) {
            if (hear(*report)) judgeBurst(*report);
        }
    }
}

bool ControlLoop::hear(const TrainReport& report) noexcept {
    taps_.push(report);
    presentation_.read(report);
    if (report.outcome != TrainOutcome::LoopSilent) return true;
    if (dispatch_.mayPost(false)) trip(FaultCause::LoopSilent, report.error.view(), report.statusAt);
    return false;
}

void ControlLoop::judge(const TrainReport& report) noexcept {
    const Instant now = report.statusAt;
    dispatch_.reported(report, shown_);
    if (report.outcome == TrainOutcome::Voided) {
        journal_.train(report, "voided");
        if (arming_.active() && report.isCheck) {
            arming_.refuse("the impedance check was voided",
                           {ErrorCode::Stopped, "arming ended: the impedance check was voided by a stop"});
        }
        return;
    }
    const bool failed = report.outcome == TrainOutcome::Failed;
    journal_.train(report, failed ? "failed" : report.isCheck ? "impedance check" : "delivered");
    if (failed) return trip(FaultCause::DeviceFault, report.error.view(), now, report.code);
    if (report.isCheck && arming_.active()) return judgeCheck(report);

    if (!report.isCheck) {
        ++shown_.trainsDelivered;
        shown_.trainAmplitude = report.amplitude;
    }
    shown_.imbalance = report.imbalance;
    shown_.imbalanceUncertainty = report.imbalanceUncertainty;
    trip(judge_.delivered(report, dispatch_.mayPost(report.isCheck)), now);
}

void ControlLoop::judgeCheck(const TrainReport& report) noexcept {
    if (const auto judgement = judge_.status(report); judgement.stops()) {
        return arming_.refuse(judgement.reason.c_str(),
                              {ErrorCode::NotArmed, fmt::format("not armed: {}", judgement.reason.view())});
    }
    // The cause of an earlier, reset fault may still be there: then the check pulse shows it, and nothing is armed.
    if (const auto fault = judge_.readBack(report)) return trip(fault, report.statusAt);
    arming_.checkRead(report);
}

void ControlLoop::judgeBurst(const TrainReport& report) noexcept {
    const bool delivered = report.outcome == TrainOutcome::Delivered;
    journal_.burst(report, delivered ? "delivered" : report.outcome == TrainOutcome::Failed ? "failed" : "voided");
    if (report.outcome == TrainOutcome::Failed) {
        return trip(FaultCause::DeviceFault, report.error.view(), report.statusAt, report.code);
    }
    if (!delivered) return;
    ++shown_.trainsDelivered;
    shown_.intensity = report.amplitude;
    rests_.burst(report.onset, report.end);
}

/// Does nothing while the fingertip drives: the motion that it feels then begins and ends with the bursts.
void ControlLoop::watchMassager(Instant now) noexcept {
    const auto* finger = finger_.input();
    if (parts_.massager == nullptr || finger == nullptr) return;
    if (drive_.source == DriveSource::Sensor) return rests_.forget();
    const auto streams = finger->session().device().streams();
    for (std::size_t s = 0; s < streams.size(); ++s) {
        if (streams[s].kind == StreamKind::Acceleration) rests_.feed(finger->blocks()[s], streams[s].channels);
    }
    if (!(rests_.goesOnAt() > 0) || parts_.interlock.causePersists(FaultCause::StuckOn)) return;
    std::array<char, 120> why{};
    fmt::format_to_n(why.data(), why.size() - 1,
                     "the massager goes on after its bursts: the accelerometer feels {:.3g} m/s2 r.m.s. at rest",
                     rests_.goesOnAt());
    rests_.forget();
    trip(FaultCause::StuckOn, why.data(), now);
}

void ControlLoop::updateCommand(Instant now) noexcept {
    const auto state = parts_.interlock.state();
    const bool permitted = state == InterlockState::Armed || state == InterlockState::Delivering;
    if (!permitted || dispatch_.paused() || drive_.source == DriveSource::Off) {
        planner_->wantNothing();
        return;
    }
    if (drive_.source == DriveSource::Manual) {
        shown_.roughness = drive_.roughness;
        shown_.pressure = drive_.pressure;
        if (const auto wanted = planner_->want(drive_.roughness, drive_.pressure, now); !wanted) {
            refused(now, wanted.error().message);
        }
        return;
    }
    const auto* finger = finger_.input();
    if (shown_.finger != FingerStanding::Fresh) {
        if (!staleSeen_ && planner_->command()) {
            ++shown_.trainsSkipped;
            journal_.sensorStale(now, shown_.sensorAge_s);
        }
        staleSeen_ = true;
        planner_->wantNothing();
        return;
    }
    staleSeen_ = false;
    if (finger->boardDrives()) return followBoard(now);
    const auto& frame = finger->latest();
    if (!frame.contact || std::isnan(frame.R)) {
        planner_->wantNothing();
        return;
    }
    finger_.noteFlags(now);
    const auto pressure = std::isnan(frame.P) ? std::nullopt : std::optional(frame.P);
    if (const auto wanted = planner_->want(frame.R, pressure, now); !wanted) {
        refused(now, wanted.error().message);
    }
}

/// The board says what is played and when, and the bench whether: each of its trains goes to the gate once, on time, or
/// not at all.
void ControlLoop::followBoard(Instant now) noexcept {
    const auto lateBy = [&](double onset_s) { return toSeconds(now) - onset_s; };
    const auto skip = [&](double late_s) {
        ++shown_.trainsSkipped;
        journal_.boardTrainSkipped(now, late_s);
        planner_->wantNothing();
    };
    finger_.noteFlags(now);
    const auto& encoded = finger_.input()->encoded();
    for (const auto& train : encoded.trains) {
        if (const auto waiting = planner_->due()) skip(lateBy(toSeconds(*waiting - kBoardDelay)));
        const double late_s = lateBy(train.onset_s);
        if (!(std::abs(late_s) <= toSeconds(kBoardLate))) {
            skip(late_s);
            continue;
        }
        const Instant due = toInstant(Seconds(train.onset_s)) + kBoardDelay;
        planner_->want(train, due);
        const double interval_s = train.interval.count();
        boardUntil_ = due + kBoardLate + toInstant(interval_s > 0 && interval_s < 60 ? interval_s : 0);
    }
    const auto due = planner_->due();
    const bool silent = !encoded.silences.empty() && !shown_.boardSilent.empty();
    if (due && (silent || *due < now - kBoardLate))
        skip(lateBy(toSeconds(*due - kBoardDelay)));
    else if (silent || (!due && now > boardUntil_))
        planner_->wantNothing();
}

RoughnessFlags ControlLoop::flags() noexcept {
    if (auto next = inbox_.takeFinger()) finger_.replace(std::move(*next));
    return finger_.flags();
}

void ControlLoop::sendDue(Instant now) noexcept {
    if (!dispatch_.isDue(*planner_, now, kPeriod)) return;
    if (parts_.massager == nullptr && reading_.isOld(now)) return renewReading(now);
    const auto sent = parts_.massager != nullptr ? dispatch_.sendBurst(*planner_, now, shown_)
                                                 : dispatch_.sendTrain(*planner_, now, shown_);
    if (!sent) refused(now, sent.error().message);
}

/// Sends one check pulse; the train follows once that pulse was judged.
void ControlLoop::renewReading(Instant now) noexcept {
    if (const auto sent = dispatch_.sendCheck(now, shown_); !sent)
        trip(FaultCause::LimitBroken, sent.error().message, now);
}

void ControlLoop::goOnPresenting(Instant now) noexcept {
    const auto reason = parts_.interlock.reason();
    const bool paused = pausedSince_.load(std::memory_order_acquire) || dispatch_.paused();
    const auto due = presentation_.next(
        {now, parts_.interlock.state(), reason.view(), order_.stopped(), paused, dispatch_.idle(), reading_.until()});
    if (due == PresentationRun::Due::Check) return renewReading(now);
    // Also done before an empty presentation: what the bench shows must not reveal which presentations are empty.
    if (!presentation_.begun() || !dispatch_.beginDelivery()) return;  // the next turn finds the reason
    if (due != PresentationRun::Due::Train) return;
    if (const auto sent = dispatch_.sendPresented(presentation_, *planner_, now, shown_); !sent)
        refused(now, sent.error().message);
}

void ControlLoop::refused(Instant now, std::string_view why) noexcept {
    ++shown_.trainsRefused;
    shown_.lastRefusal = why;
    latest_.write(shown_);  // written first, so that a caller who sees the count finds the reason
    refusals_.store(shown_.trainsRefused, std::memory_order_release);
    journal_.refused(now, why);
}

void ControlLoop::trip(FaultCause cause, std::string_view reason, Instant now) noexcept {
    trip(cause, reason, now, codeOf(cause));
}

void ControlLoop::trip(FaultCause cause, std::string_view reason, Instant now, ErrorCode code) noexcept {
    parts_.gate.latchStop();
    dispatch_.forceOff();
    parts_.interlock.fault(cause, reason, code);  // after switching off, because this saves to a disk that may be slow
    faults_.fetch_add(1, std::memory_order_acq_rel);
    journal_.fault(now, reason);
    noteState(now);
}

/// Notes the deviation once, each time the output leaves the stated accuracy of the source.
void ControlLoop::noteMeasured(Instant now) noexcept {
    const bool before = shown_.measured.beyond;
    shown_.measured = judge_.measured();
    if (shown_.measured.beyond && !before) journal_.measuredBeyond(now, shown_.measured, judge_.unit());
}

void ControlLoop::publish(Instant now) noexcept {
    shown_.at = now;
    shown_.state = parts_.interlock.state();
    shown_.paused = dispatch_.paused();
    shown_.driving = drive_.source;
    const auto& command = planner_->command();
    shown_.amplitude_v = command ? command->amplitude.value() : NAN;
    shown_.interval_s = command ? command->interval.count() : NAN;
    const auto due = planner_->due();
    shown_.nextTrain_s = due ? toSeconds(*due) : NAN;
    shown_.impedance_ohm = load_.impedance ? load_.impedance->value() : NAN;
    shown_.impedanceAge_s = load_.impedance ? toSeconds(now - load_.impedanceAt) : NAN;
    ++shown_.steps;
    noteMeasured(now);
    exposure_.look(now, shown_.measured);
    latest_.write(shown_);
}

Telemetry ControlLoop::telemetry() const noexcept {
    Telemetry all{latest_.read(), {}, 0};  // the exposure table is read afterwards, so it is never older than the step
    exposure_.show(all);
    return all;
}

}  // namespace tacto
