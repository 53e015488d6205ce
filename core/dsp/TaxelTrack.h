// TaxelTrack.h - the baseline of the taxels, their spatial feature v, and their pressure.
//
// The baseline is the declared interval; else the rest before the first contact if that lasted 250 ms; else the first
// 250 ms. A sample with a value that is not finite is counted and not used.
//
// Thread-safety: none; one owner. Never allocates after construction.
#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include "core/base/Stream.h"
#include "core/dsp/RoughnessChain.h"
#include "core/dsp/SampleHistory.h"

namespace tacto {

class TaxelTrack {
public:
    static constexpr double kShortestRest_s = 0.25;

    TaxelTrack(const StreamInfo& info, std::optional<TimeInterval> declaredBaseline);

    void push(double t_s, const double* values) noexcept;
    void clear() noexcept;
    void preset(const RestLevels& rest);

    [[nodiscard]] double first_s() const noexcept { return first_; }
    [[nodiscard]] double newest_s() const noexcept { return samples_.newest_s(); }
    /// Returns the largest distance in time from a frame at which a sample is used for it.
    [[nodiscard]] double reach_s() const noexcept { return reach_; }

    /// Adds the samples up to `known_s` to the stretches from which the baseline is chosen. `firstContact_s`: the first
    /// contact up to that time; infinity: none yet.
    void settle(double known_s, double firstContact_s) noexcept;
    /// Returns true once no later sample can change the baseline of the frames so far.
    [[nodiscard]] bool decided(double known_s) const noexcept;
    /// Fixes the baseline with the present samples, at the end of the data.
    void close() noexcept;

    struct Reading {
        double v;     ///< NaN if absent
        double mean;  ///< mean of the taxels, without baseline removal; NaN if no sample is near enough
    };
    /// Returns the reading at `t_s`, which must never decrease. Requires newest_s() ≥ t_s, or silence since.
    [[nodiscard]] Reading at(double t_s, bool dynamic) noexcept;

    [[nodiscard]] bool baselineKnown() const noexcept { return known_; }
    [[nodiscard]] bool baselineAssumed() const noexcept { return assumed_; }
    [[nodiscard]] const std::vector<double>& baseline() const noexcept { return baseline_; }
    [[nodiscard]] double floor() const noexcept { return floor_; }
    [[nodiscard]] std::size_t invalidSamples() const noexcept { return invalid_; }
    [[nodiscard]] std::size_t samplesBeyond() const noexcept { return beyond_; }
    [[nodiscard]] std::size_t outOfOrder() const noexcept { return outOfOrder_; }

private:
    /// Mean of each taxel, and the spread of the taxels' mean, over one stretch of samples.
    struct Stretch {
        std::vector<double> sum;
        std::size_t count = 0;
        double mean = 0;     // running mean of the taxels' mean
        double squares = 0;  // running sum of squared deviations
        void add(const double* values) noexcept;
        void clear() noexcept;
    };
    void adopt(const Stretch& stretch, double validFrom_s) noexcept;
    void decide(double known_s) noexcept;
    [[nodiscard]] double variance(std::size_t sample, bool dynamic, double& meanAbove) noexcept;

    const std::size_t taxels_;
    const double most_;
    const std::optional<TimeInterval> declared_;
    double reach_;
    SampleHistory samples_;
    Stretch inDeclared_, beforeContact_, atStart_;
    std::vector<double> baseline_;
    std::vector<double> above_;     // scratch: u of one sample
    std::vector<double> trailing_;  // scratch: moving average of u
    double floor_ = 0;
    double first_;
    double firstContact_;
    double validFrom_;         // frames before this time have no baseline, whenever they are completed
    std::size_t settled_ = 0;  // samples before this number are in the baseline stretches
    std::size_t cursor_ = 0;   // last sample at or before the frame
    std::size_t window_ = 0;   // first sample of the moving average
    bool known_ = false;
    bool assumed_ = false;
    bool preset_ = false;
    std::size_t invalid_ = 0;
    std::size_t beyond_ = 0;
    std::size_t outOfOrder_ = 0;
};

}  // namespace tacto
