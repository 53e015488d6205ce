#include "core/measure/StateLevels.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <fmt/format.h>
#include <vector>

namespace tacto {

namespace {

constexpr std::size_t kBins = 200;
constexpr std::size_t kFewestSamples = 20;
constexpr double kSpanInNoise = 8;          // Gaussian noise alone reaches 7 to 9 in a record's span
constexpr double kPeakOverValley = 2;       // two modes are two when the valley between is half the lower
constexpr double kSmallestBaseline = 0.05;  // of the samples, between two other states
constexpr double kSmallestReturn = 0.2;     // of the leading phase's charge, to be a second phase and not ringing
constexpr double kRestingSpread = 0.2;  // of the way to the next state; a sine has 0.24, a square wave's ringing less

struct Range {
    double low = 0;
    double high = 0;
    double trimmedLow = 0;  // without the two outermost samples: a glitch must not stretch the histogram
    double trimmedHigh = 0;
    std::size_t n = 0;
};

Range rangeOf(std::span<const float> samples) {
    std::array<float, 3> lowest;   // ascending
    std::array<float, 3> highest;  // descending
    lowest.fill(std::numeric_limits<float>::infinity());
    highest.fill(-std::numeric_limits<float>::infinity());
    std::size_t n = 0;
    for (const float x : samples) {
        if (!std::isfinite(x)) continue;
        ++n;
        if (x < lowest[2]) {
            lowest[2] = x;
            if (lowest[2] < lowest[1]) std::swap(lowest[2], lowest[1]);
            if (lowest[1] < lowest[0]) std::swap(lowest[1], lowest[0]);
        }
        if (x > highest[2]) {
            highest[2] = x;
            if (highest[2] > highest[1]) std::swap(highest[2], highest[1]);
            if (highest[1] > highest[0]) std::swap(highest[1], highest[0]);
        }
    }
    return {lowest[0], highest[0], lowest[2], highest[2], n};
}

/// Noise from the median step between neighbours: edges are too few to move a median.
double noiseOf(std::span<const float> samples) {
    constexpr std::size_t kPairs = 4096;
    const std::size_t stride = std::max<std::size_t>(1, samples.size() / kPairs);
    std::vector<float> steps;
    steps.reserve(kPairs * 2);
    for (std::size_t i = 0; i + 1 < samples.size(); i += stride) {
        const float step = std::abs(samples[i + 1] - samples[i]);
        if (std::isfinite(step)) steps.push_back(step);
    }
    if (steps.empty()) return 0;
    const auto middle = steps.begin() + static_cast<std::ptrdiff_t>(steps.size() / 2);
    std::nth_element(steps.begin(), middle, steps.end());
    return static_cast<double>(*middle) / (0.6745 * std::sqrt(2.0));
}

struct Mode {
    std::size_t bin = 0;
    double weight = 0;  // samples within the smoothing window
    double level = 0;   // their mean
};

/// Counts and sums per bin, so that a level is a mean of samples and not a bin's centre.
struct Histogram {
    std::array<double, kBins> count{};
    std::array<double, kBins> sum{};
    double low = 0;
    double width = 0;
    std::size_t halfWindow = 2;
    std::size_t noiseReach = 2;  // beyond this many bins from a mode lies no noise of it

    Histogram(std::span<const float> samples, const Range& range, double noise) {
        low = range.trimmedLow;
        width = (range.trimmedHigh - range.trimmedLow) / static_cast<double>(kBins);
        halfWindow = std::clamp<std::size_t>(static_cast<std::size_t>(std::ceil(1.5 * noise / width)), 2, kBins / 8);
        noiseReach = std::max(halfWindow, static_cast<std::size_t>(std::ceil(5 * noise / width)));
        for (const float x : samples) {
            if (!std::isfinite(x)) continue;
            const double value = std::clamp(static_cast<double>(x), range.trimmedLow, range.trimmedHigh);
            const auto bin = std::min(kBins - 1, static_cast<std::size_t>((value - low) / width));
            count[bin] += 1;
            sum[bin] += value;
        }
    }

    [[nodiscard]] Mode modeAt(std::size_t bin) const {
        Mode mode{bin, 0, 0};
        const std::size_t first = bin < halfWindow ? 0 : bin - halfWindow;
        for (std::size_t k = first; k <= std::min(kBins - 1, bin + halfWindow); ++k) {
            mode.weight += count[k];
            mode.level += sum[k];
        }
        mode.level = mode.weight > 0 ? mode.level / mode.weight : low + (static_cast<double>(bin) + 0.5) * width;
        return mode;
    }

    /// Local maxima of the smoothed histogram that are separated by valleys, ascending.
    [[nodiscard]] std::vector<Mode> modes() const {
        std::vector<double> smooth(kBins);
        for (std::size_t k = 0; k < kBins; ++k) smooth[k] = modeAt(k).weight;
        std::vector<Mode> found;
        std::size_t peak = 0;
        std::size_t plateauEnd = 0;
        double valley = 0;
        bool rising = true;
        const auto accept = [&] { found.push_back(modeAt((peak + plateauEnd) / 2)); };
        for (std::size_t k = 0; k < kBins; ++k) {
            if (rising) {
                if (smooth[k] > smooth[peak]) {
                    peak = plateauEnd = k;
                } else if (smooth[k] == smooth[peak] && k == plateauEnd + 1) {
                    plateauEnd = k;
                } else if (smooth[k] * kPeakOverValley < smooth[peak]) {
                    accept();
                    rising = false;
                    valley = smooth[k];
                }
            } else {
                valley = std::min(valley, smooth[k]);
                if (smooth[k] > valley * kPeakOverValley && smooth[k] > 0) {
                    rising = true;
                    peak = plateauEnd = k;
                }
            }
        }
        if (rising && smooth[peak] > 0) accept();
        return found;
    }

    /// ∫ of what lies above (sign +1) or below (-1) the mode's window, relative to its level.
    [[nodiscard]] double chargeBeside(const Mode& mode, int sign) const {
        double charge = 0;
        for (std::size_t k = 0; k < kBins; ++k) {
            const bool beside = sign > 0 ? k > mode.bin + noiseReach : k + noiseReach < mode.bin;
            if (beside) charge += std::abs(sum[k] - count[k] * mode.level);
        }
        return charge;
    }

    /// Share of samples above `level`, to a bin's width.
    [[nodiscard]] double shareAbove(double level) const {
        double above = 0;
        double all = 0;
        for (std::size_t k = 0; k < kBins; ++k) {
            all += count[k];
            if (count[k] > 0 && sum[k] / count[k] > level) above += count[k];
        }
        return above / all;
    }
};

/// The mode that holds most, weighing time by distance: a state, not the ringing beside one.
const Mode* strongest(const std::vector<Mode>& modes, const Mode& from, int sign) {
    const Mode* best = nullptr;
    double bestCharge = 0;
    for (const auto& mode : modes) {
        const double distance = mode.level - from.level;
        if ((sign > 0 && !(distance > 0)) || (sign < 0 && !(distance < 0)) || mode.bin == from.bin) continue;
        if (mode.weight * std::abs(distance) > bestCharge) {
            best = &mode;
            bestCharge = mode.weight * std::abs(distance);
        }
    }
    return best;
}

StateLevels none(std::string why) {
    StateLevels levels;
    levels.why = std::move(why);
    return levels;
}

bool threeStates(const Histogram& histogram, const std::vector<Mode>& modes, std::size_t n, StateLevels& levels) {
    const Mode* baseline = nullptr;
    for (const auto& candidate : modes) {
        if (candidate.weight < kSmallestBaseline * static_cast<double>(n)) continue;
        const double above = histogram.chargeBeside(candidate, +1);
        const double below = histogram.chargeBeside(candidate, -1);
        if (!(std::min(above, below) >= kSmallestReturn * std::max(above, below)) || !(above > 0)) continue;
        const Mode* high = strongest(modes, candidate, +1);
        const Mode* low = strongest(modes, candidate, -1);
        if (high == nullptr || low == nullptr) continue;
        const double highCharge = high->weight * (high->level - candidate.level);
        const double lowCharge = low->weight * (candidate.level - low->level);
        if (!(std::min(highCharge, lowCharge) >= 0.5 * kSmallestReturn * std::max(highCharge, lowCharge))) continue;
        if (baseline == nullptr || candidate.weight > baseline->weight) baseline = &candidate;
    }
    if (baseline == nullptr) return false;
    levels.count = StateCount::Three;
    levels.baseline = baseline->level;
    levels.high = strongest(modes, *baseline, +1)->level;
    levels.low = strongest(modes, *baseline, -1)->level;
    return true;
}

bool twoStates(const Histogram& histogram, const std::vector<Mode>& modes, StateLevels& levels) {
    if (modes.size() < 2) return false;
    const auto& largest =
        *std::max_element(modes.begin(), modes.end(), [](const Mode& a, const Mode& b) { return a.weight < b.weight; });
    const Mode* other = strongest(modes, largest, 0);
    if (other == nullptr) return false;
    levels.count = StateCount::Two;
    levels.low = std::min(largest.level, other->level);
    levels.high = std::max(largest.level, other->level);
    const double difference = levels.high - levels.low;
    const double above = histogram.shareAbove(0.5 * (levels.low + levels.high));
    const bool lowIsZero = std::abs(levels.low) <= 0.1 * difference;
    const bool highIsZero = std::abs(levels.high) <= 0.1 * difference;
    levels.baseline = above >= 0.9 ? levels.high : above <= 0.1 || lowIsZero || !highIsZero ? levels.low : levels.high;
    return true;
}

/// Baseline as the mean about its mode, the noise about it, and whether the signal rests there at all.
bool refineBaseline(std::span<const float> samples, double neighbourNoise, StateLevels& levels) {
    double nearest = std::numeric_limits<double>::infinity();
    for (const double state : {levels.low, levels.high}) {
        if (state != levels.baseline) nearest = std::min(nearest, std::abs(state - levels.baseline));
    }
    const double window = std::max(4 * neighbourNoise, 0.005 * nearest);
    const double origin = levels.baseline;
    double near = 0, sum = 0, squares = 0, half = 0, spread = 0;
    for (const float x : samples) {
        const double d = static_cast<double>(x) - origin;
        if (std::abs(d) < 0.5 * nearest) {
            half += 1;
            spread += d * d;
            if (std::abs(d) <= window) {
                near += 1;
                sum += d;
                squares += d * d;
            }
        }
    }
    if (!(half > 0) || !(near > 0) || std::sqrt(spread / half) > kRestingSpread * nearest) return false;
    const double mean = sum / near;
    const bool isLow = levels.low == levels.baseline;
    const bool isHigh = levels.high == levels.baseline;
    levels.baseline = origin + mean;
    if (isLow) levels.low = levels.baseline;
    if (isHigh) levels.high = levels.baseline;
    levels.noise = near > 1 ? std::sqrt(std::max(0.0, squares / near - mean * mean)) : 0;
    return true;
}

}  // namespace

StateLevels findStateLevels(std::span<const float> samples, double lsb, bool logic) {
    const Range range = rangeOf(samples);
    if (range.n < kFewestSamples)
        return none(fmt::format("it has {} samples; {} are the least", range.n, kFewestSamples));
    if (!(range.high > range.low)) return none(fmt::format("it stays at {:.4g}", range.low));
    if (logic) {
        StateLevels levels;
        levels.count = StateCount::Two;
        levels.baseline = levels.low = 0;
        levels.high = 1;
        return levels;
    }
    const double noise = std::max(noiseOf(samples), lsb / std::sqrt(12.0));
    const double span = range.trimmedHigh - range.trimmedLow;
    if (!(span > kSpanInNoise * noise) || !(span > 4 * lsb)) {
        return none(fmt::format("it moves by {:.3g} in all, no more than its noise", range.high - range.low));
    }
    const Histogram histogram(samples, range, noise);
    const auto modes = histogram.modes();
    StateLevels levels;
    if (!threeStates(histogram, modes, range.n, levels) && !twoStates(histogram, modes, levels)) {
        return none("it rests at fewer than two levels");
    }
    if (!refineBaseline(samples, noise, levels)) return none("it moves all the time and rests at no level");
    return levels;
}

}  // namespace tacto
