// What transitions, the encoding comparison and the sensor calibration print: each its own figures.
#include <cmath>
#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "app/cli/ResultText.h"
#include "app/cli/Say.h"
#include "app/cli/Verdicts.h"
#include "core/base/QuantityText.h"

namespace tacto::cli {

namespace {

using nlohmann::json;

double number(const json& object, const char* key) {
    if (!object.is_object()) return NAN;
    const auto found = object.find(key);
    return found != object.end() && found->is_number() ? found->get<double>() : NAN;
}

/// "12.3", or a dash for what was not measured.
std::string shown(double value, int decimals) {
    return std::isfinite(value) ? fmt::format("{:.{}f}", value, decimals) : std::string("–");
}

json objectAt(const json& results, const char* key) {
    const auto found = results.find(key);
    return found != results.end() && found->is_object() ? *found : json::object();
}

json listAt(const json& results, const char* key) {
    const auto found = results.find(key);
    return found != results.end() && found->is_array() ? *found : json::array();
}

void printKnownLoad(const json& results) {
    const auto reference = objectAt(results, "reference");
    const double load = number(reference, "load_ohm"), measured = number(reference, "measured_ohm");
    if (!std::isfinite(load)) return;
    say("\n  known load {} read as {}\n", exactText(load, "ohm"),
        std::isfinite(measured) ? measuredText(measured, number(reference, "expanded_ohm"), "ohm") : "nothing");
}

}  // namespace

void printTransitions(const json& results) {
    printKnownLoad(results);
    const auto changes = objectAt(results, "changes");
    say("\n  {:<30} {:>3} {:>14} {:>14} {:>12} {:>7}   {}\n", "change", "n", "amplitude JND", "interval JND",
        "complete s", "trains", "verdict");
    for (const auto& group : listAt(changes, "groups")) {
        say("  {:<30} {:>3} {:>14} {:>14} {:>12} {:>7}   {}\n", resultText(group, "name"), resultNumber(group, "n"),
            shown(number(group, "amplitude_jnd"), 2), shown(number(group, "interval_jnd"), 2),
            shown(number(objectAt(group, "complete_s"), "max"), 2), shown(number(objectAt(group, "trains"), "max"), 0),
            resultText(group, "verdict"));
    }
    const auto latency = objectAt(results, "latency");
    if (listAt(latency, "groups").empty()) return;
    say("\n  {:<30} {:>3} {:>14} {:>20}   {}\n", "latency", "n", "mean ms", "beside design ms", "verdict");
    for (const auto& group : listAt(latency, "groups")) {
        say("  {:<30} {:>3} {:>14} {:>20}   {}\n", resultText(group, "name"), resultNumber(group, "n"),
            shown(1e3 * number(objectAt(group, "latency_s"), "mean"), 1),
            shown(1e3 * number(objectAt(group, "difference_s"), "max"), 1), resultText(group, "verdict"));
    }
}

void printEncodingComparison(const json& results) {
    printKnownLoad(results);
    say("\n  {:<26} {:>18} {:>16} {:>16} {:>12}\n", "encoding", "smallest pair JND", "neighbours JND", "per train JND",
        "separable");
    for (const auto& each : listAt(results, "encodings")) {
        say("  {:<26} {:>18} {:>16} {:>16} {:>12}\n", resultText(each, "name"),
            shown(number(each, "smallest_pair_jnd"), 2), shown(number(objectAt(each, "neighbours"), "min_jnd"), 2),
            shown(number(each, "gradual_jnd"), 2), resultText(each, "separable"));
    }
}

void printSensorCalibration(const json& results) {
    const auto distances = objectAt(results, "d_prime");
    say("\n  {:<12} {:>10} {:>22}   {}\n", "reference", "d'", "95 %", "told apart");
    for (const auto* key : {"R", "h", "v"}) {
        const auto one = objectAt(distances, key);
        if (one.empty()) continue;
        say("  {:<12} {:>10} {:>22}   {}\n", key, shown(number(one, "value"), 1),
            shown(number(one, "low"), 1) + " to " + shown(number(one, "high"), 1),
            one.value("told_apart", json()) == json(true) ? "yes" : "no");
    }
    const auto force = objectAt(results, "force");
    if (std::isfinite(number(force, "scale"))) {
        say("\n  force scale {}, offset {}\n",
            measuredText(number(force, "scale"), number(force, "scale_expanded_uncertainty"), ""),
            measuredText(number(force, "offset"), number(force, "offset_expanded_uncertainty"), "N"));
    }
    const auto spread = objectAt(results, "uncertainty_R");
    if (std::isfinite(number(spread, "expanded"))) say("  U of R for one slide {:.2g}\n", number(spread, "expanded"));
}

}  // namespace tacto::cli
