#include "app/scripting/host/report/CertificateItem.h"

#include <cmath>

#include "app/scripting/host/report/Cells.h"
#include "core/analysis/statistics/StatisticsJson.h"
#include "core/analysis/statistics/Verdict.h"
#include "core/base/Statistics.h"

namespace tacto::host::report {

namespace {

Json certifiedRow(const Json& found, const Json& level, const Correction& correction) {
    const double commanded = numberOr(level, "commanded");
    const double moved = correction ? correction->programmedFor(commanded) - commanded : 0;
    double error = kNaN;
    for (const char* key : {"mean", "mean_up", "mean_down"}) {
        const double one = numberOr(level, key) + numberOr(found, "gain") * moved - commanded;
        if (std::isnan(error) || std::abs(one) > std::abs(error)) error = one;
    }
    const double k = numberOr(level, "worst_coverage_factor");
    double expanded = numberOr(level, "worst_expanded_uncertainty");
    if (moved != 0) {
        expanded += k * std::abs(moved) * numberOr(found, "gain_expanded_uncertainty") /
                    numberOr(found, "gain_coverage_factor");
    }
    const double tolerance = numberOr(level, "tolerance");
    // A reading that was not measured may be the one outside the tolerance.
    const auto judged = guardBanded(error, expanded, tolerance);
    const auto verdict = numberOr(level, "not_measured") > 0 ? worseOf(judged, Verdict::Indeterminate) : judged;
    return {{"commanded", commanded},
            {"error", numberOrNull(error)},
            {"expanded_uncertainty", numberOrNull(expanded)},
            {"coverage_factor", numberOrNull(k)},
            {"tolerance", tolerance},
            {"verdict", nameOf(verdict)}};
}

Json certifiedRows(const Json& found, const Correction& correction) {
    Json rows = Json::array();
    for (const auto& level : listIn(found, "levels")) rows.push_back(certifiedRow(found, level, correction));
    return rows;
}

}  // namespace

Json certifiedQuantity(const Json& found, const Correction& before, const Correction& after) {
    const auto quantity = textOr(found, "quantity");
    return {{"quantity", quantity},
            {"title", titleOfQuantity(quantity)},
            {"unit", textOr(found, "unit")},
            {"tolerance_pct", numberOrNull(numberOr(found, "tolerance_pct"))},
            {"warnings", found.value("warnings", Json::array())},
            {"measured", certifiedRows(found, {})},
            {"found", before ? certifiedRows(found, before) : Json()},
            {"left", after ? certifiedRows(found, after) : Json()}};
}

}  // namespace tacto::host::report
