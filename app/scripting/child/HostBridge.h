// HostBridge.h - the only QObject behind the host objects. Scripts see functions (closures) and never this object.
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

    /// Calls function `index` of the table. A failure becomes a JavaScript Error with the operator's sentence.
    Q_INVOKABLE QJSValue call(int index, const QJSValue& arguments);

    /// Returns the number of a failure if `thrown` is the very object that a failed call threw. A script can throw that
    /// object again, but cannot make another object like it (hazard H9). Remembers the last kFailures.
    [[nodiscard]] std::optional<std::int64_t> failureOf(const QJSValue& thrown) const;

private:
    static constexpr std::size_t kFailures = 256;
    [[nodiscard]] int callingLine() const;
    QJSEngine& engine_;
    HostCalls& calls_;
    const QString scriptUrl_;
    std::deque<std::pair<QJSValue, std::int64_t>> failures_;  // thrown values and the numbers of their failures
};

}  // namespace tacto
