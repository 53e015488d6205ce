// RoomLooks.h - text that has no room in cells and fields, and pages that are cut sideways.
//
// Thread-safety: the GUI thread.
#pragma once

#include <QStringList>
#include <QWidget>

namespace tacto::test {

/// Cells in sight that are narrower than their text. One column of a view may elide, the last or the one that takes the
/// rest, where the tool tip has the whole text.
[[nodiscard]] QStringList cutCells(const QWidget& in);
/// Line edits, also those of spin boxes and boxes of choices, with a text or placeholder wider than they are that does
/// not stand in the tool tip.
[[nodiscard]] QStringList cutFields(const QWidget& in);
/// Pages, tables, lists and texts that are wider than their place, whether a scroll bar leads there or none does. An
/// editor of text that does not wrap scrolls by right.
[[nodiscard]] QStringList cutSideways(const QWidget& in);
/// Widgets that stand partly outside of what they stand in, where that is not a page that scrolls.
[[nodiscard]] QStringList beyondTheirPlace(const QWidget& in);
/// Labels that elide by design and do, without the whole text in their tool tip.
[[nodiscard]] QStringList untoldElisions(const QWidget& in);

}  // namespace tacto::test
