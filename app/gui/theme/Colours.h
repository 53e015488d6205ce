// Colours.h - the window's colours by purpose, light and dark.
//
// Colour is for data and the output's state; all else is quiet. Contrast on every background used: text 4.5:1, fills,
// edges and traces 3:1. Red means STOP and faults; blue means voltage and delivering.
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
    QColor sunken;     ///< troughs of bars, tags, and the widget under the pointer
    QColor selection;  ///< the chosen row, step or workspace
    QColor line;       ///< separators
    QColor edge;       ///< edges of fields and buttons
    QColor text;
    QColor quiet;        ///< secondary text
    QColor primary;      ///< the one button for the next step; in ink, because blue has another meaning
    QColor primaryText;  ///< text on primary
    QColor voltage;
    QColor current;
    QColor currentText;  ///< text in the colour of the current
    QColor third;        ///< the third axis, and values computed from voltage and current
    QColor grid;
    QColor zero;       ///< the line at 0, and older traces
    QColor frame;      ///< the frame of plots
    QColor amber;      ///< background of the armed state, and bar of a limit from 80 %
    QColor amberInk;   ///< text on amber
    QColor amberText;  ///< text of warnings
    QColor amberCell;  ///< a table cell near its limit
    QColor delivering;
    QColor stop;      ///< background of STOP and of the faulted state
    QColor fault;     ///< words and symbols of faults only
    QColor banner;    ///< background of the fault banner
    QColor pass;      ///< background of a passed verdict, with white text
    QColor passText;  ///< text of a passed verdict without a background, and edges of tolerance bands
    QColor passCell;  ///< a passed table cell, and tolerance bands
    QColor fail;      ///< background of a failed verdict or cell
    QColor failText;  ///< text on fail
    QColor hatch;     ///< pattern for "not evaluated"
    QColor bar;       ///< the bar of a limit below 80 %
    QColor watermark;
};

[[nodiscard]] const Colours& coloursOf(Theme theme);
/// Contrast ratio of two colours, 1 to 21 (WCAG 2.1).
[[nodiscard]] double contrast(const QColor& a, const QColor& b);
/// Returns `ink`, made darker or lighter until text on `paper` has a contrast of 4.5:1 (WCAG 2.1, AA).
[[nodiscard]] QColor legible(QColor ink, const QColor& paper);
/// Qt's palette in these colours, for widgets that the style sheet does not draw.
[[nodiscard]] QPalette paletteOf(const Colours& colours);

// The program's one style sheet, made from these colours: flat fills, lines of 1 px, no shadow.
//
// Properties select a widget's variant. A button's `role` is "primary" (filled; one on each screen), "quiet" (no edge
// until the pointer is over it) or "segment" (one of several side by side); a tool's can also be "row" (an unfolding
// table row). A button without a role has an edge. A label's `tone` is "quiet" or "warning"; any widget's `textSize` is
// "small" or "large", its `textWeight` "strong".

/// Lengths grow with the size of `text`.
[[nodiscard]] QString styleSheetOf(Theme theme, const QFont& text);

}  // namespace tacto::gui
