// ResultTable.h - describes how results are shown: the tables of a kind, their order and columns. The window, the
// terminal and reports all use it. A member that is not listed is kept in the session but not shown.
#pragma once

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

namespace tacto {

struct ResultColumn {
    enum class As {
        Text,
        Heading,    ///< the subject of a record, as the start of a sentence
        Number,     ///< with U, standard deviation or interval if the member has one
        Spread,     ///< a standard deviation, or a deviation without U: two digits
        Tolerance,  ///< "± 0.5 %": two digits at most
        Jnd,        ///< a distance in just-noticeable differences: two decimals
        AtLeast,    ///< a number with its one-sided 95 % lower bound
        Chance,     ///< a probability; small ones as "< 0.001"
        Share,      ///< a share of 1, in %; `beside` may name its one-sided 95 % upper bound
        Used,       ///< used part of a limit or tolerance; with `beside`, (|number| + U) / @unit
        Freedom,    ///< degrees of freedom; infinite without a number
        Limit,      ///< "≤ 40 V"; `beside`: comparison sign; no number: a rule in words
        YesNo,
        Verdict,
        Load,
        LimitSet,
        Quantity,  ///< a calibrated quantity by its id: "Phase width" for "width"
        Condition  ///< a pilot's condition or answer: "rough, firm" for "rough-high"
    };
    std::string title{};
    std::string at{};  ///< the member; "a.b" for a nested member; "a-b" for the difference of a number and another
    As as = As::Text;
    std::string unit{};    ///< unit of a number; "@b": the record's member b states it
    std::string beside{};  ///< the member shown next to it: U (95 %) in the number's unit, or the bound
};

struct ResultTable {
    enum class Shape {
        Facts,      ///< one record as a form; absent members are left out
        Rows,       ///< a list of records; left out if empty or missing
        Sentences,  ///< one text or a list of texts
        Confusion,  ///< a matrix of counts
        Limits,     ///< limits against loads, as toJson(LimitMatrix)
        Across      ///< records side by side, one column each; rows without any measured value are left out
    };
    /// Other places that show this table's content.
    enum class Else {
        Nowhere,
        InTheReport,    ///< a report shows it as a figure, a matrix or on its first page
        InTheTerminal,  ///< not in the terminal, because it is too long for a screen
        InBoth,
        InTheWindow,     ///< the window shows it in a separate panel
        OnlyInTheReport  ///< window and terminal show it shorter, or next to the matrix
    };
    std::string title{};
    std::string at{};  ///< "changes.groups"; empty: the results themselves; "a|b": the records a and b as rows
    Shape shape = Shape::Rows;
    std::vector<ResultColumn> columns{};
    std::string but{};            ///< Rows: leaves out records with this verdict
    std::string where{};          ///< Rows: keeps only records in which this member
    nlohmann::json is = nullptr;  ///< has this value
    std::string note{};           ///< a note for readers, below the table
    Else shown = Else::Nowhere;
};

[[nodiscard]] constexpr bool isInReport(ResultTable::Else shown) noexcept {
    return shown != ResultTable::Else::InTheReport && shown != ResultTable::Else::InBoth;
}
[[nodiscard]] constexpr bool isInTerminal(ResultTable::Else shown) noexcept {
    using Else = ResultTable::Else;
    return shown != Else::InTheTerminal && shown != Else::InBoth && shown != Else::OnlyInTheReport;
}
[[nodiscard]] constexpr bool isInWindow(ResultTable::Else shown) noexcept {
    return shown != ResultTable::Else::InTheWindow && shown != ResultTable::Else::OnlyInTheReport;
}

/// Returns the member at "a.b"; null if it does not exist.
[[nodiscard]] const nlohmann::json& memberAt(const nlohmann::json& record, const std::string& path);

/// Returns the rows of a table: all records that are objects, without the excluded verdict. A record without `unit` or
/// `quantity` gets those of its parent record. If there are several parents, `of` names the one.
[[nodiscard]] nlohmann::json rowsOf(const ResultTable& table, const nlohmann::json& results);

/// Returns the part of `results` that the tables show, at the same paths. Reports keep this part.
[[nodiscard]] nlohmann::json shownIn(const std::vector<ResultTable>& tables, const nlohmann::json& results);

}  // namespace tacto
