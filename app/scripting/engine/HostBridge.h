// HostBridge.h - the one QObject behind the host objects. Scripts never hold it: the functions they see are closures.
//
// Thread-safety: the engine's thread.
#pragma once

#include <QJSEngine>
#include <QObject>
#include <QString>
#include <deque>
#include <optional>
#include <utility>

#include "app/scripting/engine/Sandbox.h"

namespace tacto {

class HostBridge final : public QObject {
    Q_OBJECT
public:
    HostBridge(QJSEngine& engine, HostPort& port, QString scriptUrl)
        : engine_(engine), port_(port), scriptUrl_(std::move(scriptUrl)) {}

    /// Calls hostFunctions()[index]; a failure becomes a JavaScript Error with the operator's sentence.
    Q_INVOKABLE QJSValue call(int index, const QJSValue& arguments);

    /// The failure that `thrown` was made for, if it is the very object that a call threw: a script can catch that one
    /// and throw it again, but make none like it (hazard H9). Remembers the last kFailures.
    [[nodiscard]] std::optional<Error> failureOf(const QJSValue& thrown) const;

private:
    static constexpr std::size_t kFailures = 256;
    [[nodiscard]] int callingLine() const;
    QJSEngine& engine_;
    HostPort& port_;
    const QString scriptUrl_;
    std::deque<std::pair<QJSValue, Error>> failures_;  // what was thrown, and why
};

}  // namespace tacto
