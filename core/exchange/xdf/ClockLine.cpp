#include "core/exchange/xdf/ClockLine.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace tacto::xdf {

namespace {

constexpr double kRobust_s = 1e-4;

double medianOf(std::vector<double> values) {
    std::ranges::sort(values);
    const auto n = values.size();
    return n % 2 == 1 ? values[n / 2] : 0.5 * (values[n / 2 - 1] + values[n / 2]);
}

/// The distance of each value from the median, and the median of these distances.
struct Spread {
    double median = 0, deviation = 0;
    std::vector<double> distance = {};
};
Spread spreadOf(const std::vector<double>& values) {
    Spread spread{.median = medianOf(values)};
    for (const double value : values) spread.distance.push_back(std::abs(value - spread.median));
    spread.deviation = medianOf(spread.distance);
    return spread;
}

/// Returns the steps from each offset to the next.
std::vector<double> stepsOf(std::span<const ClockOffset> offsets, double ClockOffset::*of) {
    std::vector<double> steps;
    for (std::size_t i = 1; i < offsets.size(); ++i) steps.push_back(offsets[i].*of - offsets[i - 1].*of);
    return steps;
}

}  // namespace

ClockLine fitClock(std::span<const ClockOffset> offsets) {
    std::vector<ClockOffset> known;
    for (const auto& offset : offsets)
        if (std::isfinite(offset.at_s) && std::isfinite(offset.offset_s)) known.push_back(offset);
    if (known.empty()) return {};
    std::vector<double> values;
    ClockLine line;
    for (const auto& offset : known) {
        values.push_back(offset.offset_s);
        line.at_s += offset.at_s / static_cast<double>(known.size());
    }
    line.offset_s = medianOf(values);
    double reach = 0;
    for (const auto& offset : known) reach = std::max(reach, std::abs(offset.at_s - line.at_s));
    if (!(reach > 0) || !std::isfinite(reach)) return line;
    // Weighted least squares, again and again with the weights of the last residuals. x is scaled to -1..1.
    constexpr std::size_t kMaxRounds = 500, kMinRounds = 10, kMaxSteps = 50'000'000;  // of rounds times offsets
    const auto rounds = std::clamp(kMaxSteps / known.size(), kMinRounds, kMaxRounds);
    constexpr double kSettled_s = 1e-9;
    const double level = line.offset_s;  // keeps the sums small
    double constant = 0, slope = 0;
    for (std::size_t round = 0; round < rounds; ++round) {
        double w = 0, wx = 0, wxx = 0, wy = 0, wxy = 0;
        for (const auto& offset : known) {
            const double x = (offset.at_s - line.at_s) / reach, y = offset.offset_s - level;
            const double residual = std::abs(y - constant - slope * x);
            const double weight = round == 0 || residual <= kRobust_s ? 1 : kRobust_s / residual;
            w += weight;
            wx += weight * x;
            wxx += weight * x * x;
            wy += weight * y;
            wxy += weight * x * y;
        }
        const double determinant = w * wxx - wx * wx;
        if (!(determinant > 0)) break;
        const double nextSlope = (w * wxy - wx * wy) / determinant;
        const double nextConstant = (wy - nextSlope * wx) / w;
        const bool settled = std::abs(nextSlope - slope) < kSettled_s && std::abs(nextConstant - constant) < kSettled_s;
        constant = nextConstant;
        slope = nextSlope;
        if (settled) break;
    }
    line.offset_s = level + constant;
    line.drift = slope / reach;
    return line;
}

std::optional<std::size_t> clockReset(std::span<const ClockOffset> offsets) {
    if (offsets.size() < 2) return std::nullopt;
    const auto times = stepsOf(offsets, &ClockOffset::at_s);
    const auto inTime = spreadOf(times), inValue = spreadOf(stepsOf(offsets, &ClockOffset::offset_s));
    const auto isFar = [](const Spread& spread, std::size_t i, double least_s, double deviations) {
        const double usual = spread.deviation + std::numeric_limits<double>::epsilon();
        return spread.distance[i] > least_s && spread.distance[i] > deviations * usual;
    };
    for (std::size_t i = 0; i < times.size(); ++i)
        if (times[i] < 0 || (isFar(inTime, i, 5, 5) && isFar(inValue, i, 1, 10))) return i;
    return std::nullopt;
}

bool lastOffsetIsStray(std::span<const ClockOffset> offsets) {
    constexpr double kFar = 10;
    constexpr double kDeviationOfNormal = 1.4826;  // standard deviations in a median deviation, if it is normal
    if (offsets.size() < 3) return false;
    const auto before = offsets.first(offsets.size() - 1);
    const double usual = medianOf(stepsOf(before, &ClockOffset::at_s));
    const double last = std::abs(offsets.back().at_s - before.back().at_s);
    if (usual > 0 ? last > kFar * usual : last > 0) return true;
    std::vector<double> values;
    for (const auto& offset : before) values.push_back(offset.offset_s);
    const auto spread = spreadOf(values);
    return spread.deviation > std::numeric_limits<double>::epsilon() &&
           std::abs(offsets.back().offset_s - spread.median) > kFar * kDeviationOfNormal * spread.deviation;
}

}  // namespace tacto::xdf
