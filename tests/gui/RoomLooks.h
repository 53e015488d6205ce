// RoomLooks.h - finds text that does not fit into cells and fields, and pages that are cut off at the side.
//
// Thread-safety: the GUI thread.
#pragma once

#include <QStringList>
#include <QWidget>

namespace tacto::test {

/// Visible cells that are narrower than their text. One column of a view (the last or the stretched one) may be
/// shortened if the tool tip has the whole text.
[[nodiscard]] QStringList cutCells(const QWidget& in);
/// Line edits, also in spin boxes and combo boxes, that are narrower than their text or placeholder, if the tool tip
/// does not have it.
[[nodiscard]] QStringList cutFields(const QWidget& in);
/// Pages, tables, lists and texts that are wider than their place, with or without a scroll bar. Editors without line
/// wrap are allowed to scroll.
[[nodiscard]] QStringList cutSideways(const QWidget& in);
/// Widgets that are partly outside their parent, unless the parent is a page that scrolls.
[[nodiscard]] QStringList beyondTheirPlace(const QWidget& in);
/// Labels shortened by design, without the whole text in their tool tip.
[[nodiscard]] QStringList untoldElisions(const QWidget& in);

}  // namespace tacto::test
