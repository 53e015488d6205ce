#include "core/analysis/identification/IdentificationText.h"

#include <algorithm>
#include <cmath>

#include "core/analysis/statistics/Estimate.h"
#include "core/base/QuantityText.h"

namespace tacto {

namespace {

std::string countWord(std::size_t n) {
    constexpr std::string_view kWords[] = {"zero", "one", "two", "three", "four", "five", "six"};
    return n < std::size(kWords) ? std::string(kWords[n]) : std::to_string(n);
}

/// Returns " between 4.0 and 6.5 mA, 14 to 22 V at 3.4 kΩ"; empty if the range is unknown.
std::string rangeText(const PresentedRange& range) {
    if (range.lowIntensity && range.highIntensity) {
        return fmt::format(" between strengths of {:.2f} and {:.2f}", *range.lowIntensity, *range.highIntensity);
    }
    if (!range.low || !range.high) return {};
    auto text = fmt::format(" between {:.1f} and {:.1f} mA", range.low->value(), range.high->value());
    const double low_v = range.lowVoltage.value(), high_v = range.highVoltage.value();
    if (!std::isfinite(low_v) || !std::isfinite(high_v)) return text;
    text += ", " + voltageRangeText(range.lowVoltage, range.highVoltage);
    const double ohm = range.impedance.value();
    if (std::isfinite(ohm))
        text += ohm < 1000 ? fmt::format(" at {:.0f} Ω", ohm) : fmt::format(" at {:.1f} kΩ", ohm / 1000);
    return text;
}

/// Half the width of the Wilson interval at this share of right answers, in %.
double reach_pct(std::size_t n, double share) {
    const auto interval = wilsonInterval(static_cast<std::size_t>(std::lround(share * static_cast<double>(n))), n);
    return 50 * (interval.high - interval.low);
}

}  // namespace

std::string voltageRangeText(Volts low, Volts high) {
    const int decimals = std::clamp(1 - decimalExponent(std::min(low, high).value(), 2), 0, 3);
    return fmt::format("{:.{}f} to {:.{}f} V", low.value(), decimals, high.value(), decimals);
}

std::string headline(const std::string& name, const Identification& found, const PresentedRange& range) {
    const auto& all = found.all;
    if (all.n == 0) return fmt::format("{} answered no test trial.", name);
    return fmt::format(
        "{} told the {} apart in {} of {} trials ({:.0f} %, 95 % interval {:.0f} to {:.0f} %, chance {:.0f} %){}.",
        name, countWord(found.labels.size()), all.hits, all.n, 100 * all.accuracy.value, 100 * all.accuracy.low,
        100 * all.accuracy.high, 100 * all.chance, rangeText(range));
}

std::string answerWords(std::string_view key) {
    if (key == kNoneResponse) return "nothing";
    if (key == kNotSureResponse) return "not sure";
    const auto [texture, pressure] = featuresOf(key);
    if ((texture != "rough" && texture != "smooth") || (pressure != "high" && pressure != "low"))
        return std::string(key);
    return fmt::format("{}, {}", texture, pressure == "high" ? "firm" : "light");
}

std::string chanceText(double p) {
    if (!std::isfinite(p)) return "–";
    return p < 0.001 ? "< 0.001" : decimalText(p, 3);
}

std::string bitsText(const Estimate& bits) {
    if (!std::isfinite(bits.value)) return "–";
    if (!std::isfinite(bits.low)) return decimalText(bits.value, 2);  // from an older version, without an interval
    return fmt::format("{} ({} to {})", decimalText(bits.value, 2), decimalText(bits.low, 2),
                       decimalText(bits.high, 2));
}

std::string precisionSentence(std::size_t n, double chance) {
    const std::size_t from = aboveChanceFrom(n, chance);
    const auto clear = from > n ? fmt::format("not even {} right of {} are above chance", n, n)
                                : fmt::format("{} right of {} is above chance", from, n);
    return fmt::format("{} trials: ± {:.0f} % at 85 %, ± {:.0f} % at 50 %; {}.", n, reach_pct(n, 0.85),
                       reach_pct(n, 0.5), clear);
}

}  // namespace tacto
