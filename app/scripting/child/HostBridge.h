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

#include "app/scripting/child/Sandbox.h"

namespace tacto {

class HostBridge final : public QObject {
    Q_OBJECT
public:
    HostBridge(QJSEngine& engine, HostCalls& calls, QString scriptUrl)
        : engine_(engine), calls_(calls), scriptUrl_(std::move(scriptUrl)) {}

    /// Calls the table's function `index`; a failure becomes a JavaScript Error with the operator's sentence.
    Q_INVOKABLE QJSValue call(int index, const QJSValue& arguments);

    /// The failure that `thrown` was made for, if it is the very object that a call threw: a script can catch that one
    /// and throw it again, but make none like it (hazard H9). Remembers the last kFailures.
    [[nodiscard]] std::optional<std::int64_t> failureOf(const QJSValue& thrown) const;

private:
    static constexpr std::size_t kFailures = 256;
    [[nodiscard]] int callingLine() const;
    QJSEngine& engine_;
    HostCalls& calls_;
    const QString scriptUrl_;
    std::deque<std::pair<QJSValue, std::int64_t>> failures_;  // the thrown values, each with its number
};

}  // namespace tacto
