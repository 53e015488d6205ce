// QtJson.h - JSON of a session file as Qt has it: figures, tables and reports are read with Qt's classes.
//
// Thread-safety: a pure function.
#pragma once

#include <QJsonDocument>
#include <QJsonObject>

#include "core/base/JsonText.h"

namespace tacto {

/// Empty for what is not an object. What no JSON text can hold (a broken byte in a name) is replaced.
[[nodiscard]] inline QJsonObject qtObject(const nlohmann::json& json) {
    return QJsonDocument::fromJson(QByteArray::fromStdString(dumpJson(json))).object();
}

}  // namespace tacto
