#include "core/base/TypedNumber.h"

#include <fmt/format.h>

#include "core/base/LocaleFreeText.h"

namespace tacto {

namespace {

bool isDigit(char c) noexcept { return c >= '0' && c <= '9'; }

std::size_t digitsFrom(std::string_view text, std::size_t at) noexcept {
    std::size_t count = 0;
    while (at + count < text.size() && isDigit(text[at + count])) ++count;
    return count;
}

/// The number that a text begins with: digits, and groups of digits after commas.
struct Commas {
    std::size_t first = 0;                          ///< where the first comma stands
    std::size_t count = 0;                          ///< commas with digits behind them
    std::size_t digitsBefore = 0, digitsAfter = 0;  ///< of the first
    bool beginsWithZero = false;
    bool hasPoint = false;  ///< a point, too, stands in it

    /// One of 1 to 3 digits and one of 3: a thousand is written so.
    [[nodiscard]] bool mayGroup() const noexcept {
        return digitsBefore >= 1 && digitsBefore <= 3 && digitsAfter == 3 && !beginsWithZero;
    }
    [[nodiscard]] bool isDecimal() const noexcept { return count == 1 && !hasPoint && !mayGroup(); }
};

/// Nothing where no comma stands among the digits.
std::optional<Commas> commasOf(std::string_view text) noexcept {
    std::size_t at = !text.empty() && (text.front() == '-' || text.front() == '+') ? 1 : 0;
    Commas found;
    found.digitsBefore = digitsFrom(text, at);
    found.beginsWithZero = found.digitsBefore > 0 && text[at] == '0';
    at += found.digitsBefore;
    found.first = at;
    while (at < text.size() && (text[at] == ',' || text[at] == '.')) {
        const auto digits = digitsFrom(text, at + 1);
        if (text[at] == '.') {
            found.hasPoint = true;
        } else if (digits > 0) {
            if (found.count++ == 0) {
                found.first = at;
                found.digitsAfter = digits;
            }
        } else {
            break;
        }
        at += 1 + digits;
    }
    return found.count > 0 ? std::optional(found) : std::nullopt;
}

}  // namespace

std::optional<double> typedNumber(std::string_view text, std::string_view unit) {
    std::string plain(trimmed(text));
    if (const auto commas = commasOf(plain); commas && commas->isDecimal()) plain[commas->first] = '.';
    return unit.empty() ? parseNumber(plain) : parseQuantity(plain, unit);
}

std::string typedTrouble(std::string_view text) {
    text = trimmed(text);
    const auto commas = commasOf(text);
    if (!commas || commas->isDecimal()) return "";
    if (commas->count > 1 || commas->hasPoint) return "; write it with a point, and without commas";
    const auto sign = isDigit(text.front()) ? std::string_view() : text.substr(0, 1);
    const auto whole = text.substr(sign.size(), commas->digitsBefore);
    const auto rest = text.substr(commas->first + 1, commas->digitsAfter);
    return fmt::format("; \"{}{},{}\" may be {}{}.{} or {}{}{}: write one of these", sign, whole, rest, sign, whole,
                       rest, sign, whole, rest);
}

}  // namespace tacto
