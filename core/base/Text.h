// Text.h - numbers to and from text, the same way in every language setting.
//
// Thread-safety: pure functions.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace tacto {

/// Takes the number that `text` begins with off it ("1e-3", "-4"): of "2.5 kHz" " kHz" is left. Nothing, and `text` as
/// it was, where none begins and where a double cannot hold it. Accepts "nan" and "inf".
[[nodiscard]] std::optional<double> takeNumber(std::string_view& text);

/// The whole of `text`, blanks trimmed, as a number ("1e-3", "-4"). Nothing for an empty text, trailing
/// characters or a decimal comma. Accepts "nan" and "inf": whether those are welcome is the caller's rule.
[[nodiscard]] std::optional<double> parseNumber(std::string_view text);

/// A number with an optional engineering prefix and the given unit: "1.5 kohm", "500ohm", "50 nF", "500".
/// Prefixes p n u µ m k M G. Nothing when the text is something else.
[[nodiscard]] std::optional<double> parseQuantity(std::string_view text, std::string_view unit);

[[nodiscard]] std::string_view trimmed(std::string_view text);
[[nodiscard]] std::vector<std::string_view> split(std::string_view text, char separator);

}  // namespace tacto
