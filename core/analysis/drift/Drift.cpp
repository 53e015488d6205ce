#include "core/analysis/drift/Drift.h"

#include <Eigen/Dense>
#include <algorithm>
#include <array>
#include <cmath>

#include "core/analysis/statistics/StatisticsJson.h"
#include "core/analysis/statistics/UncertaintyBudget.h"
#include "core/base/Statistics.h"
#include "core/results/ResultRecord.h"

namespace tacto {

namespace {

constexpr std::size_t kQuarters = 4, kPairsOfQuarters = 6;
constexpr double kMaxTolerance_pct = 100;
constexpr double kUnstatedUncertainty = 0.001;  // used if a table states none, as in a separability test

double percentOf(double logRatio) { return 100 * std::expm1(logRatio); }

/// One measured trial: its place in the session from 0 to 1, and the logarithm of the amplitude.
struct Point {
    std::size_t condition = 0, quarter = 0;
    double place = 0, log = 0, resolution = 0;
};

/// Fits log amplitudes by least squares, with a level for each condition and the columns that `row` fills. Fitting
/// deviations from the condition's means removes the levels from the fit (Frisch and Waugh).
class Fit {
public:
    template <class Row>
    Fit(const std::vector<Point>& points, std::size_t conditions, Eigen::Index columns, double floor, Row&& row) {
        const auto n = Eigen::Index(points.size());
        Eigen::MatrixXd all = Eigen::MatrixXd::Zero(n, columns + 1);  // the columns, then the logarithm
        Eigen::MatrixXd means = Eigen::MatrixXd::Zero(Eigen::Index(conditions), columns + 1);
        Eigen::VectorXd counts = Eigen::VectorXd::Zero(Eigen::Index(conditions));
        const auto conditionOf = [&](Eigen::Index i) { return Eigen::Index(points[std::size_t(i)].condition); };
        for (Eigen::Index i = 0; i < n; ++i) {
            row(points[std::size_t(i)], all.row(i));
            all(i, columns) = points[std::size_t(i)].log;
            means.row(conditionOf(i)) += all.row(i);
            counts(conditionOf(i)) += 1;
        }
        for (Eigen::Index i = 0; i < n; ++i) all.row(i) -= means.row(conditionOf(i)) / counts(conditionOf(i));
        const auto measured = (counts.array() > 0).count();
        const auto x = all.leftCols(columns);
        const Eigen::ColPivHouseholderQR<Eigen::MatrixXd> qr(x);
        if (n <= measured + columns || qr.rank() < columns) return;
        found_ = qr.solve(all.col(columns));
        freedom_ = double(n - measured - columns);
        const double scatter = (all.col(columns) - x * found_).squaredNorm() / freedom_;
        covariance_ = std::max(scatter, floor * floor) * (x.transpose() * x).inverse();
    }

    [[nodiscard]] bool known() const { return freedom_ > 0; }
    [[nodiscard]] const Eigen::VectorXd& columns() const { return found_; }

    /// Weighted sum of the columns, in %, with the interval for the largest of `among` such comparisons (Bonferroni).
    [[nodiscard]] Estimate percent(const Eigen::VectorXd& weights, std::size_t among = 1) const {
        const double value = weights.dot(found_);
        const double reach =
            studentQuantile(1 - 0.025 / double(among), freedom_) * std::sqrt(weights.dot(covariance_ * weights));
        return {percentOf(value), percentOf(value - reach), percentOf(value + reach)};
    }

private:
    Eigen::VectorXd found_;
    Eigen::MatrixXd covariance_;
    double freedom_ = 0;
};

/// Relative uncertainty of one reading without the gain's part; NaN: unknown, 0: not stated.
double resolutionOf(const SeparabilityTrial& trial) {
    const double gain = std::isnan(trial.amplitudeGain) ? 0 : trial.amplitudeGain;
    const double relative = trial.amplitudeUncertainty / trial.amplitude;
    const double rest = relative * relative - gain * gain;
    return std::sqrt(rest < 0 ? 0 : rest);
}

Result<std::vector<Point>> sortTrials(std::span<const SeparabilityTrial> trials, Drift& drift) {
    std::vector<Point> points;
    for (std::size_t i = 0; i < trials.size(); ++i) {
        const auto& trial = trials[i];
        if (trial.condition.empty()) return fail(ErrorCode::InvalidArgument, "trial {} names no condition", i + 1);
        auto condition = std::ranges::find(drift.conditions, trial.condition, &Drift::Condition::name);
        if (condition == drift.conditions.end()) {
            drift.conditions.push_back({.name = trial.condition});
            condition = drift.conditions.end() - 1;
        }
        if (std::isnan(trial.amplitude)) {
            ++condition->notMeasured;
            continue;
        }
        if (!(trial.amplitude > 0) || !std::isfinite(trial.amplitude)) {
            return fail(ErrorCode::InvalidArgument,
                        "trial {} ('{}') has amplitude {}; a finite value above 0 was expected", i + 1, trial.condition,
                        trial.amplitude);
        }
        condition->trial.push_back(double(i + 1));
        condition->change.push_back(std::log(trial.amplitude));
        points.push_back({.condition = std::size_t(condition - drift.conditions.begin()),
                          .quarter = kQuarters * i / trials.size(),
                          .place = trials.size() > 1 ? double(i) / double(trials.size() - 1) : 0,
                          .log = std::log(trial.amplitude),
                          .resolution = resolutionOf(trial)});
    }
    return points;
}

Estimate lineOf(const std::vector<Point>& points, std::size_t conditions, double floor) {
    const Fit fit(points, conditions, 1, floor, [](const Point& point, auto row) { row(0) = point.place; });
    return fit.known() ? fit.percent(Eigen::VectorXd::Ones(1)) : Estimate{};
}

void describeConditions(const std::vector<Point>& points, double floor, Drift& drift) {
    for (std::size_t c = 0; c < drift.conditions.size(); ++c) {
        auto& condition = drift.conditions[c];
        condition.n = condition.trial.size();
        std::vector<double> amplitudes;
        for (const double log : condition.change) amplitudes.push_back(std::exp(log));
        condition.amplitude = statisticsOf(amplitudes);
        for (double& value : condition.change) value = percentOf(value - std::log(condition.amplitude.mean));
        std::vector<Point> own;
        for (auto point : points) {
            if (point.condition != c) continue;
            point.condition = 0;
            own.push_back(point);
        }
        condition.change_pct = lineOf(own, 1, floor);
    }
}

/// Compares quarters within conditions, so that an uneven number of strong conditions does not look like drift.
void compareQuarters(const std::vector<Point>& points, double floor, Drift& drift) {
    for (std::size_t q = 0; q < kQuarters && drift.trials >= kQuarters; ++q) {
        const auto first = [&](std::size_t quarter) { return (quarter * drift.trials + kQuarters - 1) / kQuarters; };
        const auto n = std::ranges::count(points, q, &Point::quarter);
        drift.quarters.push_back({first(q) + 1, first(q + 1), std::size_t(n), kNaN});
    }
    const Fit fit(points, drift.conditions.size(), kQuarters - 1, floor, [](const Point& point, auto row) {
        if (point.quarter > 0) row(Eigen::Index(point.quarter) - 1) = 1;
    });
    if (!fit.known()) return;
    std::array<double, kQuarters> level{};
    for (std::size_t q = 1; q < kQuarters; ++q) level[q] = fit.columns()(Eigen::Index(q) - 1);
    const double mean = (level[0] + level[1] + level[2] + level[3]) / kQuarters;
    for (std::size_t q = 0; q < kQuarters; ++q) drift.quarters[q].change_pct = percentOf(level[q] - mean);
    const auto [lowest, highest] = std::ranges::minmax_element(level);
    // Later minus earlier, so that a fall is negative.
    const auto [earlier, later] = std::minmax({lowest - level.begin(), highest - level.begin()});
    Eigen::VectorXd weights = Eigen::VectorXd::Zero(kQuarters - 1);
    if (later > 0) weights(later - 1) += 1;
    if (earlier > 0) weights(earlier - 1) -= 1;
    drift.betweenQuarters_pct = fit.percent(weights, kPairsOfQuarters);
}

void judge(Drift& drift) {
    std::vector<std::string> open;
    auto& failures = drift.reasons;
    const double most = drift.tolerance_pct;
    for (const auto& [what, change] :
         {std::pair{"From the first trial to the last the amplitude changes by", drift.change_pct},
          std::pair{"Between two quarters of the trials the amplitude changes by", drift.betweenQuarters_pct}}) {
        if (std::isnan(change.value)) continue;  // reported below
        const auto sentence = fmt::format("{} {:+.2g} % (95 % interval {:+.2g} to {:+.2g} %); ± {:g} % is accepted",
                                          what, change.value, change.low, change.high, most);
        if (change.low > most || change.high < -most)
            failures.push_back(sentence + ".");
        else if (!(change.low >= -most && change.high <= most))
            open.push_back(sentence + ", and whether that holds is open.");
    }
    std::size_t measured = 0, missing = 0;
    for (const auto& condition : drift.conditions) {
        measured += condition.n;
        missing += condition.notMeasured;
    }
    if (std::isnan(drift.change_pct.value) || std::isnan(drift.betweenQuarters_pct.value)) {
        open.push_back(
            fmt::format("{} measured trials of {} condition(s) are too few, or too unevenly spread, to tell "
                        "a drift; three of each condition in every quarter are enough.",
                        measured, drift.conditions.size()));
    }
    if (missing > 0) open.push_back(fmt::format("{} of {} trials were not measured.", missing, drift.trials));
    if (measured > 0 && std::isnan(drift.floor_pct))
        open.emplace_back("The uncertainty of the amplitude is unknown: the oscilloscope does not state it.");
    drift.verdict = !failures.empty() ? Verdict::Fail : !open.empty() ? Verdict::Indeterminate : Verdict::Pass;
    failures.insert(failures.end(), open.begin(), open.end());
    if (drift.verdict != Verdict::Pass) return;
    drift.reasons.push_back(fmt::format(
        "Over {} trials the amplitude changes by {:+.2g} % (95 % interval {:+.2g} to {:+.2g} %), and between any two "
        "quarters of them by at most {:.2g} %; ± {:g} % is accepted.",
        drift.trials, drift.change_pct.value, drift.change_pct.low, drift.change_pct.high,
        std::max(std::abs(drift.betweenQuarters_pct.low), std::abs(drift.betweenQuarters_pct.high)), most));
}

}  // namespace

Result<Drift> judgeDrift(std::span<const SeparabilityTrial> trials, const DriftOptions& options) {
    if (trials.empty()) return fail(ErrorCode::InvalidArgument, "there are no trials; at least one is expected");
    if (!(options.tolerance_pct > 0 && options.tolerance_pct <= kMaxTolerance_pct)) {
        return fail(ErrorCode::InvalidArgument, "the tolerance is {} %; above 0 to {} % is accepted",
                    options.tolerance_pct, kMaxTolerance_pct);
    }
    Drift drift;
    drift.trials = trials.size();
    drift.tolerance_pct = options.tolerance_pct;
    const auto points = sortTrials(trials, drift);
    if (!points) return failure(points);
    double squares = 0;
    for (const auto& point : *points) squares += point.resolution * point.resolution;
    const double floor = std::max(std::sqrt(squares / double(points->size())), squares == 0 ? kUnstatedUncertainty : 0);
    drift.floor_pct = 100 * floor;
    const double least = std::isnan(floor) ? 0 : floor;
    describeConditions(*points, least, drift);
    drift.change_pct = lineOf(*points, drift.conditions.size(), least);
    compareQuarters(*points, least, drift);
    judge(drift);
    return drift;
}

namespace {

using namespace describe;

ResultColumn change(const char* title, const char* at) { return number(title, at, "%"); }

ResultRecord<Drift::Condition> describeCondition() {
    using C = Drift::Condition;
    ResultRecord<C> all;
    all.shown(text("Condition", "name"), &C::name);
    all.shown(number("n", "n"), &C::n);
    all.shown(number("Amplitude, mean and s.d.", "amplitude_v", "V"), &C::amplitude);
    all.shown(change("First trial to last", "change_pct"), &C::change_pct);
    all.shown(number("Not measured", "not_measured"), &C::notMeasured);
    return all;
}

ResultRecord<Drift::Quarter> describeQuarter() {
    using Q = Drift::Quarter;
    ResultRecord<Q> all;
    all.shown(text("Trials", "trials"),
              [](const Q& quarter) { return fmt::format("{} to {}", quarter.from, quarter.to); });
    all.shown(number("n", "n"), &Q::n);
    all.shown(change("Amplitude", "change_pct"), &Q::change_pct);
    return all;
}

/// Makes the figure for plot.curves().
nlohmann::json curvesOf(const Drift& found) {
    auto curves = nlohmann::json::array();
    for (const auto& each : found.conditions) {
        if (each.n > 0) curves.push_back({{"label", each.name}, {"x", each.trial}, {"y", each.change}});
    }
    const nlohmann::json lines = {{{"label", "accepted, most"}, {"y", found.tolerance_pct}},
                                  {{"label", "accepted, least"}, {"y", -found.tolerance_pct}}};
    return {{"x", {{"label", "Trial"}, {"unit", ""}}},
            {"y", {{"label", "Amplitude, from its mean"}, {"unit", "%"}}},
            {"curves", std::move(curves)},
            {"lines", lines}};
}

ResultRecord<Drift> describeDrift() {
    using D = Drift;
    ResultRecord<D> all;
    all.shown(number("Trials", "trials"), &D::trials);
    all.shown(tolerance("Accepted, ±", "tolerance_pct", "%"), &D::tolerance_pct);
    all.shown(change("First trial to last", "change_pct"), &D::change_pct);
    all.shown(change("Between quarters, largest", "between_quarters_pct"), &D::betweenQuarters_pct);
    all.shown(spread("Instrument's floor", "floor_pct", "%"), &D::floor_pct);
    all.facts("Drift of the amplitude");
    all.rows("Conditions", "conditions", &D::conditions, describeCondition()).note = "Intervals are 95 %.";
    all.rows("Quarters of the trials, against the mean of the four", "quarters", &D::quarters, describeQuarter());
    all.kept("curves", curvesOf);
    all.judged();
    return all;
}

constexpr std::string_view kDrift = "drift";

}  // namespace

nlohmann::json toJson(const Drift& found) {
    auto out = builtOnce<describeDrift>().write(found);
    out["kind"] = kDrift;
    return out;
}

ResultTraits driftKind() {
    return {.name = kDrift,
            .decisionRule =
                "Steady when the 95 % intervals of two changes lie within the tolerance: that of a straight line from "
                "the first trial to the last, and the largest between two quarters of the trials; a fail when one of "
                "them lies beyond it. The tolerance is a choice.",
            .members = builtOnce<describeDrift>().keys(),
            .tables = withBasis(builtOnce<describeDrift>().tables())};
}

}  // namespace tacto
