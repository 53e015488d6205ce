// PulseTrain.h - what is asked of a stimulator: one self-ending train of electrical pulses.
//
// A request only. Drivers never take it; they take the ApprovedTrain that SafetyGate makes of it.
// Definitions: science.md sections 4 and 5.
#pragma once

#include <span>
#include <variant>

#include "core/base/DriveSegment.h"
#include "core/base/Result.h"
#include "core/base/Units.h"

namespace tacto {

enum class PulseShape {
    SymmetricBiphasic,   ///< second phase mirrors the first
    AsymmetricBiphasic,  ///< second phase of equal charge, `rechargeRatio` times longer and lower
    Monophasic,          ///< leading phase only: bench loads only
};
enum class Polarity { Positive, Negative };  ///< sign of the leading phase

/// What the source does between the phases and after the pulse.
enum class GapState { HoldsZero, HighImpedance };

/// The leading phase's plateau, unsigned. The unit says what kind of source it is meant for, so volts cannot
/// reach a current source by accident (hazard H4).
/// A type of its own, not an alias, because clang instantiates every conversion between units while it chooses an
/// alternative, and volts to milliamps is an error already there.
struct Amplitude : std::variant<Volts, Milliamps> {
    Amplitude(Volts v) noexcept : variant(std::in_place_type<Volts>, v) {}
    Amplitude(Milliamps i) noexcept : variant(std::in_place_type<Milliamps>, i) {}
};

[[nodiscard]] inline bool isCurrent(const Amplitude& a) noexcept { return std::holds_alternative<Milliamps>(a); }
[[nodiscard]] inline const char* amplitudeUnit(const Amplitude& a) noexcept {
    return amplitudeUnit(isCurrent(a) ? Drive::Current : Drive::Voltage);
}
/// The amplitude in V or A, depending on the drive.
[[nodiscard]] double siValue(const Amplitude& a) noexcept;

struct PulseTrain {
    Amplitude amplitude = Volts(0);
    PulseShape shape = PulseShape::SymmetricBiphasic;
    Polarity polarity = Polarity::Positive;
    Micros phaseWidth{200};     ///< width of the leading phase
    Micros interPhaseGap{100};  ///< 0 or more
    double rechargeRatio = 10;  ///< AsymmetricBiphasic only, > 1
    int pulses = 1;             ///< n ≥ 1
    Hertz rate{100};            ///< intra-train pulse rate

    /// n / intra-train rate: the window of the in-train RMS, and the time a train occupies.
    [[nodiscard]] Seconds duration() const noexcept;
    /// The time from the leading edge to the end of the last phase of one pulse.
    [[nodiscard]] Seconds pulseDuration() const noexcept;
    /// The time from the first leading edge to the end of the last phase of the last pulse.
    [[nodiscard]] Seconds outputDuration() const noexcept;
    bool operator==(const PulseTrain&) const = default;
};

/// `train` with `change` applied to its amplitude, in V or mA, depending on the drive.
template <class Change>
[[nodiscard]] PulseTrain withAmplitude(PulseTrain train, Change change) noexcept {
    if (const auto* volts = std::get_if<Volts>(&train.amplitude)) {
        train.amplitude = Volts(change(volts->value()));
    } else {
        train.amplitude = Milliamps(change(std::get<Milliamps>(train.amplitude).value()));
    }
    return train;
}

/// Refuses what no stimulator could mean: values that are not finite or negative, n < 1, a pulse longer than
/// its period, a recharge ratio not above 1. Says nothing about safety.
[[nodiscard]] Result<void> validate(const PulseTrain& train);

/// One pulse as ideal rectangular segments, without the rest after it. `gap` is the source's declared state.
[[nodiscard]] PulseSegments segmentsOf(const PulseTrain& train, GapState gap) noexcept;

/// What the source does after a pulse, for `duration`: 0 V held, or high impedance.
[[nodiscard]] DriveSegment restOf(GapState gap, Seconds duration) noexcept;
/// The time from the end of one pulse's last phase to the next pulse of the same train: 1/rate less the pulse.
[[nodiscard]] Seconds restBetweenPulses(const PulseTrain& train) noexcept;

// A pulse train as samples, charge-exact at any rate.
//
// Each sample is the mean of the ideal rectangular waveform over its own interval [k/fs, (k + 1)/fs), not its value at
// an instant. So the sum of the samples times 1/fs is the exact charge (or flux) of every phase, even where a phase
// does not fall on the sampling grid: an edge inside a sample shows as a partial value there, and a symmetric biphasic
// train sums to zero (to rounding) at any rate.

/// Fills `out` with the train's level in V or A. Sample k covers `start` + [k, k + 1)/sampleRate, time 0 being the
/// leading edge; outside the pulses (gap, rest, before and after) the level is 0. Errors: InvalidArgument as
/// validate(), or for a sampling rate or start that is not finite or not above 0.
[[nodiscard]] Result<void> synthesize(const PulseTrain& train, Hertz sampleRate, std::span<double> out,
                                      Seconds start = Seconds(0));

}  // namespace tacto
