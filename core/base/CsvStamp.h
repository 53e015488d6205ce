// CsvStamp.h - reads dates and times of day as stamps of samples: ISO 8601 ("2026-11-29T10:00:00.000Z",
// "20261129T100000+0100", with a blank for the T or without a zone) or a time of day alone ("10:00:00.5").
#pragma once

#include <cstdint>
#include <fast_float/fast_float.h>
#include <optional>
#include <string_view>

namespace tacto {

struct CsvStamp {
    std::int64_t seconds = 0;  ///< since 1970 in UTC (as written if there is no zone), or since midnight
    double fraction = 0;       ///< 0 to 1
    /// Returns seconds since `origin`, which is the whole seconds of another stamp.
    [[nodiscard]] double since(std::int64_t origin) const noexcept {
        return static_cast<double>(seconds - origin) + fraction;
    }
};

/// Reads the stamp at `text` and returns the position after it; null if there is no stamp. `point` is '.' or ','.
[[nodiscard]] const char* takeStamp(const char* text, const char* end, char point, CsvStamp& stamp) noexcept;

/// Reads a whole field as a stamp.
[[nodiscard]] std::optional<CsvStamp> fieldStamp(std::string_view field, char point) noexcept;

// Reads one number from the middle of a line with fast_float: the double nearest to the text.

/// Reads the number at `text` (also with '+', nan and inf; inf if too large for a double) and returns the position
/// after it; null if there is no number. `point` is '.' or ','.
inline const char* takeNumber(const char* text, const char* end, char point, double& value) noexcept {
    if (end - text > 1 && *text == '+' && text[1] != '-') ++text;
    const auto [behind, error] = fast_float::from_chars_advanced(
        text, end, value, fast_float::parse_options(fast_float::chars_format::general, point));
    return error == std::errc() ? behind : nullptr;
}

}  // namespace tacto
