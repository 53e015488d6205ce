#include "core/dsp/AccelerationTrack.h"

#include <algorithm>
#include <cmath>

#include "core/dsp/SampleHistory.h"

namespace tacto {

namespace {
constexpr double kAccelerationKept_s = 2.5;  // longer than any frame waits
constexpr std::size_t kMaxWaiting = 512;
// At a lower rate the upper edge would be too close to half the rate.
constexpr double kFullBandRate_hz = 2 * AccelerationTrack::kHigh_hz / 0.9;

std::size_t rounded(double x) { return static_cast<std::size_t>(std::lround(x)); }
}  // namespace

AccelerationTrack::AccelerationTrack(const StreamInfo& info)
    : axes_(info.channels),
      rate_(info.rate_hz),
      most_(mostPlausible(info.unit)),
      length_(rounded(kWindow_s * info.rate_hz)),
      hop_(std::max<std::size_t>(rounded(kHop_s * info.rate_hz), 1)),
      truncated_(info.rate_hz < kFullBandRate_hz),
      upperEdge_(truncated_ ? 0.45 * info.rate_hz : kHigh_hz),
      softLimit_(8 * length_ + 2 * kChunk),
      filter_(kLow_hz, upperEdge_, rate_, axes_),
      grid_(info.rate_hz),
      stamps_(std::max(rounded(kAccelerationKept_s * info.rate_hz) + 2 * length_, softLimit_) + kChunk),
      windows_(kMaxWaiting) {
    for (std::size_t a = 0; a < axes_; ++a) filtered_[a].resize(stamps_.size());
    clear();
}

void AccelerationTrack::clear() noexcept {
    grid_.reset();
    windowsFront_ = waiting_ = offset_ = end_ = normalised_ = nextWindow_ = hops_ = 0;
    anchor_ = 0;
    first_ = kInfinity_s;
    newest_ = -kInfinity_s;
    running_ = false;
    losses_ = {};
}

inline bool AccelerationTrack::plausible(const double* sample) const noexcept {
    bool all = true;
    for (std::size_t a = 0; a < axes_; ++a) all &= std::abs(sample[a]) <= most_;
    return all;
}

inline AccelerationTrack::Use AccelerationTrack::judge(double t_s, const double* sample) noexcept {
    const auto kind = grid_.next(t_s);
    switch (kind) {
        case StampClass::Regular:
        case StampClass::First:
            break;
        case StampClass::Gap:
        case StampClass::Early:
            ++losses_.gaps;
            break;
        case StampClass::Repeat:
            ++losses_.repeats;
            return Use::Skip;
        case StampClass::Backward:
            ++losses_.clockSteps;
            running_ = false;
            return Use::Skip;
        case StampClass::Invalid:
            ++losses_.invalid;
            running_ = false;
            return Use::Skip;
    }
    if (!plausible(sample)) {
        ++(std::any_of(sample, sample + axes_, [](double x) { return std::isnan(x); }) ? losses_.invalid
                                                                                       : losses_.beyond);
        running_ = false;
        return Use::Skip;
    }
    return kind == StampClass::Regular && running_ ? Use::Continue : Use::Begin;
}

void AccelerationTrack::push(std::span<const double> stamps, const double* values) noexcept {
    std::size_t from = 0;  // first sample that the filter has not processed yet
    for (std::size_t i = 0; i < stamps.size(); ++i) {
        const auto use = judge(stamps[i], values + i * axes_);
        if (use == Use::Continue) continue;
        append(stamps.subspan(from, i - from), values + from * axes_);
        if (use == Use::Begin) begin(stamps[i], values + i * axes_);
        from = use == Use::Begin ? i : i + 1;
    }
    append(stamps.subspan(from), values + from * axes_);
}

void AccelerationTrack::begin(double t_s, const double* sample) noexcept {
    filter_.restart(sample);
    if (first_ == kInfinity_s) first_ = t_s;
    nextWindow_ = end_;
    anchor_ = t_s;
    hops_ = 0;
    running_ = true;
}

void AccelerationTrack::append(std::span<const double> stamps, const double* values) noexcept {
    if (stamps.empty()) return;
    makeRoom(stamps.size());
    const std::size_t at = end_ - offset_;
    std::ranges::copy(stamps, stamps_.begin() + static_cast<std::ptrdiff_t>(at));
    std::array<double*, AxesBandpass::kMaxAxes> out{};
    for (std::size_t a = 0; a < axes_; ++a) out[a] = filtered_[a].data() + at;
    filter_.process(values, stamps.size(), out);
    end_ += stamps.size();
    newest_ = stamps.back();
    queueWindows();
}

void AccelerationTrack::queueWindows() noexcept {
    for (; nextWindow_ + length_ <= end_; nextWindow_ += hop_) {
        const double stamp = stamps_[nextWindow_ - offset_];
        double begin = anchor_ + static_cast<double>(hops_ * hop_) / rate_;
        // The nominal rate drifts from the real clock, so the time is reset to the stamps.
        if (std::abs(begin - stamp) > 1 / rate_) {
            begin = anchor_ = stamp;
            hops_ = 0;
        }
        // Computed as one expression, as in the definition: t0 + (k·H + N/2) / fs.
        const double samples = static_cast<double>(hops_ * hop_) + 0.5 * static_cast<double>(length_);
        auto& window = windows_[(windowsFront_ + waiting_) % windows_.size()];
        window = {nextWindow_, begin, anchor_ + samples / rate_, begin + static_cast<double>(length_ - 1) / rate_,
                  stamps_[nextWindow_ + length_ - 1 - offset_]};
        if (waiting_ < windows_.size()) ++waiting_;
        ++hops_;
    }
}

std::size_t AccelerationTrack::oldestNeeded() const noexcept {
    std::size_t oldest = std::min(nextWindow_, normalised_);
    if (waiting_ > 0) oldest = std::min(oldest, windows_[windowsFront_].first);
    return std::max(std::min(oldest, end_), offset_);
}

bool AccelerationTrack::full() const noexcept {
    // At the lowest rate, 100 Hz, there is at most one window per two samples.
    return waiting_ + kChunk / 2 > windows_.size() || end_ - oldestNeeded() + kChunk > stamps_.size();
}

void AccelerationTrack::makeRoom(std::size_t count) noexcept {
    const std::size_t used = end_ - offset_;
    const std::size_t oldest = oldestNeeded();
    const std::size_t kept = end_ - oldest;
    const bool untidy = used + count > softLimit_ && kept * 2 < used;
    if (!untidy && used + count <= stamps_.size()) return;
    const auto from = static_cast<std::ptrdiff_t>(oldest - offset_);
    const auto to = static_cast<std::ptrdiff_t>(used);
    std::copy(stamps_.begin() + from, stamps_.begin() + to, stamps_.begin());
    for (std::size_t a = 0; a < axes_; ++a) {
        std::copy(filtered_[a].begin() + from, filtered_[a].begin() + to, filtered_[a].begin());
    }
    offset_ = oldest;
}

AccelerationTrack::Stretch AccelerationTrack::unnormalised(double until_s) noexcept {
    const auto from = stamps_.begin() + static_cast<std::ptrdiff_t>(normalised_ - offset_);
    const auto to = stamps_.begin() + static_cast<std::ptrdiff_t>(end_ - offset_);
    const auto end = newest_ <= until_s ? to : std::upper_bound(from, to, until_s);
    Stretch stretch{{from, end}, {}};
    for (std::size_t a = 0; a < axes_; ++a) stretch.axes[a] = filtered_[a].data() + (normalised_ - offset_);
    return stretch;
}

const AccelerationWindow* AccelerationTrack::frontWindow() const noexcept {
    return waiting_ == 0 ? nullptr : &windows_[windowsFront_];
}

std::array<const double*, AxesBandpass::kMaxAxes> AccelerationTrack::samples(
    const AccelerationWindow& window) const noexcept {
    std::array<const double*, AxesBandpass::kMaxAxes> out{};
    for (std::size_t a = 0; a < axes_; ++a) out[a] = filtered_[a].data() + (window.first - offset_);
    return out;
}

void AccelerationTrack::popWindow() noexcept {
    windowsFront_ = (windowsFront_ + 1) % windows_.size();
    --waiting_;
}

}  // namespace tacto
