#include "app/scripting/host/report/CalibrationTables.h"

#include <fmt/format.h>
#include <map>

#include "app/scripting/host/report/Cells.h"
#include "core/analysis/statistics/StatisticsJson.h"
#include "core/base/QuantityText.h"
#include "core/base/Statistics.h"
#include "core/encoding/StimulatorCalibration.h"

namespace tacto::host::report {

namespace {

Json plain(double value, const std::string& unit) { return {{"value", numberOrNull(value)}, {"unit", unit}}; }

Json withU(double value, double expanded, const std::string& unit) {
    return {{"value", numberOrNull(value)}, {"expanded", numberOrNull(expanded)}, {"unit", unit}};
}

Json tableOf(const std::string& caption, Json rows, Json columns) {
    return {{"kind", "table"}, {"caption", caption}, {"rows", std::move(rows)}, {"columns", std::move(columns)}};
}

/// k beside its U.
std::string factorText(double k) { return std::isfinite(k) ? fmt::format("{:.2f}", k) : "–"; }

Json levels(const Json& found, const std::string& title, const std::string& unit) {
    Json rows = Json::array();
    for (const auto& level : listIn(found, "levels")) {
        const double commanded = numberOr(level, "commanded");
        const double up = numberOr(level, "mean_up"), down = numberOr(level, "mean_down");
        rows.push_back({{"commanded", scaledText(commanded, unit)},
                        {"n", level.at("n")},
                        {"error_going_up", plain(up - commanded, unit)},
                        {"error_going_down", plain(down - commanded, unit)},
                        {"hysteresis", plain(down - up, unit)},
                        {"error judged ± U",
                         withU(numberOr(level, "worst_error"), numberOr(level, "worst_expanded_uncertainty"), unit)},
                        {"k", factorText(numberOr(level, "worst_coverage_factor"))},
                        {"tolerance", "± " + measuredText(numberOr(level, "tolerance"), 0, unit)},
                        {"verdict", level.at("verdict")}});
    }
    return tableOf(title + ": levels", std::move(rows),
                   {"commanded", "n", "error_going_up", "error_going_down", "hysteresis", "error judged ± U", "k",
                    "tolerance", "verdict"});
}

/// What the uncertainty is made of, at both ends: what weighs at one need not at the other.
Json budget(const Json& found, const std::string& title, const std::string& unit) {
    const Json &largest = found.at("budget"), &smallest = found.at("budget_smallest");
    std::map<std::string, double> small;
    for (const auto& row : listIn(smallest, "rows")) small[textOr(row, "name")] = numberOr(row, "contribution");
    Json rows = Json::array();
    for (const auto& row : listIn(largest, "rows")) {
        const auto name = textOr(row, "name");
        const double freedom = numberOr(row, "degrees_of_freedom");
        rows.push_back({{"contribution", name},
                        {"distribution", row.at("distribution")},
                        {"at_the_smallest", plain(small.contains(name) ? small[name] : kNaN, unit)},
                        {"at_the_largest", plain(numberOr(row, "contribution"), unit)},
                        {"degrees_of_freedom", std::isnan(freedom) ? "∞" : fmt::format("{:.0f}", freedom)}});
    }
    for (const auto& [name, key] :
         {std::pair("combined, u", "combined"), std::pair("expanded, U (95 %)", "expanded_uncertainty")}) {
        rows.push_back({{"contribution", name},
                        {"distribution", ""},
                        {"at_the_smallest", plain(numberOr(smallest, key), unit)},
                        {"at_the_largest", plain(numberOr(largest, key), unit)},
                        {"degrees_of_freedom", ""}});
    }
    return tableOf(title + ": uncertainty budget at the smallest and the largest command", std::move(rows),
                   {"contribution", "distribution", "at_the_smallest", "at_the_largest", "degrees_of_freedom"});
}

std::string coverage(const Json& of) {
    const double factor = numberOr(of, "coverage_factor");
    return (std::isnan(factor) ? "" : fmt::format("k = {:.2f}, ", factor)) + textOr(of, "method");
}

}  // namespace

std::string titleOfQuantity(const std::string& quantity) {
    const auto* known = calibratedQuantity(quantity);
    return known != nullptr ? std::string(known->title) : quantity;
}

Json calibrationItems(const Json& found) {
    const auto title = titleOfQuantity(textOr(found, "quantity")), unit = textOr(found, "unit");
    const double outliers = numberOr(found, "outliers");
    Json marked = Json::array();
    for (const auto& reading : listIn(found, "readings")) {
        if (reading.value("outlier", Json()) != Json(true)) continue;
        marked.push_back({{"commanded", scaledText(numberOr(reading, "commanded"), unit)},
                          {"measured", plain(numberOr(reading, "measured"), unit)},
                          {"direction", reading.at("direction")}});
    }
    const auto text =
        fmt::format("Coverage at the smallest: {}; at the largest: {}. {}", coverage(found.at("budget_smallest")),
                    coverage(found.at("budget")),
                    outliers == 0 ? "No reading stands out."
                                  : fmt::format("{} readings stand out; they are marked and kept.", outliers));
    Json items =
        Json::array({levels(found, title, unit), budget(found, title, unit), {{"kind", "text"}, {"text", text}}});
    if (!marked.empty())
        items.push_back(
            tableOf(title + ": marked readings", std::move(marked), {"commanded", "measured", "direction"}));
    return items;
}

}  // namespace tacto::host::report
