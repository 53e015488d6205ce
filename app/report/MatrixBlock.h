// MatrixBlock.h - rows against columns: limits or quantities against loads. Described once; window, terminal, HTML and
// PDF set it.
#pragma once

#include <QStringList>
#include <nlohmann/json.hpp>
#include <vector>

#include "core/results/ResultTable.h"

namespace tacto {

/// A number in each cell and a smaller one below it; what needs attention stands out, in print without colour too.
struct MatrixBlock {
    enum class State { Plain, Close, Broken, Open, Empty };  ///< Open: not evaluated; Empty: nothing asked there
    struct Cell {
        QString main, detail;
        State state = State::Empty;
        QString verdict{};      ///< the verdict on what is judged: "pass"
        QString share{};        ///< how much of the limit is used, "23 %", or the words in its place
        QString measured{};     ///< the value with its U and unit
        QString note{};         ///< what is to be known beside it, as a sentence
        bool hasShare = false;  ///< `share` is one
        bool isNear = false;    ///< 80 % or more of it
    };
    struct Row {
        QString title, note;
        std::vector<Cell> cells;
        QString name{};                                       ///< the title without the unit that its cells share
        QString unit{}, limit{}, set{}, source{}, verdict{};  ///< a limit, as "≤ 10 mA", and whose it is
        bool hasLimit = false;                                ///< else `limit` is a rule in words that was kept or not
        int worst = -1;                                       ///< the cell with the smallest margin
    };
    QString caption{};
    QStringList columns{};
    std::vector<Row> rows{};
    QString legend{};
};

/// `rows` as toJson(LimitMatrix) has its lines, or a script its matrix: {"title", "note", "unit", "limit", "compare",
/// "set" or "sets", "source", "verdict", "worst_load", "cells"}, a cell null (nothing asked there) or {"load", "value",
/// "unit", "expanded_uncertainty", "margin_pct", "verdict", "note", "text"}.
[[nodiscard]] MatrixBlock matrixOf(const QStringList& columns, const nlohmann::json& rows);
/// The block of what toJson(LimitMatrix) gives; one limit from two documents is one row. Empty for anything else.
[[nodiscard]] MatrixBlock limitsOf(const nlohmann::json& matrix);
/// A table of Across: each record is a column, by its first.
[[nodiscard]] MatrixBlock acrossOf(const ResultTable& table, const nlohmann::json& records);

}  // namespace tacto
