// StreamHealth.h - checks whether a stream is continuous, how old it is, and its real rate.
//
// Gaps, repeats and clock steps are counted, never bridged (science.md section 1, hazard H7). The rate is (n - 1) /
// (last - first stamp) over the longest gap-free stretch, because the median step of rounded stamps would be
// misleading.
//
// Thread-safety: none; one owner. feed() and the queries never allocate.
#pragma once

#include <array>
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

/// The findings so far. Counts only increase.
struct HealthReport {
    std::size_t samples = 0;
    std::size_t gaps = 0;            ///< number of places with missing samples
    std::size_t missingSamples = 0;  ///< estimate of their number, at the nominal rate
    std::size_t repeats = 0;         ///< stamps equal to the previous stamp
    std::size_t clockSteps = 0;      ///< stamps earlier than the previous stamp
    std::size_t irregular = 0;       ///< stamps half a step or more early, but in order
    std::size_t invalidStamps = 0;   ///< number of stamps that are not finite
    std::size_t invalidSamples = 0;  ///< number of samples with a value that is not finite
    bool coarseStamps = false;       ///< stamps with so few digits that they repeat; spread evenly when read
    double longestGap_s = 0;
    double rate_hz = std::numeric_limits<double>::quiet_NaN();  ///< measured rate; NaN before two regular samples

    [[nodiscard]] bool continuous() const noexcept {
        return gaps + repeats + clockSteps + irregular + invalidStamps + invalidSamples == 0;
    }
    /// Returns one line for people: "2 gaps (longest 0.08 s, about 14 samples), 1 repeat", or "continuous".
    [[nodiscard]] std::string text() const;
};

class StreamHealth {
public:
    /// Stamps are compared with `nominalRate_hz`, which must be finite and positive.
    explicit StreamHealth(double nominalRate_hz) noexcept : grid_(nominalRate_hz) {}

    StampClass feed(double t_s) noexcept;
    /// Takes all samples of `block` and checks their values too. `channels`: as in the stream's StreamInfo.
    void feed(const SampleBlock& block, std::size_t channels) noexcept;

    /// Returns the age of the newest sample; infinite before the first.
    [[nodiscard]] double age_s(double now_s) const noexcept { return now_s - grid_.last(); }
    /// Returns true if the newest sample is older than 100 ms: no new trains then (hazard H7).
    [[nodiscard]] bool stale(double now_s) const noexcept { return !(age_s(now_s) <= kStale_s); }
    [[nodiscard]] const HealthReport& report() const noexcept { return report_; }

    static constexpr double kStale_s = 0.1;

private:
    SampleGrid grid_;
    HealthReport report_;
    double stretchFirst_ = 0;       // first stamp of the current gap-free stretch
    std::size_t stretchSteps_ = 0;  // number of regular steps in the stretch
    std::size_t longestSteps_ = 0;
};

/// Returns a robust estimate of the rate of recorded stamps: from the mean step, without steps that are obviously gaps.
/// 0 with fewer than two distinct stamps.
[[nodiscard]] double roughRate_hz(std::span<const double> stamps);

/// Returns true if more than one stamp in four repeats the one before: the file has too few digits in its times.
[[nodiscard]] bool stampsAreCoarse(std::span<const double> stamps) noexcept;

/// Spreads coarse stamps evenly over each stretch that has no gap or step back.
void spreadCoarseStamps(std::span<double> stamps);

// Detects that the values of a stream stand still although its stamps continue: a sensor that hangs while its
// electronics repeat its last value or its last block (hazard H7).
//
// How often a value repeats exactly because of noise and coarse steps is learnt from the stream. A stream stands still
// if the repeats in a row would occur by chance once in 10^9 times, and last longer than samples may be old. A value
// that usually moves must not repeat with a period of several samples either, and no single axis may stand still while
// others move.

class Standstill {
public:
    /// Length of the longest block, in samples, for which repetition is detected.
    static constexpr std::size_t kPeriods = 64;

    /// `eachChannel`: repeatsSince() checks each channel by itself; otherwise all of them together.
    explicit Standstill(std::size_t channels, bool eachChannel = false);

    /// Takes all samples of `block`, in order.
    void feed(const SampleBlock& block) noexcept;
    /// Returns the stamp since which no channel has changed, or nothing while this may be chance.
    [[nodiscard]] std::optional<double> since() const noexcept;
    /// Returns the stamp since which a channel that usually moves has stood still or repeated the same values.
    [[nodiscard]] std::optional<double> repeatsSince() const noexcept;

private:
    /// Samples that are compared together; fewer than show a standstill (kEnough).
    static constexpr std::size_t kTogether = 32;
    /// Bit (kPeriods - period) is set if a sample repeats the value `period` samples before.
    using Mask = std::uint64_t;
    using Masks = std::array<Mask, kTogether>;

    /// The last kPeriods values of a channel, then those that are compared together.
    struct Values {
        std::array<std::uint64_t, kPeriods + kTogether> bits{};
        std::array<std::uint8_t, kPeriods + kTogether> marks{};  // a byte of each; equal values have equal ones
    };
    /// What one channel, or all together, has repeated; for each bit of a mask.
    struct Repeats {
        std::array<std::uint64_t, kPeriods> count{};   // all repeats so far
        std::array<std::uint64_t, kPeriods> excess{};  // of them, those beyond kEnough of each standstill that ended
        std::array<std::uint64_t, kPeriods> run{};     // of them, those in a row up to the newest sample
        std::array<double, kPeriods> since_s{};        // while `run` is not 0: time of the last different value
        Mask newest = 0;                               // of the newest sample
    };
    void compare(std::size_t channel, const double* values, std::size_t count, Masks& same) noexcept;
    void track(Repeats& row, const Masks& same, std::span<const double> t_s) const noexcept;
    [[nodiscard]] static bool moves(const Repeats& row, std::size_t bit, std::uint64_t seen, std::uint64_t count,
                                    std::uint64_t run) noexcept;

    const std::size_t channels_;
    const bool eachChannel_;
    std::vector<Values> before_;    // one for each channel
    std::vector<Repeats> repeats_;  // of all channels together, then of each; its runs only with eachChannel_
    std::uint64_t seen_ = 0;        // samples so far
    double newest_s_ = 0;           // stamp of the newest
};

}  // namespace tacto
