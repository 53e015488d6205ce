#include "core/bench/delivery/PresentationRun.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "core/bench/ControlLoop.h"

namespace tacto {

void PresentationRun::expect() {
    const std::scoped_lock lock(mutex_);
    result_.reset();
    beganAt_.reset();
}

std::optional<Instant> PresentationRun::beganAt() {
    const std::scoped_lock lock(mutex_);
    return beganAt_;
}

std::optional<Presented> PresentationRun::result() {
    const std::scoped_lock lock(mutex_);
    return std::exchange(result_, std::nullopt);
}

void PresentationRun::begin(Presentation presentation, const TrainPlanner& planner) {
    Timed timed{{}, presentation.interval, {}, toInstant(presentation.duration), presentation.notBefore};
    for (std::size_t train = 0; train < presentation.onsets.size(); ++train) {
        timed.levels.push_back(presentation.levelOf(train));
        timed.onsets.push_back(toInstant(planner.programmed(presentation.onsets[train])));
    }
    made_ = {};
    made_.trains.reserve(timed.onsets.size());
    what_ = std::move(timed);
    began_.reset();
    next_ = awaited_ = 0;
    lost_ = false;
}

PresentationRun::Due PresentationRun::next(const Sight& sight) noexcept {
    endIfHindered(sight);
    // A train or check pulse is still being read, or was just read and is not judged yet.
    if (!active() || !sight.idle || awaited_ > 0) return Due::Nothing;
    if (!began_) {
        if (const Due due = beforeBegin(sight); due != Due::Nothing || !began_) return due;
    }
    while (next_ < what_->onsets.size() && onset() < sight.now + ControlLoop::kPeriod) {
        if (sight.now > onset() + Presented::kLatest) {
            end(sight.now, PresentationEnd::Late,
                fmt::format("train {} is {:.0f} ms late; the limit is {:.0f} ms", next_ + 1,
                            1e3 * toSeconds(sight.now - onset()), 1e3 * toSeconds(Presented::kLatest)));
            return Due::Nothing;
        }
        const bool old = sight.readingUntil && *sight.readingUntil < sight.now;
        if (!isEmpty(what_->levels[next_])) return old ? Due::Check : Due::Train;
        ++next_;
    }
    if (next_ == what_->onsets.size() && sight.now >= *began_ + what_->duration)
        end(sight.now, PresentationEnd::Complete, {});
    return Due::Nothing;
}

void PresentationRun::endIfHindered(const Sight& sight) noexcept {
    if (sight.state == InterlockState::Faulted) return end(sight.now, PresentationEnd::Faulted, sight.reason);
    if (sight.paused) return end(sight.now, PresentationEnd::Paused, "the output was paused");
    if (sight.stopped || (sight.state != InterlockState::Armed && sight.state != InterlockState::Delivering)) {
        return end(sight.now, PresentationEnd::Stopped,
                   sight.reason.empty() ? "stopped" : fmt::format("stopped: {}", sight.reason));
    }
    if (lost_) end(sight.now, PresentationEnd::Late, "a train could not be written before its approval ended");
}

Result<PlannedStimulus> PresentationRun::plan(TrainPlanner& planner, SafetyGate& gate, Instant now) {
    const Instant at = std::max(onset(), now);
    const auto refused = [&](const Error& why) {
        end(now, PresentationEnd::Refused, why.message);
        return tl::unexpected<Error>(why);
    };
    if (const auto* current = std::get_if<Milliamps>(&what_->levels[next_])) {
        auto train = planner.planLevel(*current, what_->interval, at);
        if (!train) return refused(train.error());
        return std::move(*train);
    }
    auto burst = gate.approve(VibrationBurst{.intensity = std::get<VibrationIntensity>(what_->levels[next_]).value});
    if (!burst) return refused(burst.error());
    return PlannedVibration{std::move(*burst), at, what_->interval};
}

/// An empty presentation takes the same steps, so that nothing reveals it.
PresentationRun::Due PresentationRun::beforeBegin(const Sight& sight) noexcept {
    const Instant begin = std::max(what_->notBefore, sight.now + ControlLoop::kPeriod);
    const Instant first = begin + what_->onsets.front();
    // Do not use the first onset here: it may come later than a check takes, and `begin` would recede forever.
    if (sight.now < begin - kCheckAhead) return Due::Nothing;
    if (sight.readingUntil && *sight.readingUntil < first) return Due::Check;
    began_ = begin;
    made_.began = begin;
    const std::scoped_lock lock(mutex_);
    beganAt_ = begin;
    return Due::Nothing;
}

void PresentationRun::read(const TrainReport& report) noexcept {
    if (!active()) return;
    if (!std::isnan(report.impedance_ohm)) made_.impedance = Ohms(report.impedance_ohm);
    // A train still under way from an earlier presentation does not belong to this presentation.
    if (report.isCheck || report.outcome == TrainOutcome::LoopSilent || awaited_ == 0) return;
    --awaited_;
    if (report.outcome == TrainOutcome::Voided) lost_ = true;
    if (report.outcome != TrainOutcome::Delivered) return;
    PresentedTrain train;
    train.onset = report.onset;
    train.approved = what_->levels[next_ - 1];  // no train is posted while another is awaited
    train.interval = what_->interval;
    if (!std::isnan(report.measured)) train.readBack = Milliamps(report.measured);
    if (!std::isnan(report.impedance_ohm)) train.impedance = Ohms(report.impedance_ohm);
    made_.trains.push_back(train);
}

void PresentationRun::end(Instant now, PresentationEnd end, std::string_view reason) noexcept {
    if (!active()) return;
    what_.reset();
    made_.end = end;
    made_.reason = reason;
    made_.ended = now;
    const std::scoped_lock lock(mutex_);
    result_ = std::move(made_);
}

}  // namespace tacto
