#include "core/measure/MinMaxPyramid.h"

#include <algorithm>
#include <array>

namespace tacto {

namespace {

constexpr float kNothing = std::numeric_limits<float>::infinity();
constexpr std::size_t kLanes = 16;
static_assert(MinMaxPyramid::kBlock % kLanes == 0);

/// Returns the extremes of `count` samples, a multiple of the lanes. Sixteen lanes and no branch let a compiler
/// vectorise the loop. A comparison with NaN is false, so NaN never becomes an extreme.
Envelope ofLanes(const float* samples, std::size_t count) noexcept {
    std::array<float, kLanes> low;
    std::array<float, kLanes> high;
    std::array<std::int32_t, kLanes> missing;
    for (std::size_t lane = 0; lane < kLanes; ++lane) {
        low[lane] = kNothing;
        high[lane] = -kNothing;
        missing[lane] = 0;
    }
    for (std::size_t row = 0; row < count; row += kLanes) {
        for (std::size_t lane = 0; lane < kLanes; ++lane) {
            const float x = samples[row + lane];
            low[lane] = x < low[lane] ? x : low[lane];
            high[lane] = x > high[lane] ? x : high[lane];
            missing[lane] |= x != x ? 1 : 0;
        }
    }
    for (std::size_t half = kLanes / 2; half > 0; half /= 2) {
        for (std::size_t lane = 0; lane < half; ++lane) {
            low[lane] = std::min(low[lane], low[lane + half]);
            high[lane] = std::max(high[lane], high[lane + half]);
            missing[lane] |= missing[lane + half];
        }
    }
    return {low[0], high[0], missing[0] != 0};
}

void mergeSamples(std::span<const float> samples, Envelope& into) noexcept {
    const std::size_t whole = samples.size() / kLanes * kLanes;
    if (whole > 0) {
        const auto most = ofLanes(samples.data(), whole);
        into.low = std::min(into.low, most.low);
        into.high = std::max(into.high, most.high);
        into.gap |= most.gap;
    }
    bool missing = false;
    for (const float x : samples.subspan(whole)) {
        into.low = x < into.low ? x : into.low;
        into.high = x > into.high ? x : into.high;
        missing |= x != x;
    }
    into.gap |= missing;
}

constexpr std::size_t ceilDivided(std::size_t value, std::size_t by) noexcept { return (value + by - 1) / by; }

}  // namespace

void MinMaxPyramid::Level::resize(std::size_t blocks) {
    low.resize(blocks);
    high.resize(blocks);
    gap.resize(blocks);
}

void MinMaxPyramid::clear() noexcept {
    record_ = {};
    levels_.clear();
}

void MinMaxPyramid::extend(std::span<const float> record) {
    if (record.size() < record_.size()) clear();
    record_ = record;
    std::size_t blocks = record.size() / kBlock;
    if (blocks == 0) return;
    if (levels_.empty()) levels_.emplace_back();
    {
        auto& lowest = levels_.front();
        const std::size_t known = lowest.size();
        lowest.resize(blocks);
        for (std::size_t b = known; b < blocks; ++b) {
            const auto found = ofLanes(record.data() + b * kBlock, kBlock);
            lowest.low[b] = found.low;
            lowest.high[b] = found.high;
            lowest.gap[b] = found.gap ? 1 : 0;
        }
    }
    for (std::size_t above = 1; (blocks /= kFan) > 0; ++above) {
        if (above == levels_.size()) levels_.emplace_back();
        auto& level = levels_[above];
        const auto& below = levels_[above - 1];
        const std::size_t known = level.size();
        level.resize(blocks);
        for (std::size_t b = known; b < blocks; ++b) {
            Envelope merged;
            mergeBlocks(below, b * kFan, (b + 1) * kFan, merged);
            level.low[b] = merged.low;
            level.high[b] = merged.high;
            level.gap[b] = merged.gap ? 1 : 0;
        }
    }
}

void MinMaxPyramid::mergeBlocks(const Level& level, std::size_t first, std::size_t last,
                                Envelope& into) const noexcept {
    for (std::size_t b = first; b < last; ++b) {
        into.low = std::min(into.low, level.low[b]);
        into.high = std::max(into.high, level.high[b]);
        into.gap |= level.gap[b] != 0;
    }
}

Envelope MinMaxPyramid::over(std::size_t first, std::size_t last) const noexcept {
    Envelope result;
    last = std::min(last, record_.size());
    if (first >= last) return result;
    std::size_t from = ceilDivided(first, kBlock);
    std::size_t to = last / kBlock;
    if (from >= to) {
        mergeSamples(record_.subspan(first, last - first), result);
        return result;
    }
    mergeSamples(record_.subspan(first, from * kBlock - first), result);
    mergeSamples(record_.subspan(to * kBlock, last - to * kBlock), result);
    for (std::size_t at = 0; at < levels_.size(); ++at) {
        const std::size_t upFrom = ceilDivided(from, kFan);
        const std::size_t upTo = to / kFan;
        if (upFrom >= upTo) {
            mergeBlocks(levels_[at], from, to, result);
            break;
        }
        mergeBlocks(levels_[at], from, upFrom * kFan, result);
        mergeBlocks(levels_[at], upTo * kFan, to, result);
        from = upFrom;
        to = upTo;
    }
    return result;
}

}  // namespace tacto
