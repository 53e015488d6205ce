// StreamHealth.h - is a stream continuous, how old is it, and how fast does it really come?
//
// Gaps, repeats and clock steps are counted, never bridged (science.md section 1, hazard H7). The rate is
// (n - 1) / (last - first stamp) over the longest gap-free stretch: printed stamps are rounded, so a
// median step would mislead.
//
// Thread-safety: none; one owner. feed() and the queries never allocate.
#pragma once

#include <cstddef>
#include <cstdint>
#include <limits>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "core/base/Stream.h"

namespace tacto {

/// The findings so far. Counts only grow.
struct HealthReport {
    std::size_t samples = 0;
    std::size_t gaps = 0;            ///< places where samples are missing
    std::size_t missingSamples = 0;  ///< about how many, at the nominal rate
    std::size_t repeats = 0;         ///< stamps equal to the one before
    std::size_t clockSteps = 0;      ///< stamps earlier than the one before
    std::size_t irregular = 0;       ///< stamps half a step or more early, yet in order
    std::size_t invalidStamps = 0;   ///< stamps that are not finite
    std::size_t invalidSamples = 0;  ///< samples with a value that is not finite
    bool coarseStamps = false;       ///< printed so coarsely that they repeat; they were spread evenly on reading
    double longestGap_s = 0;
    double rate_hz = std::numeric_limits<double>::quiet_NaN();  ///< measured; NaN before two regular samples

    [[nodiscard]] bool continuous() const noexcept {
        return gaps + repeats + clockSteps + irregular + invalidStamps + invalidSamples == 0;
    }
    /// One line for people: "2 gaps (longest 0.08 s, about 14 samples), 1 repeat", or "continuous".
    [[nodiscard]] std::string text() const;
};

class StreamHealth {
public:
    /// `nominalRate_hz` must be finite and positive: what stamps are judged against.
    explicit StreamHealth(double nominalRate_hz) noexcept : grid_(nominalRate_hz) {}

    StampClass feed(double t_s) noexcept;
    /// Takes all samples of `block`, and judges their values, too; `channels` as in the stream's StreamInfo.
    void feed(const SampleBlock& block, std::size_t channels) noexcept;

    /// The age of the newest sample; infinite before the first.
    [[nodiscard]] double age_s(double now_s) const noexcept { return now_s - grid_.last(); }
    /// True when the newest sample is older than 100 ms: no new trains (hazard H7).
    [[nodiscard]] bool stale(double now_s) const noexcept { return !(age_s(now_s) <= kStale_s); }
    [[nodiscard]] const HealthReport& report() const noexcept { return report_; }

    static constexpr double kStale_s = 0.1;

private:
    SampleGrid grid_;
    HealthReport report_;
    double stretchFirst_ = 0;       // stamp of the current gap-free stretch
    std::size_t stretchSteps_ = 0;  // how many of its steps are regular
    std::size_t longestSteps_ = 0;
};

/// A robust guess of the rate of recorded stamps: the mean step without the steps that are obviously gaps.
/// 0 with fewer than two distinct stamps.
[[nodiscard]] double roughRate_hz(std::span<const double> stamps);

/// True when more than one stamp in four repeats the one before: the file prints time too coarsely.
[[nodiscard]] bool stampsAreCoarse(std::span<const double> stamps) noexcept;

/// Spreads coarse stamps evenly over each stretch without a gap or a step back.
void spreadCoarseStamps(std::span<double> stamps);

// Whether the values of a stream stand still although its stamps go on: a sensor that hangs, behind
// electronics that repeat the last it said, or the last of its blocks over and over (hazard H7).
//
// How often a value repeats to the last bit by itself, from noise and coarse steps, is learnt from the stream: it
// stands still once so many repeats in a row would come by chance once in 10^9 times, and for longer than samples may
// be old. A value that moves more often than not cannot repeat with a period of several samples either, nor can one
// axis stand still while others move.

class Standstill {
public:
    /// The longest block, in samples, whose repetition is found.
    static constexpr std::size_t kPeriods = 64;

    /// `eachChannel`: repeatsSince() is about each channel by itself, else about all of them at once.
    explicit Standstill(std::size_t channels, bool eachChannel = false);

    /// Takes all samples of `block`, in order.
    void feed(const SampleBlock& block) noexcept;
    /// The stamp since which nothing has changed in any channel; nothing while it may be chance.
    [[nodiscard]] std::optional<double> since() const noexcept;
    /// The stamp since which a channel that moves by itself stands still or repeats the same values.
    [[nodiscard]] std::optional<double> repeatsSince() const noexcept;

private:
    /// Compares one channel, or all at once, with itself some samples before.
    struct Repeats {
        double since_s = 0;                       // time of the last different value, while it repeats
        std::uint64_t run = 0;                    // goes on
        std::uint64_t matched = 0, repeated = 0;  // before that: all values, and those that its noise may have repeated
    };
    void compare(const double* values) noexcept;
    void keep(const double* values) noexcept;
    void countAll(std::size_t row, std::uint64_t same) noexcept;
    void count(Repeats& one, std::size_t period, bool same) const noexcept;
    [[nodiscard]] std::uint64_t changes(const Repeats& one, std::size_t period) const noexcept;
    [[nodiscard]] bool moves(const Repeats& one, std::size_t period) const noexcept;
    [[nodiscard]] bool stands(const Repeats& one, std::size_t period) const noexcept;

    const std::size_t channels_;
    const bool eachChannel_;
    // By channel: the bits of the last kPeriods samples, newest first from newest_ on, with as much room before them.
    std::vector<std::uint64_t> before_;
    std::size_t newest_ = kPeriods;
    std::uint64_t seen_ = 0;            // samples before this one
    std::vector<Repeats> repeats_;      // a row of kPeriods for all channels at once, then, with eachChannel_, for each
    std::vector<std::uint64_t> same_;   // by row: the bit period - 1 is set where the newest sample repeats
    double newest_s_ = 0, last_s_ = 0;  // of this sample and the one before
};

}  // namespace tacto
