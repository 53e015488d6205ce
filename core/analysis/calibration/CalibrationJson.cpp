#include "core/analysis/calibration/CalibrationJson.h"

#include <cmath>

#include "core/analysis/statistics/StatisticsJson.h"

namespace tacto {

using nlohmann::json;

json toJson(const Calibration& found) {
    json levels = json::array();
    for (const auto& level : found.levels) {
        levels.push_back({{"commanded", level.commanded},
                          {"n", level.n},
                          {"not_measured", level.notMeasured},
                          {"mean", numberOrNull(level.mean)},
                          {"mean_up", numberOrNull(level.meanUp)},
                          {"mean_down", numberOrNull(level.meanDown)},
                          {"s", numberOrNull(level.s)},
                          {"residual", numberOrNull(level.residual)}});
    }
    json readings = json::array();
    for (const auto& r : found.readings) {
        readings.push_back({{"commanded", r.commanded},
                            {"measured", numberOrNull(r.measured)},
                            {"direction", nameOf(r.direction)},
                            {"outlier", r.outlier}});
    }
    return {{"gain", found.gain},
            {"offset", found.offset},
            {"gain_standard_error", numberOrNull(found.gainStandardError)},
            {"offset_standard_error", numberOrNull(found.offsetStandardError)},
            {"weighted", found.weighted},
            {"full_scale", found.fullScale},
            {"residual_max_pct_fs", numberOrNull(found.residualMax_pct)},
            {"repeatability_pct_fs", numberOrNull(found.repeatability_pct)},
            {"hysteresis_pct_fs", numberOrNull(found.hysteresis_pct)},
            {"n", found.readings.size() - found.notMeasured},
            {"not_measured", found.notMeasured},
            {"outliers", found.outliers},
            {"complete", found.complete},
            {"levels", levels},
            {"readings", readings},
            {"warnings", found.warnings}};
}

json toJson(const UncertaintyBudget& budget) {
    json rows = json::array();
    for (const auto& row : budget.rows) {
        rows.push_back({{"name", row.name},
                        {"distribution", nameOf(row.distribution)},
                        {"value", numberOrNull(row.value)},
                        {"divisor", row.divisor},
                        {"sensitivity", row.sensitivity},
                        {"contribution", numberOrNull(row.contribution())},
                        {"degrees_of_freedom", numberOrNull(row.degreesOfFreedom)}});
    }
    return {{"rows", rows},
            {"combined", numberOrNull(budget.combined)},
            {"degrees_of_freedom", numberOrNull(budget.degreesOfFreedom)},
            {"coverage_factor", numberOrNull(budget.coverageFactor)},
            {"expanded_uncertainty", numberOrNull(budget.expanded)},
            {"method", nameOf(budget.method)}};
}

json toJson(const JudgedCalibration& judged) {
    json out = toJson(judged.calibration);
    for (std::size_t k = 0; k < judged.levels.size(); ++k) {
        const auto& level = judged.levels[k];
        auto& row = out["levels"][k];
        row["error"] = numberOrNull(level.error);
        row["worst_error"] = numberOrNull(level.worstError);
        row["expanded_uncertainty"] = numberOrNull(level.budget.expanded);
        row["worst_expanded_uncertainty"] = numberOrNull(level.worstBudget.expanded);
        row["worst_coverage_factor"] = numberOrNull(level.worstBudget.coverageFactor);
        row["tolerance"] = level.tolerance;
        row["verdict"] = nameOf(level.verdict);
    }
    const auto& top = judged.fullScale().budget;
    out["expanded_uncertainty"] = numberOrNull(top.expanded);
    out["gain_expanded_uncertainty"] = numberOrNull(judged.gain.expanded);
    out["gain_coverage_factor"] = numberOrNull(judged.gain.coverageFactor);
    out["offset_expanded_uncertainty"] = numberOrNull(judged.offset.expanded);
    out["offset_coverage_factor"] = numberOrNull(judged.offset.coverageFactor);
    out["budget"] = toJson(top);
    out["budget_smallest"] = toJson(judged.smallest().budget);
    out["tolerance_pct"] = judged.tolerance_pct;
    out["verdict"] = nameOf(judged.verdict);
    out["reasons"] = judged.reasons;
    return out;
}

}  // namespace tacto
