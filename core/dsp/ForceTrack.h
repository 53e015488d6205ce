// ForceTrack.h - normal force at any time, and contact as the force samples show it.
//
// Contact starts at F ≥ 0.1 N and ends below 0.05 N. There is none while the newest sample is older than 100 ms. F is
// interpolated linearly between samples, and held before the first and after the last. During a silence of more
// than 1 s, F is held too, so that a live chain gives the same numbers as a file without a longer wait.
//
// Thread-safety: none; one owner. Never allocates after construction.
#pragma once

#include <cstddef>
#include <limits>
#include <span>

#include "core/dsp/SampleHistory.h"

namespace tacto {

class ForceTrack {
public:
    static constexpr double kContactStart_n = 0.1;
    static constexpr double kContactEnd_n = 0.05;
    static constexpr double kStale_s = 0.1;
    static constexpr double kSmallestDivisor_n = 0.1;
    static constexpr double kLongestBridge_s = 1.0;

    /// A force beyond ±`most` is not accepted as a reading.
    explicit ForceTrack(double rate_hz, double most = std::numeric_limits<double>::max());

    /// Adds a sample. If it is not a number, beyond ±`most` or not later than the last one, it is counted but not used.
    void push(double t_s, double force_n) noexcept;
    void clear() noexcept;

    /// Returns the stamp of the newest sample; -infinity before the first.
    [[nodiscard]] double newest_s() const noexcept { return samples_.newest_s(); }
    /// Returns the stamp of the first sample with contact; infinity if there is none yet.
    [[nodiscard]] double firstContact_s() const noexcept { return firstContact_; }

    /// Multiplies the samples `[0, stamps.size())` of each axis by 1 / max(F, 0.1 N) at their stamps. The cursor only
    /// moves forward. `start_s`: the start of the stream that is normalised.
    void normalise(std::span<const double> stamps, std::span<double* const> axes, double start_s) noexcept;

    /// Writes max(F, 0.1 N) for each of `stamps`, which must not be later than the last normalised ones.
    void divisors(std::span<const double> stamps, std::span<double> out, double start_s) const noexcept;
    /// Returns true if max(F, 0.1 N) changes by more than a factor of 2 between the two times.
    [[nodiscard]] bool unsteady(double begin_s, double end_s, double start_s) const noexcept;

    struct Reading {
        double force_n;  ///< NaN if no sample is valid for that time
        bool contact;
        bool fresh;  ///< true if the sample before is at most 100 ms old
    };
    /// Returns the reading at `t_s`. The time must not decrease from call to call.
    [[nodiscard]] Reading at(double t_s) noexcept;

    /// Releases samples that are needed only before `t_s`.
    void release(double t_s) noexcept;

    /// Returns the number of silences of more than 100 ms, including one that lasts until `end_s`.
    [[nodiscard]] std::size_t staleStretches(double end_s) const noexcept;
    [[nodiscard]] std::size_t invalidSamples() const noexcept { return invalid_; }
    [[nodiscard]] std::size_t samplesBeyond() const noexcept { return beyond_; }
    /// Return the range of the samples used; infinite before the first sample.
    [[nodiscard]] double least() const noexcept { return least_; }
    [[nodiscard]] double most() const noexcept { return most_; }
    [[nodiscard]] std::size_t outOfOrder() const noexcept { return outOfOrder_; }

private:
    /// F as a straight line: force + slope * (t - from), valid for times before `until`.
    struct Line {
        double force = 0;
        double slope = 0;
        double from = 0;
        double until;
        [[nodiscard]] double divisor(double t_s) const noexcept;
    };
    [[nodiscard]] Line lineAt(std::size_t& cursor, double t_s, double start_s) const noexcept;
    /// Moves `cursor` to the last sample at or before t_s; begin() - 1 means "before the first".
    void advance(std::size_t& cursor, double t_s) const noexcept;
    [[nodiscard]] bool hasNext(std::size_t cursor) const noexcept { return cursor + 1 < samples_.end(); }

    SampleHistory samples_;  // values: force and contact (0 or 1)
    bool contact_ = false;
    double firstContact_;
    std::size_t normaliseCursor_ = 0;
    std::size_t readCursor_ = 0;
    std::size_t stale_ = 0;
    std::size_t invalid_ = 0;
    std::size_t beyond_ = 0;
    double least_ = std::numeric_limits<double>::infinity(), most_ = -std::numeric_limits<double>::infinity();
    const double mostPlausible_;
    std::size_t outOfOrder_ = 0;
};

}  // namespace tacto
