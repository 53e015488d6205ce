// LimitMatrix.h - limits x loads: every limit once, what was measured against it on each load, and how much of the
// limit is left; and whether the output ended by itself on an open and on a short circuit. Made from the rows of a
// load-safety check, so that it can say nothing that they do not.
#pragma once

#include <nlohmann/json.hpp>
#include <optional>

#include "core/analysis/load_safety/LoadSafety.h"
#include "core/results/ResultTable.h"

namespace tacto {

/// The column of what is extrapolated over the permitted loads.
inline constexpr const char* kExtrapolatedColumn = "worst case";

struct LimitCell {
    /// In a trip, the time to the end of output: from the train that found it where known, else from the change.
    double value = std::numeric_limits<double>::quiet_NaN();
    double expanded = std::numeric_limits<double>::quiet_NaN();  ///< U, in the value's unit
    /// (limit - value - U) / limit; below 0: not kept. For a trip what was left of the time to the next train.
    double margin_pct = std::numeric_limits<double>::quiet_NaN();
    RowVerdict verdict = RowVerdict::NotEvaluated;
    std::string note{};  ///< the row's note: what was measured beside a command
};

struct LimitLine {
    std::string item, title, unit, set;
    double limit = std::numeric_limits<double>::quiet_NaN();  ///< NaN: output must end before the next train (H3)
    bool strict = false;                                      ///< whether it is "<" and not "≤"
    std::string source;                                       ///< document and clause
    std::string confidence;  ///< in that source, as its limit set states it; empty for this program's own
    double margin_pct = std::numeric_limits<double>::quiet_NaN();  ///< the smallest of the cells
    std::size_t worst = 0;                                         ///< the cell that has it, an index into the loads
    RowVerdict verdict = RowVerdict::NotEvaluated;                 ///< summaryOf() the cells; attention where one is
    std::vector<std::optional<LimitCell>> cells;                   ///< as LimitMatrix::loads; empty: asks nothing there
};

struct LimitMatrix {
    std::vector<std::string> loads;  ///< the loads in the order of the rows; kExtrapolatedColumn is last
    /// Failed limits come first, then indeterminate ones, then by the margin left; those not evaluated stand last.
    std::vector<LimitLine> lines;
};

/// `sets`: those that `found` was judged by; they say what kind of limit it is and how sure its source.
[[nodiscard]] LimitMatrix limitMatrixOf(const LoadSafety& found, const std::vector<LimitSet>& sets);

/// {"loads": [...], "lines": [{"item","title","unit","set","limit" (null: NaN),"compare","source","confidence",
/// "margin_pct","worst_load","verdict",
/// "cells": [null or {"load","value","expanded_uncertainty","margin_pct","note","verdict"}]}]}
[[nodiscard]] nlohmann::json toJson(const LimitMatrix& matrix);
/// What a table shows of its lines.
[[nodiscard]] std::vector<ResultColumn> limitColumns();

}  // namespace tacto
