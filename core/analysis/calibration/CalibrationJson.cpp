#include "core/analysis/calibration/CalibrationJson.h"

#include <cmath>
#include <limits>

#include "core/analysis/statistics/StatisticsJson.h"
#include "core/base/Csv.h"
#include "core/base/Statistics.h"
#include "core/base/Text.h"

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

namespace {

/// A finite number, or NaN where `mayLack` and the field is empty or says nan.
Result<double> numberIn(const NamedRows& rows, std::size_t index, std::string_view column, bool mayLack, double least) {
    const auto field = rows[index];
    if (field.empty() && mayLack) return kNaN;
    const auto number = parseNumber(field);
    if (number && ((std::isfinite(*number) && *number >= least) || (std::isnan(*number) && mayLack))) return *number;
    return rows.refuse("{} '{}'; a finite number{} was expected{}", column, field.substr(0, 40),
                       std::isfinite(least) ? " of 0 or more" : "", mayLack ? ", or nothing" : "");
}

Result<SweepDirection> directionIn(const NamedRows& rows, std::size_t index) {
    const auto field = rows[index];
    if (const auto known = valueFor(kSweepDirections, field)) return *known;
    return rows.refuse("direction '{}'; up, down or nothing was expected", field.substr(0, 40));
}

}  // namespace

Result<std::vector<CalibrationReading>> readCalibrationReadings(const std::filesystem::path& path) {
    const auto text = readTextFile(path);
    if (!text) return failure(text);
    return parseCalibrationReadings(*text, path.string());
}

Result<std::vector<CalibrationReading>> parseCalibrationReadings(std::string_view text, std::string_view name) {
    constexpr double kAny = -std::numeric_limits<double>::infinity();
    NamedRows rows(text, name, "columns commanded and measured, and perhaps direction and u, were expected",
                   "a row per reading");
    const auto commanded = rows.column({"commanded"});
    if (!commanded) return failure(commanded);
    const auto measured = rows.column({"measured"});
    if (!measured) return failure(measured);
    const auto direction = rows.find({"direction"});
    const auto uncertainty = rows.find({"u"});

    std::vector<CalibrationReading> readings;
    auto more = rows.next();
    for (; more && *more; more = rows.next()) {
        CalibrationReading reading;
        const auto command = numberIn(rows, *commanded, "commanded", false, kAny);
        if (!command) return failure(command);
        reading.commanded = *command;
        const auto value = numberIn(rows, *measured, "measured", true, kAny);
        if (!value) return failure(value);
        reading.measured = *value;
        if (direction) {
            const auto turned = directionIn(rows, *direction);
            if (!turned) return failure(turned);
            reading.direction = *turned;
        }
        if (uncertainty) {
            const auto u = numberIn(rows, *uncertainty, "u", true, 0);
            if (!u) return failure(u);
            reading.uncertainty = *u;
        }
        readings.push_back(reading);
    }
    if (!more) return failure(more);
    return readings;
}

}  // namespace tacto
