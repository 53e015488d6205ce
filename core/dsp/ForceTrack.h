// ForceTrack.h - normal force between its samples, and contact as its own samples judge it.
//
// Contact starts at F ≥ 0.1 N and ends below 0.05 N; there is none while the newest sample is older than 100 ms.
// Between samples F is interpolated linearly and at the ends held, but a silence of more than 1 s is not bridged: F is
// held there, so that a live chain need not wait longer to give the same numbers as a file.
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

    /// A force beyond `most` either way is not a reading.
    explicit ForceTrack(double rate_hz, double most = std::numeric_limits<double>::max());

    /// A sample that is not a number, is beyond `most` or does not move time forward is counted and not used.
    void push(double t_s, double force_n) noexcept;
    void clear() noexcept;

    /// Stamp of the newest sample; -infinity before the first.
    [[nodiscard]] double newest_s() const noexcept { return samples_.newest_s(); }
    /// Stamp of the first sample with contact; infinity before it.
    [[nodiscard]] double firstContact_s() const noexcept { return firstContact_; }

    /// Multiplies each axis' samples `[0, stamps.size())` by 1 / max(F, 0.1 N) at their stamps. The cursor only moves
    /// forward. `start_s` is when the stream that is normalised began.
    void normalise(std::span<const double> stamps, std::span<double* const> axes, double start_s) noexcept;

    /// max(F, 0.1 N) at each of `stamps`, which lie at or before those normalised last.
    void divisors(std::span<const double> stamps, std::span<double> out, double start_s) const noexcept;
    /// True when max(F, 0.1 N) changes by more than a factor 2 between the two times.
    [[nodiscard]] bool unsteady(double begin_s, double end_s, double start_s) const noexcept;

    struct Reading {
        double force_n;  ///< NaN when no sample can speak for that time
        bool contact;
        bool fresh;  ///< the newest sample before is at most 100 ms old
    };
    /// The reading at `t_s`, which never decreases from call to call.
    [[nodiscard]] Reading at(double t_s) noexcept;

    /// No time before `t_s` will be asked for again.
    void release(double t_s) noexcept;

    /// Silences of more than 100 ms, the one up to `end_s` included.
    [[nodiscard]] std::size_t staleStretches(double end_s) const noexcept;
    [[nodiscard]] std::size_t invalidSamples() const noexcept { return invalid_; }
    [[nodiscard]] std::size_t samplesBeyond() const noexcept { return beyond_; }
    /// The range of what was used; infinite before the first.
    [[nodiscard]] double least() const noexcept { return least_; }
    [[nodiscard]] double most() const noexcept { return most_; }
    [[nodiscard]] std::size_t outOfOrder() const noexcept { return outOfOrder_; }

private:
    /// F as a straight line: force + slope * (t - from), good for times before `until`.
    struct Line {
        double force = 0;
        double slope = 0;
        double from = 0;
        double until;
        [[nodiscard]] double divisor(double t_s) const noexcept;
    };
    [[nodiscard]] Line lineAt(std::size_t& cursor, double t_s, double start_s) const noexcept;
    /// The last sample at or before t, from `cursor` on; begin() - 1 stands for "before the first".
    void advance(std::size_t& cursor, double t_s) const noexcept;
    [[nodiscard]] bool hasNext(std::size_t cursor) const noexcept { return cursor + 1 < samples_.end(); }

    SampleHistory samples_;  // force, contact (0 or 1)
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
