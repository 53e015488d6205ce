// TypedNumber.h - numbers as people type them. A comma is a decimal comma where it can mean nothing else: "4,5",
// "0,250", "1234,5". "1,000" may be one or a thousand, and is refused with that reason.
#pragma once

#include <optional>
#include <string>
#include <string_view>

namespace tacto {

/// As parseQuantity() (LocaleFreeText.h) reads it, and with a decimal comma. Without a unit a plain number. Nothing for
/// other texts; typedTrouble() says why.
[[nodiscard]] std::optional<double> typedNumber(std::string_view text, std::string_view unit = "");

/// Why typedNumber() does not read a text with a comma, to end a refusal: "; \"1,000\" may be 1 or 1000: write one of
/// these". Empty where no comma is in the way.
[[nodiscard]] std::string typedTrouble(std::string_view text);

}  // namespace tacto
