#include "core/analysis/calibration/CalibrationVerdict.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <optional>

#include "core/base/QuantityText.h"

namespace tacto {

namespace {

constexpr double kHalfWidth = 1.7320508075688772;   // √3
constexpr double kResolution = 3.4641016151377544;  // √12
constexpr double kTwoEdges = 2.449489742783178;     // √6
constexpr double kTwoStamps = 1.224744871391589;    // √(3/2)
constexpr double kInfinite = std::numeric_limits<double>::infinity();

/// Adds the rows that do not depend on the number of readings. `value` is the measured value.
void addInstrument(std::vector<Contribution>& rows, const InstrumentErrors& errors, double value) {
    rows.push_back({"instrument gain", Distribution::Rectangular, errors.gainTolerance, kHalfWidth, value, kInfinite});
    const auto add = [&rows](const char* name, double halfWidth, double divisor, double sensitivity) {
        if (halfWidth == 0) return;  // zero was stated explicitly
        rows.push_back({name, Distribution::Rectangular, halfWidth, divisor, sensitivity, kInfinite});
    };
    add("probe or shunt", errors.probeTolerance, kHalfWidth, value);
    add("instrument linearity", errors.linearityTolerance, kHalfWidth, 1);
    add("instrument offset", errors.offsetTolerance, kHalfWidth, 1);
    add("resolution", errors.resolution, kResolution, 1);
    if (errors.offsetTolerance == 0) add("resolution of the baseline", errors.resolution, kResolution, 1);
    add("time stamps", errors.stampTolerance, kTwoStamps, 1);
    add("load", errors.loadTolerance, kHalfWidth, errors.loadSensitivity * value);
}

/// Makes the budget for the mean of `n` readings of a level.
Result<UncertaintyBudget> levelBudget(const CalibrationLevel& level, std::size_t n, const Calibration& found,
                                      const InstrumentErrors& errors, const BudgetOptions& options) {
    // A level read once per direction takes its scatter from the other levels.
    const bool own = level.degreesOfFreedom > 0;
    const double s = own ? level.s : found.repeatability;
    if (std::isnan(s)) {
        return fail(ErrorCode::InvalidArgument,
                    "calibration: level {} was not repeated, nor was any other; at least two readings of a level and "
                    "direction are needed for an uncertainty",
                    level.commanded);
    }
    std::vector<Contribution> rows{{"repeatability", Distribution::Student, s, std::sqrt(static_cast<double>(n)), 1,
                                    own ? level.degreesOfFreedom : found.degreesOfFreedom}};
    addInstrument(rows, errors, level.mean);
    if (const double sampling = errors.samplingStep / kTwoEdges; s < 0.5 * sampling) {
        rows.push_back({"sampling", Distribution::Normal, errors.samplingStep, kTwoEdges, 1, kInfinite});
    }
    return combine(std::move(rows), options);
}

/// Weights of the level means in the fitted gain and offset.
struct LineWeights {
    std::vector<double> gain, offset;
};

LineWeights lineWeights(const Calibration& found) {
    const auto& levels = found.levels;
    std::vector<double> trust(levels.size(), 0);
    for (std::size_t k = 0; k < levels.size() && !found.weighted; ++k) trust[k] = static_cast<double>(levels[k].n);
    for (const auto& reading : found.readings) {
        if (!found.weighted || std::isnan(reading.measured)) continue;
        const auto distance = [&](const CalibrationLevel& level) {
            return std::abs(level.commanded - reading.commanded);
        };
        const auto nearest = std::ranges::min_element(levels, {}, distance) - levels.begin();
        trust[static_cast<std::size_t>(nearest)] += 1 / (reading.uncertainty * reading.uncertainty);
    }
    double sum = 0, mean = 0, squares = 0;
    for (std::size_t k = 0; k < levels.size(); ++k) {
        sum += trust[k];
        mean += trust[k] * levels[k].commanded;
    }
    mean /= sum;
    for (std::size_t k = 0; k < levels.size(); ++k)
        squares += trust[k] * (levels[k].commanded - mean) * (levels[k].commanded - mean);
    LineWeights out;
    for (std::size_t k = 0; k < levels.size(); ++k) {
        out.gain.push_back(trust[k] * (levels[k].commanded - mean) / squares);
        out.offset.push_back(trust[k] / sum - mean * out.gain.back());
    }
    return out;
}

/// Standard deviation of the level means about the line if clearly larger than their scatter explains (F above 2.25;
/// scatter alone exceeds this in 2 of 100 calibrations); otherwise nothing.
std::optional<Contribution> departures(const Calibration& found, double sensitivity) {
    double squares = 0, readings = 0, levels = 0;
    for (const auto& level : found.levels) {
        if (level.n == 0) continue;
        squares += level.residual * level.residual;
        readings += static_cast<double>(level.n);
        ++levels;
    }
    if (!(levels > 2) || std::isnan(found.repeatability)) return std::nullopt;
    const double s = std::sqrt(squares / (levels - 2));
    if (!(s > 1.5 * found.repeatability / std::sqrt(readings / levels))) return std::nullopt;
    return Contribution{"departures of the levels from the line", Distribution::Student, s, 1, sensitivity, levels - 2};
}

/// Makes the budget of the line's gain or offset from errors shared by the levels and errors of single levels. `value`:
/// the gain or offset. `weights`: the weight of each level in it.
Result<UncertaintyBudget> lineBudget(const JudgedCalibration& judged, const InstrumentErrors& errors, const char* name,
                                     double standardError, double value, const std::vector<double>& weights,
                                     const BudgetOptions& options) {
    const auto& found = judged.calibration;
    // The cubic that is 0 at 0 and at both ends, with a maximum of 1.
    const double end = std::isnan(errors.fullScale) ? found.fullScale : std::max(errors.fullScale, found.fullScale);
    double shared = 0, squares = 0, bend = 0, straight = 0;
    for (std::size_t k = 0; k < weights.size(); ++k) {
        const double x = found.levels[k].commanded / end;
        shared += weights[k];
        squares += weights[k] * weights[k];
        straight += weights[k] * x;
        bend += weights[k] * 1.5 * std::sqrt(3.0) * x * (1 - x * x);
    }
    const double single = std::sqrt(squares);
    std::vector<Contribution> rows;
    if (auto apart = departures(found, single)) {
        rows.push_back(std::move(*apart));
    } else {
        rows.push_back({name, Distribution::Student, standardError, 1, 1, std::max(1.0, found.degreesOfFreedom)});
        if (errors.samplingStep > 0 && found.repeatability < 0.5 * errors.samplingStep / kTwoEdges)
            rows.push_back({"sampling", Distribution::Normal, errors.samplingStep, kTwoEdges, single, kInfinite});
    }
    InstrumentErrors here = errors;
    here.resolution = here.linearityTolerance = here.offsetTolerance = here.stampTolerance = 0;
    addInstrument(rows, here, value);
    const auto add = [&rows](const char* what, double tolerance, double divisor, double sensitivity) {
        if (tolerance == 0) return;
        rows.push_back({what, Distribution::Rectangular, tolerance, divisor, sensitivity, kInfinite});
    };
    // The weights of the gain sum to 0 apart from rounding, so an error common to all levels does not change the gain.
    const double common = std::round(shared);
    add("instrument linearity", errors.linearityTolerance, kHalfWidth, std::max(std::abs(bend), std::abs(straight)));
    if (common == 0) return combine(std::move(rows), options);
    add("instrument offset", errors.offsetTolerance, kHalfWidth, common);
    if (errors.offsetTolerance == 0) add("resolution of the baseline", errors.resolution, kResolution, common);
    return combine(std::move(rows), options);
}

Result<void> judgeLine(JudgedCalibration& judged, const InstrumentErrors& errors, const BudgetOptions& options) {
    const auto& found = judged.calibration;
    const auto weights = lineWeights(found);
    auto gain =
        lineBudget(judged, errors, "fit of the gain", found.gainStandardError, found.gain, weights.gain, options);
    if (!gain) return failure(gain);
    auto offset = lineBudget(judged, errors, "fit of the offset", found.offsetStandardError, found.offset,
                             weights.offset, options);
    if (!offset) return failure(offset);
    judged.gain = std::move(*gain);
    judged.offset = std::move(*offset);
    return {};
}

double worstErrorOf(const CalibrationLevel& level) {
    double worst = level.mean - level.commanded;
    for (const double mean : {level.meanUp, level.meanDown}) {
        if (std::abs(mean - level.commanded) > std::abs(worst)) worst = mean - level.commanded;
    }
    return worst;
}

void decide(JudgedCalibration& judged, const std::string& unitOfReadings) {
    const auto& found = judged.calibration;
    const auto& unit = unitOfReadings;
    const auto used = [](const JudgedLevel& level) {
        return (std::abs(level.worstError) + level.worstBudget.expanded) / level.tolerance;
    };
    const auto at = [&](const JudgedLevel& level) {
        const auto where = fmt::format("{} ({}, tolerance ± {})", exactText(level.commanded, unit),
                                       measuredText(level.worstError, level.worstBudget.expanded, unit),
                                       exactText(level.tolerance, unit));
        return std::isfinite(used(level))
                   ? fmt::format("uses {} of its tolerance at {}", scaledText(100 * used(level), "%", 2), where)
                   : "error at " + where;
    };
    judged.verdict = Verdict::Pass;
    for (const auto& level : judged.levels) judged.verdict = worseOf(judged.verdict, level.verdict);
    const bool unknown = std::any_of(judged.levels.begin(), judged.levels.end(), [](const auto& level) {
        return !level.worstBudget.rows.empty() && std::isnan(level.worstBudget.expanded);
    });
    if (unknown) {
        std::string lacking;
        for (const auto& row : judged.fullScale().worstBudget.rows) {
            if (std::isnan(row.value)) lacking += (lacking.empty() ? "" : ", ") + row.name;
        }
        judged.reasons.push_back(
            fmt::format("not evaluated: the instrument does not state its part of the uncertainty ({})", lacking));
    }
    for (const auto& level : judged.levels) {
        if (unknown || judged.verdict == Verdict::Pass || level.verdict != judged.verdict) continue;
        judged.reasons.push_back(at(level));
    }
    if (judged.verdict == Verdict::Pass) {
        const auto tightest = std::max_element(judged.levels.begin(), judged.levels.end(),
                                               [&](const auto& a, const auto& b) { return used(a) < used(b); });
        judged.reasons.push_back(at(*tightest));
    }
    if (!found.complete && judged.verdict == Verdict::Pass) judged.verdict = Verdict::Indeterminate;
    judged.reasons.insert(judged.reasons.end(), found.warnings.begin(), found.warnings.end());
}

}  // namespace

const JudgedLevel& JudgedCalibration::fullScale() const noexcept {
    return *std::max_element(levels.begin(), levels.end(), [](const auto& a, const auto& b) {
        return std::abs(a.commanded) < std::abs(b.commanded);
    });
}

const JudgedLevel& JudgedCalibration::smallest() const noexcept {
    return *std::min_element(levels.begin(), levels.end(), [](const auto& a, const auto& b) {
        return std::abs(a.commanded) < std::abs(b.commanded);
    });
}

Result<JudgedCalibration> judgeCalibration(Calibration calibration, const InstrumentErrors& errors,
                                           double tolerance_pct, const BudgetOptions& options) {
    if (!(tolerance_pct > 0) || !std::isfinite(tolerance_pct)) {
        return fail(ErrorCode::InvalidArgument, "calibration tolerance {} %; above 0 was expected", tolerance_pct);
    }
    JudgedCalibration judged;
    judged.calibration = std::move(calibration);
    judged.tolerance_pct = tolerance_pct;
    for (const auto& level : judged.calibration.levels) {
        if (level.n == 0) {
            JudgedLevel unknown;
            unknown.commanded = level.commanded;
            unknown.error = unknown.worstError = unknown.budget.expanded = unknown.worstBudget.expanded = kNaN;
            unknown.tolerance = tolerance_pct / 100 * std::abs(level.commanded);
            judged.levels.push_back(std::move(unknown));
            continue;
        }
        auto budget = levelBudget(level, level.n, judged.calibration, errors, options);
        if (!budget) return failure(budget);
        const bool bothWays = std::isfinite(level.meanUp) && std::isfinite(level.meanDown);
        auto worst =
            bothWays ? levelBudget(level, std::max<std::size_t>(1, level.n / 2), judged.calibration, errors, options)
                     : budget;
        if (!worst) return failure(worst);
        JudgedLevel out;
        out.commanded = level.commanded;
        out.error = level.mean - level.commanded;
        out.worstError = worstErrorOf(level);
        out.budget = std::move(*budget);
        out.worstBudget = std::move(*worst);
        out.tolerance = tolerance_pct / 100 * std::abs(level.commanded);
        out.verdict = guardBanded(out.worstError, out.worstBudget.expanded, out.tolerance);
        judged.levels.push_back(std::move(out));
    }
    if (auto line = judgeLine(judged, errors, options); !line) return failure(line);
    decide(judged, errors.unit);
    return judged;
}

Verdict verdictAt(const JudgedCalibration& judged, double tolerance_pct) noexcept {
    Verdict verdict = judged.calibration.complete ? Verdict::Pass : Verdict::Indeterminate;
    for (const auto& level : judged.levels) {
        verdict = worseOf(verdict, guardBanded(level.worstError, level.worstBudget.expanded,
                                               tolerance_pct / 100 * std::abs(level.commanded)));
    }
    return verdict;
}

}  // namespace tacto
