#include "core/exchange/dcc/DsiUnit.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "core/base/LocaleFreeText.h"

namespace tacto {

namespace {

struct Named {
    std::string_view name;
    DsiUnit unit;
};
using Dimension = std::array<double, 7>;  // kg, m, s, A, K, mol, cd
constexpr Dimension kNumber{}, kTime{0, 0, 1}, kFrequency{0, 0, -1};
constexpr Named kUnits[] = {{"one", {kNumber}},
                            {"percent", {kNumber, 1e-2}},
                            {"ppm", {kNumber, 1e-6}},
                            {"radian", {kNumber}},
                            {"kilogram", {{1}}},
                            {"gram", {{1}, 1e-3}},
                            {"metre", {{0, 1}}},
                            {"second", {kTime}},
                            {"minute", {kTime, 60}},
                            {"hour", {kTime, 3600}},
                            {"day", {kTime, 86400}},
                            {"ampere", {{0, 0, 0, 1}}},
                            {"kelvin", {{0, 0, 0, 0, 1}}},
                            {"mole", {{0, 0, 0, 0, 0, 1}}},
                            {"candela", {{0, 0, 0, 0, 0, 0, 1}}},
                            {"hertz", {kFrequency}},
                            {"newton", {{1, 1, -2}}},
                            {"pascal", {{1, -1, -2}}},
                            {"joule", {{1, 2, -2}}},
                            {"watt", {{1, 2, -3}}},
                            {"coulomb", {{0, 0, 1, 1}}},
                            {"volt", {{1, 2, -3, -1}}},
                            {"farad", {{-1, -2, 4, 2}}},
                            {"ohm", {{1, 2, -3, -2}}},
                            {"siemens", {{-1, -2, 3, 2}}},
                            {"henry", {{1, 2, -2, -2}}}};
constexpr std::pair<std::string_view, double> kPrefixes[] = {
    {"deca", 1e1},  {"hecto", 1e2},  {"kilo", 1e3},   {"mega", 1e6},   {"giga", 1e9},  {"tera", 1e12},
    {"deci", 1e-1}, {"centi", 1e-2}, {"milli", 1e-3}, {"micro", 1e-6}, {"nano", 1e-9}, {"pico", 1e-12}};

/// Takes "\name" from the front.
std::optional<std::string_view> takeWord(std::string_view& text) {
    if (text.empty() || text.front() != '\\') return std::nullopt;
    const auto isLetter = [](char each) { return lowered(each) >= 'a' && lowered(each) <= 'z'; };
    const auto end = std::find_if_not(text.begin() + 1, text.end(), isLetter);
    const auto word = text.substr(1, static_cast<std::size_t>(end - text.begin()) - 1);
    text.remove_prefix(word.size() + 1);
    return word;
}

/// Takes "\tothe{-2}" from the front; 1 if it is not there.
std::optional<double> takeExponent(std::string_view& text) {
    constexpr std::string_view kBegin = "\\tothe{";
    constexpr double kMax = 20;
    if (!text.starts_with(kBegin)) return 1;
    const auto end = text.find('}');
    if (end == std::string_view::npos) return std::nullopt;
    const auto exponent = parseNumber(text.substr(kBegin.size(), end - kBegin.size()));
    if (!exponent || !(std::abs(*exponent) <= kMax)) return std::nullopt;
    text.remove_prefix(end + 1);
    return exponent;
}

}  // namespace

std::optional<DsiUnit> dsiUnit(std::string_view text) {
    text = trimmed(text);
    if (text.empty()) return std::nullopt;
    DsiUnit all;
    while (!text.empty()) {
        auto word = takeWord(text);
        const bool per = word == "per";
        if (per) word = takeWord(text);
        double factor = 1;
        if (const auto prefix =
                std::ranges::find(kPrefixes, word.value_or(""), &std::pair<std::string_view, double>::first);
            prefix != std::end(kPrefixes)) {
            factor = prefix->second;
            word = takeWord(text);
        }
        const auto found = std::ranges::find(kUnits, word.value_or(""), &Named::name);
        if (found == std::end(kUnits)) return std::nullopt;
        const auto exponent = takeExponent(text);
        if (!exponent) return std::nullopt;
        const double power = per ? -*exponent : *exponent;
        all.factor *= power == 1 ? factor * found->unit.factor : std::pow(factor * found->unit.factor, power);
        for (std::size_t i = 0; i < all.dimension.size(); ++i) all.dimension[i] += power * found->unit.dimension[i];
    }
    if (!std::isfinite(all.factor) || !(all.factor > 0)) return std::nullopt;
    return all;
}

}  // namespace tacto
