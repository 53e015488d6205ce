#include "core/measure/CaptureAverage.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/measure/Clipping.h"

namespace tacto {

namespace {

constexpr float kMissing = std::numeric_limits<float>::quiet_NaN();
constexpr double kOnTheGrid = 1e-3;   ///< share of a sample: no trigger is known more closely than this
constexpr double kSameAmount = 1e-6;  ///< relative difference of amplitudes that are the same

double beforeTrigger(const Capture& capture) { return capture.start_s - capture.trigger_s; }

bool same(double a, double b) {
    return std::isnan(a) ? std::isnan(b) : std::abs(a - b) <= kSameAmount * std::max(std::abs(a), std::abs(b));
}

bool sameInput(const CaptureChannel& a, const CaptureChannel& b) {
    return a.name == b.name && a.unit == b.unit && a.low == b.low && a.high == b.high;
}

}  // namespace

void CaptureAverage::setCaptures(std::size_t captures) {
    if (captures == wanted_) return;
    wanted_ = std::max<std::size_t>(1, captures);
    clear();
}

void CaptureAverage::clear() {
    count_ = 0;
    channels_.clear();
}

bool CaptureAverage::repeats(const Capture& capture) const {
    return count_ > 0 && capture.samples() == samples_ && same(capture.rate_hz, like_.rate_hz) &&
           std::abs(beforeTrigger(capture) - beforeTrigger(like_)) * like_.rate_hz < 1 &&
           same(capture.programmed, like_.programmed) && capture.simulated == like_.simulated &&
           std::equal(capture.channels.begin(), capture.channels.end(), like_.channels.begin(), like_.channels.end(),
                      sameInput);
}

void CaptureAverage::begin(const Capture& capture) {
    count_ = 0;
    samples_ = capture.samples();
    like_ = {};
    like_.rate_hz = capture.rate_hz;
    like_.start_s = capture.start_s;
    like_.trigger_s = capture.trigger_s;
    like_.programmed = capture.programmed;
    like_.simulated = capture.simulated;
    channels_.clear();
    for (const auto& channel : capture.channels) {
        auto& its = like_.channels.emplace_back();
        its.name = channel.name;
        its.unit = channel.unit;
        its.low = channel.low;
        its.high = channel.high;
        channels_.push_back({std::vector<double>(samples_, 0.0), std::vector<unsigned>(samples_, 0U),
                             std::vector<float>(samples_, kMissing)});
    }
}

void CaptureAverage::take(const Capture& capture) {
    // Sample i of the grid lies `shift` samples after sample i of this capture.
    double shift = (beforeTrigger(like_) - beforeTrigger(capture)) * like_.rate_hz;
    if (std::abs(shift) < kOnTheGrid) shift = 0;
    const double floor = std::floor(shift), part = shift - floor;
    const auto offset = static_cast<std::ptrdiff_t>(floor);
    const auto size = static_cast<std::ptrdiff_t>(samples_);
    for (std::size_t c = 0; c < channels_.size(); ++c) {
        const auto& samples = capture.channels[c].samples;
        const auto limits = clipLimits(capture.channels[c]);
        auto& its = channels_[c];
        for (std::ptrdiff_t i = 0; i < size; ++i) {
            const auto first = i + offset, second = part > 0 ? first + 1 : first;
            if (first < 0 || second >= size) continue;
            const float a = samples[static_cast<std::size_t>(first)], b = samples[static_cast<std::size_t>(second)];
            const double value = static_cast<double>(a) + part * (static_cast<double>(b) - static_cast<double>(a));
            if (std::isnan(value)) continue;
            const auto at = static_cast<std::size_t>(i);
            for (const float x : {a, b}) {
                if (limits && limits->reachedBy(static_cast<double>(x))) its.clipped[at] = x;
            }
            const auto seen = std::min<std::size_t>(its.seen[at] + 1, wanted_);
            its.seen[at] = static_cast<unsigned>(seen);
            its.mean[at] += (value - its.mean[at]) / static_cast<double>(seen);
        }
    }
    count_ = std::min(count_ + 1, wanted_);
}

std::shared_ptr<const Capture> CaptureAverage::mean(const Capture& newest) const {
    auto mean = std::make_shared<Capture>(newest);
    mean->start_s = newest.trigger_s + beforeTrigger(like_);
    for (std::size_t c = 0; c < channels_.size(); ++c) {
        const auto& its = channels_[c];
        auto& samples = mean->channels[c].samples;
        for (std::size_t i = 0; i < samples_; ++i) {
            samples[i] = its.seen[i] == 0             ? kMissing
                         : std::isnan(its.clipped[i]) ? static_cast<float>(its.mean[i])
                                                      : its.clipped[i];
        }
    }
    return mean;
}

std::shared_ptr<const Capture> CaptureAverage::add(std::shared_ptr<const Capture> capture) {
    if (wanted_ <= 1 || !capture || !std::isfinite(capture->trigger_s)) return capture;
    if (!repeats(*capture)) begin(*capture);
    take(*capture);
    return mean(*capture);
}

}  // namespace tacto
