#include "core/analysis/vibration/BurstFigures.h"

#include <algorithm>
#include <cmath>
#include <optional>

namespace tacto {

namespace {

constexpr double kOnsetShare = 0.1, kRisenShare = 0.9;  // shares of the peak
constexpr double kGap = 3;                              // in sample periods

/// Magnitudes with their time stamps, after subtraction of the mean in the quiet.
struct Course {
    std::vector<double> t_s;
    std::vector<double> magnitude;
    double period_s = kNaN;
    double noise = kNaN;

    [[nodiscard]] std::size_t from(double t) const {
        return static_cast<std::size_t>(std::ranges::lower_bound(t_s, t) - t_s.begin());
    }
    /// True if no sample between the two times is missing.
    [[nodiscard]] bool covers(double begin, double end) const {
        const double most = kGap * period_s;
        double before = begin;
        for (auto i = from(begin); i < t_s.size() && t_s[i] <= end; ++i) {
            if (!(t_s[i] - before <= most) || !std::isfinite(magnitude[i])) return false;
            before = t_s[i];
        }
        return end - before <= most;
    }
};

Result<void> checkBursts(std::span<const CommandedBurst> bursts) {
    if (bursts.empty()) return invalid("no burst; at least one is expected");
    for (std::size_t i = 0; i < bursts.size(); ++i) {
        const auto& burst = bursts[i];
        const bool ascends = i == 0 || burst.onset_s > bursts[i - 1].onset_s;
        if (std::isfinite(burst.onset_s) && ascends && burst.duration.count() > 0) continue;
        return invalid("burst {} begins at {} s and lasts {} s; one after the other, each above 0 s, is expected",
                       i + 1, burst.onset_s, burst.duration.count());
    }
    return {};
}

Result<void> checkStamps(std::span<const AccelerationSample> samples) {
    double before = -std::numeric_limits<double>::infinity();
    for (const auto& sample : samples) {
        if (!(sample.t_s > before) || !std::isfinite(sample.t_s))
            return invalid("a sample at {} s after one at {} s; ascending stamps are expected", sample.t_s, before);
        before = sample.t_s;
    }
    return {};
}

double medianPeriod(std::span<const AccelerationSample> samples) {
    std::vector<double> apart;
    for (std::size_t i = 1; i < samples.size(); ++i) apart.push_back(samples[i].t_s - samples[i - 1].t_s);
    if (apart.empty()) return kNaN;
    const auto middle = apart.begin() + static_cast<std::ptrdiff_t>(apart.size() / 2);
    std::ranges::nth_element(apart, middle);
    return *middle;
}

/// Errors: NotFound if there is no quiet before `firstOnset`.
Result<Course> courseOf(std::span<const AccelerationSample> samples, double firstOnset) {
    Course course;
    course.period_s = medianPeriod(samples);
    double x = 0, y = 0, z = 0, n = 0;
    for (const auto& sample : samples) {
        if (sample.t_s >= firstOnset) break;
        if (sample.t_s < firstOnset - BurstFigures::kMinQuiet.count()) continue;
        x += sample.x;
        y += sample.y;
        z += sample.z;
        n += 1;
    }
    if (!(n * course.period_s >= 0.9 * BurstFigures::kMinQuiet.count()) || !std::isfinite(x + y + z))
        return fail(ErrorCode::NotFound, "the accelerometer was not read in the {} s before the first burst",
                    BurstFigures::kMinQuiet.count());
    double squares = 0;
    for (const auto& sample : samples) {
        const double magnitude = std::hypot(sample.x - x / n, sample.y - y / n, sample.z - z / n);
        const double before = firstOnset - sample.t_s;
        if (before > 0 && before <= BurstFigures::kMinQuiet.count()) squares += magnitude * magnitude;
        course.t_s.push_back(sample.t_s);
        course.magnitude.push_back(magnitude);
    }
    course.noise = std::sqrt(squares / n);
    return course;
}

struct OneBurst {
    double onset_s, rise_s, strength;
    double samples;  // number of samples in the strength
};

/// Returns nothing if the motor did not move. `until`: the next burst, or the end of the run-down.
std::optional<OneBurst> measure(const Course& course, const CommandedBurst& burst, double until) {
    const auto begin = course.from(burst.onset_s), end = course.from(until);
    if (begin >= end) return std::nullopt;
    const auto first = course.magnitude.begin();
    const auto at = [&](std::size_t i) { return first + static_cast<std::ptrdiff_t>(i); };
    const double peak = *std::max_element(at(begin), at(end));
    if (!(peak > BurstFigures::kAboveNoise * course.noise)) return std::nullopt;
    // In a weak burst, a tenth of the peak may be noise.
    const double threshold = std::max(kOnsetShare * peak, BurstFigures::kAboveNoise * course.noise);
    const auto reached = [&](double share) {
        const auto found = std::find_if(at(begin), at(end), [share](double each) { return each >= share; });
        return course.t_s[static_cast<std::size_t>(found - first)];
    };
    OneBurst out{reached(threshold), 0, 0, 0};
    out.rise_s = std::max(0.0, reached(std::max(kRisenShare * peak, threshold)) - out.onset_s);
    double squares = 0;
    for (auto i = course.from(out.onset_s); i < course.t_s.size(); ++i) {
        if (course.t_s[i] >= out.onset_s + burst.duration.count()) break;
        squares += course.magnitude[i] * course.magnitude[i];
        out.samples += 1;
    }
    out.strength = std::sqrt(std::max(0.0, squares / out.samples - course.noise * course.noise));
    return out;
}

}  // namespace

Result<BurstFigures> burstFigures(std::span<const AccelerationSample> samples, std::span<const CommandedBurst> bursts) {
    if (auto sound = checkBursts(bursts); !sound) return failure(sound);
    if (auto sound = checkStamps(samples); !sound) return failure(sound);
    const auto course = courseOf(samples, bursts.front().onset_s);
    if (!course) return failure(course);
    BurstFigures out;
    out.bursts = bursts.size();
    out.noise_m_s2 = course->noise;
    double strength = 0, latency = 0, rise = 0, taken = 0, intervals = 0, between = 0;
    std::optional<double> before;
    for (std::size_t i = 0; i < bursts.size(); ++i) {
        const auto& burst = bursts[i];
        const double runDown = burst.onset_s + (burst.duration + BurstFigures::kRunDown).count();
        const double until = i + 1 < bursts.size() ? std::min(runDown, bursts[i + 1].onset_s) : runDown;
        if (!course->covers(burst.onset_s, until)) {
            ++out.missed;
            before.reset();
            continue;
        }
        const auto one = measure(*course, burst, until);
        if (!one) {
            before.reset();
            continue;
        }
        ++out.moved;
        strength += one->strength;
        latency += one->onset_s - burst.onset_s;
        rise += one->rise_s;
        taken += one->samples;
        if (before) {
            between += one->onset_s - *before;
            ++intervals;
        }
        before = one->onset_s;
    }
    if (out.moved == 0) return out;
    const auto moved = static_cast<double>(out.moved);
    out.strength_m_s2 = strength / moved;
    out.latency_s = latency / moved;
    out.rise_s = rise / moved;
    // Noise in each sample adds to the mean square; its root has half of that relative error.
    out.strengthUncertainty_m_s2 = out.noise_m_s2 / std::sqrt(taken);
    if (intervals == 0) return out;
    out.interval_s = between / intervals;
    // Each of the two outer onsets lies anywhere within a sample period; the onsets between cancel.
    out.intervalUncertainty_s = course->period_s / std::sqrt(6.0) / intervals;
    return out;
}

}  // namespace tacto
