// CsvNumber.h - one number out of the middle of a line, read by fast_float: the double nearest to the text.
//
// Thread-safety: pure functions.
#pragma once

#include <fast_float/fast_float.h>

namespace tacto {

/// Reads the number that begins at `text` (also a '+', nan and inf; beyond a double it is inf) and gives the place
/// behind it; null where none begins. `point` is '.' or ','.
inline const char* takeNumber(const char* text, const char* end, char point, double& value) noexcept {
    if (end - text > 1 && *text == '+' && text[1] != '-') ++text;
    const auto [behind, error] = fast_float::from_chars_advanced(
        text, end, value, fast_float::parse_options(fast_float::chars_format::general, point));
    return error == std::errc() ? behind : nullptr;
}

}  // namespace tacto
