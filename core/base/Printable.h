// Printable.h - text from a file or a device as a terminal may show it: what would move the cursor, change colours or
// turn the reading direction is spelled out instead (hazard H10).
#pragma once

#include <cstddef>
#include <string>
#include <string_view>

namespace tacto {

enum class Newlines { Escape, Keep };

/// `text` with C0 and C1 control characters, DEL and bytes that are not UTF-8 written as "\x1b", and characters that
/// turn the reading direction or cannot be seen as "\u202e". Everything else stays as it is.
[[nodiscard]] std::string printable(std::string_view text, Newlines newlines = Newlines::Escape);

/// Whether every byte is part of a character in its shortest form, and no part of a surrogate.
[[nodiscard]] bool isUtf8(std::string_view text) noexcept;

/// Whether printable() spells it out: C0, DEL and C1.
[[nodiscard]] bool isControl(char32_t code) noexcept;
/// The others that it spells out: they turn the reading direction, separate lines or have no width.
[[nodiscard]] bool isHidden(char32_t code) noexcept;

/// The number of code points in a UTF-8 text.
[[nodiscard]] std::size_t charactersOf(std::string_view utf8) noexcept;

/// Every number becomes "…": a level in a sentence tells what was felt.
[[nodiscard]] std::string withoutNumbers(std::string_view text);

}  // namespace tacto
