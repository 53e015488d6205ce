#include "app/scripting/host/report/LoadSafetyTables.h"

#include <algorithm>
#include <fmt/format.h>
#include <vector>

#include "app/scripting/host/report/Cells.h"
#include "core/base/QuantityText.h"
#include "core/base/Statistics.h"

namespace tacto::host::report {

namespace {

/// What the table of loads shows of each.
struct MeasuredRow {
    const char* title;
    const char* key;  ///< of a load
    const char* unit;
    bool overSeconds = false;  ///< longer than any record
};
constexpr MeasuredRow kMeasured[] = {{"|Z| at the end of the leading phase", "measured_ohm", "ohm"},
                                     {"Peak voltage", "peak_v", "V"},
                                     {"Peak current", "peak_ma", "mA"},
                                     {"RMS current in the train", "rms_train_ma", "mA"},
                                     {"RMS current over 1 s", "rms_1s_ma", "mA", true},
                                     {"RMS current over 5 s", "rms_5s_ma", "mA", true},
                                     {"Charge of a phase", "charge_uc", "uC"},
                                     {"Net charge of a pulse", "net_charge_uc", "uC"},
                                     {"Energy of a pulse", "energy_mj", "mJ"},
                                     {"Current density", "current_density_ma_cm2", "mA/cm2"},
                                     {"Power density over 1 s", "power_density_w_cm2", "W/cm2", true}};
constexpr const char* kBeforeNextTrain = "before the next train";
constexpr std::size_t kCritical = 3;  // rows closest to their limits that are named before the matrix

/// A list of the matrix; empty where nothing was analysed.
const Json& ofMatrix(const Json& found, const char* key) {
    static const Json kNone = Json::object();
    const auto matrix = found.find("matrix");
    return listIn(matrix != found.end() ? *matrix : kNone, key);
}

const Json& linesOf(const Json& found) { return ofMatrix(found, "lines"); }

bool hasLimit(const Json& line) { return line.at("limit").is_number(); }

/// The same limit from two documents is one row of the matrix; the table of sources has both.
bool isSameLimit(const Json& a, const Json& b) {
    const auto values = [](const Json& line) {
        Json out = Json::array();
        for (const auto& cell : listIn(line, "cells"))
            out.push_back(cell.is_object() ? Json{cell.value("value", Json()), cell.value("verdict", Json())} : Json());
        return out;
    };
    for (const char* key : {"title", "limit", "unit"}) {
        if (a.value(key, Json()) != b.value(key, Json())) return false;
    }
    return values(a) == values(b);
}

/// Every limit against every load: seventy rows that pass do not bury the three that nearly do not.
Json limitRows(const Json& found) {
    Json rows = Json::array();
    for (const auto& line : linesOf(found)) {
        const auto same = std::ranges::find_if(rows, [&](const Json& row) { return isSameLimit(row, line); });
        if (same == rows.end()) {
            Json row = line;
            row["sets"] = Json::array({line.at("set")});
            row.erase("set");
            if (!hasLimit(line)) row["note"] = kBeforeNextTrain;
            rows.push_back(std::move(row));
        } else {
            (*same)["sets"].push_back(line.at("set"));
            if (textOr(line, "compare") == "<") (*same)["compare"] = "<";
        }
    }
    return rows;
}

Json closest(const Json& limits) {
    Json rows = Json::array();
    for (const auto& line : limits) {
        if (rows.size() == kCritical) break;
        if (line.value("margin_pct", Json()).is_null()) continue;
        const auto& cells = listIn(line, "cells");
        const auto cell = std::ranges::find_if(
            cells, [&](const Json& each) { return each.is_object() && each.at("load") == line.at("worst_load"); });
        if (cell == cells.end()) continue;
        Json row = {{"remark", textOr(*cell, "note")}};
        copy(row, "requirement", line, "title");
        copy(row, "load", line, "worst_load");
        copy(row, "value", *cell, "value");
        copy(row, "expanded_uncertainty", *cell, "expanded_uncertainty");
        copy(row, "limit", line, "limit");
        row["used_pct"] = 100 - numberOr(line, "margin_pct");
        copy(row, "unit", line, "unit");
        copy(row, "verdict", *cell, "verdict");
        rows.push_back(std::move(row));
    }
    return rows;
}

/// An open or a short circuit is judged by its trip alone and has nothing to measure.
Json loadsMatrix(const Json& found) {
    std::vector<const Json*> loads;
    double fewest = kNaN;  // trains
    for (const auto& load : listIn(found, "loads")) {
        if (!(numberOr(load, "commands_delivered") > 0) && !(numberOr(load, "commands_refused") > 0)) continue;
        loads.push_back(&load);
        if (numberOr(load, "trains") > 0) fewest = std::fmin(fewest, numberOr(load, "trains"));
    }
    Json columns = Json::array(), impedances = Json::array(), verdicts = Json::array();
    for (const auto* load : loads) {
        Json cell = {{"unit", "ohm"}}, verdict = Json::object();
        copy(cell, "value", *load, "nominal_ohm");
        copy(verdict, "text", *load, "verdict");
        columns.push_back(load->at("name"));
        impedances.push_back(std::move(cell));
        verdicts.push_back(std::move(verdict));
    }
    Json rows = Json::array({{{"title", "Nominal |Z|"}, {"cells", impedances}}});
    for (const auto& measured : kMeasured) {
        const std::string key(measured.key);
        const std::string expanded = key == "measured_ohm" ? "measured_expanded_ohm" : key + "_expanded";
        Json cells = Json::array();
        for (const auto* load : loads) {
            Json cell = Json::object();
            copy(cell, "value", *load, measured.key);
            copy(cell, "expanded_uncertainty", *load, expanded.c_str());
            cells.push_back(std::move(cell));
        }
        const auto note = measured.overSeconds && fewest > 0 ? fmt::format("from {} captured trains, repeated", fewest)
                                                             : std::string();
        rows.push_back({{"title", measured.title}, {"note", note}, {"unit", measured.unit}, {"cells", cells}});
    }
    rows.push_back({{"title", "Verdict"}, {"cells", verdicts}});
    return {
        {"kind", "matrix"},
        {"caption",
         "Each load, and what was measured into it or computed from that, the strongest command that the limits allow"},
        {"columns", columns},
        {"rows", rows}};
}

/// The outputs that are described and disclosed, each with the loads it is asked for.
Json outputs(const Json& found) {
    Json rows = listIn(found, "described");
    const std::size_t described = rows.size();
    for (const auto& row : listIn(found, "disclosed")) {
        const auto value = numberOr(row, "value");
        const auto load = writtenLoad(textOr(row, "load"));
        const auto text =
            std::isnan(value)
                ? fmt::format("not evaluated into {}: {}", load, textOr(row, "reason"))
                : fmt::format("{} into {}",
                              measuredText(value, numberOr(row, "expanded_uncertainty"), textOr(row, "unit")), load);
        const auto same = std::find_if(rows.begin() + static_cast<std::ptrdiff_t>(described), rows.end(),
                                       [&](const Json& each) { return each.at("output") == row.at("output"); });
        if (same == rows.end()) {
            rows.push_back({{"output", row.at("output")}, {"commanded", ""}, {"measured", text}});
        } else {
            (*same)["measured"] = textOr(*same, "measured") + "; " + text;
        }
    }
    return rows;
}

std::string limitText(const Json& line) {
    if (!hasLimit(line)) return kBeforeNextTrain;
    return fmt::format("{} {}", textOr(line, "compare") == "<" ? "<" : "≤",
                       scaledText(numberOr(line, "limit"), textOr(line, "unit"), 3));
}

/// Where each limit comes from and how sure that is, once and not on every row.
Json sources(const Json& found) {
    Json rows = Json::array();
    for (const auto& line : linesOf(found)) {
        const auto limit = textOr(line, "title") + " " + limitText(line);
        const auto confidence = textOr(line, "confidence").empty() ? "our own" : textOr(line, "confidence");
        const auto same = std::ranges::find_if(rows, [&](const Json& row) {
            return row.at("source") == line.at("source") && row.at("confidence") == confidence;
        });
        if (same == rows.end()) {
            rows.push_back({{"requirement", limit}, {"source", line.at("source")}, {"confidence", confidence}});
        } else {
            (*same)["requirement"] = textOr(*same, "requirement") + "; " + limit;
        }
    }
    return rows;
}

Json refusals(const Json& found) {
    Json rows = Json::array();
    for (const auto& row : listIn(found, "rows")) {
        if (textOr(row, "set") != "gate") continue;
        Json out = Json::object();
        copy(out, "load", row, "load");
        copy(out, "asked", row, "title");
        copy(out, "would_be", row, "source");
        copy(out, "verdict", row, "verdict");
        copy(out, "reason", row, "reason");
        if (textOr(row, "verdict") == "refused as expected") out["reason"] = "";
        rows.push_back(std::move(out));
    }
    return rows;
}

Json trips(const Json& found) {
    constexpr std::string_view kTrip = "trip: ";
    Json rows = Json::array();
    for (const auto& row : listIn(found, "rows")) {
        if (textOr(row, "set") != "interlock") continue;
        auto title = textOr(row, "title");
        if (const auto at = title.find(kTrip); at != std::string::npos) title.erase(at, kTrip.size());
        Json out = {{"trip", title}};
        copy(out, "ended_after_s", row, "value");
        copy(out, "verdict", row, "verdict");
        copy(out, "reason", row, "reason");
        copy(out, "remark", row, "note");
        rows.push_back(std::move(out));
    }
    return rows;
}

}  // namespace

Json loadSafetyTables(const Json& found) {
    const Json limits = limitRows(found);
    return Json::array(
        {{{"caption", "Closest to their limits"},
          {"rows", closest(limits)},
          {"columns",
           {"requirement", "load", "value", "expanded_uncertainty", "limit", "used_pct", "unit", "verdict", "remark"}}},
         {{"kind", "matrix"},
          {"caption", "Limits against loads, closest to a limit first"},
          {"columns", ofMatrix(found, "loads")},
          {"rows", limits}},
         loadsMatrix(found),
         {{"caption", "Output, as the FDA guidance asks"},
          {"rows", outputs(found)},
          {"columns", {"output", "commanded", "measured"}}},
         {{"caption", "Asked for and refused"},
          {"rows", refusals(found)},
          {"columns", {"load", "asked", "would_be", "verdict", "reason"}}},
         {{"caption", "What must end output by itself"},
          {"rows", trips(found)},
          {"columns", {"trip", "ended_after_s", "verdict", "remark", "reason"}}},
         {{"caption", "Where each limit comes from, and our confidence in it"},
          {"rows", sources(found)},
          {"columns", {"requirement", "source", "confidence"}}}});
}

}  // namespace tacto::host::report
