// Describe.h - columns and tables of results in few words.
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
/// Reports have it as a figure.
inline ResultTable confusion(const char* title = "Presented and recognised") {
    return {.title = title, .at = "confusion", .shape = Shape::Confusion, .shown = Else::InTheReport};
}
inline ResultTable across(const char* title, const char* at, Columns columns, Else shown = Else::Nowhere) {
    return {.title = title, .at = at, .shape = Shape::Across, .columns = std::move(columns), .shown = shown};
}
/// Those records alone of which a member is that.
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

/// The same of a record that is the member `place`.
[[nodiscard]] Columns under(const std::string& place, Columns columns);
[[nodiscard]] ResultTable under(const std::string& place, ResultTable table);

/// With what every run with an oscilloscope rests on; reports have that on their first page.
[[nodiscard]] Tables withBasis(Tables tables);

}  // namespace tacto::describe
