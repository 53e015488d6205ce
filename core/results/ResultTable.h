// ResultTable.h - how results are shown: which tables a kind has, in which order, with which columns. Window, terminal
// and report all go by it; what is not named here is not shown, and is in the session.
#pragma once

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

namespace tacto {

struct ResultColumn {
    enum class As {
        Text,
        Heading,    ///< what a record is about, as a sentence begins
        Number,     ///< with U, a standard deviation or an interval where the member has one
        Spread,     ///< a standard deviation, or a deviation without its U: two digits
        Tolerance,  ///< "± 0.5 %": two digits at most
        Jnd,        ///< a distance in just-noticeable differences: two decimals
        AtLeast,    ///< a number with its one-sided 95 % lower bound
        Chance,     ///< a probability: "< 0.001" below that
        Share,      ///< of one, in %; where `beside` names one, with its one-sided 95 % upper bound
        Used,       ///< how much of a limit or a tolerance is used, of one; with `beside`, |number| + U over @unit
        Freedom,    ///< degrees of freedom: without end where there is no number
        Limit,      ///< "≤ 40 V"; `beside` says how it is compared; without one a rule in words
        YesNo,
        Verdict,
        Load,
        LimitSet,
        Quantity,  ///< a calibrated one by its id: "Phase width" of "width"
        Condition  ///< of a pilot, or an answer: "rough, firm" of "rough-high"
    };
    std::string title{};
    std::string at{};  ///< the member; "a.b" for a member of a member; "a-b" for what a number is above another
    As as = As::Text;
    std::string unit{};    ///< of a number; "@b": the record's own, which its member b states
    std::string beside{};  ///< the member that stands beside it: U (95 %) in the number's unit, or the bound
};

struct ResultTable {
    enum class Shape {
        Facts,      ///< one record as a form; members that it does not have are left out
        Rows,       ///< a list of records; one that is empty or missing is left out
        Sentences,  ///< a list of texts, or one
        Confusion,  ///< counts, row by column
        Limits,     ///< limits against loads, as toJson(LimitMatrix)
        Across      ///< a list of records that stand beside each other, a column each; what was measured in none is not
    };
    /// Where else it is shown, or shown better.
    enum class Else {
        Nowhere,
        InTheReport,    ///< a report has it as a figure, a matrix or on its first page
        InTheTerminal,  ///< the terminal leaves it out: too long for a screen
        InBoth,
        InTheWindow,     ///< the window has what it says in a panel of its own
        OnlyInTheReport  ///< window and terminal say it in fewer words, or beside the matrix
    };
    std::string title{};
    std::string at{};  ///< "changes.groups"; empty: the results themselves; "a|b": the records a and b as rows
    Shape shape = Shape::Rows;
    std::vector<ResultColumn> columns{};
    std::string but{};            ///< Rows: those with this verdict are left out, as they say nothing
    std::string where{};          ///< Rows: those alone of which this member
    nlohmann::json is = nullptr;  ///< is this
    std::string note{};           ///< what a reader has to know of it; below it
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

/// The member at "a.b"; null where there is none.
[[nodiscard]] const nlohmann::json& memberAt(const nlohmann::json& record, const std::string& path);

/// The records of a table of Rows: those that are objects, without those of the verdict that is left out. A record
/// without a `unit` or a `quantity` of its own has those of what it is a part of; of several, `of` says which it is.
[[nodiscard]] nlohmann::json rowsOf(const ResultTable& table, const nlohmann::json& results);

/// What of `results` the tables show, in its own places: what a report keeps.
[[nodiscard]] nlohmann::json shownIn(const std::vector<ResultTable>& tables, const nlohmann::json& results);

}  // namespace tacto
