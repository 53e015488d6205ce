#include "core/exchange/edf/EdfGrid.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>

#include "core/base/LocaleFreeText.h"

namespace tacto::edf {

namespace {

/// Returns the decimal of at most 7 characters nearest to `value` and not below it (`up`) or not above it; nothing if
/// there is none.
std::optional<std::string> decimalBeside(double value, bool up) {
    constexpr std::size_t kMaxText = 7;
    for (int digits = 5; digits >= 0; --digits) {
        const double scale = std::pow(10, digits);
        double rounded = (up ? std::ceil(value * scale) : std::floor(value * scale)) / scale;
        // The product may round the wrong way.
        if (up ? rounded < value : rounded > value) rounded += (up ? 1 : -1) / scale;
        auto text = fmt::format("{:.{}f}", rounded == 0 ? 0.0 : rounded, digits);
        if (text.size() > kMaxText) continue;
        const auto read = parseNumber(text);
        if (read && (up ? *read >= value : *read <= value)) return text;
    }
    return std::nullopt;
}

}  // namespace

double recordDuration_s(std::span<const double> rates_hz, double maxRecord) {
    constexpr double kWhole = 1e-9;
    const auto errorAt = [&](double duration_s) {
        double worst = 0;
        for (const double rate : rates_hz) {
            const double samples = rate * duration_s;
            worst = std::max(worst, std::round(samples) < 1 ? 1 : std::abs(std::round(samples) - samples) / samples);
        }
        return worst;
    };
    double together = 0;
    for (const double rate : rates_hz) together += rate;
    for (const double duration_s : {1.0, 2.0, 4.0, 5.0, 8.0, 10.0})
        if (errorAt(duration_s) <= kWhole && together * duration_s <= maxRecord) return duration_s;
    double best_s = 1, least = INFINITY;
    constexpr int kMultiples = 6000;
    for (int i = 1; i <= kMultiples; ++i) {
        const double duration_s = i / std::round(1 / kMinRecord_s);
        if (together * duration_s > maxRecord && i > 1) break;
        if (const double error = errorAt(duration_s); error < least) {
            least = error;
            best_s = duration_s;
        }
    }
    return best_s;
}

void Scale::digital(const double* values, std::size_t apart, std::span<int> to) const noexcept {
    // Of its own, so that the loop becomes vector instructions.
    const double from = low, by = step, most = static_cast<double>(digitalMax) - static_cast<double>(digitalMin);
    const int least = digitalMin;
    for (std::size_t i = 0; i < to.size(); ++i) {
        const double value = values[i * apart];
        const double steps = (value - from) / by;
        const double above = steps > 1 ? steps : 1;  // also for NaN
        const double inside = above < most ? above : most;
        to[i] = std::abs(value) < INFINITY ? least + static_cast<int>(inside + 0.5) : least;
    }
}

std::optional<Scale> scaleFor(double least, double most, bool whole, int bits) {
    Scale scale;
    scale.digitalMax = (1 << (bits - 1)) - 1;
    scale.digitalMin = -scale.digitalMax - 1;
    if (std::isnan(least) || std::isnan(most)) least = most = 0;
    if (whole && least > scale.digitalMin && most <= scale.digitalMax) {
        scale.exact = true;
        scale.low = scale.digitalMin;
        scale.high = scale.digitalMax;
        scale.physicalMin = fmt::format("{}", scale.digitalMin);
        scale.physicalMax = fmt::format("{}", scale.digitalMax);
        return scale;
    }
    auto top = decimalBeside(most, true);
    if (!top) return std::nullopt;
    scale.high = parseNumber(*top).value_or(0);
    // Where the lowest digital value but one is `least`.
    const double steps = static_cast<double>(scale.digitalMax) - static_cast<double>(scale.digitalMin);
    auto bottom = decimalBeside((least - scale.high / steps) / (1 - 1 / steps), false);
    if (!bottom) return std::nullopt;
    scale.low = parseNumber(*bottom).value_or(0);
    if (!(scale.low < scale.high)) {  // one value, which a decimal holds
        top = decimalBeside(scale.high + std::max(1.0, std::abs(scale.high)), true);
        bottom = decimalBeside(scale.low - std::max(1.0, std::abs(scale.low)), false);
        if (!top || !bottom) return std::nullopt;
        scale.high = parseNumber(*top).value_or(0);
        scale.low = parseNumber(*bottom).value_or(0);
    }
    scale.physicalMin = *bottom;
    scale.physicalMax = *top;
    scale.step = (scale.high - scale.low) / steps;
    return scale;
}

}  // namespace tacto::edf
