#include "app/scripting/engine/HostBridge.h"

#include <exception>

#include "app/scripting/engine/JsValue.h"

namespace tacto {

int HostBridge::callingLine() const {
    // A new Error carries the stack: "wait@tactoscope:host:1\nrun@file:///.../x.js:12\n...".
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
    const auto& functions = hostFunctions();
    if (index < 0 || static_cast<std::size_t>(index) >= functions.size()) return {};
    const HostFunction& function = functions[static_cast<std::size_t>(index)];
    const int line = callingLine();

    Result<nlohmann::json> given = toJson(arguments);
    if (engine_.hasError()) return {};  // a getter of the script's own threw
    const auto asked = [&]() -> Result<nlohmann::json> {
        try {
            return port_.call(function, *given, line);
        } catch (const std::exception& surprise) {  // the engine cannot be unwound by one
            return fail(ErrorCode::InvalidArgument, "{}: {}", function.name, surprise.what());
        }
    };
    Result<nlohmann::json> answer =
        given ? asked()
              : tl::unexpected<Error>(
                    {given.error().code, fmt::format("{}: {}", function.fullName(), given.error().message)});
    if (answer) return toJs(engine_, *answer);

    QJSValue error = engine_.newErrorObject(QJSValue::GenericError, QString::fromStdString(answer.error().message));
    error.setProperty(QStringLiteral("code"), static_cast<int>(answer.error().code));
    error.setProperty(QStringLiteral("limit"), answer.error().code == ErrorCode::LimitExceeded);
    if (failures_.size() == kFailures) failures_.pop_front();
    failures_.emplace_back(error, answer.error());
    engine_.throwError(error);
    return {};
}

std::optional<Error> HostBridge::failureOf(const QJSValue& thrown) const {
    for (const auto& [object, error] : failures_) {
        if (object.strictlyEquals(thrown)) return error;
    }
    return std::nullopt;
}

}  // namespace tacto

#include "moc_HostBridge.cpp"
