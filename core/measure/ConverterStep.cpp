#include "core/measure/ConverterStep.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace tacto {

namespace {

constexpr std::size_t kRun = 256;          // neighbouring samples checked together
constexpr std::size_t kRuns = 64;          // number of runs across the whole record
constexpr double kRoundedTo = 5e-7;        // share of the largest value: smaller differences are rounding of a float
constexpr double kOffGrid = 0.2;           // share of a step: a value further off does not lie on the grid
constexpr double kNeighbours = 6;          // steps: a wider gap is ignored, because the step is not known well enough
constexpr std::size_t kManyCodes = 32;     // gaps of one step that are enough
constexpr std::size_t kReturnsWithin = 4;  // samples, because some instruments write each sample twice
constexpr double kMinReturns = 4;          // fewest returns to a code from its neighbour
constexpr std::size_t kHeld = 3;           // samples at one value: a stair, not an edge
constexpr std::size_t kFewCodes = 4;       // gaps of one step, climbed one by one
constexpr double kStairs = 0.8;            // share of the stairs that must be one step
constexpr double kReturns = 0.005;         // share of the samples that must return
constexpr std::size_t kFewValues = 64;     // most values that are compared one by one
constexpr std::size_t kMinOnGrid = 2;      // fewest values on the grid, apart from the two that are one step apart
constexpr double kOffWholeGrid = 0.02;     // share of a step: two values agree by chance once in six hundred
constexpr double kMinSpan = 16;            // steps: an ideal record with few levels may span less

struct Seen {
    std::vector<float> values;    ///< all different, in ascending order
    std::vector<double> returns;  ///< size of each change to a value and back: the larger of the two changes
    std::vector<double> stairs;   ///< steps from one held value to the next held value
    std::size_t samples = 0;
};

/// Collects the changes between successive values in runs of `samples` that begin every `stride` samples.
void lookAtChanges(std::span<const float> samples, std::size_t stride, Seen& seen) {
    double before = 0;
    std::size_t changed = 0, held = 0;
    for (std::size_t k = 1; k * stride < samples.size(); ++k) {
        const float now = samples[k * stride], last = samples[(k - 1) * stride];
        if (now == last) continue;
        const double jump = static_cast<double>(now) - static_cast<double>(last);
        if (stride == 1 && before * jump < 0 && k - changed <= kReturnsWithin) {
            seen.returns.push_back(std::max(std::abs(before), std::abs(jump)));
        }
        if (held >= kHeld && k - changed >= kHeld) seen.stairs.push_back(std::abs(before));
        held = k - changed;
        before = jump;
        changed = k;
    }
}

Seen lookAt(std::span<const float> samples) {
    Seen seen;
    const std::size_t stride = samples.size() / kRuns;
    const std::size_t run = std::max(kRun, samples.size() <= kRun * kRuns ? samples.size() : 0);
    seen.values.reserve(kRun * (kRuns + 1));
    for (std::size_t first = 0; first < samples.size(); first += std::max(run, stride)) {
        const auto neighbours = samples.subspan(first, std::min(run, samples.size() - first));
        std::copy_if(neighbours.begin(), neighbours.end(), std::back_inserter(seen.values),
                     [](float x) { return std::isfinite(x); });
        lookAtChanges(neighbours, 1, seen);
    }
    // A slow baseline stays on each stair for longer than a run.
    if (stride > kRun) lookAtChanges(samples, samples.size() / (kRun * kRuns), seen);
    seen.samples = seen.values.size();
    std::sort(seen.values.begin(), seen.values.end());
    seen.values.erase(std::unique(seen.values.begin(), seen.values.end()), seen.values.end());
    return seen;
}

/// Returns whether a few values all lie on one grid of about `step`. Each distance refines the step.
bool fillOneGrid(const std::vector<float>& values, double step) {
    if (values.size() > kFewValues || values.size() < 2 + kMinOnGrid) return false;
    const auto first = std::adjacent_find(values.begin(), values.end(), [&](float a, float b) {
        return static_cast<double>(b) - static_cast<double>(a) < 1.5 * step;
    });
    std::vector<double> distances;
    for (const float value : values)
        distances.push_back(std::abs(static_cast<double>(value) - static_cast<double>(*first)));
    std::sort(distances.begin(), distances.end());
    for (const double distance : distances) {
        const double steps = std::round(distance / step);
        if (std::abs(distance / step - steps) > kOffWholeGrid) return false;
        if (steps > 0) step = distance / steps;
    }
    return static_cast<double>(values.back()) - static_cast<double>(values.front()) > (kMinSpan - 0.5) * step;
}

}  // namespace

double converterStep(std::span<const float> samples) {
    const auto seen = lookAt(samples);
    if (seen.values.size() < 2) return 0;
    std::vector<double> gaps;
    gaps.reserve(seen.values.size());
    for (std::size_t k = 1; k < seen.values.size(); ++k) {
        gaps.push_back(static_cast<double>(seen.values[k]) - static_cast<double>(seen.values[k - 1]));
    }
    std::sort(gaps.begin(), gaps.end());
    const double largest =
        std::max(std::abs(static_cast<double>(seen.values.front())), std::abs(static_cast<double>(seen.values.back())));
    if (!(gaps.front() > kRoundedTo * largest)) return 0;
    // Text may have rounded the values: the step is the mean of all gaps that can be one step.
    const auto ones =
        static_cast<std::size_t>(std::upper_bound(gaps.begin(), gaps.end(), 1.5 * gaps.front()) - gaps.begin());
    double step = 0;
    for (std::size_t k = 0; k < ones; ++k) step += gaps[k] / static_cast<double>(ones);
    const auto near = static_cast<std::size_t>(
        std::upper_bound(gaps.begin(), gaps.end(), (kNeighbours + kOffGrid) * step) - gaps.begin());
    const auto onGrid = static_cast<std::size_t>(
        std::count_if(gaps.begin(), gaps.begin() + static_cast<std::ptrdiff_t>(near),
                      [&](double gap) { return std::abs(gap / step - std::round(gap / step)) <= kOffGrid; }));
    if (20 * onGrid < 19 * near) return 0;
    const auto single = [&](const std::vector<double>& jumps) {
        return static_cast<double>(
            std::ranges::count_if(jumps, [&](double jump) { return std::abs(jump / step - 1) <= kOffGrid; }));
    };
    const double returns = single(seen.returns), stairs = single(seen.stairs);
    const bool flickers = returns >= kMinReturns && returns >= kReturns * static_cast<double>(seen.samples);
    const bool climbs =
        ones >= kFewCodes && stairs >= kMinReturns && stairs >= kStairs * static_cast<double>(seen.stairs.size());
    // Otherwise, most of the values must lie on the grid.
    const bool fills = ones >= kManyCodes && 2 * near >= gaps.size();
    const bool fewOnGrid = stairs >= 1 && 2 * stairs >= static_cast<double>(seen.stairs.size());
    return flickers || climbs || fills || (fewOnGrid && fillOneGrid(seen.values, step)) ? step : 0;
}

namespace {

constexpr double kLeapInNoise = 8;
constexpr double kLeapInSteps = 2.5;
constexpr double kLeapInSpan = 0.005;  // share of the record's span: smaller leaps are ignored
constexpr float kAgree = 0.1F;         // share of the leap, or half of the least leap if that is more
constexpr std::size_t kOneIn = 100;

/// Returns whether any sample from `first` to before `end` lies more than `least` beyond both of its neighbours.
/// Written without a branch, so that a compiler can vectorise it.
bool anyLeaps(const float* x, std::size_t first, std::size_t end, float least) noexcept {
    std::int32_t any = 0;
    for (std::size_t i = first; i < end; ++i) {
        const float up = std::min(x[i] - x[i - 1], x[i] - x[i + 1]);
        const float down = std::min(x[i - 1] - x[i], x[i + 1] - x[i]);
        any |= (up > least ? 1 : 0) | (down > least ? 1 : 0);
    }
    return any != 0;
}

/// Sample `i` must have two neighbours on either side.
bool leaps(const float* x, std::size_t i, float least) noexcept {
    const float middle = 0.5F * (x[i - 1] + x[i + 1]);
    const float leap = std::abs(x[i] - middle);
    if (!(leap > least) || !std::isfinite(leap)) return false;
    const auto agrees = [&](float other) { return std::abs(other - middle) <= std::max(kAgree * leap, 0.5F * least); };
    return agrees(x[i - 1]) && agrees(x[i + 1]) && (agrees(x[i - 2]) || agrees(x[i + 2]));
}

}  // namespace

std::vector<std::size_t> leapingSamples(const SampleBlocks& blocks, double noise, double lsb) {
    const auto samples = blocks.samples();
    std::vector<std::size_t> found;
    if (samples.size() < 5) return found;
    const double span = static_cast<double>(blocks.thirdHighest()) - static_cast<double>(blocks.thirdLowest());
    const double least = std::max({kLeapInNoise * noise, kLeapInSteps * lsb, kLeapInSpan * span});
    if (!(least > 0)) return found;
    const std::size_t most = samples.size() / kOneIn;
    const auto limit = static_cast<float>(least);
    for (std::size_t first = 2; first + 2 < samples.size();) {
        const std::size_t end =
            std::min((first / SampleBlocks::kSamples + 1) * SampleBlocks::kSamples, samples.size() - 2);
        if (blocks.moves(first, limit) && anyLeaps(samples.data(), first, end, limit)) {
            for (std::size_t i = first; i < end; ++i) {
                if (!leaps(samples.data(), i, limit)) continue;
                found.push_back(i);
                if (found.size() > most) return {};
            }
        }
        first = end;
    }
    return found;
}

SampleView withoutLeaps(const SampleView& view, const std::vector<std::size_t>& leaps) {
    SampleView result = view;
    result.own.assign(view.samples.begin(), view.samples.end());
    for (const std::size_t i : leaps) result.own[i] = 0.5F * (view.samples[i - 1] + view.samples[i + 1]);
    result.samples = result.own;
    return result;
}

}  // namespace tacto
