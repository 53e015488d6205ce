#include "core/analysis/load_safety/LoadSafety.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "core/analysis/load_safety/LoadSafetyRows.h"
#include "core/base/Words.h"

namespace tacto {

namespace {

bool isTrip(const LoadRecord& record) {
    return record.load.kind == LoadKind::Open || record.load.kind == LoadKind::Short;
}

LoadLine lineOf(const LoadRecord& record, const LoadSafetyInput& input, const std::vector<SafetyRow>& rows) {
    LoadLine line;
    line.name = record.name;
    line.serial = record.serial;
    line.nominal_ohm = expectedOhms(record, input);
    line.steps = record.steps.size();
    line.refused = static_cast<std::size_t>(
        std::count_if(record.refusals.begin(), record.refusals.end(), [](const auto& asked) { return asked.refused; }));
    if (!record.steps.empty()) {
        line.measured_ohm = record.steps.front().reading.impedance_ohm;
        line.strongest = strongestOf(record);
        line.powerDensity_w_cm2 = readingOf(line.strongest, Quantity::PowerDensity, input).value;
        line.currentDensity_ma_cm2 = readingOf(line.strongest, Quantity::CurrentDensity, input).value;
    }
    std::vector<RowVerdict> verdicts;
    for (const auto& row : rows) verdicts.push_back(row.verdict);
    line.verdict = summaryOf(verdicts);
    return line;
}

SafetyRow missing(std::string load, std::string item, std::string title, std::string reason) {
    SafetyRow row;
    row.load = std::move(load);
    row.item = std::move(item);
    row.title = std::move(title);
    row.reason = std::move(reason);
    return row;
}

void addMissingLoads(const LoadSafetyInput& input, LoadSafety& out) {
    for (const auto& wanted : benchLoads()) {
        const auto same = [&](const LoadRecord& record) { return record.load == wanted.load; };
        if (std::any_of(input.loads.begin(), input.loads.end(), same)) continue;
        LoadLine line;
        line.name = wanted.name;
        out.loads.push_back(std::move(line));
        out.rows.push_back(missing(std::string(wanted.name), "load", "the load",
                                   fmt::format("{} was not evaluated: it was not reached", wanted.name)));
    }
}

/// True if a row lacks only the electrode's area. Such rows share one sentence.
bool waitsForArea(const SafetyRow& row, const LoadSafetyInput& input) {
    const auto quantity = quantityOf(row.item);
    return !input.area_cm2 && quantity && needsArea(*quantity) && row.verdict == RowVerdict::NotEvaluated;
}

bool isReference(const SafetyRow& row) {
    return row.item == "reference" || row.item == "absolute_reference" || row.item == "time_reference";
}

/// Describes the passed rows truthfully: a command has no uncertainty, and a trip is judged by its time.
std::string whatPassed(const std::vector<SafetyRow>& rows) {
    std::size_t withU = 0, trips = 0, commanded = 0, others = 0;
    for (const auto& row : rows) {
        if (row.verdict != RowVerdict::Pass) continue;
        ++(row.basis == RowBasis::Commanded ? commanded
           : row.item == "trip"             ? trips
           : row.expanded >= 0              ? withU
                                            : others);
    }
    std::string text = fmt::format("{} values with their uncertainty inside their limits", withU);
    const auto add = [&text](std::size_t count, std::string_view what) {
        if (count > 0) text += fmt::format(", {} {}", count, what);
    };
    add(commanded, "as commanded");
    add(trips, "by the end of output in time");
    add(others, "without a value");
    return text;
}

void decide(const LoadSafetyInput& input, LoadSafety& out) {
    bool areaSaid = false;
    const auto collect = [&](RowVerdict verdict) {
        for (const auto* rows : {&out.rows, &out.worstCase.rows}) {
            for (const auto& row : *rows) {
                if (row.verdict != verdict || row.reason.empty() || isReference(row)) continue;
                if (!waitsForArea(row, input)) {
                    out.reasons.push_back(row.reason);
                } else if (!std::exchange(areaSaid, true)) {
                    out.reasons.emplace_back(
                        "current and power density were not evaluated on any load: the electrode's area is not known");
                }
            }
        }
    };
    std::vector<RowVerdict> verdicts{out.worstCase.verdict};
    for (const auto& row : out.rows) verdicts.push_back(row.verdict);
    const auto summary = summaryOf(verdicts);
    out.verdict = summary == RowVerdict::Fail   ? Verdict::Fail
                  : summary == RowVerdict::Pass ? Verdict::Pass
                                                : Verdict::Indeterminate;
    if (out.verdict == Verdict::Pass) {
        const auto count = [&verdicts](RowVerdict verdict) {
            return std::count(verdicts.begin() + 1, verdicts.end(), verdict);
        };
        const auto refused = count(RowVerdict::RefusedAsExpected);
        out.reasons.push_back(fmt::format(
            "{} checks on {} loads passed: {}{}", count(RowVerdict::Pass), out.loads.size(), whatPassed(out.rows),
            refused == 0   ? ""
            : refused == 1 ? "; the one command that must be refused was refused"
            : refused == 2 ? "; both commands that must be refused were refused"
                           : fmt::format("; all {} commands that must be refused were refused", refused)));
    }
    // If the known load does not read as it should, no further measurement was made.
    for (const auto& row : out.rows) {
        if (isReference(row) && row.verdict != RowVerdict::Pass) out.reasons.push_back(row.reason);
    }
    for (const auto verdict : {RowVerdict::Fail, RowVerdict::Indeterminate, RowVerdict::NotEvaluated,
                               RowVerdict::NotApplicable, RowVerdict::Attention}) {
        collect(verdict);
    }
}

constexpr Word<RowBasis> kRowBasisWords[] = {
    {"measured", RowBasis::Measured}, {"commanded", RowBasis::Commanded}, {"computed", RowBasis::Computed}};
constexpr Word<RowVerdict> kRowVerdictWords[] = {{"pass", RowVerdict::Pass},
                                                 {"fail", RowVerdict::Fail},
                                                 {"indeterminate", RowVerdict::Indeterminate},
                                                 {"not evaluated", RowVerdict::NotEvaluated},
                                                 {"not applicable", RowVerdict::NotApplicable},
                                                 {"refused as expected", RowVerdict::RefusedAsExpected},
                                                 {"attention", RowVerdict::Attention}};
}  // namespace

std::string_view nameOf(RowVerdict verdict) noexcept { return wordFor(kRowVerdictWords, verdict); }
std::string_view nameOf(RowBasis basis) noexcept { return wordFor(kRowBasisWords, basis); }

RowVerdict judgeUpper(double value, double expanded, double limit, bool strict) noexcept {
    if (!std::isfinite(value) || !(expanded >= 0) || std::isnan(limit)) return RowVerdict::NotEvaluated;
    const auto keeps = [&](double v) { return strict ? v < limit : v <= limit; };
    if (keeps(value + expanded)) return RowVerdict::Pass;
    return keeps(value - expanded) ? RowVerdict::Indeterminate : RowVerdict::Fail;
}

RowVerdict summaryOf(const std::vector<RowVerdict>& verdicts) noexcept {
    if (verdicts.empty()) return RowVerdict::NotEvaluated;
    const auto has = [&](RowVerdict wanted) {
        return std::find(verdicts.begin(), verdicts.end(), wanted) != verdicts.end();
    };
    for (const auto worst : {RowVerdict::Fail, RowVerdict::Indeterminate, RowVerdict::NotEvaluated}) {
        if (has(worst)) return worst;
    }
    if (has(RowVerdict::Pass) || has(RowVerdict::Attention)) return RowVerdict::Pass;
    return has(RowVerdict::RefusedAsExpected) ? RowVerdict::RefusedAsExpected : RowVerdict::NotApplicable;
}

LoadSafety judgeLoadSafety(const LoadSafetyInput& input) {
    LoadSafety out;
    for (const auto& record : input.loads) {
        if (isTrip(record)) {
            // This record is judged only by its trips; its rows are among the rows of the trips.
            LoadLine line;
            line.name = record.name;
            std::vector<RowVerdict> verdicts;
            for (const auto& trip : tripRows(input))
                if (trip.load == record.name) verdicts.push_back(trip.verdict);
            line.verdict = summaryOf(verdicts);
            out.loads.push_back(std::move(line));
            continue;
        }
        auto rows = rowsOf(record, input);
        out.loads.push_back(lineOf(record, input, rows));
        out.rows.insert(out.rows.end(), std::make_move_iterator(rows.begin()), std::make_move_iterator(rows.end()));
    }
    addMissingLoads(input, out);
    if (input.reference) {
        out.rows.push_back(*input.reference);
    } else {
        out.rows.push_back(missing("", "reference", "known-reference check", "the known-reference check was not made"));
    }
    for (const auto& also : {input.time, input.absolute})
        if (also) out.rows.push_back(*also);
    for (auto& row : openCircuitRows(input)) out.rows.push_back(std::move(row));
    for (auto& row : tripRows(input)) out.rows.push_back(std::move(row));
    if (input.limits.empty()) {
        out.rows.push_back(missing("", "limits", "limits", "no limit set was given: nothing can be called safe"));
    }
    out.disclosed = disclosedOf(input);
    out.worstCase = worstCaseOf(input);
    decide(input, out);
    return out;
}

}  // namespace tacto
