// VerdictMark.h - a verdict's shape and colours in a report: those that the window shows in its light theme.
#pragma once

#include <QColor>
#include <QString>

#include "app/report/ReportModel.h"

namespace tacto {

struct VerdictMark {
    QString shape;  ///< tells it apart without colour: "✔"
    QColor fill;
    QColor ink;     ///< on the fill
    QColor colour;  ///< the word's colour on white
};
/// `key` is a verdict as a result or a row writes it: "pass", "fail", "indeterminate", "stopped", "attention",
/// "refused as expected", "not evaluated", "not applicable". Every other text has the mark of no verdict.
[[nodiscard]] VerdictMark verdictMark(const QString& key);
[[nodiscard]] VerdictMark verdictMark(ReportVerdict verdict);

}  // namespace tacto
