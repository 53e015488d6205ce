// Whether a stored calibration still holds: its line against levels that were read again.
#include "app/scripting/host/analysis/AnalysisObject.h"
#include "app/scripting/host/report/CalibrationTables.h"
#include "app/scripting/host/report/Cells.h"
#include "core/analysis/statistics/StatisticsJson.h"
#include "core/analysis/statistics/Verdict.h"
#include "core/base/QuantityText.h"
#include "core/encoding/CalibratedQuantity.h"

namespace tacto::host::analysis {

namespace {

std::string notHeld(const Json& row) {
    const auto unit = textOr(row, "unit");
    return fmt::format("{}: at {} the stored calibration expects {}, and {} was measured; ± {} is allowed",
                       report::titleOfQuantity(textOr(row, "quantity")), scaledText(numberOr(row, "commanded"), unit),
                       scaledText(numberOr(row, "expected"), unit),
                       measuredText(numberOr(row, "measured"), numberOr(row, "expanded_uncertainty"), unit),
                       scaledText(numberOr(row, "allowed"), unit)) +
           (numberOr(row, "not_measured") > 0
                ? fmt::format("; {:g} of its readings were not measured", numberOr(row, "not_measured"))
                : "");
}

}  // namespace

/// Guard-banded, as at its making: within the tolerance, this run's uncertainty included.
Result<Json> calibrationCheck(ScriptSession&, const Arguments& arguments) {
    const Json &found = arguments.object("found"), &line = arguments.object("line");
    const auto quantity = textOr(found, "quantity");
    const auto* one = calibratedQuantity(quantity);
    const double scale = one != nullptr ? one->perUnit : 1;  // as people read them
    Json rows = Json::array(), reasons = Json::array();
    const Json& levels = report::listIn(found, "levels");
    Verdict verdict = levels.empty() ? Verdict::Indeterminate : Verdict::Pass;
    if (levels.empty()) reasons.push_back("No level was read: nothing was checked.");
    for (const auto& level : levels) {
        const double commanded = numberOr(level, "commanded"), mean = numberOr(level, "mean");
        const double expected = numberOr(line, "gain") * commanded + numberOr(line, "offset");
        const double off = mean - expected, u = numberOr(level, "expanded_uncertainty");
        const double allowed = arguments.number("tolerance") / 100 * commanded;
        // A current source is programmed to A / |Z|: that it comes back to the same levels is not sure. The line knows
        // its own range.
        const bool known =
            commanded >= 0.98 * numberOr(line, "lowest") && commanded <= 1.02 * numberOr(line, "highest");
        const auto within = known ? guardBanded(off, u, allowed) : Verdict::Indeterminate;
        // A reading that was not measured may be the one that is off.
        const double missing = numberOr(level, "not_measured");
        const Verdict judged = missing == 0 ? within : worseOf(within, Verdict::Indeterminate);
        verdict = worseOf(verdict, judged);
        rows.push_back({{"quantity", quantity},
                        {"commanded", numberOrNull(commanded * scale)},
                        {"expected", numberOrNull(expected * scale)},
                        {"measured", numberOrNull(mean * scale)},
                        {"off", numberOrNull(off * scale)},
                        {"expanded_uncertainty", numberOrNull(u * scale)},
                        {"allowed", numberOrNull(allowed * scale)},
                        {"not_measured", numberOrNull(missing)},
                        {"unit", scale != 1 ? "us" : textOr(found, "unit")},
                        {"verdict", nameOf(judged)}});
        if (judged != Verdict::Pass) reasons.push_back(notHeld(rows.back()));
    }
    return Json{{"rows", std::move(rows)}, {"verdict", nameOf(verdict)}, {"reasons", std::move(reasons)}};
}

}  // namespace tacto::host::analysis
