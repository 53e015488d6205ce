#include "core/analysis/load_safety/LimitMatrix.h"

#include <algorithm>
#include <cmath>
#include <tuple>

#include "core/analysis/statistics/StatisticsJson.h"
#include "core/results/ResultRecord.h"

namespace tacto {

namespace {

using nlohmann::json;

bool isTripRow(const SafetyRow& row) { return row.item == "trip"; }

bool isShown(const SafetyRow& row) {
    if (row.load.empty() || row.item == "reference" || row.item == "time_reference") return false;
    return isTripRow(row) || (std::isfinite(row.limit) && row.limit > 0);
}

LimitCell cellOf(const SafetyRow& row) {
    LimitCell cell{row.value, row.expanded, std::nan(""), row.verdict, row.note};
    if (std::isfinite(row.stop_s)) {
        cell.value = row.stop_s;
        cell.margin_pct = 100 * (1 - row.stop_s / row.allowed_s);
    }
    if (row.basis == RowBasis::Commanded) cell.expanded = 0;  // a command is known exactly
    if (std::isfinite(row.limit) && std::isfinite(cell.value) && cell.expanded >= 0)
        cell.margin_pct = 100 * (row.limit - cell.value - cell.expanded) / row.limit;
    return cell;
}

/// Output must end by itself whether or not trains run when the circuit opens. Returns the worse verdict, and the
/// longer time unless one of the two cells was timed against the next train.
LimitCell worseOf(const LimitCell& a, const LimitCell& b) {
    const bool timed = std::isfinite(a.margin_pct) || std::isfinite(b.margin_pct);
    auto worse = std::isfinite(b.margin_pct) ? b : a;
    if (!timed) worse.value = std::fmax(a.value, b.value);
    worse.verdict = summaryOf({a.verdict, b.verdict});
    if (worse.verdict != RowVerdict::Pass) worse.margin_pct = kNaN;
    return worse;
}

/// Copies what the limit set says about the limit. The laboratory's own limits belong to no set.
void fillFromSets(LimitLine& line, const std::vector<LimitSet>& sets) {
    const auto set = std::find_if(sets.begin(), sets.end(), [&](const LimitSet& each) { return each.id == line.set; });
    if (set == sets.end()) return;
    for (const auto& row : set->rows) {
        if (keyOf(row.quantity) != line.item || row.max != line.limit || row.source != line.source) continue;
        line.strict = row.strict;
        line.confidence = nameOf(row.confidence);
        return;
    }
    for (const auto& asked : set->accuracy) {
        if (asked.parameter + "_accuracy" == line.item) line.confidence = nameOf(asked.confidence);
    }
}

void summarise(LimitLine& line) {
    std::vector<RowVerdict> verdicts;
    for (std::size_t i = 0; i < line.cells.size(); ++i) {
        if (!line.cells[i]) continue;
        const auto& cell = *line.cells[i];
        verdicts.push_back(cell.verdict);
        // Net charge that is only reported, not judged, has no margin.
        if (cell.verdict == RowVerdict::NotApplicable || !std::isfinite(cell.margin_pct)) continue;
        if (!(line.margin_pct <= cell.margin_pct)) line.margin_pct = cell.margin_pct, line.worst = i;
    }
    line.verdict = summaryOf(verdicts);
    const bool warned = std::find(verdicts.begin(), verdicts.end(), RowVerdict::Attention) != verdicts.end();
    if (line.verdict == RowVerdict::Pass && warned) line.verdict = RowVerdict::Attention;
}

int rankOf(RowVerdict verdict) {
    switch (verdict) {
        case RowVerdict::Fail:
            return 0;
        case RowVerdict::Indeterminate:
            return 1;
        case RowVerdict::Pass:
        case RowVerdict::Attention:
        case RowVerdict::RefusedAsExpected:
            return 2;
        case RowVerdict::NotEvaluated:
            return 3;
        case RowVerdict::NotApplicable:
            return 4;
    }
    return 3;
}

}  // namespace

LimitMatrix limitMatrixOf(const LoadSafety& found, const std::vector<LimitSet>& sets) {
    LimitMatrix matrix;
    const auto columnOf = [&](const std::string& load) {
        const auto at = std::find(matrix.loads.begin(), matrix.loads.end(), load);
        if (at != matrix.loads.end()) return static_cast<std::size_t>(at - matrix.loads.begin());
        matrix.loads.push_back(load);
        return matrix.loads.size() - 1;
    };
    const auto add = [&](const SafetyRow& row, const std::string& load) {
        if (!isShown(row)) return;
        const auto column = columnOf(load);
        const auto same = [&](const LimitLine& line) {
            return line.item == row.item && line.set == row.set && line.source == row.source &&
                   (line.limit == row.limit || isTripRow(row));
        };
        auto line = std::find_if(matrix.lines.begin(), matrix.lines.end(), same);
        if (line == matrix.lines.end()) {
            LimitLine begun;
            begun.item = row.item, begun.title = isTripRow(row) ? "output ends by itself" : row.title;
            begun.unit = isTripRow(row) ? "s" : row.unit, begun.set = row.set;
            begun.limit = row.limit, begun.source = row.source;
            line = matrix.lines.insert(matrix.lines.end(), std::move(begun));
        }
        if (line->cells.size() <= column) line->cells.resize(column + 1);
        auto& cell = line->cells[column];
        cell = cell && isTripRow(row) ? worseOf(*cell, cellOf(row)) : cellOf(row);
    };
    for (const auto& row : found.rows) add(row, row.load);
    for (const auto& row : found.worstCase.rows) add(row, kExtrapolatedColumn);
    for (auto& line : matrix.lines) {
        line.cells.resize(matrix.loads.size());
        fillFromSets(line, sets);
        summarise(line);
    }
    const auto order = [](const LimitLine& line) {
        // A trip without a measured time has no margin and comes first in its rank. Other limits without one come last.
        const double without = line.item == "trip" ? -1e9 : 1e9;
        return std::tuple(rankOf(line.verdict), std::isfinite(line.margin_pct) ? line.margin_pct : without);
    };
    std::stable_sort(matrix.lines.begin(), matrix.lines.end(),
                     [&](const LimitLine& a, const LimitLine& b) { return order(a) < order(b); });
    return matrix;
}

namespace {

using namespace describe;

/// A cell together with the name of the load in its column.
struct PlacedCell {
    std::string load;
    LimitCell cell;
};

ResultRecord<PlacedCell> describeCell() {
    using P = PlacedCell;
    ResultRecord<P> all;
    all.kept("load", &P::load);
    all.kept("value", in(&P::cell, &LimitCell::value));
    all.kept("expanded_uncertainty", in(&P::cell, &LimitCell::expanded));
    all.kept("margin_pct", in(&P::cell, &LimitCell::margin_pct));
    all.kept("note", nullIfEmpty(in(&P::cell, &LimitCell::note)));
    all.kept("verdict", in(&P::cell, &LimitCell::verdict));
    return all;
}

ResultRecord<LimitLine> describeLine() {
    using L = LimitLine;
    ResultRecord<L> all;
    all.kept("item", &L::item);
    all.shown(as(As::Heading, "Requirement", "title"), &L::title);
    all.kept("unit", &L::unit);
    all.kept("set", &L::set);
    all.shown({"Limit", "limit", As::Limit, "@unit", "compare"}, &L::limit);
    all.kept("compare", [](const L& line) { return line.strict ? "<" : "<="; });
    all.shown(text("Source", "source"), &L::source);
    all.shown(text("Confidence", "confidence"), nullIfEmpty(&L::confidence));
    all.kept("margin_pct", &L::margin_pct);
    all.kept("verdict", &L::verdict);
    return all;
}

}  // namespace

json toJson(const LimitMatrix& matrix) {
    json lines = json::array();
    for (const auto& line : matrix.lines) {
        auto row = builtOnce<describeLine>().write(line);
        row["worst_load"] = std::isfinite(line.margin_pct) ? json(matrix.loads[line.worst]) : json();
        row["cells"] = json::array();
        for (std::size_t i = 0; i < line.cells.size(); ++i) {
            row["cells"].push_back(line.cells[i] ? builtOnce<describeCell>().write({matrix.loads[i], *line.cells[i]})
                                                 : json());
        }
        lines.push_back(std::move(row));
    }
    return {{"loads", matrix.loads}, {"lines", std::move(lines)}};
}

std::vector<ResultColumn> limitColumns() { return builtOnce<describeLine>().columns(); }

}  // namespace tacto
