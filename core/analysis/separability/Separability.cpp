#include "core/analysis/separability/Separability.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <tuple>

#include "core/analysis/separability/LinearDiscriminant.h"
#include "core/base/JustNoticeable.h"

namespace tacto {

namespace {

constexpr double kJndNeeded = 5;
constexpr double kLargestVariation = 0.05;
constexpr double kAccuracyNeeded = 0.95;
constexpr std::size_t kMaxFolds = 10;
constexpr double kUnstatedUncertainty = 0.001;  // share of the pooled mean
constexpr std::array<std::string_view, 4> kPaperConditions{"smooth-low", "smooth-high", "rough-low", "rough-high"};

bool isMeasured(const SeparabilityTrial& trial) {
    return !std::isnan(trial.amplitude) && !std::isnan(trial.interval_s);
}

Result<std::vector<std::string>> conditionsOf(std::span<const SeparabilityTrial> trials,
                                              const SeparabilityOptions& options) {
    std::vector<std::string> names = options.conditions;
    for (const auto& trial : trials) {
        if (trial.condition.empty()) return invalid("a trial names no condition");
        if (std::find(names.begin(), names.end(), trial.condition) != names.end()) continue;
        if (!options.conditions.empty()) {
            return invalid("a trial of condition '{}'; {} were expected", trial.condition,
                           fmt::join(options.conditions, ", "));
        }
        names.push_back(trial.condition);
    }
    if (options.conditions.empty()) {
        const auto rank = [](const std::string& name) {
            return std::find(kPaperConditions.begin(), kPaperConditions.end(), name) - kPaperConditions.begin();
        };
        std::stable_sort(names.begin(), names.end(), [&](const auto& a, const auto& b) { return rank(a) < rank(b); });
    }
    if (names.size() < 2) {
        return invalid("{} condition(s); at least two are needed to tell apart", names.size());
    }
    return names;
}

Result<void> checkValues(std::span<const SeparabilityTrial> trials) {
    for (std::size_t i = 0; i < trials.size(); ++i) {
        for (const auto& [name, value] :
             {std::pair{"amplitude", trials[i].amplitude}, std::pair{"interval", trials[i].interval_s}}) {
            if (std::isnan(value)) continue;  // not measured
            if (!(value > 0) || !std::isfinite(value)) {
                return invalid("trial {} ('{}') has {} {}; a finite value above 0 was expected", i + 1,
                               trials[i].condition, name, value);
            }
        }
    }
    return {};
}

double amplitudeUncertaintyOf(const SeparabilityTrial& trial) { return trial.amplitudeUncertainty; }
/// Combines reading and time base; 0 if the reading states no uncertainty.
double intervalUncertaintyOf(const SeparabilityTrial& trial) {
    return trial.intervalUncertainty_s == 0
               ? 0
               : std::hypot(trial.intervalUncertainty_s, trial.timeBase * trial.interval_s);
}

/// Uncertainty without the gain and the time base, which are equal in all trials and cancel in a ratio.
double ownAmplitudeUncertaintyOf(const SeparabilityTrial& trial) {
    const double gain = std::isnan(trial.amplitudeGain) ? 0 : trial.amplitudeGain * trial.amplitude;
    const double rest = trial.amplitudeUncertainty * trial.amplitudeUncertainty - gain * gain;
    return std::sqrt(rest < 0 ? 0 : rest);  // an unknown value stays unknown
}
double ownIntervalUncertaintyOf(const SeparabilityTrial& trial) {
    return std::isnan(trial.timeBase) ? trial.timeBase : trial.intervalUncertainty_s;
}

/// Root mean square of the uncertainties of one condition or of all trials. 0.1 % of the mean over all trials if a
/// trial states none; NaN if one is unknown.
double resolutionOf(std::span<const SeparabilityTrial> trials, double SeparabilityTrial::*value,
                    double (*uncertaintyOf)(const SeparabilityTrial&), const std::string* condition = nullptr) {
    double sum = 0, all = 0, squares = 0, n = 0;
    bool stated = true;
    for (const auto& trial : trials) {
        if (!isMeasured(trial)) continue;
        sum += trial.*value;
        all += 1;
        if (condition != nullptr && trial.condition != *condition) continue;
        const double u = uncertaintyOf(trial);
        stated = stated && u != 0;
        squares += u * u;
        n += 1;
    }
    if (n == 0) return std::numeric_limits<double>::quiet_NaN();
    return stated ? std::sqrt(squares / n) : kUnstatedUncertainty * sum / all;
}

/// Returns a floor even if the uncertainty is unknown (as if not stated), because the discriminant needs a floor.
Eigen::Vector2d classifyingFloor(std::span<const SeparabilityTrial> trials, const Separability& found) {
    const auto none = [](const SeparabilityTrial&) { return 0.0; };
    const auto orElse = [&](double floor, double SeparabilityTrial::*value) {
        return std::isfinite(floor) ? floor : resolutionOf(trials, value, none);
    };
    return {orElse(found.amplitudeFloor, &SeparabilityTrial::amplitude),
            orElse(found.intervalFloor_s, &SeparabilityTrial::interval_s)};
}

struct Points {
    std::vector<LabelledPoint> all;
    std::vector<std::size_t> indexInCondition;  // index of each trial within its condition, in time order
};

Points summariseConditions(std::span<const SeparabilityTrial> trials, const std::vector<std::string>& names,
                           Separability& result) {
    Points points;
    for (std::size_t c = 0; c < names.size(); ++c) {
        ConditionSummary summary;
        summary.name = names[c];
        std::vector<double> amplitudes;
        std::vector<double> intervals;
        for (const auto& trial : trials) {
            if (trial.condition != names[c]) continue;
            if (!isMeasured(trial)) {
                ++summary.notMeasured;
                continue;
            }
            points.all.push_back({{trial.amplitude, trial.interval_s}, c});
            points.indexInCondition.push_back(amplitudes.size());
            amplitudes.push_back(trial.amplitude);
            intervals.push_back(trial.interval_s);
        }
        summary.n = amplitudes.size();
        summary.amplitude = statisticsOf(amplitudes);
        summary.interval_s = statisticsOf(intervals);
        summary.amplitudeVariation = summary.amplitude.sd / summary.amplitude.mean;
        summary.intervalVariation = summary.interval_s.sd / summary.interval_s.mean;
        summary.amplitudeVariationBounds = variationBounds(summary.amplitudeVariation, summary.n);
        summary.intervalVariationBounds = variationBounds(summary.intervalVariation, summary.n);
        result.conditions.push_back(std::move(summary));
    }
    return points;
}

/// Bounds of the distance between two means, in just-noticeable differences.
Bounds jndBounds(const MeanReading& a, const MeanReading& b, double weberFraction) {
    const Bounds distance = logRatioBounds(a, b);
    return {distance.low / std::log1p(weberFraction), distance.high / std::log1p(weberFraction)};
}

void comparePairs(const LinearDiscriminant& discriminant, std::span<const SeparabilityTrial> trials,
                  Separability& result) {
    const bool resolved = std::isfinite(result.amplitudeFloor) && std::isfinite(result.intervalFloor_s);
    const auto amplitudeOf = [&](const ConditionSummary& c) {
        const double u = resolutionOf(trials, &SeparabilityTrial::amplitude, ownAmplitudeUncertaintyOf, &c.name);
        return MeanReading{c.amplitude.mean, c.amplitude.sd, c.n, u};
    };
    const auto intervalOf = [&](const ConditionSummary& c) {
        const double u = resolutionOf(trials, &SeparabilityTrial::interval_s, ownIntervalUncertaintyOf, &c.name);
        return MeanReading{c.interval_s.mean, c.interval_s.sd, c.n, u};
    };
    for (std::size_t a = 0; a < result.conditions.size(); ++a) {
        for (std::size_t b = a + 1; b < result.conditions.size(); ++b) {
            const auto& first = result.conditions[a];
            const auto& second = result.conditions[b];
            result.pairs.push_back(
                {first.name, second.name,
                 resolved ? discriminant.distance(a, b) : std::numeric_limits<double>::quiet_NaN(),
                 justNoticeableDifferences(first.amplitude.mean, second.amplitude.mean, kAmplitudeWeberFraction),
                 justNoticeableDifferences(first.interval_s.mean, second.interval_s.mean, kIntervalWeberFraction),
                 jndBounds(amplitudeOf(first), amplitudeOf(second), kAmplitudeWeberFraction),
                 jndBounds(intervalOf(first), intervalOf(second), kIntervalWeberFraction)});
        }
    }
}

void crossValidate(const Points& points, const Eigen::Vector2d& floor, Separability& result) {
    const std::size_t classes = result.conditions.size();
    result.confusion.assign(classes, std::vector<std::size_t>(classes, 0));
    std::size_t smallest = kMaxFolds;
    for (const auto& condition : result.conditions) smallest = std::min(smallest, condition.n);
    if (smallest < 2) {
        result.accuracy = wilsonInterval(0, 0);
        return;
    }
    result.folds = smallest;
    std::size_t correct = 0;
    std::vector<LabelledPoint> training;
    for (std::size_t fold = 0; fold < result.folds; ++fold) {
        training.clear();
        for (std::size_t i = 0; i < points.all.size(); ++i) {
            if (points.indexInCondition[i] % result.folds != fold) training.push_back(points.all[i]);
        }
        const LinearDiscriminant discriminant(training, classes, floor);
        for (std::size_t i = 0; i < points.all.size(); ++i) {
            if (points.indexInCondition[i] % result.folds != fold) continue;
            const std::size_t classified = discriminant.classify(points.all[i].x);
            ++result.confusion[points.all[i].label][classified];
            if (classified == points.all[i].label) ++correct;
        }
    }
    result.accuracy = wilsonInterval(correct, points.all.size());
}

/// Collects the reasons against a pass. Failures are listed before open points.
struct Judgement {
    std::vector<std::string> failures;
    std::vector<std::string> open;
};

void judgePairs(const Separability& found, Judgement& judgement) {
    for (const auto& pair : found.pairs) {
        const Bounds &amplitude = pair.amplitudeJndBounds, &interval = pair.intervalJndBounds;
        if (amplitude.low >= kJndNeeded || interval.low >= kJndNeeded) continue;
        if (std::isnan(pair.amplitudeJnd) || std::isnan(pair.intervalJnd)) {
            judgement.open.push_back(
                fmt::format("{} and {} cannot be compared: one was not measured.", pair.a, pair.b));
            continue;
        }
        const auto difference =
            fmt::format("{} and {} differ by {:.1f} just-noticeable differences in amplitude and {:.1f} in interval",
                        pair.a, pair.b, pair.amplitudeJnd, pair.intervalJnd);
        if (amplitude.high < kJndNeeded && interval.high < kJndNeeded) {
            judgement.failures.push_back(fmt::format("{}; {} in one of them are needed.", difference, kJndNeeded));
        } else if (std::isnan(amplitude.low) || std::isnan(interval.low)) {
            judgement.open.push_back(fmt::format("{}; how far this is certain is unknown.", difference));
        } else {
            judgement.open.push_back(
                fmt::format("{}, with 95 % confidence by {:.1f} and {:.1f} at least; whether {} in one of them are "
                            "reached is open.",
                            difference, amplitude.low, interval.low, kJndNeeded));
        }
    }
}

void judgeConsistency(const Separability& found, Judgement& judgement) {
    for (const auto& condition : found.conditions) {
        for (const auto& [name, variation, bounds] :
             {std::tuple{"amplitude", condition.amplitudeVariation, condition.amplitudeVariationBounds},
              std::tuple{"interval", condition.intervalVariation, condition.intervalVariationBounds}}) {
            if (bounds.high <= kLargestVariation) continue;
            if (std::isnan(variation)) {
                judgement.open.push_back(fmt::format("The {} of {} was measured {} time(s): its variation is unknown.",
                                                     name, condition.name, condition.n));
            } else if (bounds.low > kLargestVariation) {
                judgement.failures.push_back(fmt::format("The {} of {} varies by {:.1f} %; {:.0f} % is the most.", name,
                                                         condition.name, 100 * variation, 100 * kLargestVariation));
            } else {
                judgement.open.push_back(
                    fmt::format("The {} of {} varies by {:.1f} % in {} trials, which leaves {:.1f} to {:.1f} % open; "
                                "{:.0f} % is the most.",
                                name, condition.name, 100 * variation, condition.n, 100 * bounds.low, 100 * bounds.high,
                                100 * kLargestVariation));
            }
        }
        if (condition.notMeasured > 0) {
            judgement.open.push_back(fmt::format("{} of {} trials of {} were not measured.", condition.notMeasured,
                                                 condition.n + condition.notMeasured, condition.name));
        }
    }
}

void judgeResolution(const Separability& found, Judgement& judgement) {
    const bool measured = std::ranges::any_of(found.conditions, [](const auto& each) { return each.n > 0; });
    for (const auto& [name, floor] : {std::pair{"amplitude", found.amplitudeFloor},
                                      std::pair{"interval, with the time base,", found.intervalFloor_s}}) {
        if (!measured || std::isfinite(floor)) continue;
        judgement.open.push_back(fmt::format(
            "The uncertainty of the {} is unknown: the oscilloscope does not state it. Mahalanobis distances are not "
            "evaluated.",
            name));
    }
}

void judgeAccuracy(const Separability& found, Judgement& judgement) {
    const auto& accuracy = found.accuracy;
    if (accuracy.low >= kAccuracyNeeded) return;
    if (found.folds == 0) {
        judgement.open.push_back("Too few trials to cross-validate: every condition needs at least 2.");
        return;
    }
    auto sentence = fmt::format("Conditions were recognised in {:.1f} % of trials (95 % interval {:.1f} to {:.1f} %)",
                                100 * accuracy.value, 100 * accuracy.low, 100 * accuracy.high);
    if (accuracy.high < kAccuracyNeeded) {
        judgement.failures.push_back(sentence + "; the interval lies below 95 %.");
        return;
    }
    std::size_t trials = 0;
    for (const auto& condition : found.conditions) trials += condition.n;
    const bool tooFew = wilsonInterval(trials, trials).low < kAccuracyNeeded;
    judgement.open.push_back(sentence +
                             (tooFew ? "; fewer than 73 trials cannot show 95 %." : "; its lower end is below 95 %."));
}

}  // namespace

Result<Separability> judgeSeparability(std::span<const SeparabilityTrial> trials, const SeparabilityOptions& options) {
    const auto names = conditionsOf(trials, options);
    if (!names) return failure(names);
    if (auto checked = checkValues(trials); !checked) return failure(checked);

    Separability result;
    const Points points = summariseConditions(trials, *names, result);
    result.amplitudeFloor = resolutionOf(trials, &SeparabilityTrial::amplitude, amplitudeUncertaintyOf);
    result.intervalFloor_s = resolutionOf(trials, &SeparabilityTrial::interval_s, intervalUncertaintyOf);
    const Eigen::Vector2d floor = classifyingFloor(trials, result);
    comparePairs(LinearDiscriminant(points.all, names->size(), floor), trials, result);
    crossValidate(points, floor, result);

    Judgement judgement;
    judgePairs(result, judgement);
    judgeResolution(result, judgement);
    judgeConsistency(result, judgement);
    judgeAccuracy(result, judgement);
    result.verdict = !judgement.failures.empty() ? Verdict::Fail
                     : !judgement.open.empty()   ? Verdict::Indeterminate
                                                 : Verdict::Pass;
    result.reasons = std::move(judgement.failures);
    result.reasons.insert(result.reasons.end(), judgement.open.begin(), judgement.open.end());
    if (result.verdict == Verdict::Pass) {
        result.reasons.push_back(
            fmt::format("With 95 % confidence every pair differs by at least {} just-noticeable differences and every "
                        "condition varies by at most {:.0f} %; conditions were recognised in {:.1f} % of trials (95 % "
                        "interval from {:.1f} %).",
                        kJndNeeded, 100 * kLargestVariation, 100 * result.accuracy.value, 100 * result.accuracy.low));
    }
    return result;
}

}  // namespace tacto
