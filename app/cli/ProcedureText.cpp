// What transitions, the encoding comparison and the sensor calibration print: each its own figures.
#include <cmath>
#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "app/cli/ResultText.h"
#include "app/cli/Say.h"
#include "app/cli/TextTable.h"
#include "app/cli/Verdicts.h"
#include "core/base/QuantityText.h"

namespace tacto::cli {

using nlohmann::json;

void printTransitions(const json& results) {
    printKnownLoad(results);
    const auto changes = resultObject(results, "changes");
    TextTable table({"change", ">n", ">amplitude JND", ">interval JND", ">complete s", ">trains", "verdict"});
    for (const auto& group : resultList(changes, "groups")) {
        table.add({resultText(group, "name"), resultNumber(group, "n"),
                   decimalText(resultValue(group, "amplitude_jnd"), 2),
                   decimalText(resultValue(group, "interval_jnd"), 2),
                   decimalText(resultValue(resultObject(group, "complete_s"), "max"), 2),
                   decimalText(resultValue(resultObject(group, "trains"), "max"), 0), resultText(group, "verdict")});
    }
    table.print();
    const auto latency = resultObject(results, "latency");
    if (resultList(latency, "groups").empty()) return;
    TextTable late({"latency", ">n", ">mean ms", ">beside design ms", "verdict"});
    for (const auto& group : resultList(latency, "groups")) {
        late.add({resultText(group, "name"), resultNumber(group, "n"),
                  decimalText(1e3 * resultValue(resultObject(group, "latency_s"), "mean"), 1),
                  decimalText(1e3 * resultValue(resultObject(group, "difference_s"), "max"), 1),
                  resultText(group, "verdict")});
    }
    late.print();
}

void printEncodingComparison(const json& results) {
    printKnownLoad(results);
    TextTable table({"encoding", ">smallest pair JND", ">neighbours JND", ">per train JND", "separable"});
    for (const auto& each : resultList(results, "encodings")) {
        table.add({resultText(each, "name"), decimalText(resultValue(each, "smallest_pair_jnd"), 2),
                   decimalText(resultValue(resultObject(each, "neighbours"), "min_jnd"), 2),
                   decimalText(resultValue(each, "gradual_jnd"), 2), resultText(each, "separable")});
    }
    table.print();
}

void printSensorCalibration(const json& results) {
    const auto distances = resultObject(results, "d_prime");
    TextTable table({"reference", ">d'", ">95 %", "told apart"});
    for (const auto* key : {"R", "h", "v"}) {
        const auto one = resultObject(distances, key);
        if (one.empty()) continue;
        table.add({key, decimalText(resultValue(one, "value"), 1),
                   decimalText(resultValue(one, "low"), 1) + " to " + decimalText(resultValue(one, "high"), 1),
                   one.value("told_apart", json()) == json(true) ? "yes" : "no"});
    }
    table.print();
    const auto force = resultObject(results, "force");
    if (std::isfinite(resultValue(force, "scale"))) {
        say("\n  force scale {}, offset {}\n",
            measuredText(resultValue(force, "scale"), resultValue(force, "scale_expanded_uncertainty"), ""),
            measuredText(resultValue(force, "offset"), resultValue(force, "offset_expanded_uncertainty"), "N"));
    }
    const auto spread = resultObject(results, "uncertainty_R");
    if (std::isfinite(resultValue(spread, "expanded")))
        say("  U of R for one slide {:.2g}\n", resultValue(spread, "expanded"));
}

}  // namespace tacto::cli
