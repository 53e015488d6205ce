#include "drivers/sensor_board/ClockFit.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace tacto::sensorboard {

namespace {
constexpr std::size_t kRecent = 15;  // half a minute of windows; the shortest delay in them gives the offset
constexpr int kHalvings = 3;
constexpr std::size_t kMinKept = 4;   // points left after all halvings
constexpr double kRamp_s = 8e-3;      // a shift is spread over this time: a usual block of acceleration
constexpr double kSettle_s = 1;       // time in which a correction should be made up
constexpr double kMaxDoubt_s = 5e-3;  // upper limit, as one long pause of the host says little
constexpr double kDoubtOver = 64;     // smoothing, in messages: about 0.2 s
constexpr double kMinStep_s = 1e-4;   // a smaller shift is not counted as a step: under half a sample at 4 kHz
constexpr double kCrystal = 100e-6;   // typical error of a crystal, by the makers' tolerances
constexpr double kFinest_s = 1e-6;    // the board's resolution, the smallest spread assumed
constexpr double kInfinite = std::numeric_limits<double>::infinity();
}  // namespace

ClockFit::ClockFit() {
    windows_.reserve(kWindows);
    kept_.reserve(kWindows);
    wider_.reserve(kWindows);
    misses_.reserve(kWindows);
    lowest_.y = kInfinite;
}

void ClockFit::observe(std::uint64_t device_us, Instant arrival, Seconds doubt) {
    const double arrival_s = toSeconds(arrival);
    if (!started_) {
        started_ = true;
        first_us_ = device_us;
        firstArrival_s_ = arrival_s;
        windowEnds_ = kFirstWindow_s;
        knots_[0] = {0, 0};
        knotCount_ = 1;
    }
    // The difference of two 64-bit numbers is exact; as a double it keeps microseconds for 285 years.
    const double x = static_cast<double>(static_cast<std::int64_t>(device_us - first_us_)) * 1e-6;
    const double y = arrival_s - firstArrival_s_ - x;
    if (x >= windowEnds_) {
        closeWindow();
        windowEnds_ = x + (windows_.size() < kFirstWindows ? kFirstWindow_s : kWindow_s);
    }
    if (y - slope_ * x < lowest_.y - slope_ * lowest_.x) lowest_ = {x, y};
    doubt_s_ += (std::min(doubt.count(), kMaxDoubt_s) - doubt_s_) / kDoubtOver;
    // A delay shorter than any before is used at once, a longer one only at the end of its window.
    base_ = std::min(base_, y - slope_ * x);
    follow(x, y);
}

void ClockFit::closeWindow() {
    if (std::isfinite(lowest_.y)) {
        if (windows_.size() < kWindows) {
            windows_.push_back(lowest_);
        } else {
            windows_[begin_] = lowest_;
            begin_ = (begin_ + 1) % kWindows;
        }
    }
    lowest_ = {0, kInfinite};
    if (const auto line = fit()) {
        // Applies the slope only as far as it is known better than a crystal's tolerance; the bound is about 4 sigma.
        const double deviation = line->uncertainty / 4;
        const double known = kCrystal * kCrystal / (kCrystal * kCrystal + deviation * deviation);
        slope_ = known * line->slope;
        // y = arrival - board time, so its slope s is 1 / (1 + drift) - 1.
        const double drift = 1 / (1 + line->slope) - 1;
        report_.drift_ppm = drift * 1e6;
        report_.uncertainty_ppm = line->uncertainty * 1e6;
        report_.span_s = line->extent;
    }
    place();
}

std::optional<ClockFit::Line> ClockFit::fit() {
    if (windows_.size() < kMinWindows) return std::nullopt;
    kept_.assign(windows_.begin(), windows_.end());
    wider_ = kept_;
    Line line;
    for (int round = 0;; ++round) {
        double meanX = 0, meanY = 0;
        for (const auto& p : kept_) {
            meanX += p.x;
            meanY += p.y;
        }
        meanX /= static_cast<double>(kept_.size());
        meanY /= static_cast<double>(kept_.size());
        double xx = 0, xy = 0;
        for (const auto& p : kept_) {
            xx += (p.x - meanX) * (p.x - meanX);
            xy += (p.x - meanX) * (p.y - meanY);
        }
        if (!(xx > 0)) return std::nullopt;
        line.slope = xy / xx;
        const auto miss = [&](const Point& p) { return p.y - meanY - line.slope * (p.x - meanX); };
        if (round == kHalvings || kept_.size() / 2 < kMinKept) {
            const auto [low, high] = std::ranges::minmax_element(wider_, {}, miss);
            const auto [begin, end] = std::ranges::minmax_element(kept_, {}, &Point::x);
            line.extent = end->x - begin->x;
            const double spread = std::max(miss(*high) - miss(*low), kFinest_s) + doubt_s_;
            line.uncertainty = 2 * spread / line.extent;
            return line;
        }
        // Keeps the lower half: points above the median came late.
        wider_ = kept_;
        misses_.clear();
        for (const auto& p : kept_) misses_.push_back(miss(p));
        const auto middle = misses_.begin() + static_cast<std::ptrdiff_t>(misses_.size() / 2);
        std::ranges::nth_element(misses_, middle);
        const double limit = *middle;
        std::erase_if(kept_, [&](const Point& p) { return miss(p) > limit; });
    }
}

void ClockFit::place() {
    const std::size_t recent = std::min(kRecent, windows_.size());
    base_ = kInfinite;
    for (std::size_t i = 0; i < recent; ++i) {
        const std::size_t newest = begin_ + windows_.size() - 1 - i;
        const auto& p = windows_[newest % windows_.size()];
        base_ = std::min(base_, p.y - slope_ * p.x);
    }
    if (!std::isfinite(base_)) base_ = 0;
}

double ClockFit::margin() const noexcept { return std::max(kMargin_s, 1.1 * doubt_s_); }

void ClockFit::settle() noexcept {
    knots_[newest_] = {knots_[newest_].x, base_ - margin() + slope_ * knots_[newest_].x};
    knotCount_ = 1;
    rate_ = slope_;
}

void ClockFit::shiftBack(double x, double early) noexcept {
    if (x < knots_[newest_].x) {  // from a stream that lags behind the others
        for (auto& knot : knots_) knot.correction -= early;
        return;
    }
    // Spreads the shift over the samples of the block that has just come.
    const double reached = correctionAt(x) - early;
    const double begin = x - kRamp_s;
    if (knots_[newest_].x > begin && knotCount_ > 1) {
        knots_[newest_] = {begin, correctionAt(begin)};
        // Keeps the knots in time order, whatever came before.
        const Knot& before = knots_[(newest_ + kKnots - 1) % kKnots];
        if (before.x >= begin) knots_[newest_].x = (before.x + x) / 2;
    } else {
        pushKnot({begin, correctionAt(begin)});
    }
    pushKnot({x, reached});
}

void ClockFit::pushKnot(const Knot& knot) noexcept {
    newest_ = (newest_ + 1) % kKnots;
    knots_[newest_] = knot;
    knotCount_ = std::min(knotCount_ + 1, kKnots);
}

void ClockFit::follow(double x, double y) {
    const Knot last = knots_[newest_];
    if (x >= last.x + kKnotEvery_s) {
        const double line = base_ - margin() + slope_ * x;
        // After a long silence the stamps need not continue evenly.
        const bool resumed = x - last.x > kSettle_s;
        const Knot reached{x, resumed ? line : last.correction + rate_ * (x - last.x)};
        pushKnot(reached);
        // The line's own slope, plus the rate that brings the mapping onto the line.
        const double behind = line - reached.correction;
        rate_ = std::clamp(slope_ + behind / kSettle_s, slope_ - kMaxSlew, slope_ + kMaxSlew);
    }
    if (const double early = correctionAt(x) - y; early > 0) {
        shiftBack(x, early);
        report_.largestStep_s = std::max(report_.largestStep_s, early);
        if (early >= kMinStep_s) ++report_.steps;
    }
    report_.correction_s = correctionAt(x);
}

double ClockFit::correctionAt(double x) const noexcept {
    const Knot& newest = knots_[newest_];
    if (x >= newest.x || knotCount_ < 2) return newest.correction + rate_ * (x - newest.x);
    std::size_t after = newest_;
    for (std::size_t i = 1; i < knotCount_; ++i) {
        const std::size_t before = (newest_ + kKnots - i) % kKnots;
        const bool oldest = i + 1 == knotCount_;
        if (x >= knots_[before].x || oldest) {
            const Knot &a = knots_[before], &b = knots_[after];
            return a.correction + (b.correction - a.correction) * (x - a.x) / (b.x - a.x);
        }
        after = before;
    }
    return newest.correction;
}

double ClockFit::early_s(std::uint64_t device_us, Instant arrival) const noexcept {
    return toSession(static_cast<double>(device_us)) - toSeconds(arrival);
}

double ClockFit::toSession(double device_us) const noexcept {
    const double x = (device_us - static_cast<double>(first_us_)) * 1e-6;
    return firstArrival_s_ + x + correctionAt(x);
}

}  // namespace tacto::sensorboard
