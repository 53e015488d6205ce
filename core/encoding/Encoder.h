// Encoder.h - turns what the finger feels into the command of the next train.
//
// Uses the formulas of science.md section 4. The encoder computes an amplitude A in volts, as in the paper. A current
// source gets A / |Z|, and no command until |Z| was measured (hazard H4).
//
// Thread-safety: Encoder is immutable; the other functions are pure. A successful call never allocates.
#pragma once

#include <optional>

#include "core/encoding/EncodingProfile.h"

namespace tacto {

/// The encoder's output: the amplitude of a train and the time from its onset to the next onset.
struct Command {
    Volts amplitude{0};
    Seconds interval{0};
    bool operator==(const Command&) const = default;
};

class Encoder {
public:
    /// `profile` must have passed validate().
    explicit Encoder(const EncodingProfile& profile);

    /// Encodes roughness R and pressure P, both 0..1. Without a pressure P is 0: the interval is then T_max (or the
    /// amplitude A_min if swapped). Errors: InvalidArgument outside 0..1 or for NaN.
    [[nodiscard]] Result<Command> encode(double roughness, std::optional<double> pressure) const;

    /// Returns the command nearest to `wanted` that keeps all step limits of the profile, for a train that follows the
    /// train `last` after `sinceLast`. TrainSeries uses it.
    [[nodiscard]] Command limited(const Command& last, const Command& wanted, Seconds sinceLast) const noexcept;

    /// Returns a massager's vibration strength, 0..1: A / A_max, so that R = 0 is still felt.
    [[nodiscard]] double massagerIntensity(Volts amplitude) const noexcept;

    [[nodiscard]] const EncodingProfile& profile() const noexcept { return profile_; }

private:
    const EncodingProfile profile_;  // constant after construction
};

/// Returns the profile's train at `amplitude`, for a voltage source.
[[nodiscard]] PulseTrain voltageTrain(const EncodingProfile& profile, Volts amplitude) noexcept;

/// Corrects `amplitude` for a load that changed from `armed` to `now`, so that the held quantity stays constant: times
/// (now / armed)^p, with p = 0, 1 or 1/2 for voltage, charge and energy. Exact if the load only scales. Errors:
/// NotArmed if an impedance is needed but unknown; InvalidArgument if it is not finite and positive; LimitExceeded if
/// it more than doubled or halved since arming, which is no longer a drift.
[[nodiscard]] Result<Volts> heldAmplitude(Hold hold, Volts amplitude, std::optional<Ohms> armed,
                                          std::optional<Ohms> now);

/// Returns the profile's train at `amplitude` / `impedance`, for a current source. `impedance` is |Z| at the end of the
/// leading phase, measured with the same kind of source, shape and width. Errors: NotArmed without a measured
/// impedance; InvalidArgument if it is not finite and positive.
[[nodiscard]] Result<PulseTrain> currentTrain(const EncodingProfile& profile, Volts amplitude,
                                              std::optional<Ohms> impedance);

/// Calls the matching one of these two. `source`: Voltage or Current, else InvalidArgument. Errors: as currentTrain().
[[nodiscard]] Result<PulseTrain> trainFor(Drive source, const EncodingProfile& profile, Volts amplitude,
                                          std::optional<Ohms> impedance);

}  // namespace tacto
