// StyleSheet.h - the one style sheet of the program, made from its colours: flat fills, lines of 1 px, no shadow.
//
// What a widget is beyond its class it says by a property: a button's `role` is "primary" (filled, one a screen),
// "quiet" (no edge until the pointer is over it) or "segment" (one of several beside each other), a tool's "row" (a
// table's row that unfolds); without one it has an edge. A label's `tone` is "quiet" or "warning", any widget's
// `textSize` "small" or "large", its `textWeight` "strong".
//
// Thread-safety: pure function.
#pragma once

#include <QFont>
#include <QString>

#include "app/gui/theme/Colours.h"

namespace tacto::gui {

/// Lengths follow the size of `text`.
[[nodiscard]] QString styleSheetOf(Theme theme, const QFont& text);

}  // namespace tacto::gui
