// DeclaredText.h - checks the texts that a protocol script declares: required texts are present, and no text is too
// long for a report or a window.
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

/// Errors: InvalidArgument naming `where`, `what` and both lengths if `text` has more than `most` characters.
[[nodiscard]] Result<void> noLongerThan(std::string_view where, std::string_view what, const std::string& text,
                                        std::size_t most);

/// Returns the text under `key` of `object`, or an empty text if it is missing. Errors: InvalidArgument naming `where`
/// and `key` if it is not text, is longer than `most`, or is `required` and missing or empty.
[[nodiscard]] Result<std::string> declaredText(const nlohmann::json& object, std::string_view where, const char* key,
                                               bool required, std::size_t most = kMaxDeclaredText);

/// Returns the words of an enum as an error lists them: "sensor, stimulator".
template <class Table>
[[nodiscard]] std::string namesOf(const Table& words) {
    std::vector<std::string_view> names;
    for (const auto& word : words) names.push_back(word.text);
    return fmt::format("{}", fmt::join(names, ", "));
}

}  // namespace tacto
