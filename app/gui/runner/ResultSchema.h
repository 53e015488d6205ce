// ResultSchema.h - how each kind of result is read: which tables it has, in which order, with which columns. The one
// place that knows the keys of results; what is not named here is not shown, and is in the session.
//
// Thread-safety: pure functions.
#pragma once

#include <string_view>
#include <vector>

#include "app/gui/theme/RecordColumns.h"

namespace tacto::gui {

struct ResultTable {
    enum class Shape {
        Facts,       ///< one record as a form; members that it does not have are left out
        Rows,        ///< a list of records; one that is empty or missing is left out
        Sentences,   ///< a list of texts
        Confusion,   ///< counts, row by column
        Calibration  ///< one calibrated quantity: CalibrationResult
    };
    QString title;
    std::string at;  ///< "changes.groups"; empty: the results themselves
    Shape shape = Shape::Rows;
    std::vector<RecordColumn> columns{};
    std::string but{};  ///< Rows: those with this verdict are left out, as they say nothing
};

/// The tables of a kind ("separability"), in the order in which they are read. One that is not known has none.
[[nodiscard]] const std::vector<ResultTable>& tablesOf(std::string_view kind);

/// For results of a kind that is not known, a lab's own: their numbers, texts and lists of records, with the words of
/// their keys. What is nested deeper is left out.
[[nodiscard]] std::vector<ResultTable> tablesIn(const nlohmann::json& results);

}  // namespace tacto::gui
