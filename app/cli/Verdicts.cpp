#include "app/cli/Verdicts.h"

#include <cmath>
#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "app/cli/Command.h"
#include "app/cli/ResultText.h"
#include "app/cli/TextTable.h"
#include "core/base/JsonText.h"
#include "core/base/QuantityText.h"

namespace tacto::cli {

int exitForVerdict(std::string_view verdict) noexcept {
    if (verdict == "fail") return kVerdictFailed;
    if (verdict == "indeterminate") return kIndeterminate;
    if (verdict == "stopped") return kStopped;
    return kDone;
}

void printKnownLoad(const nlohmann::json& results) {
    const auto reference = resultObject(results, "reference");
    const double load = resultValue(reference, "load_ohm"), measured = resultValue(reference, "measured_ohm");
    if (!std::isfinite(load)) return;
    say("\n  known load {} read as {}\n", exactText(load, "ohm"),
        std::isfinite(measured) ? measuredText(measured, resultValue(reference, "expanded_ohm"), "ohm") : "nothing");
}

void printResults(const nlohmann::json& results) {
    TextTable table({"", ""});
    for (const auto& [key, value] : results.items()) {
        if (key != "verdict") table.add({key, value.is_string() ? value.get<std::string>() : dumpJson(value)});
    }
    say("\n");
    table.print();
}

void printVerdict(std::string_view verdict, const std::vector<std::string>& reasons) {
    TextTable table({"", ""});
    table.add({"verdict", std::string(verdict)});
    for (const auto& reason : reasons) table.add({"", reason});
    table.print();
}

void printCalibration(const nlohmann::json& results) {
    printKnownLoad(results);
    TextTable table(
        {"", ">gain", ">offset", ">residual %", ">repeatability %", ">hysteresis %", ">U at the largest", "verdict"});
    for (const char* name : {"amplitude", "interval", "width", "gap"}) {
        const auto found = results.value(name, nlohmann::json::object());
        if (!found.contains("gain")) continue;
        const auto unit = resultText(found, "unit");
        table.add({name, decimalText(resultValue(found, "gain"), 6), resultQuantity(found, "offset", unit, 3),
                   decimalText(resultValue(found, "residual_max_pct_fs"), 4),
                   decimalText(resultValue(found, "repeatability_pct_fs"), 4),
                   decimalText(resultValue(found, "hysteresis_pct_fs"), 4),
                   resultQuantity(found, "expanded_uncertainty", unit, 2), resultText(found, "verdict")});
    }
    table.print();
}

void printSeparability(const nlohmann::json& results) {
    TextTable conditions({"condition", ">n", ">amplitude", ">sd", ">interval", ">sd"});
    for (const auto& c : resultList(results, "conditions")) {
        const auto& amplitude = c.at("amplitude_v");
        const auto& interval = c.at("interval_s");
        conditions.add({c.value("name", ""), resultNumber(c, "n"), resultQuantity(amplitude, "mean", "V", 5),
                        resultQuantity(amplitude, "sd", "V", 2), resultQuantity(interval, "mean", "s", 6),
                        resultQuantity(interval, "sd", "s", 2)});
    }
    conditions.print();
    TextTable pairs({"pair", ">Mahalanobis", ">amplitude JND", ">interval JND"});
    for (const auto& p : resultList(results, "pairs")) {
        pairs.add({p.value("a", "") + " / " + p.value("b", ""), decimalText(resultValue(p, "mahalanobis"), 1),
                   decimalText(resultValue(p, "amplitude_jnd"), 1), decimalText(resultValue(p, "interval_jnd"), 1)});
    }
    pairs.print();
    const auto accuracy = resultObject(results, "accuracy");
    const auto percent = [&](const char* key) { return decimalText(100 * resultValue(accuracy, key), 1); };
    say("\n  accuracy {} % (95 %: {} to {} %)\n", percent("value"), percent("low"), percent("high"));
}

}  // namespace tacto::cli
