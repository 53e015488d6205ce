#include "core/analysis/transitions/CapturedChange.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>

#include "core/base/JustNoticeable.h"

namespace tacto {

namespace {

constexpr double kCoverageFactor = 2;

/// Relative scatter of the trains with one command: the uncertainty that a capture leaves in a ratio of two amplitudes.
double scatterOf(std::span<const CapturedChange> changes) {
    double squares = 0, freedom = 0;
    for (const auto& change : changes) {
        std::vector<double> same;
        for (const double one : change.before_v) {
            if (!std::isnan(one)) same.push_back(one);
        }
        if (same.size() < 2) continue;
        const Statistics s = statisticsOf(same);
        const double freedomOfOne = static_cast<double>(same.size()) - 1;
        squares += freedomOfOne * (s.sd / s.mean) * (s.sd / s.mean);
        freedom += freedomOfOne;
    }
    return freedom > 0 ? std::sqrt(squares / freedom) : kNaN;
}

void takeStep(LargestStep& axis, double jnd, double from, double to) {
    if (std::isnan(jnd)) {
        ++axis.unmeasured;
    } else if (!(jnd <= axis.jnd)) {
        axis.jnd = jnd;
        axis.from = from;
        axis.to = to;
    }
}

double largerOrUnknown(double a, double b) { return std::isnan(a) || std::isnan(b) ? kNaN : std::max(a, b); }

/// Relative standard uncertainty of the step from `before_v` to a train, from both levels. The previous level is
/// assumed to have the same uncertainty in volts.
double statedOf(const CapturedTrain& train, double before_v) {
    return train.amplitudeUncertainty_v * std::hypot(1 / train.amplitude_v, 1 / before_v);
}

/// Expanded uncertainty of the step from `before_s` to the interval that ends with train `k`. The time stamp between
/// the two intervals is common to both: an error lengthens one and shortens the other. Uses the largest uncertainty of
/// the three time stamps.
double intervalUncertainty_jnd(const std::vector<CapturedTrain>& trains, std::size_t k, double before_s) {
    double stamp_s = 0;
    for (std::size_t i = k < 2 ? 0 : k - 2; i <= k; ++i)
        stamp_s = largerOrUnknown(stamp_s, trains[i].onsetUncertainty_s);
    const double now = 1 / trains[k].interval_s, before = std::isnan(before_s) ? now : 1 / before_s;
    const double all = std::hypot(now, before, now + before);
    return kCoverageFactor * all * stamp_s / std::log1p(kIntervalWeberFraction);
}

void addTrains(ChangeGroup& group, const CapturedChange& change) {
    double last_v = kNaN, last_s = kNaN;
    if (!change.before_v.empty() && !std::isnan(change.before_v.back())) {
        last_v = change.before_v.back();
        last_s = change.from_s;
    }
    const bool movement = change.kind == ChangeKind::Movement;
    for (std::size_t k = 0; k < change.trains.size(); ++k) {
        const auto& train = change.trains[k];
        ++group.captured;
        // The first train of a movement has no earlier train for comparison.
        if (!movement || k >= 1) {
            const bool isFirst = std::isnan(group.amplitude.jnd);
            takeStep(group.amplitude, train.amplitude_jnd, last_v, train.amplitude_v);
            if (!std::isnan(train.amplitude_jnd)) {
                double& widest = group.amplitude.uncertainty;
                widest = isFirst ? statedOf(train, last_v) : largerOrUnknown(widest, statedOf(train, last_v));
            }
        }
        if (!movement || k >= 2) {
            const bool isFirst = std::isnan(group.interval.jnd);
            takeStep(group.interval, train.interval_jnd, last_s, train.interval_s);
            if (!std::isnan(train.interval_jnd)) {
                const double u = intervalUncertainty_jnd(change.trains, k, last_s);
                double& widest = group.interval.uncertainty;
                widest = isFirst ? u : largerOrUnknown(widest, u);
            }
        }
        last_v = train.amplitude_v;
        last_s = train.interval_s;
    }
}

void addChange(ChangeGroup& group, const CapturedChange& change, const ChangeLimits& limits) {
    ++group.changes;
    addTrains(group, change);
    if (change.kind == ChangeKind::Movement) {
        group.completes = false;
        return;
    }
    group.from_v = change.from_v;
    group.to_v = change.to_v;
    group.from_s = change.from_s;
    group.to_s = change.to_s;
    const StepCourse &measured = change.measured, &fastest = change.fastest;
    if (std::isfinite(measured.complete_s)) group.complete_s.push_back(measured.complete_s);
    if (std::isfinite(fastest.complete_s)) group.fastest_s.push_back(fastest.complete_s);
    if (std::isfinite(measured.trains)) group.trains.push_back(measured.trains);
    if (std::isfinite(fastest.trains)) group.fewest.push_back(fastest.trains);
    if (measured.complete_s <= limits.complete_s || std::isnan(measured.complete_s)) return;
    if (limits.secondsAlone || !(fastest.complete_s > limits.complete_s)) {
        ++group.late;
        return;
    }
    ++group.outOfReach;
    if (!(measured.trains <= fastest.trains)) ++group.tooMany;
}

/// Sentences with the reasons against a pass.
struct Findings {
    std::vector<std::string> failures, open, notes;
    [[nodiscard]] Verdict verdict() const {
        return !failures.empty() ? Verdict::Fail : !open.empty() ? Verdict::Indeterminate : Verdict::Pass;
    }
};

void judgeAxis(const ChangeGroup& group, const LargestStep& axis, const char* name, const char* unit,
               const ChangeLimits& limits, Findings& findings) {
    const auto step = [&] {
        return fmt::format("{}: {} goes from {:.3g} to {:.3g} {} in one train, {:.2f} just-noticeable differences",
                           group.name, name, axis.from, axis.to, unit, axis.jnd);
    };
    if (axis.unmeasured > 0) {
        findings.open.push_back(fmt::format("{}: {} of {} steps of {} were not measured", group.name, axis.unmeasured,
                                            group.captured, name));
    }
    if (std::isnan(axis.jnd)) {
        if (axis.unmeasured == 0)
            findings.open.push_back(fmt::format("{}: no step of {} was captured", group.name, name));
    } else if (std::isnan(axis.uncertainty)) {
        findings.open.push_back(fmt::format("{}; its uncertainty is unknown", step()));
    } else if (axis.jnd - axis.uncertainty > limits.perTrain_jnd) {
        findings.failures.push_back(fmt::format("{}; at most {:g} are wanted", step(), limits.perTrain_jnd));
    } else if (!(axis.jnd + axis.uncertainty <= limits.perTrain_jnd)) {
        findings.open.push_back(fmt::format("{} ± {:.2f}; whether at most {:g}, as wanted, is open", step(),
                                            axis.uncertainty, limits.perTrain_jnd));
    }
}

std::string endsOf(const ChangeGroup& group) {
    std::string ends;
    if (group.from_v != group.to_v) ends += fmt::format("{:.3g} to {:.3g} V", group.from_v, group.to_v);
    if (group.from_s != group.to_s) {
        ends += fmt::format("{}{:.3g} to {:.3g} s", ends.empty() ? "" : ", ", group.from_s, group.to_s);
    } else {
        ends += fmt::format(" at one train every {:.3g} s", group.from_s);
    }
    return ends;
}

void judgeCompletion(const ChangeGroup& group, const ChangeLimits& limits, Findings& findings) {
    if (!group.completes) return;
    const Statistics complete = statisticsOf(group.complete_s), fastest = statisticsOf(group.fastest_s);
    const Statistics trains = statisticsOf(group.trains), fewest = statisticsOf(group.fewest);
    if (group.complete_s.size() < group.changes) {
        findings.open.push_back(fmt::format("{}: {} of {} changes were not seen to be complete", group.name,
                                            group.changes - group.complete_s.size(), group.changes));
    }
    if (group.late > 0) {
        findings.failures.push_back(
            fmt::format("{}: {} of {} changes were complete later than {:g} s, after {:.2f} s at most", group.name,
                        group.late, group.changes, limits.complete_s, complete.max));
    }
    if (group.tooMany > 0) {
        findings.failures.push_back(
            fmt::format("{}: {} of {} changes took more trains, {:.0f} at most, than steps of {:g} differences need, "
                        "{:.0f}",
                        group.name, group.tooMany, group.changes, trains.max, limits.perTrain_jnd, fewest.max));
    }
    if (group.outOfReach > 0) {
        findings.notes.push_back(fmt::format(
            "{}, {}: complete after {:.2f} to {:.2f} s. {:g} s are out of reach: in steps of at most {:g} differences "
            "it takes {:.0f} trains and {:.2f} s at least; this one took {:.0f} trains",
            group.name, endsOf(group), complete.min, complete.max, limits.complete_s, limits.perTrain_jnd, fewest.max,
            fastest.min, trains.max));
    }
}

void append(std::vector<std::string>& to, const std::vector<std::string>& more) {
    to.insert(to.end(), more.begin(), more.end());
}

}  // namespace

ChangeJudgement judgeChanges(std::span<const CapturedChange> changes, const std::vector<std::string>& names,
                             const ChangeLimits& limits) {
    ChangeJudgement out{.limits = limits, .groups = groupsOf<ChangeGroup>(names)};
    for (const auto& change : changes) addChange(groupNamed(out.groups, change.name), change, limits);
    const double scatter = std::sqrt(2.0) * scatterOf(changes);
    Findings all;
    for (auto& group : out.groups) {
        double& step = group.amplitude.uncertainty;
        step = kCoverageFactor * std::hypot(scatter, step) / std::log1p(kAmplitudeWeberFraction);
        Findings own;
        if (group.changes == 0) {
            own.open.push_back(fmt::format("{}: no change was captured", group.name));
        } else {
            judgeAxis(group, group.amplitude, "the amplitude", "V", limits, own);
            judgeAxis(group, group.interval, "the interval", "s", limits, own);
            judgeCompletion(group, limits, own);
        }
        group.verdict = own.verdict();
        append(all.failures, own.failures);
        append(all.open, own.open);
        append(all.notes, own.notes);
    }
    if (out.groups.empty()) all.open.emplace_back("no change was captured");
    out.verdict = all.verdict();
    out.reasons = std::move(all.failures);
    append(out.reasons, all.open);
    out.notes = std::move(all.notes);
    return out;
}

namespace {

/// All steps with the same name, measured or not.
struct MeasuredSteps {
    std::string name;
    std::vector<double> latency_s, designed_s, error_s, trains, designedTrains;
    std::size_t steps = 0;
    std::size_t slow = 0;  // steps that took more trains than designed
};

void addStep(MeasuredSteps& group, const CapturedChange& step) {
    ++group.steps;
    const StepCourse &measured = step.measured, &designed = step.designed;
    if (std::isfinite(designed.latency_s)) group.designed_s.push_back(designed.latency_s);
    if (std::isfinite(measured.latency_s) && std::isfinite(designed.latency_s)) {
        group.latency_s.push_back(measured.latency_s);
        // A difference within the range expected of a measurement is zero.
        const double low = step.designedFirst.latency_s, high = step.designedLast.latency_s;
        const bool ranged = low <= designed.latency_s && designed.latency_s <= high;
        group.error_s.push_back(measured.latency_s -
                                (ranged ? std::clamp(measured.latency_s, low, high) : designed.latency_s));
    }
    if (std::isfinite(measured.trains)) group.trains.push_back(measured.trains);
    if (std::isfinite(designed.trains)) group.designedTrains.push_back(designed.trains);
    if (measured.trains > std::fmax(designed.trains, step.designedLast.trains)) ++group.slow;
}

Verdict judgeSteps(const MeasuredSteps& group, double tolerance_s, std::vector<std::string>& reasons) {
    const Statistics error = statisticsOf(group.error_s);
    const double worst = std::max(std::abs(error.min), std::abs(error.max));
    if (group.error_s.empty() || group.error_s.size() < group.steps || group.trains.size() < group.steps) {
        const std::size_t missing = group.steps - std::min(group.error_s.size(), group.trains.size());
        reasons.push_back(fmt::format("{}: {} of {} steps were not measured", group.name, missing, group.steps));
    }
    if (!group.error_s.empty() && worst > tolerance_s) {
        reasons.push_back(
            fmt::format("{}: a train carried the step {:.4f} s off the design; at most {:.4f} s are accepted",
                        group.name, worst, tolerance_s));
        return Verdict::Fail;
    }
    if (group.slow > 0) {
        reasons.push_back(fmt::format(
            "{}: {} of {} steps took more trains, {:.0f} at most, than the design says, {:.0f}", group.name, group.slow,
            group.steps, statisticsOf(group.trains).max, statisticsOf(group.designedTrains).max));
        return Verdict::Fail;
    }
    const bool whole = group.steps > 0 && group.error_s.size() == group.steps && group.trains.size() == group.steps;
    return whole ? Verdict::Pass : Verdict::Indeterminate;
}

}  // namespace

LatencyJudgement judgeLatency(std::span<const CapturedChange> steps, const std::vector<std::string>& names,
                              double tolerance_s) {
    auto groups = groupsOf<MeasuredSteps>(names);
    for (const auto& step : steps) addStep(groupNamed(groups, step.name), step);
    LatencyJudgement out;
    out.tolerance_s = tolerance_s;
    out.verdict = groups.empty() ? Verdict::Indeterminate : Verdict::Pass;
    for (const auto& group : groups) {
        const Verdict verdict = judgeSteps(group, tolerance_s, out.reasons);
        out.verdict = worseOf(out.verdict, verdict);
        out.groups.push_back({group.name, group.steps, statisticsOf(group.latency_s), statisticsOf(group.designed_s),
                              statisticsOf(group.error_s), statisticsOf(group.trains),
                              statisticsOf(group.designedTrains), verdict});
    }
    if (groups.empty()) out.reasons.emplace_back("no step was measured");
    return out;
}

}  // namespace tacto
