// HeightLooks.h - finds text that is cut off at the top or the bottom: text higher than its place, and text cut by an
// edge.
//
// Thread-safety: the GUI thread.
#pragma once

#include <QStringList>
#include <QWidget>

namespace tacto::test {

/// Text higher than its place in cells, fields, tabs, column titles and lines that are shortened; also lists, tables
/// and texts without room for a single line.
[[nodiscard]] QStringList lowTexts(const QWidget& in);
/// Rows, words and fields that an edge cuts horizontally, and anything below an edge, if no visible scroll bar leads
/// there.
[[nodiscard]] QStringList cutBelow(const QWidget& in);

}  // namespace tacto::test
