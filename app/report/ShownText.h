// ShownText.h - how much of a text a report shows. A script may write any length, and laying out a hundred thousand
// characters takes seconds. The session keeps the whole text (hazard H10).
#pragma once

#include <QString>

#include "app/report/ReportModel.h"

namespace tacto {

inline constexpr qsizetype kShownText = 4000;
inline constexpr qsizetype kShownCell = 1000;  ///< characters in a table's cell, which is not broken between pages
inline constexpr qsizetype kShownHead = 80;    ///< shown at the head of every page

/// The text, or its first `most` characters and how many more the session holds.
[[nodiscard]] QString shownText(const QString& text, qsizetype most = kShownText);

/// The text with a capital at its beginning: "Peak voltage".
[[nodiscard]] QString capitalised(QString text);

/// An axis's title, in window and report: "Force (N)"; without a unit the title alone.
[[nodiscard]] QString axisTitle(const QString& title, const QString& unit = {});

/// The model with its texts as they are shown, but for the cells of scripts' tables: those are shortened when worded.
[[nodiscard]] ReportModel shownModel(ReportModel model);

}  // namespace tacto
