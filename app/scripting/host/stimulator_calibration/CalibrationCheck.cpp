// Checks whether a stored calibration still holds: compares its line with levels that were read again.
#include <cmath>
#include <utility>

#include "app/scripting/host/report/Cells.h"
#include "app/scripting/host/stimulator_calibration/StimulatorLevels.h"
#include "core/analysis/statistics/StatisticsJson.h"
#include "core/analysis/statistics/Verdict.h"
#include "core/base/QuantityText.h"
#include "core/base/Statistics.h"
#include "core/encoding/StimulatorCalibration.h"

namespace tacto::host::stimulator_calibration {

namespace {

struct LevelMean {
    double value = kNaN, expanded = kNaN;
    std::string direction;
};

/// Returns the mean furthest from the line: of all readings of the level, of those going up, or of those going down.
LevelMean furthest(const Json& level, double expected) {
    LevelMean out{numberOr(level, "mean"), numberOr(level, "expanded_uncertainty"), {}};
    for (const auto& [key, direction] : {std::pair("mean_up", "up"), std::pair("mean_down", "down")}) {
        const double mean = numberOr(level, key);
        if (std::abs(mean - expected) > std::abs(out.value - expected))
            out = {mean, numberOr(level, "worst_expanded_uncertainty"), direction};
    }
    return out;
}

std::string notHeld(const Json& row) {
    const auto unit = textOr(row, "unit");
    const auto direction = textOr(row, "direction");
    return fmt::format("{}: at {} the stored calibration expects {}, and {} was measured{}; ± {} is allowed",
                       report::titleOfQuantity(textOr(row, "quantity")), scaledText(numberOr(row, "commanded"), unit),
                       scaledText(numberOr(row, "expected"), unit),
                       measuredText(numberOr(row, "measured"), numberOr(row, "expanded_uncertainty"), unit),
                       direction.empty() ? direction : " going " + direction,
                       scaledText(numberOr(row, "allowed"), unit)) +
           (numberOr(row, "not_measured") > 0
                ? fmt::format("; {:g} of its readings were not measured", numberOr(row, "not_measured"))
                : "");
}

}  // namespace

/// Judges as when the calibration was made: error plus expanded uncertainty within the tolerance, in either direction.
Json checkAgainst(const Json& line, const Json& found, double tolerance_pct) {
    const auto quantity = textOr(found, "quantity");
    const auto* one = calibratedQuantity(quantity);
    const double scale = one != nullptr ? one->perUnit : 1;  // in the units that people read
    Json rows = Json::array(), reasons = Json::array();
    const Json& levels = report::listIn(found, "levels");
    Verdict verdict = levels.empty() ? Verdict::Indeterminate : Verdict::Pass;
    if (levels.empty()) reasons.push_back("No level was read: nothing was checked.");
    for (const auto& level : levels) {
        const double commanded = numberOr(level, "commanded");
        const double expected = numberOr(line, "gain") * commanded + numberOr(line, "offset");
        const auto [mean, u, direction] = furthest(level, expected);
        const double off = mean - expected;
        const double allowed = tolerance_pct / 100 * commanded;
        // A current source is programmed to A / |Z|, so it may not return to the same levels. Levels outside the line's
        // range are not judged.
        const bool known =
            commanded >= 0.98 * numberOr(line, "lowest") && commanded <= 1.02 * numberOr(line, "highest");
        const auto within = known ? guardBanded(off, u, allowed) : Verdict::Indeterminate;
        // A reading that was not measured may be the one outside the tolerance.
        const double missing = numberOr(level, "not_measured");
        const Verdict judged = missing == 0 ? within : worseOf(within, Verdict::Indeterminate);
        verdict = worseOf(verdict, judged);
        rows.push_back({{"quantity", quantity},
                        {"commanded", numberOrNull(commanded * scale)},
                        {"expected", numberOrNull(expected * scale)},
                        {"measured", numberOrNull(mean * scale)},
                        {"direction", direction},
                        {"off", numberOrNull(off * scale)},
                        {"expanded_uncertainty", numberOrNull(u * scale)},
                        {"allowed", numberOrNull(allowed * scale)},
                        {"not_measured", numberOrNull(missing)},
                        {"unit", scale != 1 ? "us" : textOr(found, "unit")},
                        {"verdict", nameOf(judged)}});
        if (judged != Verdict::Pass) reasons.push_back(notHeld(rows.back()));
    }
    return {{"rows", std::move(rows)}, {"verdict", nameOf(verdict)}, {"reasons", std::move(reasons)}};
}

}  // namespace tacto::host::stimulator_calibration
