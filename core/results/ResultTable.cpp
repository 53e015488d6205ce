#include "core/results/ResultTable.h"

#include <algorithm>

#include "core/results/Describe.h"

namespace tacto {

namespace {

using nlohmann::json;

const json kNothing;

/// Returns "a" and "b" for "a|b".
std::vector<std::string> partsOf(const std::string& at) {
    std::vector<std::string> parts;
    for (std::size_t from = 0; from <= at.size();) {
        const auto end = std::min(at.find('|', from), at.size());
        parts.push_back(at.substr(from, end - from));
        from = end + 1;
    }
    return parts;
}

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
    json rows = json::array();
    const bool several = table.at.find('|') != table.at.npos;
    const auto take = [&](json record, const std::string& path) {
        if (!record.is_object() || (!table.but.empty() && memberAt(record, "verdict") == table.but)) return;
        if (!table.where.empty() && memberAt(record, table.where) != table.is) return;
        for (auto at = path.rfind('.'); at != path.npos && at > 0; at = path.rfind('.', at - 1)) {
            for (const char* key : {"unit", "quantity"}) {
                const auto& whole = memberAt(results, path.substr(0, at) + '.' + key);
                if (!record.contains(key) && whole.is_string()) record[key] = whole;
            }
        }
        if (several && !record.contains("of")) record["of"] = path.empty() ? "all" : path;
        rows.push_back(std::move(record));
    };
    for (const auto& path : partsOf(table.at)) {
        const auto& found = memberAt(results, path);
        if (!found.is_array()) {
            take(found, path);
        } else {
            for (const auto& record : found) take(record, path);
        }
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
        for (const auto& path : partsOf(table.at)) keep(path);
        if (!table.at.empty()) continue;
        for (const auto& column : table.columns) keep(column.at);
    }
    return shown;
}

namespace describe {

Columns under(const std::string& place, Columns columns) {
    for (auto& column : columns) column.at = column.at.empty() ? place : place + '.' + column.at;
    return columns;
}

ResultTable under(const std::string& place, ResultTable table) {
    if (table.at.empty()) {
        table.columns = under(place, std::move(table.columns));
    } else {
        table.at = place + '.' + table.at;
    }
    return table;
}

}  // namespace describe

}  // namespace tacto
