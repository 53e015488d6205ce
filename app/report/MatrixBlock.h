// MatrixBlock.h - a table of rows against columns, such as limits against loads. Described once; window, terminal, HTML
// and PDF each draw it.
#pragma once

#include <QStringList>
#include <nlohmann/json.hpp>
#include <vector>

#include "core/results/ResultTable.h"

namespace tacto {

/// Each cell has a number and a smaller number below. Cells that need attention stand out, even in grey print.
struct MatrixBlock {
    enum class State { Plain, Close, Broken, Open, Empty };  ///< Open: not evaluated; Empty: not asked for
    struct Cell {
        QString main, detail;
        State state = State::Empty;
        QString verdict{};      ///< the verdict for the cell: "pass"
        QString share{};        ///< used share of the limit, "23 %", or words instead
        QString measured{};     ///< the value with its expanded uncertainty and unit
        QString note{};         ///< a remark on the value, as a sentence
        bool hasShare = false;  ///< true if `share` is a percentage
        bool isNear = false;    ///< true if 80 % or more of the limit is used
    };
    struct Row {
        QString title, note;
        std::vector<Cell> cells;
        QString name{};                                       ///< title without the unit that its cells share
        QString unit{}, limit{}, set{}, source{}, verdict{};  ///< limit "≤ 10 mA" and its source
        bool hasLimit = false;                                ///< else `limit` is a rule in words: kept or not
        int worst = -1;                                       ///< the cell with the smallest margin
    };
    QString caption{};
    QStringList columns{};
    std::vector<Row> rows{};
    QString legend{};
};

/// Makes the matrix from `rows`, as written by toJson(LimitMatrix) or by a script: {"title", "note", "unit", "limit",
/// "compare", "set" or "sets", "source", "verdict", "worst_load", "cells"}. A cell is null (not asked for) or {"load",
/// "value", "unit", "expanded_uncertainty", "margin_pct", "verdict", "note", "text"}.
[[nodiscard]] MatrixBlock matrixOf(const QStringList& columns, const nlohmann::json& rows);
/// Makes the matrix from toJson(LimitMatrix); one limit in two documents is one row. Empty for other input.
[[nodiscard]] MatrixBlock limitsOf(const nlohmann::json& matrix);
/// Makes the matrix from a table of Across: each record is a column; its first member is the title.
[[nodiscard]] MatrixBlock acrossOf(const ResultTable& table, const nlohmann::json& records);

}  // namespace tacto
