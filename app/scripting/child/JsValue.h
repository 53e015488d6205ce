// JsValue.h - plain data across the border between a script and the program: JSON in, JSON out.
//
// Only copies cross: a script never holds a reference into the program, nor the program one into the script.
//
// Thread-safety: the engine's thread.
#pragma once

#include <QJSEngine>
#include <nlohmann/json.hpp>

#include "core/base/Result.h"

namespace tacto {

/// A deep copy. Whole numbers become integers; NaN and infinities stay what they are; undefined is null, and absent as
/// a member. Getters of the script's objects run; what one throws is lost, its value is then whatever
/// the engine makes of it. Errors: InvalidArgument for a function or symbol, a value nested
/// deeper than 32 levels (a cycle), or more than 10 million elements.
[[nodiscard]] Result<nlohmann::json> toJson(const QJSValue& value);

/// A deep copy of plain objects and arrays. NaN, an absent value, becomes null.
[[nodiscard]] QJSValue toJs(QJSEngine& engine, const nlohmann::json& value);

}  // namespace tacto
