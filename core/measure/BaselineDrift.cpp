#include "core/measure/BaselineDrift.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>

namespace tacto {

namespace {

constexpr std::size_t kShortestBlock = 48;
constexpr std::size_t kCoarsest = 8;  // least number of blocks in a record
constexpr std::size_t kFinest = 4096;
constexpr std::size_t kPerMedian = 65;   // samples of a block from which its median is taken
constexpr std::size_t kJudged = 32'768;  // samples used to check whether a baseline fits
constexpr double kTail = 0.15;           // share of the samples at each end of the range that may be pulses
constexpr double kTailsApart = 2.073;    // distance between the two tails of a Gaussian, in standard deviations
constexpr double kMedianSpread = 1.25;   // standard deviation of a median, in σ/√n
constexpr double kMovesFor = 6;          // standard deviations of a median: a larger movement is a wandering baseline
constexpr double kRests = 1.4;           // times the noise: the most that may remain about a fitting baseline
constexpr double kMaxBend = 0.2;         // largest bend, as a share of the baseline's span
constexpr double kAsGood = 1.05;         // times the best remainder: still as good as the best

std::ptrdiff_t placeOf(double share, const std::vector<double>& values) {
    return static_cast<std::ptrdiff_t>(share * static_cast<double>(values.size() - 1));
}

double quantile(std::vector<double>& values, double share) {
    const auto at = values.begin() + placeOf(share, values);
    std::nth_element(values.begin(), at, values.end());
    return *at;
}

/// Returns the values from the quantile kTail to the quantile 1 - kTail.
double withoutTails(std::vector<double>& values) {
    const double high = quantile(values, 1 - kTail);  // smaller values now stand before this one
    const auto low = values.begin() + placeOf(kTail, values);
    std::nth_element(values.begin(), low, values.begin() + placeOf(1 - kTail, values) + 1);
    return high - *low;
}

double medianOf(std::span<const float> block, std::vector<float>& scratch) {
    const std::size_t stride = std::max<std::size_t>(1, block.size() / kPerMedian);
    scratch.clear();
    for (std::size_t i = stride / 2; i < block.size(); i += stride) {
        if (std::isfinite(block[i])) scratch.push_back(block[i]);
    }
    if (scratch.empty()) return std::numeric_limits<double>::quiet_NaN();
    const auto middle = scratch.begin() + static_cast<std::ptrdiff_t>(scratch.size() / 2);
    std::nth_element(scratch.begin(), middle, scratch.end());
    return static_cast<double>(*middle);
}

/// Returns false if a block has no sample at all.
bool follow(std::span<const float> samples, std::size_t blocks, BaselineDrift& drift) {
    std::vector<float> scratch;
    drift.block = samples.size() / blocks;
    drift.medians.resize(blocks);
    for (std::size_t b = 0; b < blocks; ++b) {
        drift.medians[b] = medianOf(samples.subspan(b * drift.block, drift.block), scratch);
        if (std::isnan(drift.medians[b])) return false;
    }
    const auto [least, most] = std::minmax_element(drift.medians.begin(), drift.medians.end());
    drift.span = *most - *least;
    return true;
}

/// A baseline bends little from block to block (a sine that is eleven blocks long bends by 0.16 of its span). A signal
/// that jumps, even once, changes its state.
bool bendsLittle(const BaselineDrift& drift, double still) {
    const auto& m = drift.medians;
    for (std::size_t b = 2; b < m.size(); ++b) {
        if (!(std::abs(m[b] - 2 * m[b - 1] + m[b - 2]) <= kMaxBend * drift.span + still)) return false;
    }
    return true;
}

/// Returns the spread of the middle 70 % of the samples about the baseline, as a standard deviation.
double restAbout(std::span<const float> samples, const BaselineDrift& drift) {
    std::vector<double> left;
    const std::size_t stride = std::max<std::size_t>(1, samples.size() / kJudged);
    left.reserve(samples.size() / stride + 1);
    for (std::size_t i = 0; i < samples.size(); i += stride) {
        const double x = static_cast<double>(samples[i]);
        if (std::isfinite(x)) left.push_back(x - drift.at(i));
    }
    return withoutTails(left) / kTailsApart;
}

}  // namespace

double BaselineDrift::at(std::size_t sample) const noexcept {
    const double position = (static_cast<double>(sample) + 0.5) / static_cast<double>(block) - 0.5;
    const double last = static_cast<double>(medians.size()) - 1;
    // Before the middle of the first block and after the middle of the last, the line continues straight.
    const auto from = static_cast<std::size_t>(std::clamp(position, 0.0, std::max(0.0, last - 1)));
    if (from + 1 >= medians.size()) return medians[from];
    return medians[from] + (position - static_cast<double>(from)) * (medians[from + 1] - medians[from]);
}

std::optional<BaselineDrift> findDrift(std::span<const float> samples, double noise, double lsb) {
    const std::size_t most = std::min(kFinest, samples.size() / kShortestBlock);
    if (most < kCoarsest) return std::nullopt;
    BaselineDrift drift;
    if (!follow(samples, std::min<std::size_t>(64, most), drift)) return std::nullopt;
    const double perMedian = static_cast<double>(std::min(kPerMedian, drift.block));
    const double still = std::max(kMovesFor * kMedianSpread * noise / std::sqrt(perMedian), 1.5 * lsb);
    auto medians = drift.medians;
    if (!(withoutTails(medians) > still)) return std::nullopt;

    BaselineDrift none;
    if (!follow(samples, 1, none)) return std::nullopt;
    const double undisturbed = std::max(noise, lsb / std::sqrt(12.0));
    const double before = restAbout(samples, none);
    std::vector<std::pair<double, BaselineDrift>> candidates;
    double best = std::numeric_limits<double>::infinity();
    for (std::size_t blocks = kCoarsest; blocks <= most; blocks *= 2) {
        if (!follow(samples, blocks, drift)) break;
        if (!bendsLittle(drift, still)) continue;
        const double rest = restAbout(samples, drift);
        best = std::min(best, rest);
        candidates.emplace_back(rest, drift);
    }
    if (!(best < 0.97 * before) || !(best <= kRests * undisturbed)) return std::nullopt;
    for (auto& [rest, candidate] : candidates) {
        if (rest <= kAsGood * best) return std::move(candidate);
    }
    return std::nullopt;
}

SampleView withoutDrift(const SampleView& view, const BaselineDrift& drift) {
    SampleView result;
    result.capture = view.capture;
    result.channel = view.channel;
    result.mean = view.mean;
    result.rate_hz = view.rate_hz;
    result.start_s = view.start_s;
    result.own.resize(view.samples.size());
    auto medians = drift.medians;
    const double origin = quantile(medians, 0.5);
    // Works from block to block, since the line is straight between the middles of two neighbouring blocks.
    const std::size_t n = view.samples.size();
    for (std::size_t first = 0; first < n;) {
        const std::size_t middle = drift.block / 2;
        const std::size_t next = std::min(n, first < middle ? middle : first + drift.block);
        const double slope =
            next - first > 1 ? (drift.at(next - 1) - drift.at(first)) / static_cast<double>(next - 1 - first) : 0;
        const double begin = drift.at(first) - origin;
        for (std::size_t i = first; i < next; ++i) {
            const double baseline = begin + slope * static_cast<double>(static_cast<std::int64_t>(i - first));
            result.own[i] = static_cast<float>(static_cast<double>(view.samples[i]) - baseline);
        }
        first = next;
    }
    result.samples = result.own;
    return result;
}

}  // namespace tacto
