#include "core/measure/AmplitudeHistogram.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <iterator>

namespace tacto {

namespace {

constexpr double kPeakOverValley = 2;  // two peaks are two modes if the valley between them is at most half the lower

}  // namespace

AmplitudeHistogram::AmplitudeHistogram(const SampleBlocks& blocks, double noise, double lsb) {
    low_ = static_cast<double>(blocks.thirdLowest());
    width_ = (static_cast<double>(blocks.thirdHighest()) - low_) / static_cast<double>(kBins);
    halfWindow_ = std::clamp<std::size_t>(
        static_cast<std::size_t>(std::ceil(std::max(1.5 * noise, 0.6 * lsb) / width_)), 2, kBins / 8);
    noiseReach_ = std::max(halfWindow_, static_cast<std::size_t>(std::ceil(5 * noise / width_)));
    if (blocks.complete()) {
        fill(blocks.samples());
        return;
    }
    std::vector<float> finite;
    finite.reserve(blocks.finite());
    std::copy_if(blocks.samples().begin(), blocks.samples().end(), std::back_inserter(finite),
                 [](float x) { return std::isfinite(x); });
    fill(finite);
}

/// Finds the bins of a chunk first, while it is in the cache, and then counts. Four separate sets of counts are used,
/// because the same bin often follows before its last sum is written.
void AmplitudeHistogram::fill(std::span<const float> samples) {
    constexpr std::size_t kChunk = 1024;
    constexpr std::size_t kBanks = 4;
    constexpr auto kLastBin = static_cast<float>(kBins - 1);
    struct Bin {
        double count = 0;
        double sum = 0;
    };
    std::array<std::array<Bin, kBins>, kBanks> banks{};
    std::array<std::int32_t, kChunk> bins;
    std::array<float, kChunk> values;
    std::array<float, kChunk> filledUp{};
    const auto least = static_cast<float>(low_);
    const auto most = static_cast<float>(low_ + width_ * static_cast<double>(kBins));
    const auto perUnit = static_cast<float>(1 / width_);
    for (std::size_t first = 0; first < samples.size(); first += kChunk) {
        const std::size_t n = std::min(kChunk, samples.size() - first);
        // The last chunk is padded, so that the loops keep a fixed length. Only its own samples are counted.
        const float* chunk = samples.data() + first;
        if (n < kChunk) {
            std::copy_n(chunk, n, filledUp.begin());
            chunk = filledUp.data();
        }
        for (std::size_t k = 0; k < kChunk; ++k) {
            float x = chunk[k];
            x = x < least ? least : x;
            x = x > most ? most : x;
            values[k] = x;
            // Scaled before the conversion to an integer, because 1 / range may not fit into a float.
            const float position = (x - least) * perUnit;
            bins[k] = static_cast<std::int32_t>(position < kLastBin ? position : kLastBin);
        }
        const auto count = [&](std::size_t k, std::array<Bin, kBins>& bank) {
            auto& bin = bank[static_cast<std::size_t>(bins[k])];
            bin.count += 1;
            bin.sum += static_cast<double>(values[k]);
        };
        std::size_t k = 0;
        for (; k + kBanks <= n; k += kBanks) {
            count(k, banks[0]);
            count(k + 1, banks[1]);
            count(k + 2, banks[2]);
            count(k + 3, banks[3]);
        }
        for (; k < n; ++k) count(k, banks[k % kBanks]);
    }
    for (const auto& bank : banks) {
        for (std::size_t k = 0; k < kBins; ++k) {
            count_[k] += bank[k].count;
            sum_[k] += bank[k].sum;
        }
    }
}

Mode AmplitudeHistogram::modeAt(std::size_t bin) const {
    Mode mode{bin, 0, 0};
    const std::size_t first = bin < halfWindow_ ? 0 : bin - halfWindow_;
    for (std::size_t k = first; k <= std::min(kBins - 1, bin + halfWindow_); ++k) {
        mode.weight += count_[k];
        mode.level += sum_[k];
    }
    mode.level = mode.weight > 0 ? mode.level / mode.weight : low_ + (static_cast<double>(bin) + 0.5) * width_;
    return mode;
}

std::vector<Mode> AmplitudeHistogram::modes() const {
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

double AmplitudeHistogram::chargeBeside(const Mode& mode, int sign) const {
    double charge = 0;
    for (std::size_t k = 0; k < kBins; ++k) {
        const bool beside = sign > 0 ? k > mode.bin + noiseReach_ : k + noiseReach_ < mode.bin;
        if (beside) charge += std::abs(sum_[k] - count_[k] * mode.level);
    }
    return charge;
}

double AmplitudeHistogram::shareAbove(double level) const {
    double above = 0;
    double all = 0;
    for (std::size_t k = 0; k < kBins; ++k) {
        all += count_[k];
        if (count_[k] > 0 && sum_[k] / count_[k] > level) above += count_[k];
    }
    return above / all;
}

}  // namespace tacto
