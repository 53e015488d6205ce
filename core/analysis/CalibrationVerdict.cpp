#include "core/analysis/CalibrationVerdict.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>

namespace tacto {

namespace {

constexpr double kHalfWidth = 1.7320508075688772;   // √3
constexpr double kResolution = 3.4641016151377544;  // √12
constexpr double kTwoEdges = 2.449489742783178;     // √6
constexpr double kInfinite = std::numeric_limits<double>::infinity();

/// Rows that do not depend on how often was read. `value` is the reading's size.
void addInstrument(std::vector<Contribution>& rows, const InstrumentErrors& errors, double value) {
    rows.push_back({"instrument gain", Distribution::Rectangular, errors.gainTolerance, kHalfWidth, value, kInfinite});
    if (errors.offsetTolerance > 0) {
        rows.push_back(
            {"instrument offset", Distribution::Rectangular, errors.offsetTolerance, kHalfWidth, 1, kInfinite});
    }
    if (errors.resolution > 0) {
        rows.push_back({"resolution", Distribution::Rectangular, errors.resolution, kResolution, 1, kInfinite});
    }
    if (errors.loadTolerance > 0) {
        rows.push_back({"load", Distribution::Rectangular, errors.loadTolerance, kHalfWidth,
                        errors.loadSensitivity * value, kInfinite});
    }
}

Result<UncertaintyBudget> levelBudget(const CalibrationLevel& level, const Calibration& found,
                                      const InstrumentErrors& errors, const BudgetOptions& options) {
    // A level that was read once per direction knows its scatter from the others only.
    const bool own = level.degreesOfFreedom > 0;
    const double s = own ? level.s : found.repeatability;
    if (std::isnan(s)) {
        return fail(ErrorCode::InvalidArgument,
                    "calibration: level {} was not repeated, nor was any other; at least two readings of a level and "
                    "direction are needed for an uncertainty",
                    level.commanded);
    }
    std::vector<Contribution> rows{{"repeatability", Distribution::Student, s, std::sqrt(static_cast<double>(level.n)),
                                    1, own ? level.degreesOfFreedom : found.degreesOfFreedom}};
    addInstrument(rows, errors, level.mean);
    if (const double sampling = errors.samplingStep / kTwoEdges; s < 0.5 * sampling) {
        rows.push_back({"sampling", Distribution::Normal, errors.samplingStep, kTwoEdges, 1, kInfinite});
    }
    return combine(std::move(rows), options);
}

/// The line's two numbers: the instrument's gain error scales both, its offset shifts the offset alone.
Result<void> judgeLine(JudgedCalibration& judged, const InstrumentErrors& errors, const BudgetOptions& options) {
    const auto& found = judged.calibration;
    const auto line = [&](const char* name, double standardError, double value, double offsetTolerance) {
        std::vector<Contribution> rows{
            {name, Distribution::Student, standardError, 1, 1, std::max(1.0, found.degreesOfFreedom)}};
        InstrumentErrors here = errors;
        here.offsetTolerance = offsetTolerance;
        here.resolution = 0;  // averaged over the levels: below anything else
        addInstrument(rows, here, value);
        return combine(std::move(rows), options);
    };
    auto gain = line("fit of the gain", found.gainStandardError, found.gain, 0);
    if (!gain) return failure(gain);
    auto offset = line("fit of the offset", found.offsetStandardError, found.offset, errors.offsetTolerance);
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
    const std::string unit = unitOfReadings.empty() ? "" : " " + unitOfReadings;
    judged.verdict = Verdict::Pass;
    for (const auto& level : judged.levels) judged.verdict = worseOf(judged.verdict, level.verdict);
    for (const auto& level : judged.levels) {
        if (judged.verdict == Verdict::Pass || level.verdict != judged.verdict) continue;
        judged.reasons.push_back(fmt::format("at {:.6g}{} the error is {:+.4g} ± {:.2g}{} and the tolerance ± {:.4g}{}",
                                             level.commanded, unit, level.worstError, level.budget.expanded, unit,
                                             level.tolerance, unit));
    }
    if (judged.verdict == Verdict::Pass) {
        const auto used = [](const JudgedLevel& level) {
            return (std::abs(level.worstError) + level.budget.expanded) / level.tolerance;
        };
        const auto tightest = std::max_element(judged.levels.begin(), judged.levels.end(),
                                               [&](const auto& a, const auto& b) { return used(a) < used(b); });
        judged.reasons.push_back(fmt::format(
            "nowhere nearer to the tolerance than at {:.6g}{}: error {:+.2g} ± {:.2g}{}, tolerance ± {:.4g}{}",
            tightest->commanded, unit, tightest->worstError, tightest->budget.expanded, unit, tightest->tolerance,
            unit));
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
            unknown.error = unknown.worstError = unknown.budget.expanded = std::numeric_limits<double>::quiet_NaN();
            unknown.tolerance = tolerance_pct / 100 * std::abs(level.commanded);
            judged.levels.push_back(std::move(unknown));
            continue;
        }
        auto budget = levelBudget(level, judged.calibration, errors, options);
        if (!budget) return failure(budget);
        JudgedLevel out;
        out.commanded = level.commanded;
        out.error = level.mean - level.commanded;
        out.worstError = worstErrorOf(level);
        out.budget = std::move(*budget);
        out.tolerance = tolerance_pct / 100 * std::abs(level.commanded);
        out.verdict = guardBanded(out.worstError, out.budget.expanded, out.tolerance);
        judged.levels.push_back(std::move(out));
    }
    if (auto line = judgeLine(judged, errors, options); !line) return failure(line);
    decide(judged, errors.unit);
    return judged;
}

Verdict verdictAt(const JudgedCalibration& judged, double tolerance_pct) noexcept {
    Verdict verdict = judged.calibration.complete ? Verdict::Pass : Verdict::Indeterminate;
    for (const auto& level : judged.levels) {
        verdict = worseOf(verdict, guardBanded(level.worstError, level.budget.expanded,
                                               tolerance_pct / 100 * std::abs(level.commanded)));
    }
    return verdict;
}

}  // namespace tacto
