#include "core/bench/sensing/MassagerWatch.h"

#include <algorithm>
#include <cmath>

namespace tacto {

namespace {
constexpr double kWindow_s = 0.05;  // a few turns of a motor
constexpr double kQuiet = 3;        // in multiples of the lowest strength
constexpr std::size_t kEnough = 20;
constexpr double kSteady = 0.1;  // standard deviation of the windows, relative to their mean
constexpr double kTone = 2.1;    // upper limit of the kurtosis: a tone has 1.5, noise 3
constexpr double kFalls = 0.01;  // relative fall per window; with a larger fall the motor is running down
constexpr int kTries = 6;        // several, because a slow motor is not steady at once
}  // namespace

void MassagerWatch::Axis::add(double value, bool begins) noexcept {
    if (begins) first = value;
    const double off = value - first;
    double power = 1;
    for (double& sum : sums) sum += power *= off;
}

std::pair<double, double> MassagerWatch::Axis::moments(double n) const noexcept {
    const double mean = sums[0] / n, square = sums[1] / n, cube = sums[2] / n, fourth = sums[3] / n;
    return {std::max(0.0, square - mean * mean),
            fourth - 4 * mean * cube + 6 * mean * mean * square - 3 * mean * mean * mean * mean};
}

void MassagerWatch::burst(Instant begin, Instant end) noexcept {
    begin_s_ = toSeconds(begin);
    // A window may have included the first milliseconds of the burst before burst() was called.
    if (begin_s_ - quiet_s_ < 3 * kWindow_s) follows_ = true;
    end_s_ = std::max(end_s_, toSeconds(end));
}

void MassagerWatch::feed(const SampleBlock& block, std::size_t axes) noexcept {
    const std::size_t used = std::min(axes, now_.axes.size());
    for (std::size_t i = 0; i < block.t_s.size(); ++i) {
        const double t_s = block.t_s[i];
        if (!(t_s < now_.begin_s + kWindow_s)) {
            if (now_.samples > 3) close(now_);
            now_ = {.begin_s = t_s};
        }
        for (std::size_t axis = 0; axis < used; ++axis)
            now_.axes[axis].add(block.values[i * axes + axis], now_.samples == 0);
        ++now_.samples;
    }
}

/// Takes the kurtosis from the axis that moves most.
void MassagerWatch::close(const Window& window) noexcept {
    double all = 0, most = 0, kurtosis = 0;
    for (const auto& axis : window.axes) {
        const auto [variance, fourth] = axis.moments(static_cast<double>(window.samples));
        all += variance;
        if (!(variance > most)) continue;
        most = variance;
        kurtosis = fourth / (variance * variance);
    }
    take(window.begin_s, std::sqrt(all), kurtosis);
}

/// Uses only windows during a rest: long enough after a burst, and before the next.
void MassagerWatch::take(double begin_s, double strength, double kurtosis) noexcept {
    if (!std::isfinite(strength)) return forget();
    if (strength > 0) floor_ = std::min(floor_, strength);
    const bool burst = begin_s + kWindow_s > begin_s_ && begin_s < end_s_ + kRunDown.count();
    if (burst) return;
    if (strength <= kQuiet * floor_) {
        quiet_s_ = begin_s;
        return forget();
    }
    if (!follows_) return;
    if (std::abs(begin_s - (last_s_ + kWindow_s)) < kWindow_s / 2) {
        fall_ += last_ - strength;
        ++pairs_;
    }
    last_s_ = begin_s;
    last_ = strength;
    ++count_;
    sum_ += strength;
    squares_ += strength * strength;
    kurtosis_ += kurtosis;
    if (count_ < kEnough) return;
    const double mean = sum_ / static_cast<double>(count_);
    const double deviation = std::sqrt(std::max(0.0, squares_ / static_cast<double>(count_) - mean * mean));
    const bool holds = std::abs(fall_) <= kFalls * mean * static_cast<double>(pairs_);
    const bool goesOn = deviation <= kSteady * mean && holds && kurtosis_ / static_cast<double>(count_) < kTone;
    // If rests are too short to show a motor running down, an unsteady motion may come from a slow motor.
    const bool sees = pairs_ >= kEnough * 3 / 4;
    if (++tries_ > (sees ? kTries : 0) && !goesOn) return forget();
    count_ = pairs_ = 0;
    sum_ = squares_ = kurtosis_ = fall_ = 0;
    found_ = goesOn ? mean : 0;
}

void MassagerWatch::forget() noexcept {
    follows_ = false;
    count_ = pairs_ = 0;
    tries_ = 0;
    sum_ = squares_ = kurtosis_ = fall_ = found_ = 0;
}

}  // namespace tacto
