#include "app/cli/Verdicts.h"

#include <cmath>
#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "app/cli/Command.h"
#include "app/cli/ResultText.h"
#include "core/base/QuantityText.h"

namespace tacto::cli {

int exitForVerdict(std::string_view verdict) noexcept {
    if (verdict == "fail") return kVerdictFailed;
    if (verdict == "indeterminate") return kIndeterminate;
    if (verdict == "stopped") return kStopped;
    return kDone;
}

namespace {
double at(const nlohmann::json& object, const char* key) {
    const auto found = object.find(key);
    return found != object.end() && found->is_number() ? found->get<double>() : NAN;
}
}  // namespace

void printResults(const nlohmann::json& results) {
    say("\n");
    for (const auto& [key, value] : results.items()) {
        if (key != "verdict") say("  {:<18} {}\n", key, value.is_string() ? value.get<std::string>() : value.dump());
    }
}

void printVerdict(std::string_view verdict, const std::vector<std::string>& reasons) {
    say("  verdict  {}\n", verdict);
    for (const auto& reason : reasons) say("           {}\n", reason);
}

void printCalibration(const nlohmann::json& results) {
    const auto reference = results.value("reference", nlohmann::json::object());
    const double measured = at(reference, "measured_ohm");
    if (std::isfinite(at(reference, "load_ohm"))) {
        say("\n  known load {} read as {}\n", exactText(at(reference, "load_ohm"), "ohm"),
            std::isfinite(measured) ? measuredText(measured, at(reference, "expanded_ohm"), "ohm") : "nothing");
    }
    say("\n  {:<12} {:>10} {:>12} {:>12} {:>14} {:>12} {:>18}   {}\n", "", "gain", "offset", "residual %",
        "repeatability %", "hysteresis %", "U at the largest", "verdict");
    for (const char* name : {"amplitude", "interval", "width", "gap"}) {
        const auto found = results.value(name, nlohmann::json::object());
        if (!found.contains("gain")) continue;
        const auto unit = resultText(found, "unit");
        say("  {:<12} {:>10.6f} {:>12} {:>12.4f} {:>14.4f} {:>12.4f} {:>18}   {}\n", name, at(found, "gain"),
            resultQuantity(found, "offset", unit, 3), at(found, "residual_max_pct_fs"),
            at(found, "repeatability_pct_fs"), at(found, "hysteresis_pct_fs"),
            resultQuantity(found, "expanded_uncertainty", unit, 2), resultText(found, "verdict"));
    }
}

void printSeparability(const nlohmann::json& results) {
    say("\n  {:<14} {:>4} {:>12} {:>10} {:>12} {:>10}\n", "condition", "n", "amplitude", "sd", "interval", "sd");
    for (const auto& c : results.value("conditions", nlohmann::json::array())) {
        const auto& amplitude = c.at("amplitude_v");
        const auto& interval = c.at("interval_s");
        say("  {:<14} {:>4} {:>12} {:>10} {:>12} {:>10}\n", c.value("name", ""), resultNumber(c, "n"),
            resultQuantity(amplitude, "mean", "V", 5), resultQuantity(amplitude, "sd", "V", 2),
            resultQuantity(interval, "mean", "s", 6), resultQuantity(interval, "sd", "s", 2));
    }
    say("\n  {:<28} {:>12} {:>15} {:>14}\n", "pair", "Mahalanobis", "amplitude JND", "interval JND");
    for (const auto& p : results.value("pairs", nlohmann::json::array())) {
        say("  {:<28} {:>12.1f} {:>15.1f} {:>14.1f}\n", p.value("a", "") + " / " + p.value("b", ""),
            at(p, "mahalanobis"), at(p, "amplitude_jnd"), at(p, "interval_jnd"));
    }
    const auto accuracy = results.value("accuracy", nlohmann::json::object());
    say("\n  accuracy {:.1f} % (95 %: {:.1f} to {:.1f} %)\n", 100 * at(accuracy, "value"), 100 * at(accuracy, "low"),
        100 * at(accuracy, "high"));
}

}  // namespace tacto::cli
