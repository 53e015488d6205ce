#include "app/gui/runner/ScriptReading.h"

#include <QRegularExpression>

namespace tacto::gui {

void ScriptReading::read(const ProtocolSource& source) {
    if (busy_)
        next_ = source;
    else
        begin(source);
}

void ScriptReading::begin(const ProtocolSource& source) {
    busy_ = true;
    reading_.start(
        this, [source] { return readDeclaration(source); },
        [this, source](const Result<ProtocolDeclaration>& declaration) {
            busy_ = false;
            if (!next_) return done_(source, declaration);
            begin(*std::exchange(next_, std::nullopt));
        });
}

int lineOf(const QString& error) {
    static const QRegularExpression place(R"(:(\d+):)");
    const auto match = place.match(error);
    return match.hasMatch() ? match.captured(1).toInt() : 0;
}

}  // namespace tacto::gui
