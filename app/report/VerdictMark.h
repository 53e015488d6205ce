// VerdictMark.h - the shape and colours of a verdict in a report, the same as in the window's light theme.
#pragma once

#include <QColor>
#include <QString>

#include "app/report/ReportModel.h"

namespace tacto {

struct VerdictMark {
    QString shape;  ///< distinguishes the verdict without colour: "✔"
    QColor fill;
    QColor ink;     ///< colour on the fill
    QColor colour;  ///< colour of the word on white
};
/// `key` is a verdict in a result or a row: "pass", "fail", "indeterminate", "stopped", "attention", "refused as
/// expected", "not evaluated", "not applicable". For any other text, returns the mark for no verdict.
[[nodiscard]] VerdictMark verdictMark(const QString& key);
[[nodiscard]] VerdictMark verdictMark(ReportVerdict verdict);

}  // namespace tacto
