// JsValue.h - plain data across the border between a script and the program: JSON in, JSON out.
//
// Only copies cross: neither the script nor the program ever holds a reference into the other.
//
// Thread-safety: the engine's thread.
#pragma once

#include <QJSEngine>
#include <nlohmann/json.hpp>

#include "core/base/Result.h"

namespace tacto {

/// Returns a deep copy. Whole numbers become integers; NaN and infinities are kept. Undefined becomes null; a member
/// that is undefined is left out. Getters of the script's objects run; an exception from a getter is lost, and the
/// engine decides which value is copied. Errors: InvalidArgument for a function or symbol, a value nested deeper than
/// 32 levels (a cycle), or more than 10 million elements.
[[nodiscard]] Result<nlohmann::json> toJson(const QJSValue& value);

/// Returns a deep copy made of plain objects and arrays. NaN, which stands for an absent value, becomes null.
[[nodiscard]] QJSValue toJs(QJSEngine& engine, const nlohmann::json& value);

}  // namespace tacto
