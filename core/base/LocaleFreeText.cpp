#include "core/base/LocaleFreeText.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <fmt/format.h>

#include "core/base/QuantityText.h"

namespace tacto {

std::string_view trimmed(std::string_view text) {
    constexpr std::string_view kBlanks = " \t\r\n";
    const auto first = text.find_first_not_of(kBlanks);
    if (first == std::string_view::npos) return {};
    return text.substr(first, text.find_last_not_of(kBlanks) - first + 1);
}

std::vector<std::string_view> split(std::string_view text, char separator) {
    std::vector<std::string_view> parts;
    std::size_t begin = 0;
    for (;;) {
        const auto end = text.find(separator, begin);
        parts.push_back(text.substr(begin, end == std::string_view::npos ? end : end - begin));
        if (end == std::string_view::npos) return parts;
        begin = end + 1;
    }
}

// Not fast_float, which reads the millions of numbers of a capture: it turns 1e999 into infinity and 1e-400 into 0.
std::optional<double> takeNumber(std::string_view& text) {
    double value = 0;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
    if (error != std::errc{}) return std::nullopt;
    text.remove_prefix(static_cast<std::size_t>(end - text.data()));
    return value;
}

std::optional<double> parseNumber(std::string_view text) {
    text = trimmed(text);
    if (text.size() > 1 && text.front() == '+' && text[1] != '-') text.remove_prefix(1);
    const auto value = takeNumber(text);
    return text.empty() ? value : std::nullopt;
}

namespace {

/// Returns the engineering prefix at the end of a text; "u" and the Greek letter also mean micro.
std::optional<UnitPrefix> prefixAtEnd(std::string_view text) {
    for (const char* micro : {"u", "μ"}) {
        if (text.ends_with(micro)) return UnitPrefix{-6, micro};
    }
    for (int exponent = -12; exponent <= 9; exponent += 3) {
        const auto prefix = prefixOf(exponent);
        if (*prefix.symbol != '\0' && text.ends_with(prefix.symbol)) return prefix;
    }
    return std::nullopt;
}

}  // namespace

std::optional<double> parseQuantity(std::string_view text, std::string_view unit) {
    text = trimmed(text);
    if (text.ends_with(unit)) text = trimmed(text.substr(0, text.size() - unit.size()));
    if (const auto plain = parseNumber(text)) return plain;
    const auto prefix = prefixAtEnd(text);
    if (!prefix) return std::nullopt;
    // Parsing "1.5e3" gives the nearest double, which 1.5 * 1000.0 might miss.
    text.remove_suffix(std::string_view(prefix->symbol).size());
    return parseNumber(fmt::format("{}e{}", trimmed(text), prefix->exponent));
}

}  // namespace tacto
