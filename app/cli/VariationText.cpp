#include <fmt/format.h>
#include <nlohmann/json.hpp>
#include <string>

#include "app/cli/ResultText.h"
#include "app/cli/Say.h"
#include "app/cli/TextTable.h"
#include "app/cli/Verdicts.h"
#include "core/base/JsonText.h"

namespace tacto::cli {

namespace {

using nlohmann::json;

/// "14.5 (11.2 to 19.0)": the middle, 5 and 95 % of the participants.
std::string range(const json& object, const char* key, const char* middle = "value", double factor = 1) {
    const auto found = object.find(key);
    if (found == object.end() || !found->is_object()) return "–";
    if (!found->value(middle, json()).is_number()) return "–";
    const auto number = [&](const char* of) {
        const auto value = found->value(of, json());
        return value.is_number() ? fmt::format("{:.{}f}", factor * value.get<double>(), factor == 1 ? 2 : 1) : "–";
    };
    return fmt::format("{} ({} to {})", number(middle), number("low"), number("high"));
}

void addAim(TextTable& table, std::string aim, const json& alone, const json& pooled) {
    const bool reached = pooled.value("total", json()).is_number();
    table.add(
        {std::move(aim), alone.is_number() ? dumpJson(alone) : "–",
         reached
             ? fmt::format("{} ({} each)", resultNumber(pooled, "total"), resultNumber(pooled, "per_participant"))
             : fmt::format("not with so few: at least {} participants", resultNumber(pooled, "participants_least"))});
}

/// What is too strong decides more than anything else.
void printReadings(const json& results) {
    const json readings = resultList(results, "readings");
    if (readings.empty()) return;
    TextTable table({"too strong from", ">mA", ">fixed: served", ">own range: served", "accuracy of these, %"});
    for (const auto& row : readings) {
        table.add({resultText(row, "too_strong_from"), resultNumber(row, "median_ma"),
                   resultNumber(row, "fixed_served"), resultNumber(row, "personal_served"),
                   range(row, "accuracy", "median", 100)});
    }
    table.print();
}

void printPilots(const json& results) {
    const json pilots = resultList(results, "pilots");
    if (pilots.empty()) return;
    const auto percent = [](const json& row, const char* key) {
        const auto value = row.value(key, json());
        return value.is_number() ? fmt::format("{:.0f} %", 100 * value.get<double>()) : "–";
    };
    TextTable table({"pilot of", ">all are served", ">... and above chance", "then such people who can do it (95 %)"});
    for (const auto& row : pilots) {
        table.add({resultNumber(row, "people"), percent(row, "all_served"), percent(row, "all_above_chance"),
                   "at least " + percent(row, "prevalence_all")});
    }
    table.print();
    const json& one = pilots.front();
    say("  One person's 95 % interval after {} trials is {} % wide; {} right answers are above chance.\n",
        resultNumber(one, "trials"), range(one, "width", "value", 100), resultNumber(one, "right_from"));
}

void printTrials(const json& results) {
    const json needed = results.value("trials_needed", json());
    if (!needed.is_object()) return;
    const json& alone = needed.at("per_participant");
    const json& pooled = needed.at("pooled");
    TextTable table({fmt::format("trials of a pilot of {}, so that with {} % probability",
                                 resultNumber(pooled, "participants"), resultNumber(needed, "assurance", 100)),
                     ">one participant", "pooled"});
    addAim(table, fmt::format("the interval is {} % wide or less", resultNumber(needed, "width", 100)),
           alone.at("for_width"), pooled.at("for_width"));
    addAim(table, "its lower end lies above chance", alone.at("above_chance"), pooled.at("above_chance"));
    table.print();
}

}  // namespace

void printVariation(const json& results) {
    if (const auto reasons = resultList(results, "reasons"); !reasons.empty()) {
        say("\n");
        for (const auto& sentence : reasons) {
            if (sentence.is_string()) say("  {}\n", sentence.get<std::string>());
        }
    } else {
        say("\n  {} of {} virtual participants are served; {} are refused, {} do not feel every condition\n",
            resultNumber(results, "served"), resultNumber(results, "participants"),
            resultNumber(results, "participants_refused"), resultNumber(results, "participants_not_feeling"));
    }
    printReadings(results);
    TextTable table({"pair, JND", ">together", ">amplitude", ">interval"});
    for (const auto& pair : resultList(results, "separability")) {
        table.add({resultText(pair, "a") + " / " + resultText(pair, "b"), range(pair, "jnd"),
                   range(pair, "amplitude_jnd"), range(pair, "interval_jnd")});
    }
    table.print();
    say("\n  accuracy of the served {} %, information {} bits\n", range(results, "accuracy", "median", 100),
        range(results, "information_bits", "median"));
    printPilots(results);
    printTrials(results);
}

}  // namespace tacto::cli
