// ResultTable.h - how results are shown: which tables a kind has, in which order, with which columns. Window, terminal
// and report all go by it; what is not named here is not shown, and is in the session.
//
// Thread-safety: pure functions.
#pragma once

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

namespace tacto {

struct ResultColumn {
    enum class As {
        Text,
        Number,     ///< with U, a standard deviation or an interval where the member has one
        Spread,     ///< a standard deviation, or a deviation without its U: two digits
        Tolerance,  ///< "± 0.5 %": two digits at most
        Jnd,        ///< a distance in just-noticeable differences: two decimals
        AtLeast,    ///< a number with its one-sided 95 % lower bound
        Share,      ///< of one, in %; where `beside` names one, with its one-sided 95 % upper bound
        Used,       ///< how much of a limit or a tolerance is used, of one
        YesNo,
        Verdict,
        Load,
        LimitSet,
        Quantity  ///< a calibrated one by its id: "Phase width" of "width"
    };
    std::string title{};
    std::string at{};  ///< the member; "a.b" for a member of a member
    As as = As::Text;
    std::string unit{};    ///< of a number; "@b": the record's own, which its member b states
    std::string beside{};  ///< the member that stands beside it: U (95 %) in the number's unit, or the bound
};

struct ResultTable {
    enum class Shape {
        Facts,       ///< one record as a form; members that it does not have are left out
        Rows,        ///< a list of records; one that is empty or missing is left out
        Sentences,   ///< a list of texts, or one
        Confusion,   ///< counts, row by column
        Calibration  ///< one calibrated quantity: levels, budget, marked readings
    };
    /// Where else it is shown, or shown better.
    enum class Else {
        Nowhere,
        InTheReport,    ///< a report has it as a figure, a matrix or on its first page
        InTheTerminal,  ///< the terminal leaves it out: too long for a screen
        InBoth,
        InTheWindow  ///< the window has what it says in a panel of its own
    };
    std::string title{};
    std::string at{};  ///< "changes.groups"; empty: the results themselves; "a|b": the records a and b as rows
    Shape shape = Shape::Rows;
    std::vector<ResultColumn> columns{};
    std::string but{};   ///< Rows: those with this verdict are left out, as they say nothing
    std::string note{};  ///< what a reader has to know of it; below it
    Else shown = Else::Nowhere;
};

[[nodiscard]] constexpr bool isInReport(ResultTable::Else shown) noexcept {
    return shown != ResultTable::Else::InTheReport && shown != ResultTable::Else::InBoth;
}
[[nodiscard]] constexpr bool isInTerminal(ResultTable::Else shown) noexcept {
    return shown != ResultTable::Else::InTheTerminal && shown != ResultTable::Else::InBoth;
}

/// The member at "a.b"; null where there is none.
[[nodiscard]] const nlohmann::json& memberAt(const nlohmann::json& record, const std::string& path);

/// The records of a table of Rows: those that are objects, without those of the verdict that is left out.
[[nodiscard]] nlohmann::json rowsOf(const ResultTable& table, const nlohmann::json& results);

/// What of `results` the tables show, in its own places: what a report keeps.
[[nodiscard]] nlohmann::json shownIn(const std::vector<ResultTable>& tables, const nlohmann::json& results);

}  // namespace tacto
