// Printable.h - makes text from a file or a device safe for a terminal: characters that would move the cursor, change
// colours or turn the reading direction are written as escapes (hazard H10).
#pragma once

#include <cstddef>
#include <string>
#include <string_view>

namespace tacto {

enum class Newlines { Escape, Keep };

/// Returns `text` with C0 and C1 control characters, DEL and bytes that are not UTF-8 written like "\x1b", and
/// invisible characters or those that turn the reading direction like "\u202e". All else is unchanged.
[[nodiscard]] std::string printable(std::string_view text, Newlines newlines = Newlines::Escape);

/// Whether the text is valid UTF-8: shortest forms only, no surrogates.
[[nodiscard]] bool isUtf8(std::string_view text) noexcept;

/// Whether printable() escapes a character as a control character: C0, DEL and C1.
[[nodiscard]] bool isControl(char32_t code) noexcept;
/// Whether printable() escapes a character because it turns the reading direction, separates lines or has no width.
[[nodiscard]] bool isHidden(char32_t code) noexcept;

/// Returns the number of code points in a UTF-8 text.
[[nodiscard]] std::size_t charactersOf(std::string_view utf8) noexcept;

/// Replaces every number by "…", because a level in a sentence would reveal what was felt.
[[nodiscard]] std::string withoutNumbers(std::string_view text);

}  // namespace tacto
