// LimitMatrix.h - a table of limits against loads: for each limit the value measured on each load and the margin left,
// and whether the output ended by itself on an open and on a short circuit. Made only from the rows of a load-safety
// check.
#pragma once

#include <nlohmann/json.hpp>
#include <optional>

#include "core/analysis/load_safety/LoadSafety.h"
#include "core/results/ResultTable.h"

namespace tacto {

/// Name of the column with the values extrapolated over the permitted load range.
inline constexpr const char* kExtrapolatedColumn = "worst case";

struct LimitCell {
    /// For a trip: the time to the end of output, counted from the detecting train if known, else from the change.
    double value = std::numeric_limits<double>::quiet_NaN();
    double expanded = std::numeric_limits<double>::quiet_NaN();  ///< U, in the value's unit
    /// (limit - value - U) / limit; negative: limit not kept. For a trip: share of the allowed time that was left.
    double margin_pct = std::numeric_limits<double>::quiet_NaN();
    RowVerdict verdict = RowVerdict::NotEvaluated;
    std::string note{};  ///< the row's note, for example the measured value next to a command
};

struct LimitLine {
    std::string item, title, unit, set;
    double limit = std::numeric_limits<double>::quiet_NaN();  ///< NaN: output must end before the next train (H3)
    bool strict = false;                                      ///< true for "<", false for "≤"
    std::string source;                                       ///< document and clause
    std::string confidence;  ///< how certain the source is, as in its limit set; empty for own limits
    double margin_pct = std::numeric_limits<double>::quiet_NaN();  ///< the smallest margin of all cells
    std::size_t worst = 0;                                         ///< index of the load with that margin
    RowVerdict verdict = RowVerdict::NotEvaluated;                 ///< summaryOf() of the cells; or attention
    std::vector<std::optional<LimitCell>> cells;                   ///< one per load; empty if no limit applies there
};

struct LimitMatrix {
    std::vector<std::string> loads;  ///< the loads in the order of the rows; kExtrapolatedColumn is last
    /// Sorted: failed limits first, then indeterminate ones, then by margin left; limits not evaluated come last.
    std::vector<LimitLine> lines;
};

/// `sets`: the limit sets that `found` was judged by. They supply the comparison sign and how certain the source is.
[[nodiscard]] LimitMatrix limitMatrixOf(const LoadSafety& found, const std::vector<LimitSet>& sets);

/// {"loads": [...], "lines": [{"item","title","unit","set","limit" (null: NaN),"compare","source","confidence",
/// "margin_pct","worst_load","verdict",
/// "cells": [null or {"load","value","expanded_uncertainty","margin_pct","note","verdict"}]}]}
[[nodiscard]] nlohmann::json toJson(const LimitMatrix& matrix);
/// Returns the columns that a table of these lines shows.
[[nodiscard]] std::vector<ResultColumn> limitColumns();

}  // namespace tacto
