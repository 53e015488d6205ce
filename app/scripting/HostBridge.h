// HostBridge.h - the one QObject behind the host objects. Scripts never hold it: the functions they see are closures.
//
// Thread-safety: the engine's thread.
#pragma once

#include <QJSEngine>
#include <QObject>
#include <QString>

#include "app/scripting/Sandbox.h"

namespace tacto {

class HostBridge final : public QObject {
    Q_OBJECT
public:
    HostBridge(QJSEngine& engine, HostPort& port, QString scriptUrl)
        : engine_(engine), port_(port), scriptUrl_(std::move(scriptUrl)) {}

    /// Calls hostFunctions()[index]; a failure becomes a JavaScript Error with the operator's sentence.
    Q_INVOKABLE QJSValue call(int index, const QJSValue& arguments);

private:
    [[nodiscard]] int callingLine() const;
    QJSEngine& engine_;
    HostPort& port_;
    const QString scriptUrl_;
};

}  // namespace tacto
