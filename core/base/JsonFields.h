// JsonFields.h - fields of a JSON object that may be missing or of another type: rows of a damaged file are read too.
//
// Thread-safety: pure functions. No exception whatever the JSON.
#pragma once

#include <cstdint>
#include <nlohmann/json.hpp>
#include <string>
#include <string_view>
#include <vector>

#include "core/base/JsonText.h"

namespace tacto {

/// Limits of one row of a session file: results and report items are large, and a script's values nest by themselves.
inline constexpr JsonLimits kRowLimits{.bytes = 256'000'000, .depth = 64};

[[nodiscard]] std::string textOr(const nlohmann::json& object, const char* key);
/// NaN where there is no number: null is how NaN is written.
[[nodiscard]] double numberOr(const nlohmann::json& object, const char* key);
[[nodiscard]] double numberOr(const nlohmann::json& value);
[[nodiscard]] std::uint64_t countOr(const nlohmann::json& object, const char* key);
[[nodiscard]] bool flagOr(const nlohmann::json& object, const char* key);
[[nodiscard]] std::vector<std::string> textsOr(const nlohmann::json& object, const char* key);
/// null for NaN and infinity.
[[nodiscard]] nlohmann::json numberOrNull(double value);
/// null where there is none.
[[nodiscard]] nlohmann::json valueOr(const nlohmann::json& object, const char* key);

}  // namespace tacto
