// PulseTrain.h - the request to a stimulator: one train of electrical pulses that ends by itself.
//
// This is only a request. Drivers accept only an ApprovedTrain, which SafetyGate makes from it. Definitions: science.md
// sections 4 and 5.
#pragma once

#include <span>
#include <variant>

#include "core/base/DriveSegment.h"
#include "core/base/Result.h"
#include "core/base/Units.h"

namespace tacto {

enum class PulseShape {
    SymmetricBiphasic,   ///< second phase mirrors the first
    AsymmetricBiphasic,  ///< second phase has equal charge; it is `rechargeRatio` times longer and lower
    Monophasic,          ///< leading phase only, for bench loads only
};
enum class Polarity { Positive, Negative };  ///< sign of the leading phase

/// What the source does between the phases and after the pulse.
enum class GapState { HoldsZero, HighImpedance };

/// Plateau of the leading phase, without sign. The unit fixes the kind of source, so that volts cannot reach a current
/// source by accident (hazard H4). This is a separate type, not an alias, because clang instantiates every conversion
/// between units while it chooses an alternative, and the conversion from volts to milliamps does not compile.
struct Amplitude : std::variant<Volts, Milliamps> {
    Amplitude(Volts v) noexcept : variant(std::in_place_type<Volts>, v) {}
    Amplitude(Milliamps i) noexcept : variant(std::in_place_type<Milliamps>, i) {}
};

[[nodiscard]] inline bool isCurrent(const Amplitude& a) noexcept { return std::holds_alternative<Milliamps>(a); }
[[nodiscard]] inline const char* amplitudeUnit(const Amplitude& a) noexcept {
    return amplitudeUnit(isCurrent(a) ? Drive::Current : Drive::Voltage);
}
/// Returns the amplitude in V or A, depending on its unit.
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

    /// n / intra-train rate: the duration of a train, also the window of its RMS.
    [[nodiscard]] Seconds duration() const noexcept;
    /// Time from the leading edge to the end of the last phase of one pulse.
    [[nodiscard]] Seconds pulseDuration() const noexcept;
    /// Time from the first leading edge to the end of the last phase of the last pulse.
    [[nodiscard]] Seconds outputDuration() const noexcept;
    bool operator==(const PulseTrain&) const = default;
};

/// Returns `train` with `change` applied to its amplitude, in V or mA depending on its unit.
template <class Change>
[[nodiscard]] PulseTrain withAmplitude(PulseTrain train, Change change) noexcept {
    if (const auto* volts = std::get_if<Volts>(&train.amplitude)) {
        train.amplitude = Volts(change(volts->value()));
    } else {
        train.amplitude = Milliamps(change(std::get<Milliamps>(train.amplitude).value()));
    }
    return train;
}

/// Errors: InvalidArgument for trains that make no sense: values that are not finite or are negative, n < 1, a pulse
/// longer than its period, or a recharge ratio that is not above 1. This is not a safety check.
[[nodiscard]] Result<void> validate(const PulseTrain& train);

/// Returns one pulse as ideal rectangular segments, without the rest after it. `gap`: what the source does in gaps.
[[nodiscard]] PulseSegments segmentsOf(const PulseTrain& train, GapState gap) noexcept;

/// Returns the segment after a pulse, for `duration`: 0 V held, or high impedance.
[[nodiscard]] DriveSegment restOf(GapState gap, Seconds duration) noexcept;
/// Time from the end of a pulse's last phase to the next pulse of the same train: 1/rate minus the pulse.
[[nodiscard]] Seconds restBetweenPulses(const PulseTrain& train) noexcept;

// Sampling of a pulse train with exact charge at any sampling rate.
//
// Each sample is the mean of the ideal rectangular waveform over its own interval [k/fs, (k + 1)/fs), not its value at
// one instant. The sum of the samples times 1/fs is therefore the exact charge (or flux) of every phase, even if a
// phase does not fit the sampling grid: an edge within a sample gives a partial value there. A symmetric biphasic train
// sums to zero (apart from rounding) at any rate.

/// Fills `out` with the train's level in V or A. Sample k covers `start` + [k, k + 1)/sampleRate; time 0 is the leading
/// edge. Outside the pulses (gap, rest, before and after) the level is 0. Errors: InvalidArgument as validate(), or for
/// a sampling rate that is not finite and positive or a start that is not finite.
[[nodiscard]] Result<void> synthesize(const PulseTrain& train, Hertz sampleRate, std::span<double> out,
                                      Seconds start = Seconds(0));

}  // namespace tacto
