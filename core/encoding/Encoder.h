// Encoder.h - from what the finger feels to the command of the next train.
//
// Formulas of science.md section 4. The encoder works in volts (the paper's amplitude); a current source is given
// A / |Z|, and nothing at all before |Z| was measured (hazard H4).
//
// Thread-safety: Encoder is immutable; the rest are pure functions. Success never allocates.
#pragma once

#include <optional>

#include "core/encoding/EncodingProfile.h"

namespace tacto {

/// What the encoder asks for: the amplitude of a train and the onset-to-onset interval to the next.
struct Command {
    Volts amplitude{0};
    Seconds interval{0};
    bool operator==(const Command&) const = default;
};

class Encoder {
public:
    /// `profile` has passed validate().
    explicit Encoder(const EncodingProfile& profile);

    /// R and P in 0..1. An absent pressure counts as 0: the interval is then T_max (the amplitude A_min when swapped).
    /// Errors: InvalidArgument outside 0..1 or NaN.
    [[nodiscard]] Result<Command> encode(double roughness, std::optional<double> pressure) const;

    /// What the next train may be, `sinceLast` after a train with `last`, under the profile's limits on a step: the
    /// nearest to `wanted` that keeps all of them. TrainSeries applies it.
    [[nodiscard]] Command limited(const Command& last, const Command& wanted, Seconds sinceLast) const noexcept;

    /// Vibration strength in 0..1 for a massager: A / A_max, so that R = 0 is still felt.
    [[nodiscard]] double massagerIntensity(Volts amplitude) const noexcept;

    [[nodiscard]] const EncodingProfile& profile() const noexcept { return profile_; }

private:
    const EncodingProfile profile_;  // Constant after construction
};

/// The profile's train at `amplitude`, for a voltage source.
[[nodiscard]] PulseTrain voltageTrain(const EncodingProfile& profile, Volts amplitude) noexcept;

/// `amplitude` as it must be on a load of `now` so that what is held is what it would have been on `armed`: times
/// (now / armed)^p, p = 0, 1 or 1/2 for voltage, charge and energy. Exact on loads that scale as a whole.
/// Errors: NotArmed where an impedance is held against and not known; InvalidArgument when it is not finite and above
/// 0; LimitExceeded when it has doubled or halved since the output was armed: that is more than a drift to follow.
[[nodiscard]] Result<Volts> heldAmplitude(Hold hold, Volts amplitude, std::optional<Ohms> armed,
                                          std::optional<Ohms> now);

/// The profile's train at `amplitude` / `impedance`, for a current source. `impedance` is |Z| at the end of the leading
/// phase, measured with the same kind of source, shape and width.
/// Errors: NotArmed without a measured impedance; InvalidArgument when it is not finite and above 0.
[[nodiscard]] Result<PulseTrain> currentTrain(const EncodingProfile& profile, Volts amplitude,
                                              std::optional<Ohms> impedance);

/// Makes one of the above two. `source` is Voltage or Current. Errors: currentTrain()'s; InvalidArgument for others.
[[nodiscard]] Result<PulseTrain> trainFor(Drive source, const EncodingProfile& profile, Volts amplitude,
                                          std::optional<Ohms> impedance);

}  // namespace tacto
