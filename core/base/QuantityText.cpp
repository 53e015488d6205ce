#include "core/base/QuantityText.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <fmt/format.h>

#include "core/base/LocaleFreeText.h"

namespace tacto {

namespace {

constexpr std::array<std::string_view, 15> kScaled{"V", "A", "s", "Ω",     "Hz",    "C",   "J",  "Pa",
                                                   "N", "W", "F", "W/cm²", "A/cm²", "V/s", "S/s"};
constexpr std::array<UnitPrefix, 8> kPrefixOf{
    {{-12, "p"}, {-9, "n"}, {-6, "µ"}, {-3, "m"}, {0, ""}, {3, "k"}, {6, "M"}, {9, "G"}}};

bool takesPrefix(std::string_view unit) { return std::find(kScaled.begin(), kScaled.end(), unit) != kScaled.end(); }

void replaceAll(std::string& text, std::string_view what, std::string_view by) {
    for (auto at = text.find(what); at != std::string::npos; at = text.find(what, at + by.size()))
        text.replace(at, what.size(), by);
}

/// Returns the value with `decimals` decimals. These may be negative: 457 with -1 is "460". Never "-0".
std::string fixedText(double value, int decimals) {
    if (decimals < 0) {
        const double step = std::pow(10.0, -decimals);
        value = std::round(value / step) * step;
    }
    std::string text = fmt::format("{:.{}f}", value, std::max(0, decimals));
    if (text.front() == '-' && text.find_first_of("123456789") == std::string::npos) text.erase(0, 1);
    return text;
}

std::string withUnit(std::string number, const std::string& unit) {
    return unit.empty() ? number : std::move(number) + " " + unit;
}

std::string powerOfTen(int exponent) {
    static constexpr std::array<const char*, 10> kRaised{"⁰", "¹", "²", "³", "⁴", "⁵", "⁶", "⁷", "⁸", "⁹"};
    std::string text = "10";
    if (exponent < 0) text += "⁻";
    for (const char digit : std::to_string(std::abs(exponent))) text += kRaised[static_cast<std::size_t>(digit - '0')];
    return text;
}

/// Numbers from 0.0001 to below 10 million are written out.
bool isWrittenOut(int exponent) { return exponent >= -4 && exponent < 7; }

}  // namespace

std::string writtenUnit(std::string_view unit) {
    std::string text(unit);
    replaceAll(text, "ohm", "Ω");
    replaceAll(text, "degC", "°C");
    replaceAll(text, "cm2", "cm²");
    replaceAll(text, "m/s2", "m/s²");
    if (text.starts_with("uC") || text.starts_with("us") || text.starts_with("uA") || text.starts_with("um"))
        text.replace(0, 1, "µ");
    return text;
}

UnitParts partsOfUnit(std::string_view written) {
    if (takesPrefix(written)) return {1, std::string(written)};
    for (const auto& prefix : kPrefixOf) {
        const std::string_view symbol(prefix.symbol);
        if (symbol.empty() || !written.starts_with(symbol) || !takesPrefix(written.substr(symbol.size()))) continue;
        return {std::pow(10.0, prefix.exponent), std::string(written.substr(symbol.size()))};
    }
    return {};
}

UnitPrefix prefixOf(int exponent) noexcept {
    const int group = static_cast<int>(std::floor(exponent / 3.0)) * 3;
    return kPrefixOf[static_cast<std::size_t>((std::clamp(group, -12, 9) + 12) / 3)];
}

UnitPrefix prefixFor(std::string_view base, int exponent) noexcept {
    constexpr int kNewtonsFrom = -2;
    return prefixOf(base == "N" && exponent >= kNewtonsFrom && exponent < 0 ? 0 : exponent);
}

int decimalExponent(double value, int digits) {
    if (value == 0 || !std::isfinite(value)) return 0;
    const std::string rounded = fmt::format("{:.{}e}", std::abs(value), digits - 1);
    return static_cast<int>(parseNumber(std::string_view(rounded).substr(rounded.find('e') + 1)).value_or(0));
}

std::string decimalText(double value, int decimals) { return std::isfinite(value) ? fixedText(value, decimals) : "–"; }

std::string scaledText(double value, std::string_view unit, int digits) {
    if (!std::isfinite(value)) return "–";
    const std::string written = writtenUnit(unit);
    const auto parts = partsOfUnit(written);
    if (parts.base.empty()) {
        const int exponent = decimalExponent(value, digits);
        if (value != 0 && !isWrittenOut(exponent)) {
            return withUnit(fixedText(value / std::pow(10.0, exponent), digits - 1) + " × " + powerOfTen(exponent),
                            written);
        }
        if (value == std::floor(value)) return withUnit(fixedText(value, 0), written);
        return withUnit(fixedText(value, digits - 1 - exponent), written);
    }
    const double si = value * parts.factor;
    if (std::abs(si) < 5e-16) return withUnit("0", parts.base);
    const int exponent = decimalExponent(si, digits);
    const auto prefix = prefixFor(parts.base, exponent);
    return withUnit(fixedText(si * std::pow(10.0, -prefix.exponent), digits - 1 - (exponent - prefix.exponent)),
                    prefix.symbol + parts.base);
}

std::string exactText(double value, std::string_view unit) {
    const std::string written = writtenUnit(unit);
    const bool isWhole = value == std::floor(value) && std::abs(value) < 1e15;
    if (value == 0 || (isWhole && partsOfUnit(written).base.empty())) return withUnit(fixedText(value, 0), written);
    std::string text = scaledText(value, unit, 6);
    const auto end = text.find_first_not_of("-0123456789.");
    auto number = text.substr(0, end);
    if (number.find('.') == std::string::npos) return text;
    number.erase(number.find_last_not_of('0') + 1);
    if (number.back() == '.') number.pop_back();
    return number + (end == std::string::npos ? "" : text.substr(end));
}

std::string measuredText(double value, double expanded, std::string_view unit) {
    if (!std::isfinite(value)) return "–";
    if (!std::isfinite(expanded) || expanded < 0) return scaledText(value, unit) + " (U unknown)";
    if (expanded == 0) return scaledText(value, unit);
    const std::string written = writtenUnit(unit);
    const auto parts = partsOfUnit(written);
    const double factor = parts.base.empty() ? 1 : parts.factor;
    const int first = decimalExponent(expanded * factor, 2);  // decimal place of U's first digit
    const bool farBelow = std::abs(value) * factor < 0.5 * std::pow(10.0, first);
    const double leading = expanded * factor / std::pow(10.0, first);
    const int last = first - (farBelow && leading >= 2.95 ? 0 : 1);  // decimal place of the last digit
    const int largest = value == 0 ? first : std::max(decimalExponent(value * factor, 4), first);
    // The last digit is at or after the decimal point: "0.46 ± 0.12 V", not "460 ± 120 mV" with meaningless zeros.
    const auto prefix = parts.base.empty() ? UnitPrefix{} : prefixFor(parts.base, std::max(largest, last + 2));
    const int power = parts.base.empty() && !isWrittenOut(largest) ? largest : prefix.exponent;
    const double scale = factor * std::pow(10.0, -power);
    const double v = value * scale, u = expanded * scale;
    const int decimals = power - last;
    std::string text = fixedText(v, decimals) + " ± " + fixedText(u, decimals);
    if (power != prefix.exponent) text = "(" + text + ") × " + powerOfTen(power);
    return withUnit(std::move(text), parts.base.empty() ? written : prefix.symbol + parts.base);
}

}  // namespace tacto
