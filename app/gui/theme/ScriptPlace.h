// ScriptPlace.h - errors of a script without their place in it ("load-safety.js:66: "), which is for its author alone.
//
// Thread-safety: pure functions.
#pragma once

#include <QRegularExpression>
#include <QString>

namespace tacto::gui {

/// The file's name and line, as "load-safety.js:66"; empty if the error has none.
[[nodiscard]] inline QString scriptPlace(const QString& error) {
    static const QRegularExpression place(R"(([^/\s]+\.js:\d+): )");
    return place.match(error).captured(1);
}
[[nodiscard]] inline QString withoutScriptPlace(QString error) {
    static const QRegularExpression place(R"((^|\s)\S*\.js:\d+: )");
    return error.replace(place, QStringLiteral("\\1")).remove(QStringLiteral(", at this line or after it"));
}

}  // namespace tacto::gui
