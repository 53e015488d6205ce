#include "core/base/TypedNumber.h"

#include <fmt/format.h>
#include <optional>

#include "core/base/LocaleFreeText.h"

namespace tacto {

namespace {

/// The number at the beginning of a text with a comma in it, in parts.
struct Commas {
    std::string_view sign, whole, part;  ///< `part`: the digits after the comma
    bool isOne = false;                  ///< false if another comma or a point stands in the number

    /// True if "1,000" may be meant: groups of three digits, the first of one to three and without a leading zero.
    [[nodiscard]] bool mayGroup() const noexcept {
        return !whole.empty() && whole.size() <= 3 && whole.front() != '0' && part.size() == 3;
    }
    [[nodiscard]] bool isDecimal() const noexcept { return isOne && !mayGroup(); }
};

/// Returns nothing if no comma with a digit after it stands in the number.
std::optional<Commas> commasOf(std::string_view text) noexcept {
    const std::size_t sign = text.starts_with('-') || text.starts_with('+') ? 1 : 0;
    const auto rest = text.substr(sign);
    const auto number = rest.substr(0, rest.find_first_not_of("0123456789.,"));
    const auto comma = number.find(',');
    if (comma == number.npos || comma + 1 == number.size()) return std::nullopt;
    return Commas{text.substr(0, sign), number.substr(0, comma), number.substr(comma + 1),
                  number.find_first_of(".,") == comma && number.find_last_of(".,") == comma};
}

}  // namespace

std::optional<double> typedNumber(std::string_view text, std::string_view unit) {
    std::string plain(trimmed(text));
    if (const auto commas = commasOf(plain); commas && commas->isDecimal()) plain[plain.find(',')] = '.';
    return unit.empty() ? parseNumber(plain) : parseQuantity(plain, unit);
}

std::string typedTrouble(std::string_view text) {
    const auto commas = commasOf(trimmed(text));
    if (!commas || commas->isDecimal()) return "";
    if (!commas->isOne) return "; write it with a point, and without commas";
    const auto& [sign, whole, part, isOne] = *commas;
    return fmt::format("; \"{0}{1},{2}\" may be {0}{1}.{2} or {0}{1}{2}: write one of these", sign, whole, part);
}

}  // namespace tacto
