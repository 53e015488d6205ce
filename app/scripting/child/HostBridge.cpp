#include "app/scripting/child/HostBridge.h"

#include "app/scripting/child/JsValue.h"
#include "core/base/Result.h"

namespace tacto {

int HostBridge::callingLine() const {
    // The stack of a new Error looks like this: "wait@tactoscope:host:1\nrun@file:///.../x.js:12\n...".
    const QString stack = engine_.newErrorObject(QJSValue::GenericError).property(QStringLiteral("stack")).toString();
    const QString mark = QLatin1Char('@') + scriptUrl_ + QLatin1Char(':');
    const qsizetype at = stack.indexOf(mark);
    if (at < 0) return 0;
    const qsizetype from = at + mark.size();
    qsizetype to = from;
    while (to < stack.size() && stack.at(to).isDigit()) ++to;
    return stack.mid(from, to - from).toInt();
}

QJSValue HostBridge::call(int index, const QJSValue& arguments) {
    const int line = callingLine();
    const auto given = toJson(arguments);
    if (engine_.hasError()) return {};  // a getter of the script threw an exception
    const HostAnswer answer = given ? calls_.call(index, *given, line) : calls_.refuse(index, given.error().message);
    if (!answer.failure) return toJs(engine_, answer.value);

    QJSValue error = engine_.newErrorObject(QJSValue::GenericError, QString::fromStdString(answer.text));
    error.setProperty(QStringLiteral("code"), answer.code);
    error.setProperty(QStringLiteral("limit"), answer.code == static_cast<int>(ErrorCode::LimitExceeded));
    if (failures_.size() == kFailures) failures_.pop_front();
    failures_.emplace_back(error, *answer.failure);
    engine_.throwError(error);
    return {};
}

std::optional<std::int64_t> HostBridge::failureOf(const QJSValue& thrown) const {
    for (const auto& [object, failure] : failures_) {
        if (object.strictlyEquals(thrown)) return failure;
    }
    return std::nullopt;
}

}  // namespace tacto

#include "moc_HostBridge.cpp"
