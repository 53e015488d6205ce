// ShownText.h - shortens texts for a report. A script may write any length, and laying out a hundred thousand
// characters takes seconds. The session keeps the whole text (hazard H10).
#pragma once

#include <QString>

#include "app/report/ReportModel.h"

namespace tacto {

inline constexpr qsizetype kShownText = 4000;
inline constexpr qsizetype kShownCell = 1000;  ///< characters in a table cell, which is not broken across pages
inline constexpr qsizetype kShownHead = 80;    ///< characters in the header of every page

/// Returns the text, or its first `most` characters and how many more the session holds.
[[nodiscard]] QString shownText(const QString& text, qsizetype most = kShownText);

/// Returns the text with a capital first letter: "Peak voltage".
[[nodiscard]] QString capitalised(QString text);

/// Returns an axis title for window and report: "Force (N)", or without a unit just the title.
[[nodiscard]] QString axisTitle(const QString& title, const QString& unit = {});

/// Returns the model with shortened texts, except in cells of scripts' tables: those are shortened when formatted.
[[nodiscard]] ReportModel shownModel(ReportModel model);

}  // namespace tacto
