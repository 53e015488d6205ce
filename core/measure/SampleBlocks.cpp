#include "core/measure/SampleBlocks.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>

namespace tacto {

namespace {

constexpr float kNoExtreme = std::numeric_limits<float>::infinity();
constexpr std::size_t kBlockLanes = 16;
static_assert(SampleBlocks::kSamples % kBlockLanes == 0);

struct Extremes {
    float low = kNoExtreme;
    float high = -kNoExtreme;
    std::size_t finite = 0;
};

/// Sixteen lanes and no branch, so that a compiler can vectorise the loop.
bool ofWholeBlock(const float* samples, Extremes& into) noexcept {
    std::array<float, kBlockLanes> low;
    std::array<float, kBlockLanes> high;
    std::array<std::int32_t, kBlockLanes> odd;  // nonzero: not finite
    low.fill(kNoExtreme);
    high.fill(-kNoExtreme);
    odd.fill(0);
    for (std::size_t row = 0; row < SampleBlocks::kSamples; row += kBlockLanes) {
        for (std::size_t lane = 0; lane < kBlockLanes; ++lane) {
            const float x = samples[row + lane];
            low[lane] = x < low[lane] ? x : low[lane];
            high[lane] = x > high[lane] ? x : high[lane];
            odd[lane] |= x - x != 0.0F ? 1 : 0;
        }
    }
    std::int32_t anyOdd = 0;
    for (std::size_t lane = 0; lane < kBlockLanes; ++lane) {
        into.low = std::min(into.low, low[lane]);
        into.high = std::max(into.high, high[lane]);
        anyOdd |= odd[lane];
    }
    into.finite = SampleBlocks::kSamples;
    return anyOdd == 0;
}

Extremes oneByOne(std::span<const float> samples) noexcept {
    Extremes found;
    for (const float x : samples) {
        if (!std::isfinite(x)) continue;
        ++found.finite;
        found.low = std::min(found.low, x);
        found.high = std::max(found.high, x);
    }
    return found;
}

/// Returns the third smallest of `sign` times all samples. It is in one of the three blocks with the smallest extremes.
float third(std::span<const float> samples, const std::vector<float>& extremes, float sign) {
    std::array<std::size_t, 3> blocks{};
    std::size_t known = 0;
    for (std::size_t b = 0; b < extremes.size(); ++b) {
        std::size_t at = known;
        while (at > 0 && sign * extremes[b] < sign * extremes[blocks[at - 1]]) --at;
        if (at >= blocks.size()) continue;
        for (std::size_t k = std::min(known, blocks.size() - 1); k > at; --k) blocks[k] = blocks[k - 1];
        blocks[at] = b;
        known = std::min(known + 1, blocks.size());
    }
    std::array<float, 3> smallest;  // in ascending order
    smallest.fill(kNoExtreme);
    for (std::size_t k = 0; k < known; ++k) {
        const std::size_t first = blocks[k] * SampleBlocks::kSamples;
        for (const float sample : samples.subspan(first, std::min(SampleBlocks::kSamples, samples.size() - first))) {
            const float x = sign * sample;
            if (!std::isfinite(x) || !(x < smallest[2])) continue;
            smallest[2] = x;
            std::sort(smallest.begin(), smallest.end());
        }
    }
    return sign * smallest[2];
}

/// Returns the index of the first of `samples` below or above the limits, or their number if there is none. Tests eight
/// at once, because the silence between two pulses is short in a record with many.
std::size_t firstBeyond(std::span<const float> samples, float below, float above) noexcept {
    constexpr std::size_t kLaneRow = 8;
    const std::size_t n = samples.size();
    for (std::size_t i = 0; i < n; i += kLaneRow) {
        if (i + kLaneRow <= n) {
            std::int32_t any = 0;
            for (std::size_t k = 0; k < kLaneRow; ++k) {
                const float x = samples[i + k];
                any |= (x > above ? 1 : 0) | (x < below ? 1 : 0);
            }
            if (any == 0) continue;
        }
        for (std::size_t k = i; k < std::min(n, i + kLaneRow); ++k) {
            const float x = samples[k];
            if ((x > above || x < below) && std::isfinite(x)) return k;
        }
    }
    return n;
}

}  // namespace

SampleBlocks::SampleBlocks(std::span<const float> samples) : samples_(samples) {
    const std::size_t blocks = (samples.size() + kSamples - 1) / kSamples;
    low_.resize(blocks);
    high_.resize(blocks);
    lowest_ = kNoExtreme;
    highest_ = -kNoExtreme;
    for (std::size_t b = 0; b < blocks; ++b) {
        const auto block = samples.subspan(b * kSamples, std::min(kSamples, samples.size() - b * kSamples));
        Extremes found;
        if (block.size() < kSamples || !ofWholeBlock(block.data(), found)) found = oneByOne(block);
        low_[b] = found.low;
        high_[b] = found.high;
        finite_ += found.finite;
        lowest_ = std::min(lowest_, found.low);
        highest_ = std::max(highest_, found.high);
    }
    thirdLowest_ = third(samples_, low_, 1.0F);
    thirdHighest_ = third(samples_, high_, -1.0F);
}

std::size_t SampleBlocks::nextBeyond(std::size_t from, float below, float above) const noexcept {
    const std::size_t n = samples_.size();
    std::size_t i = from;
    while (i < n) {
        const std::size_t block = i / kSamples;
        const std::size_t end = std::min(n, (block + 1) * kSamples);
        if (high_[block] > above || low_[block] < below) {
            i += firstBeyond(samples_.subspan(i, end - i), below, above);
            if (i < end) return i;
        }
        i = end;
    }
    return n;
}

bool SampleBlocks::mayReach(std::size_t first, std::size_t end, double low, double high) const noexcept {
    if (!complete()) return true;
    for (std::size_t block = first / kSamples; block * kSamples < end; ++block) {
        if (static_cast<double>(low_[block]) <= low || static_cast<double>(high_[block]) >= high) return true;
    }
    return false;
}

SampleView asRecorded(const Capture& capture, const CaptureChannel& channel) {
    SampleView view;
    view.capture = &capture;
    view.channel = &channel;
    view.samples = channel.samples;
    view.rate_hz = capture.rate_hz;
    view.start_s = capture.start_s;
    return view;
}

SampleView averaged(const SampleView& view, std::size_t mean) {
    SampleView result;
    result.capture = view.capture;
    result.channel = view.channel;
    result.mean = view.mean * mean;
    result.rate_hz = view.rate_hz / static_cast<double>(mean);
    result.start_s = view.timeOf(0.5 * static_cast<double>(mean - 1));
    result.own.resize(view.samples.size() / mean);
    const double share = 1.0 / static_cast<double>(mean);
    const float* sample = view.samples.data();
    for (float& out : result.own) {
        // Four separate sums, so that no addition waits for the one before.
        double sums[4] = {0, 0, 0, 0};
        std::size_t k = 0;
        for (; k + 4 <= mean; k += 4) {
            for (std::size_t lane = 0; lane < 4; ++lane) sums[lane] += static_cast<double>(sample[k + lane]);
        }
        for (; k < mean; ++k) sums[0] += static_cast<double>(sample[k]);
        out = static_cast<float>((sums[0] + sums[1] + sums[2] + sums[3]) * share);
        sample += mean;
    }
    result.samples = result.own;
    return result;
}

}  // namespace tacto
