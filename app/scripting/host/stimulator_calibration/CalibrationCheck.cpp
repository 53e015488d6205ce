// Checks whether a stored calibration still holds: compares its line with levels that were read again.
#include <cmath>
#include <utility>

#include "app/scripting/host/report/Cells.h"
#include "app/scripting/host/stimulator_calibration/StimulatorLevels.h"
#include "core/base/QuantityText.h"
#include "core/base/Statistics.h"
#include "core/encoding/StimulatorCalibration.h"

namespace tacto::host::stimulator_calibration {

namespace {

/// Fills in the mean furthest from the line: of all readings of the level, of those going up, or of those going down.
void takeFurthest(CheckedLevel& row, const Json& level) {
    row.measured = numberOr(level, "mean");
    row.expanded = numberOr(level, "expanded_uncertainty");
    for (const auto& [key, direction] :
         {std::pair("mean_up", SweepDirection::Up), std::pair("mean_down", SweepDirection::Down)}) {
        const double mean = numberOr(level, key);
        if (!(std::abs(mean - row.expected) > std::abs(row.measured - row.expected))) continue;
        row.measured = mean;
        row.expanded = numberOr(level, "worst_expanded_uncertainty");
        row.direction = direction;
    }
    row.off = row.measured - row.expected;
}

std::string notHeld(const CheckedLevel& row) {
    const auto direction = nameOf(row.direction);
    return fmt::format(
        "{}: at {} the stored calibration expects {}, and {} was measured{}{}; ± {} is allowed{}",
        report::titleOfQuantity(row.quantity), scaledText(row.commanded, row.unit), scaledText(row.expected, row.unit),
        measuredText(row.measured, row.expanded, row.unit), direction.empty() ? "" : " going ", direction,
        scaledText(row.allowed, row.unit),
        row.notMeasured > 0 ? fmt::format("; {:g} of its readings were not measured", row.notMeasured) : std::string());
}

}  // namespace

/// Judges as when the calibration was made: error plus expanded uncertainty within the tolerance, in either direction.
CalibrationCheck checkAgainst(const Json& line, const Json& found, double tolerance_pct) {
    const auto quantity = textOr(found, "quantity");
    const auto* one = calibratedQuantity(quantity);
    const double scale = one != nullptr ? one->perUnit : 1;  // in the units that people read
    const Json& levels = report::listIn(found, "levels");
    CalibrationCheck check{.verdict = levels.empty() ? Verdict::Indeterminate : Verdict::Pass};
    if (levels.empty()) check.reasons.emplace_back("No level was read: nothing was checked.");
    for (const auto& level : levels) {
        const double commanded = numberOr(level, "commanded");
        CheckedLevel row{.quantity = quantity,
                         .commanded = commanded,
                         .expected = numberOr(line, "gain") * commanded + numberOr(line, "offset"),
                         .allowed = tolerance_pct / 100 * commanded,
                         .notMeasured = numberOr(level, "not_measured"),
                         .unit = scale != 1 ? "us" : textOr(found, "unit")};
        takeFurthest(row, level);
        // A current source is programmed to A / |Z|, so it may not return to the same levels. Levels outside the line's
        // range are not judged.
        const bool known =
            commanded >= 0.98 * numberOr(line, "lowest") && commanded <= 1.02 * numberOr(line, "highest");
        const auto within = known ? guardBanded(row.off, row.expanded, row.allowed) : Verdict::Indeterminate;
        // A reading that was not measured may be the one outside the tolerance.
        row.verdict = row.notMeasured == 0 ? within : worseOf(within, Verdict::Indeterminate);
        check.verdict = worseOf(check.verdict, row.verdict);
        for (double* value : {&row.commanded, &row.expected, &row.measured, &row.off, &row.expanded, &row.allowed})
            *value *= scale;
        if (row.verdict != Verdict::Pass) check.reasons.push_back(notHeld(row));
        check.rows.push_back(std::move(row));
    }
    return check;
}

}  // namespace tacto::host::stimulator_calibration
