// Colours.h - the window's colours by role, light and dark.
//
// Data and the state of the output carry the colour; everything else is quiet. Text keeps a contrast of 4.5:1 on every
// ground that it stands on, fills, edges and traces of 3:1. Red is for STOP and faults; blue is voltage and delivering.
#pragma once

#include <QColor>
#include <QFont>
#include <QPalette>
#include <QString>

namespace tacto::gui {

enum class Theme { Light, Dark };

struct Colours {
    QColor window;     ///< window, rail, docks and bars
    QColor base;       ///< plots, tables and fields
    QColor sunken;     ///< troughs of bars, tags, what the pointer is over
    QColor selection;  ///< chosen row, step or workspace
    QColor line;       ///< separators
    QColor edge;       ///< the edge of fields and buttons
    QColor text;
    QColor quiet;        ///< secondary text
    QColor primary;      ///< the one button that leads on: ink, so that blue keeps its meaning
    QColor primaryText;  ///< on it
    QColor voltage;
    QColor current;
    QColor currentText;  ///< words in the current's colour
    QColor third;        ///< the third axis, and what is computed from the two
    QColor grid;
    QColor zero;       ///< the line at 0, and older traces
    QColor frame;      ///< the frame of plots
    QColor amber;      ///< fill of what is armed, and of a limit from 80 %
    QColor amberInk;   ///< words on it
    QColor amberText;  ///< words of warning
    QColor amberCell;  ///< a table's cell near its limit
    QColor delivering;
    QColor stop;      ///< fill of STOP and of the faulted state
    QColor fault;     ///< words and marks of faults, and nothing else
    QColor banner;    ///< ground of what a fault says
    QColor pass;      ///< fill of the verdict; white on it
    QColor passText;  ///< the word alone, and the edges of tolerance bands
    QColor passCell;  ///< a table's cell, a tolerance band
    QColor fail;      ///< fill of the verdict and of a cell
    QColor failText;  ///< on it
    QColor hatch;     ///< not evaluated
    QColor bar;       ///< the bar of a limit below 80 %
    QColor watermark;
};

[[nodiscard]] const Colours& coloursOf(Theme theme);
/// Contrast ratio of two colours, 1 to 21 (WCAG 2.1).
[[nodiscard]] double contrast(const QColor& a, const QColor& b);
/// `ink`, as much darker on a light ground or lighter on a dark one as words need: 4.5:1 on `paper` (WCAG 2.1, AA).
[[nodiscard]] QColor legible(QColor ink, const QColor& paper);
/// Qt's roles from them, for what draws itself.
[[nodiscard]] QPalette paletteOf(const Colours& colours);

// The one style sheet of the program, made from its colours: flat fills, lines of 1 px, no shadow.
//
// What a widget is beyond its class it says by a property: a button's `role` is "primary" (filled, one a screen),
// "quiet" (no edge until the pointer is over it) or "segment" (one of several beside each other), a tool's "row" (a
// table's row that unfolds); without one it has an edge. A label's `tone` is "quiet" or "warning", any widget's
// `textSize` "small" or "large", its `textWeight` "strong".

/// Lengths follow the size of `text`.
[[nodiscard]] QString styleSheetOf(Theme theme, const QFont& text);

}  // namespace tacto::gui
