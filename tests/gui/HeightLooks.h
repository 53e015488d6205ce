// HeightLooks.h - text that is cut above or below: where it is higher than its place, and where an edge leaves a part
// of it.
//
// Thread-safety: the GUI thread.
#pragma once

#include <QStringList>
#include <QWidget>

namespace tacto::test {

/// Text that is higher than its place: in cells, fields, tabs, titles of columns and lines that elide; and lists,
/// tables and texts in which not one line has room.
[[nodiscard]] QStringList lowTexts(const QWidget& in);
/// Rows, words and fields of which an edge leaves only the upper or the lower part, and what lies below an edge, where
/// no scroll bar is seen that leads there.
[[nodiscard]] QStringList cutBelow(const QWidget& in);

}  // namespace tacto::test
