// What pilot sessions print: thresholds and range, and who told what apart.
#include <fmt/format.h>
#include <map>
#include <nlohmann/json.hpp>

#include "app/cli/ResultText.h"
#include "app/cli/Say.h"
#include "app/cli/TextTable.h"
#include "app/cli/Verdicts.h"
#include "core/analysis/identification/IdentificationJson.h"
#include "core/analysis/identification/IdentificationText.h"
#include "core/analysis/psychophysics/LevelGrid.h"
#include "core/base/QuantityText.h"
#include "core/study/Participant.h"

namespace tacto::cli {

using nlohmann::json;

namespace {

/// What people read for a key of the results; another text is returned as it is.
std::string wordsOf(const std::string& key) {
    static const std::map<std::string, std::string, std::less<>> kWords{
        {"too-strong", "too strong"}, {"ceiling", "the highest level"},       {"stop", "STOP"}, {"open", "not ended"},
        {"quest", "QUEST+"},          {"staircase", "the weighted staircase"}};
    const auto found = kWords.find(key);
    return found != kWords.end() ? found->second : answerWords(key);
}

/// How the session's levels are read: of current, or of a massager's strength.
struct LevelText {
    explicit LevelText(const json& results) : isStrength(resultText(results, "modality") == "massager") {}
    /// That of "min": "min_ma" or "min_intensity".
    [[nodiscard]] std::string of(const json& object, const char* name) const {
        return with(resultValue(object, fmt::format("{}_{}", name, isStrength ? "intensity" : "ma").c_str()));
    }
    [[nodiscard]] std::string with(double level) const {
        if (!std::isfinite(level)) return "–";
        return isStrength ? decimalText(level, 2) : decimalText(level, 2) + " mA";
    }
    const bool isStrength;
};

std::string percentText(const json& estimate) {
    const auto percent = [&](const char* key) { return decimalText(100 * resultValue(estimate, key), 0); };
    return fmt::format("{} % ({} to {} %)", percent("value"), percent("low"), percent("high"));
}

std::string withReason(std::string text, const std::string& reason) {
    return reason.empty() ? text : fmt::format("{}: {}", text, reason);
}

std::string rangeText(const json& range, const LevelText& levels) {
    if (range.empty()) return "not measured";
    if (range.value("usable", json()) != json(true))
        return withReason("none that is usable", resultText(range, "reason"));
    auto text = fmt::format("{} to {}", levels.of(range, "min"), levels.of(range, "max"));
    if (!levels.isStrength)
        text += fmt::format(", {} at {}",
                            voltageRangeText(Volts(resultValue(range, "min_v")), Volts(resultValue(range, "max_v"))),
                            scaledText(resultValue(range, "impedance_ohm"), "ohm", 3));
    const auto limit = valueFor(kLevelLimits, resultText(range, "limited_by"));
    return fmt::format("{}, {} JND, limited by {}", text, decimalText(resultValue(range, "jnd"), 1),
                       limit ? inWords(*limit) : resultText(range, "limited_by"));
}

std::string orBeyond(const json& found) { return found.value("at_edge", json()) == json(true) ? ", or beyond" : ""; }

/// A line each; both protocols have them.
void addThresholds(TextTable& table, const json& results, const LevelText& levels) {
    table.add({"felt from", levels.of(results, "felt")});
    table.add({"too strong from", results.value("said_too_strong", json()) == json(true)
                                      ? levels.of(results, "too_strong")
                                      : "never said; the highest was " + levels.of(results, "too_strong")});
    const auto detection = resultObject(results, "detection");
    const auto estimate = resultObject(detection, levels.isStrength ? "estimate_intensity" : "estimate_ma");
    if (!estimate.empty()) {
        const double low = resultValue(estimate, "low"), high = resultValue(estimate, "high");
        const bool isInterval = std::isfinite(low) && std::isfinite(high);  // a staircase gives none
        table.add(
            {"detection", fmt::format("{}{}{}, {} trials by {}", levels.with(resultValue(estimate, "value")),
                                      isInterval ? fmt::format(" ({} to {})", levels.with(low), levels.with(high)) : "",
                                      orBeyond(detection), resultNumber(detection, "trials"),
                                      wordsOf(resultText(detection, "method")))});
    }
    table.add({"range", rangeText(resultObject(results, "range"), levels)});
    const auto compared = resultObject(results, "comparison");
    const auto weber = resultObject(compared, "amplitude_weber");
    if (weber.empty()) return;
    const auto figure = [&](const char* key) { return decimalText(resultValue(weber, key), 2); };
    table.add({"Weber fraction",
               fmt::format("{} ({} to {}){}", figure("value"), figure("low"), figure("high"), orBeyond(compared))});
}

void addParticipant(TextTable& table, const json& results) {
    const auto code = resultText(resultObject(results, "participant"), "code");
    table.add({"participant", namedWith(basisIn(results), code)});
    if (const auto parts = resultValue(results, "parts"); parts > 1)
        table.add({"parts", fmt::format("{:.0f}: the session was interrupted and went on", parts)});
}

void printConfusion(const json& results) {
    const auto labels = resultList(results, "labels"), columns = resultList(results, "columns");
    const auto counts = resultList(results, "confusion");
    if (counts.empty() || counts.size() != labels.size()) return;
    std::vector<std::string> headings{"given, answered"};
    for (const auto& column : columns) headings.push_back(">" + wordsOf(column.get<std::string>()));
    TextTable table(headings);
    for (std::size_t i = 0; i < labels.size(); ++i) {
        std::vector<std::string> cells{wordsOf(labels[i].get<std::string>())};
        for (const auto& count : counts[i]) cells.push_back(std::to_string(count.get<std::size_t>()));
        cells.resize(headings.size());
        table.add(std::move(cells));
    }
    table.print();
}

void printTold(const json& results) {
    TextTable table({"told apart", ">right", ">n", ">share, 95 %", ">by chance p", ">bits, corrected, 95 %"});
    const auto add = [&](const char* name, const json& one) {
        if (resultObject(one, "accuracy").empty()) return;
        table.add({name, resultNumber(one, "hits"), resultNumber(one, "n"), percentText(one["accuracy"]),
                   chanceText(resultValue(one, "p_chance")), bitsText(correctedBitsFrom(one))});
    };
    add("the four", results);
    add("texture", resultObject(results, "texture"));
    add("pressure", resultObject(results, "pressure"));
    table.print();
}

void printVibration(const json& results, const LevelText& levels) {
    const auto vibration = resultObject(results, "vibration");
    if (vibration.empty()) return;
    if (vibration.value("measured", json()) != json(true)) return say("  what the massager did was not measured\n");
    TextTable table({"the massager", ">strength", ">m/s²", ">interval s", ">moved", ">missed"});
    for (const auto& each : resultList(vibration, "conditions"))
        table.add({wordsOf(resultText(each, "name")), levels.with(resultValue(each, "intensity")),
                   decimalText(resultValue(resultObject(each, "strength_m_s2"), "mean"), 2),
                   decimalText(resultValue(resultObject(each, "measured_interval_s"), "mean"), 3),
                   resultNumber(each, "moved"), resultNumber(each, "missed")});
    table.print();
    say("  what it did: {}\n", resultText(vibration, "verdict"));
}

}  // namespace

void printPilotThresholds(const json& results) {
    const LevelText levels(results);
    TextTable table({"", ""});
    addParticipant(table, results);
    addThresholds(table, results, levels);
    say("\n");
    table.print();
    TextTable series({"series", ">felt from", ">too strong from", ">highest", "ended by"});
    std::size_t number = 0;
    for (const auto& each : resultList(results, "series"))
        series.add({std::to_string(++number), levels.of(each, "felt"), levels.of(each, "too_strong"),
                    levels.of(each, "highest"), wordsOf(resultText(each, "ended_by"))});
    if (number > 0) series.print();
}

void printPilotIdentification(const json& results) {
    const LevelText levels(results);
    TextTable table({"", ""});
    addParticipant(table, results);
    addThresholds(table, resultObject(results, "thresholds"), levels);
    say("\n");
    table.print();
    const auto presented = resultList(results, "presented");
    if (!presented.empty()) {
        TextTable given({"condition", ">level", ">interval s"});
        for (const auto& each : presented)
            given.add({wordsOf(resultText(each, "name")),
                       levels.with(resultValue(each, levels.isStrength ? "intensity" : "current_ma")),
                       resultNumber(each, "interval_s")});
        given.print();
    }
    if (resultValue(results, "n") > 0) {
        printConfusion(results);
        printTold(results);
    }
    const auto empty = resultObject(results, "catch");
    if (resultValue(empty, "n") > 0)
        say("\n  nothing was given {} times and named as something {} times; no answer {} times\n",
            resultNumber(empty, "n"), resultNumber(empty, "false_alarms"), resultNumber(results, "no_answer"));
    printVibration(results, levels);
    for (const auto& note : resultList(results, "notes"))
        if (note.is_string()) say("  {}\n", note.get<std::string>());
}

}  // namespace tacto::cli
