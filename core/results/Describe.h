// Describe.h - short functions that make columns and tables of results.
#pragma once

#include <string>
#include <utility>

#include "core/results/ResultKind.h"

namespace tacto::describe {

using As = ResultColumn::As;
using Shape = ResultTable::Shape;
using Else = ResultTable::Else;
using Columns = std::vector<ResultColumn>;
using Tables = std::vector<ResultTable>;
using Kinds = std::vector<ResultTraits>;

inline ResultColumn text(const char* title, const char* at) { return {title, at}; }
inline ResultColumn number(const char* title, const char* at, const char* unit = "", const char* uncertainty = "") {
    return {title, at, As::Number, unit, uncertainty};
}
inline ResultColumn spread(const char* title, const char* at, const char* unit) {
    return {title, at, As::Spread, unit};
}
inline ResultColumn tolerance(const char* title, const char* at, const char* unit) {
    return {title, at, As::Tolerance, unit};
}
inline ResultColumn as(As as, const char* title, const char* at, const char* beside = "") {
    return {title, at, as, "", beside};
}
inline ResultColumn jnd(const char* title, const char* at) { return as(As::Jnd, title, at); }
inline ResultColumn verdict() { return as(As::Verdict, "Verdict", "verdict"); }

inline ResultTable facts(const char* title, const char* at, Columns columns, Else shown = Else::Nowhere) {
    return {.title = title, .at = at, .shape = Shape::Facts, .columns = std::move(columns), .shown = shown};
}
inline ResultTable rows(const char* title, const char* at, Columns columns, Else shown = Else::Nowhere) {
    return {.title = title, .at = at, .columns = std::move(columns), .shown = shown};
}
inline ResultTable sentences(const char* title, const char* at, Else shown = Else::Nowhere) {
    return {.title = title, .at = at, .shape = Shape::Sentences, .shown = shown};
}
/// A confusion matrix; reports show it as a figure.
inline ResultTable confusion(const char* title = "Presented and recognised") {
    return {.title = title, .at = "confusion", .shape = Shape::Confusion, .shown = Else::InTheReport};
}
inline ResultTable across(const char* title, const char* at, Columns columns, Else shown = Else::Nowhere) {
    return {.title = title, .at = at, .shape = Shape::Across, .columns = std::move(columns), .shown = shown};
}
/// Limits the table to records whose member has this value.
inline ResultTable whose(ResultTable table, const char* member, nlohmann::json is) {
    table.where = member;
    table.is = std::move(is);
    return table;
}
inline ResultTable failing(ResultTable table) {
    table.but = "pass";
    return table;
}
inline ResultTable noted(ResultTable table, const char* note) {
    table.note = note;
    return table;
}

/// Moves columns or a table to a record that is the member `place`.
[[nodiscard]] Columns under(const std::string& place, Columns columns);
[[nodiscard]] ResultTable under(const std::string& place, ResultTable table);

/// Adds the tables on references and instruments that all oscilloscope runs have; reports show them on page one.
[[nodiscard]] Tables withBasis(Tables tables);

}  // namespace tacto::describe
