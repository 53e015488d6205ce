#include "core/measure/StateLevels.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <fmt/format.h>
#include <iterator>
#include <vector>

#include "core/measure/AmplitudeHistogram.h"
#include "core/measure/SampleBlocks.h"

namespace tacto {

namespace {

constexpr std::size_t kMinForLevels = 20;
constexpr double kSpanInNoise = 8;          // standard deviations: Gaussian noise alone spans 7 to 9
constexpr double kSmallestBaseline = 0.05;  // share of the samples, for a baseline between two other states
constexpr double kWideWindow = 0.06;        // share of the distance to the next state
constexpr double kSmallestReturn = 0.2;     // share of the leading phase's charge; a smaller return is ringing
constexpr double kWanders = 0.15;           // share of the distance to the larger state: no pulses are found below this
constexpr double kStepsApart = 2.5;         // steps of the converter: least distance from the baseline to a state
constexpr double kRestingSpread = 0.2;      // share of the distance to the next state; a sine has 0.24, ringing less

/// Returns the mode with the largest product of time and distance: a state, not the ringing next to it.
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

bool threeStates(const AmplitudeHistogram& histogram, const std::vector<Mode>& modes, std::size_t n,
                 StateLevels& levels) {
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

bool twoStates(const AmplitudeHistogram& histogram, const std::vector<Mode>& modes, StateLevels& levels) {
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

/// Deviations from an origin. Within the window: their number, sum and sum of squares. Nearer than half way to the next
/// state: their number and sum of squares.
struct Moments {
    double near = 0, sum = 0, squares = 0, half = 0, spread = 0;
};

/// Works in lanes without branches on a few thousand samples at a time; for so short a sum, float precision is enough.
Moments momentsAbout(std::span<const float> samples, double origin, double window, double half) {
    constexpr std::size_t kFloatLanes = 8;
    constexpr std::size_t kLaneRows = 256;
    Moments all;
    const auto zero = static_cast<float>(origin);
    const auto outer = static_cast<float>(half);
    const auto inner = std::min(static_cast<float>(window), std::nextafter(outer, 0.0F));
    std::array<float, kFloatLanes * kLaneRows> chunk;
    // A million samples give the baseline to a thousandth of the noise, so longer records are read in part.
    const std::size_t stride = chunk.size() * std::max<std::size_t>(1, samples.size() / 1'000'000);
    for (std::size_t first = 0; first < samples.size(); first += stride) {
        const std::size_t n = std::min(chunk.size(), samples.size() - first);
        if (n < chunk.size()) chunk.fill(std::numeric_limits<float>::quiet_NaN());
        std::copy_n(samples.begin() + static_cast<std::ptrdiff_t>(first), n, chunk.begin());
        std::array<float, kFloatLanes> near{}, sum{}, squares{}, within{}, spread{};
        for (std::size_t row = 0; row < chunk.size(); row += kFloatLanes) {
            for (std::size_t lane = 0; lane < kFloatLanes; ++lane) {
                const float d = chunk[row + lane] - zero;
                const float distance = d < 0 ? -d : d;
                // A comparison with NaN is false, so missing samples are never counted.
                const float inHalf = distance < outer ? d : 0.0F;
                const float inWindow = distance <= inner ? d : 0.0F;
                within[lane] += distance < outer ? 1.0F : 0.0F;
                near[lane] += distance <= inner ? 1.0F : 0.0F;
                spread[lane] += inHalf * inHalf;
                sum[lane] += inWindow;
                squares[lane] += inWindow * inWindow;
            }
        }
        for (std::size_t lane = 0; lane < kFloatLanes; ++lane) {
            all.near += static_cast<double>(near[lane]);
            all.sum += static_cast<double>(sum[lane]);
            all.squares += static_cast<double>(squares[lane]);
            all.half += static_cast<double>(within[lane]);
            all.spread += static_cast<double>(spread[lane]);
        }
    }
    // Corrects for the origin, which was rounded to a float.
    const double rounding = static_cast<double>(zero) - origin;
    all.sum += all.near * rounding;
    return all;
}

/// Sets the baseline to the mean around its mode, and the noise. Returns whether the signal rests there at all.
bool refineBaseline(std::span<const float> samples, double noise, StateLevels& levels) {
    double nearest = std::numeric_limits<double>::infinity();
    for (const double state : {levels.low, levels.high}) {
        if (state != levels.baseline) nearest = std::min(nearest, std::abs(state - levels.baseline));
    }
    const double origin = levels.baseline;
    Moments moments = momentsAbout(samples, origin, std::max(4 * noise, 0.005 * nearest), 0.5 * nearest);
    // The mode lies between codes that are further apart than the noise suggests, so the window is widened.
    if (!(moments.near > 0)) moments = momentsAbout(samples, origin, kWideWindow * nearest, 0.5 * nearest);
    const auto [near, sum, squares, half, spread] = moments;
    if (!(half > 0) || !(near > 0)) return false;
    if (std::sqrt(spread / half) > kRestingSpread * nearest) return false;
    const double mean = sum / near;  // measured from the origin; squares are about the mean, to float precision
    const bool isLow = levels.low == levels.baseline;
    const bool isHigh = levels.high == levels.baseline;
    levels.baseline = origin + mean;
    if (isLow) levels.low = levels.baseline;
    if (isHigh) levels.high = levels.baseline;
    levels.noise = near > 1 ? std::sqrt(std::max(0.0, squares / near - mean * mean)) : 0;
    return true;
}

}  // namespace

double neighbourNoise(std::span<const float> samples, double lsb) {
    constexpr std::size_t kPairs = 4096;
    const std::size_t stride = std::max<std::size_t>(1, samples.size() / kPairs);
    std::vector<float> steps;
    steps.reserve(kPairs * 2);
    for (std::size_t i = 0; i + 1 < samples.size(); i += stride) {
        const float step = std::abs(samples[i + 1] - samples[i]);
        if (std::isfinite(step)) steps.push_back(step);
    }
    const double quantisation = lsb / std::sqrt(12.0);
    if (steps.empty()) return quantisation;
    const auto middle = steps.begin() + static_cast<std::ptrdiff_t>(steps.size() / 2);
    std::nth_element(steps.begin(), middle, steps.end());
    auto median = static_cast<double>(*middle);
    if (lsb > 0) {
        // Differences are multiples of the step. Equal ones are treated as spread over half a step either way.
        const auto nearby = [&](float x) { return std::abs(static_cast<double>(x) - median) < 0.5 * lsb; };
        const auto equal = static_cast<double>(std::ranges::count_if(steps, nearby));
        const auto below = static_cast<double>(
            std::ranges::count_if(steps, [&](float x) { return !nearby(x) && static_cast<double>(x) < median; }));
        const double share = (0.5 * static_cast<double>(steps.size()) - below) / equal;
        median = median < 0.5 * lsb ? 0.5 * lsb * share : median + lsb * (share - 0.5);
    }
    return std::max(quantisation, median / (0.6745 * std::sqrt(2.0)));
}

StateLevels findStateLevels(std::span<const float> samples, double lsb, bool logic) {
    return findStateLevels(SampleBlocks(samples), lsb, logic);
}

StateLevels findStateLevels(const SampleBlocks& blocks, double lsb, bool logic) {
    const double low = static_cast<double>(blocks.lowest());
    const double high = static_cast<double>(blocks.highest());
    if (blocks.finite() < kMinForLevels)
        return none(fmt::format("it has {} samples; {} are the least", blocks.finite(), kMinForLevels));
    if (!(high > low)) return none(fmt::format("it stays at {:.4g}", low));
    if (logic) {
        StateLevels levels;
        levels.count = StateCount::Two;
        levels.baseline = levels.low = 0;
        levels.high = 1;
        return levels;
    }
    const double noise = neighbourNoise(blocks.samples(), lsb);
    const double span = static_cast<double>(blocks.thirdHighest()) - static_cast<double>(blocks.thirdLowest());
    if (!(span > kSpanInNoise * noise) || !(span > 4 * lsb)) {
        return none(fmt::format("it moves by {:.3g} in all, no more than its noise", high - low));
    }
    const AmplitudeHistogram histogram(blocks, noise, lsb);
    const auto modes = histogram.modes();
    StateLevels levels;
    const bool three = threeStates(histogram, modes, blocks.finite(), levels);
    if (!three && !twoStates(histogram, modes, levels)) return none("it rests at fewer than two levels");
    for (const double state : {levels.low, levels.high}) {
        if (state == levels.baseline || std::abs(state - levels.baseline) >= kStepsApart * lsb) continue;
        return none("its levels lie fewer than three steps of the converter apart");
    }
    if (refineBaseline(blocks.samples(), noise, levels)) return levels;
    // A moving baseline may stay at a nearby level that is no state of the signal. There are then two states.
    const double up = levels.high - levels.baseline, down = levels.baseline - levels.low;
    if (three && std::min(up, down) < kWanders * std::max(up, down) && twoStates(histogram, modes, levels) &&
        refineBaseline(blocks.samples(), noise, levels)) {
        return levels;
    }
    return none("it moves all the time and rests at no level");
}

}  // namespace tacto
