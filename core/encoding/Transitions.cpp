#include "core/encoding/Transitions.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/base/JustNoticeable.h"
#include "core/encoding/TrainSeries.h"

namespace tacto {

namespace {

/// Time step of the control loop, at which the pending train can move.
constexpr Instant kStep = std::chrono::milliseconds(1);

/// A finger that moves through the plane, and the trains sent meanwhile.
class Walk {
public:
    explicit Walk(const EncodingProfile& profile) : profile_(profile) {}

    /// Starts at a point with a train that was felt there long enough to serve as the previous train.
    void rest(double R, double P) {
        series_.emplace(profile_);
        last_ = *series_->encoder().encode(R, P);
        way_ = {R, R, P, P};
        started_ = now_;
        series_->want(last_, now_);
        static_cast<void>(series_->begin(now_));
        series_->delivered();
    }

    /// Makes one control step at (R, P). If a train is sent, its step is passed to `found`.
    void step(double R, double P, const auto& found) {
        now_ += kStep;
        way_ = {std::min(way_.lowR, R), std::max(way_.highR, R), std::min(way_.lowP, P), std::max(way_.highP, P)};
        series_->want(*series_->encoder().encode(R, P), now_);
        if (*series_->due() > now_) return;
        static_cast<void>(series_->begin(now_));
        series_->delivered();
        const Command next = *series_->last();
        found(TransitionStep{R, P, way_, last_, next, amplitudeDistance(last_.amplitude, next.amplitude),
                             intervalDistance(last_.interval, next.interval)});
        last_ = next;
        way_ = {R, R, P, P};
    }

    [[nodiscard]] Instant elapsed() const noexcept { return now_ - started_; }

private:
    const EncodingProfile& profile_;
    std::optional<TrainSeries> series_;
    Instant now_{0};
    Instant started_{0};
    Command last_;
    PlaneExtent way_;  // part covered since the last train
};

/// Wait after a jump, in longest intervals; many, because slew limits prolong the jump.
constexpr int kTrainsAfterJump = 50;

}  // namespace

double amplitudeDistance(Volts a, Volts b) noexcept {
    return justNoticeableDifferences(a.value(), b.value(), kAmplitudeWeberFraction);
}
double intervalDistance(Seconds a, Seconds b) noexcept {
    return justNoticeableDifferences(a.count(), b.count(), kIntervalWeberFraction);
}

Result<TransitionReport> sweepTransitions(const EncodingProfile& profile, const TransitionSweep& sweep) {
    if (auto valid = validate(profile); !valid) return failure(valid);
    if (sweep.lines < 2 || sweep.lines > 1000) {
        return invalid("{} lines are not 2 to 1000", sweep.lines);
    }
    const double traverse = sweep.traverse.count();
    if (!(traverse >= 0.1 && traverse <= 600)) {
        return invalid("a traverse of {} s is outside 0.1 to 600 s", traverse);
    }
    TransitionReport report;
    const auto keepLargest = [](LargestSteps& largest, const TransitionStep& step) {
        if (step.amplitude > largest.amplitude.amplitude) largest.amplitude = step;
        if (step.interval > largest.interval.interval) largest.interval = step;
    };
    Walk walk(profile);
    for (const bool alongR : {true, false}) {
        for (int line = 0; line < sweep.lines; ++line) {
            const double fixed = static_cast<double>(line) / (sweep.lines - 1);
            walk.rest(alongR ? 0 : fixed, alongR ? fixed : 0);
            while (toSeconds(walk.elapsed()) < 2 * traverse) {
                const double phase = toSeconds(walk.elapsed() + kStep) / traverse;
                const double moving = std::clamp(phase <= 1 ? phase : 2 - phase, 0.0, 1.0);
                walk.step(alongR ? moving : fixed, alongR ? fixed : moving, [&](const TransitionStep& step) {
                    report.steps.push_back(step);
                    keepLargest(report.gradual, step);
                });
            }
        }
    }
    for (const double fromR : {0.0, 1.0}) {
        for (const double fromP : {0.0, 1.0}) {
            for (const double toR : {0.0, 1.0}) {
                for (const double toP : {0.0, 1.0}) {
                    walk.rest(fromR, fromP);
                    const Instant end = toInstant(profile.intervalMax * kTrainsAfterJump);
                    while (walk.elapsed() < end) {
                        walk.step(toR, toP, [&](const TransitionStep& step) { keepLargest(report.abrupt, step); });
                    }
                }
            }
        }
    }
    return report;
}

Result<TransitionMap> mapOf(const std::vector<TransitionStep>& steps, int cells) {
    if (cells < 2 || cells > 101) return invalid("{} cells are not 2 to 101", cells);
    const auto n = static_cast<std::size_t>(cells);
    const std::vector<std::vector<double>> nothing(n, std::vector<double>(n, std::numeric_limits<double>::quiet_NaN()));
    TransitionMap map{nothing, nothing};
    const auto cellOf = [cells](double x) {
        return static_cast<std::size_t>(std::lround(std::clamp(x, 0.0, 1.0) * (cells - 1)));
    };
    for (const auto& step : steps) {
        for (std::size_t p = cellOf(step.way.lowP); p <= cellOf(step.way.highP); ++p) {
            for (std::size_t r = cellOf(step.way.lowR); r <= cellOf(step.way.highR); ++r) {
                map.amplitude[p][r] = std::fmax(map.amplitude[p][r], step.amplitude);  // fmax ignores NaN
                map.interval[p][r] = std::fmax(map.interval[p][r], step.interval);
            }
        }
    }
    return map;
}

}  // namespace tacto
