// DeclaredText.h - the texts that a protocol script declares: there where they are required, and no longer than a
// report or a window shows well.
//
// Thread-safety: pure functions.
#pragma once

#include <fmt/ranges.h>
#include <nlohmann/json.hpp>
#include <string>
#include <string_view>
#include <vector>

#include "core/base/Result.h"

namespace tacto {

inline constexpr std::size_t kMaxDeclaredTitle = 200;  ///< characters
inline constexpr std::size_t kMaxDeclaredText = 2000;

/// Errors: InvalidArgument naming `where`, `what` and both lengths when `text` has more than `most` characters.
[[nodiscard]] Result<void> noLongerThan(std::string_view where, std::string_view what, const std::string& text,
                                        std::size_t most);

/// The text that `object` has under `key`; empty where it has none. Errors: InvalidArgument naming `where` and `key`
/// when it is not text, is longer than `most`, or is missing or empty and `required`.
[[nodiscard]] Result<std::string> declaredText(const nlohmann::json& object, std::string_view where, const char* key,
                                               bool required, std::size_t most = kMaxDeclaredText);

/// "sensor, stimulator": the words of an enum, as an error lists them.
template <class Table>
[[nodiscard]] std::string namesOf(const Table& words) {
    std::vector<std::string_view> names;
    for (const auto& word : words) names.push_back(word.text);
    return fmt::format("{}", fmt::join(names, ", "));
}

}  // namespace tacto
