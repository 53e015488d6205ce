#include "core/results/ResultTable.h"

#include <algorithm>

#include "core/results/Describe.h"

namespace tacto {

namespace {

using nlohmann::json;

const json kNothing;

}  // namespace

const json& memberAt(const json& record, const std::string& path) {
    const auto* here = &record;
    for (std::size_t from = 0; from <= path.size() && !path.empty();) {
        const auto dot = std::min(path.find('.', from), path.size());
        if (!here->is_object()) return kNothing;
        const auto at = here->find(path.substr(from, dot - from));
        if (at == here->end()) return kNothing;
        here = &*at;
        from = dot + 1;
    }
    return *here;
}

json rowsOf(const ResultTable& table, const json& results) {
    json all = json::array();
    if (table.at.find('|') == table.at.npos) {
        const auto& list = memberAt(results, table.at);
        if (list.is_array()) all = list;
    } else {
        for (std::size_t from = 0; from <= table.at.size();) {
            const auto end = std::min(table.at.find('|', from), table.at.size());
            all.push_back(memberAt(results, table.at.substr(from, end - from)));
            from = end + 1;
        }
    }
    json rows = json::array();
    for (auto& record : all) {
        if (record.is_object() && (table.but.empty() || memberAt(record, "verdict") != table.but))
            rows.push_back(std::move(record));
    }
    return rows;
}

json shownIn(const std::vector<ResultTable>& tables, const json& results) {
    json shown = json::object();
    const auto keep = [&](const std::string& path) {
        const auto key = path.substr(0, path.find('.'));
        if (const auto& member = memberAt(results, key); !member.is_null()) shown[key] = member;
    };
    for (const auto& table : tables) {
        for (std::size_t from = 0; from <= table.at.size();) {
            const auto end = std::min(table.at.find('|', from), table.at.size());
            keep(table.at.substr(from, end - from));
            from = end + 1;
        }
        if (!table.at.empty()) continue;
        for (const auto& column : table.columns) keep(column.at);
    }
    return shown;
}

namespace describe {

Tables withBasis(Tables tables) {
    tables.push_back(
        facts("Known reference", "reference",
              {number("Known load", "load_ohm", "ohm"), number("Read as", "measured_ohm", "ohm", "expanded_ohm"),
               number("Deviation", "deviation_pct", "%", "expanded_uncertainty_pct"),
               number("Allowed, ±", "allowed_pct", "%"), verdict(), text("Reason", "reason")},
              Else::InTheReport));
    tables.push_back(facts("Absolute reference", "absolute",
                           {number("Deviation", "deviation_pct", "%", "expanded_uncertainty_pct"),
                            number("Allowed, ±", "allowed_pct", "%"), verdict(), text("It read", "text")},
                           Else::InTheReport));
    tables.push_back(
        rows("Instruments", "instruments",
             {text("Role", "role"), text("Instrument", "name"), text("Serial", "serial"), text("Channel", "channel"),
              tolerance("Gain, ±", "gain_pct", "%"), tolerance("Probe, ±", "probe_pct", "%"),
              tolerance("Time base, ±", "timebase_ppm", "ppm"), text("As stated by", "stated_by")},
             Else::InBoth));
    tables.push_back(sentences("What it rests on", "rests_on", Else::InBoth));
    return tables;
}

}  // namespace describe

}  // namespace tacto
