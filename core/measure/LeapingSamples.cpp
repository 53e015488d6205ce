#include "core/measure/LeapingSamples.h"

#include <algorithm>
#include <cmath>
#include <cstdint>

namespace tacto {

namespace {

constexpr double kLeapInNoise = 8;
constexpr double kLeapInSteps = 2.5;
constexpr double kLeapInSpan = 0.005;  // share of the record: smaller leaps do not count
constexpr float kAgree = 0.1F;         // share of the leap; half of the least
constexpr std::size_t kOneIn = 100;

/// Whether any sample from `first` to before `end` lies more than `least` beyond both of its neighbours. No branch, so
/// that a compiler turns it into vectors.
bool anyLeaps(const float* x, std::size_t first, std::size_t end, float least) noexcept {
    std::int32_t any = 0;
    for (std::size_t i = first; i < end; ++i) {
        const float up = std::min(x[i] - x[i - 1], x[i] - x[i + 1]);
        const float down = std::min(x[i - 1] - x[i], x[i + 1] - x[i]);
        any |= (up > least ? 1 : 0) | (down > least ? 1 : 0);
    }
    return any != 0;
}

/// `i` has two neighbours on either side.
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
