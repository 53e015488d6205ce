#include "app/gui/runner/ScriptReading.h"

#include <QRegularExpression>

namespace tacto::gui {

ScriptReading::~ScriptReading() {
    if (thread_.joinable()) thread_.join();
}

void ScriptReading::read(const ProtocolSource& source) {
    if (busy())
        next_ = source;
    else
        begin(source);
}

void ScriptReading::begin(const ProtocolSource& source) {
    thread_ = std::thread([this, source] {
        auto declaration = readDeclaration(source);
        // Posted to this object: forgotten, should it be gone by then.
        QMetaObject::invokeMethod(
            this,
            [this, source, declaration = std::move(declaration)] {
                thread_.join();
                if (!next_) return done_(source, declaration);
                begin(*std::exchange(next_, std::nullopt));
            },
            Qt::QueuedConnection);
    });
}

int lineOf(const QString& error) {
    static const QRegularExpression place(R"(:(\d+):)");
    const auto match = place.match(error);
    return match.hasMatch() ? match.captured(1).toInt() : 0;
}

}  // namespace tacto::gui
