#include "core/base/Text.h"

#include <algorithm>
#include <array>
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

std::optional<double> parseNumber(std::string_view text) {
    text = trimmed(text);
    if (text.size() > 1 && text.front() == '+' && text[1] != '-') text.remove_prefix(1);
    double value = 0;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
    if (error != std::errc{} || end != text.data() + text.size()) return std::nullopt;
    return value;
}

namespace {
struct Prefix {
    std::string_view symbol;
    int exponent;
};
constexpr std::array<Prefix, 9> kParsed{
    {{"p", -12}, {"n", -9}, {"u", -6}, {"µ", -6}, {"μ", -6}, {"m", -3}, {"k", 3}, {"M", 6}, {"G", 9}}};
}  // namespace

std::optional<double> parseQuantity(std::string_view text, std::string_view unit) {
    text = trimmed(text);
    if (text.ends_with(unit)) text = trimmed(text.substr(0, text.size() - unit.size()));
    if (const auto plain = parseNumber(text)) return plain;
    for (const auto& prefix : kParsed) {
        if (!text.ends_with(prefix.symbol)) continue;
        // Parsing "1.5e3" keeps the nearest double, which 1.5 * 1000.0 might miss.
        const std::string number =
            fmt::format("{}e{}", trimmed(text.substr(0, text.size() - prefix.symbol.size())), prefix.exponent);
        return parseNumber(number);
    }
    return std::nullopt;
}

}  // namespace tacto
