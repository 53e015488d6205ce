#include "core/dsp/TaxelTrack.h"

#include <algorithm>
#include <cmath>

#include "core/base/Statistics.h"
#include "core/dsp/SampleHistory.h"

namespace tacto {

namespace {
constexpr double kReach_s = 0.1;
constexpr double kTrailing_s = 0.25;
constexpr double kFloorDeviations = 3;
constexpr double kTaxelsKept_s = 4;  // longer than any frame waits, with its moving average
}  // namespace

void TaxelTrack::Stretch::add(const double* values) noexcept {
    double total = 0;
    for (std::size_t i = 0; i < sum.size(); ++i) {
        sum[i] += values[i];
        total += values[i];
    }
    ++count;
    const double value = total / static_cast<double>(sum.size());
    const double step = value - mean;
    mean += step / static_cast<double>(count);
    squares += step * (value - mean);
}

void TaxelTrack::Stretch::clear() noexcept {
    std::ranges::fill(sum, 0.0);
    count = 0;
    mean = squares = 0;
}

TaxelTrack::TaxelTrack(const StreamInfo& info, std::optional<TimeInterval> declaredBaseline)
    : taxels_(info.channels),
      most_(mostPlausible(info.unit)),
      declared_(declaredBaseline),
      reach_(std::max(kReach_s, 1.5 / info.rate_hz)),
      samples_(info.channels, static_cast<std::size_t>(2 * kTaxelsKept_s * info.rate_hz) + 256),
      baseline_(info.channels),
      above_(info.channels),
      trailing_(info.channels),
      first_(kInfinity_s),
      firstContact_(kInfinity_s),
      validFrom_(kInfinity_s) {
    for (auto* stretch : {&inDeclared_, &beforeContact_, &atStart_}) stretch->sum.resize(info.channels);
}

void TaxelTrack::clear() noexcept {
    samples_.clear();
    for (auto* stretch : {&inDeclared_, &beforeContact_, &atStart_}) stretch->clear();
    first_ = firstContact_ = kInfinity_s;
    settled_ = cursor_ = window_ = invalid_ = beyond_ = outOfOrder_ = 0;
    known_ = preset_;
    if (!preset_) validFrom_ = kInfinity_s;
    assumed_ = assumed_ && preset_;
}

void TaxelTrack::preset(const RestLevels& rest) {
    if (rest.taxelBaseline.size() != taxels_) return;
    baseline_ = rest.taxelBaseline;
    floor_ = rest.taxelFloor;
    known_ = preset_ = true;
    validFrom_ = -kInfinity_s;
}

void TaxelTrack::push(double t_s, const double* values) noexcept {
    if (!std::isfinite(t_s) || std::any_of(values, values + taxels_, [](double x) { return std::isnan(x); })) {
        ++invalid_;
        return;
    }
    if (!std::all_of(values, values + taxels_, [&](double x) { return std::abs(x) <= most_; })) {
        ++beyond_;
        return;
    }
    if (!(t_s > newest_s())) {
        ++outOfOrder_;
        return;
    }
    if (samples_.end() == 0) first_ = t_s;
    samples_.push(t_s, values);
    settled_ = std::max(settled_, samples_.begin());
    cursor_ = std::max(cursor_, samples_.begin());
    window_ = std::max(window_, samples_.begin());
}

void TaxelTrack::settle(double known_s, double firstContact_s) noexcept {
    if (known_) {
        settled_ = samples_.end();
        return;
    }
    firstContact_ = firstContact_s;
    for (; settled_ < samples_.end() && samples_.t(settled_) <= known_s; ++settled_) {
        const double t = samples_.t(settled_);
        const double* values = samples_.values(settled_);
        if (declared_ && declared_->contains(t)) inDeclared_.add(values);
        if (t < firstContact_) beforeContact_.add(values);
        if (t < first_ + kShortestRest_s) atStart_.add(values);
    }
    decide(std::min(known_s, newest_s()));
}

void TaxelTrack::decide(double known_s) noexcept {
    if (declared_ && known_s <= declared_->end_s) return;
    if (declared_ && inDeclared_.count > 0) return adopt(inDeclared_, declared_->end_s);
    if (!(known_s >= first_ + kShortestRest_s)) return;
    if (known_s < firstContact_) return;  // the rest is not over yet
    if (firstContact_ - first_ >= kShortestRest_s && beforeContact_.count > 0)
        return adopt(beforeContact_, firstContact_);
    assumed_ = true;
    adopt(atStart_, -kInfinity_s);
}

void TaxelTrack::close() noexcept {
    if (known_ || samples_.end() == 0) return;
    if (inDeclared_.count > 0) return adopt(inDeclared_, declared_->end_s);
    if (firstContact_ - first_ >= kShortestRest_s && beforeContact_.count > 0)
        return adopt(beforeContact_, firstContact_);
    assumed_ = true;
    adopt(atStart_, -kInfinity_s);
}

void TaxelTrack::adopt(const Stretch& stretch, double validFrom_s) noexcept {
    validFrom_ = validFrom_s;
    const auto count = static_cast<double>(stretch.count);
    for (std::size_t i = 0; i < taxels_; ++i) baseline_[i] = stretch.sum[i] / count;
    floor_ = kFloorDeviations * std::sqrt(stretch.squares / count);
    known_ = true;
}

bool TaxelTrack::decided(double known_s) const noexcept {
    return known_ || declared_.has_value() || known_s >= first_ + kShortestRest_s;
}

double TaxelTrack::variance(std::size_t sample, bool dynamic, double& meanAbove) noexcept {
    const auto count = static_cast<double>(taxels_);
    const double* values = samples_.values(sample);
    double total = 0;
    for (std::size_t i = 0; i < taxels_; ++i) {
        above_[i] = std::max(values[i] - baseline_[i], 0.0);
        total += above_[i];
    }
    meanAbove = total / count;
    double mean = meanAbove;
    if (dynamic) {
        const double since = samples_.t(sample) - kTrailing_s;
        while (window_ < sample && samples_.t(window_) <= since) ++window_;
        std::ranges::fill(trailing_, 0.0);
        for (std::size_t s = window_; s <= sample; ++s) {
            const double* row = samples_.values(s);
            for (std::size_t i = 0; i < taxels_; ++i) trailing_[i] += std::max(row[i] - baseline_[i], 0.0);
        }
        const auto rows = static_cast<double>(sample - window_ + 1);
        mean = 0;
        for (std::size_t i = 0; i < taxels_; ++i) {
            above_[i] -= trailing_[i] / rows;
            mean += above_[i] / count;
        }
    }
    double squares = 0;
    for (const double u : above_) squares += (u - mean) * (u - mean);
    return squares / count;
}

TaxelTrack::Reading TaxelTrack::at(double t_s, bool dynamic) noexcept {
    if (samples_.empty()) return {kNaN, kNaN};
    while (cursor_ + 1 < samples_.end() && samples_.t(cursor_ + 1) <= t_s) ++cursor_;
    std::size_t nearest = cursor_;
    if (nearest + 1 < samples_.end()) {
        // Of two samples at the same distance, the earlier one is used, whatever the rounding of their stamps.
        const double later = std::abs(samples_.t(nearest + 1) - t_s);
        if (later + kStampRounding_s < std::abs(samples_.t(nearest) - t_s)) ++nearest;
    }
    if (std::abs(samples_.t(nearest) - t_s) > reach_) return {kNaN, kNaN};

    Reading reading{kNaN, 0};
    const double* values = samples_.values(nearest);
    for (std::size_t i = 0; i < taxels_; ++i) reading.mean += values[i];
    reading.mean /= static_cast<double>(taxels_);
    if (known_ && t_s >= validFrom_) {
        double meanAbove = 0;
        const double spread = variance(nearest, dynamic, meanAbove);
        // A mean of 0 has no relative variance; a mean below the floor is noise.
        if (meanAbove > 0 && meanAbove >= floor_) reading.v = spread / (meanAbove * meanAbove);
    }
    // The next frame may need this sample again, with the moving average before it.
    while (window_ < cursor_ && samples_.t(window_) <= samples_.t(cursor_) - kTrailing_s) ++window_;
    if (settled_ > 0) samples_.release(std::min({window_, cursor_, settled_}));
    return reading;
}

}  // namespace tacto
