// VariationDelivery.h - computes what a virtual participant receives at each condition, and what is withheld and why.
//
// The chain matches the bench: encoder, A / |Z| for a current source, rounding to the device's grid, the worst case of
// the limits over the load range, and the exact response of the skin's circuit. A condition that the bench would refuse
// is refused here, too, with its reason. No amplitude is reduced to make it acceptable.
//
// Assumptions: a participant's |Z|, thresholds and personal range are known without error. Skin is linear: R_p does not
// fall with intensity or drift, and contact is never lost.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "core/analysis/variation/VirtualParticipant.h"
#include "core/encoding/Encoder.h"
#include "core/safety/GateSetup.h"

namespace tacto {

/// The range of amplitudes that a participant gets.
enum class AmplitudeLevels {
    Profile,   ///< the profile's A_min to A_max, the same for everybody
    Personal,  ///< personal range from felt to too strong, within the profile's range
};
[[nodiscard]] std::string_view nameOf(AmplitudeLevels levels) noexcept;  // "profile", "personal"
[[nodiscard]] Result<AmplitudeLevels> amplitudeLevelsFrom(std::string_view name);

struct VirtualStimulation {
    EncodingProfile encoding;
    SourceTraits source;
    std::vector<LimitSet> limits;
    Ceilings ceilings;
    std::optional<SquareCentimetres> electrodeArea;  ///< > 0; if empty, the area to which the skin model refers
    Ohms loadLow{500};                               ///< permitted range of a person's |Z|
    Ohms loadHigh{10'000};
    AmplitudeLevels levels = AmplitudeLevels::Personal;
    /// Personal range: A_min is this factor times the detection threshold; 1.5 lies four 10 % steps above it (choice).
    double aboveDetection = 1.5;
    double belowDiscomfort = 0.8;  ///< A_max is this factor times the level that is too strong (choice)
};
/// Returns a source without its own errors: continuous amplitude and compliance that is never reached.
[[nodiscard]] SourceTraits idealSource(Drive drive) noexcept;

/// Errors: InvalidArgument naming the field, its value and what is accepted; for the encoding those of its validate().
[[nodiscard]] Result<void> validate(const VirtualStimulation& stimulation);

enum class DeliveryOutcome {
    Presented,
    ImpedanceOutOfRange,  ///< the check pulse would find |Z| outside the profile's range
    NotSettable,          ///< below the device's smallest step, above its range, or rounded by more than 10 %
    RefusedByLimits,      ///< forbidden by a limit set or a ceiling of the profile
    Uncomfortable,        ///< too strong for the participant; in person mode the gate's ceiling
    NoRange,              ///< the participant's personal range and the profile's range do not overlap
};
[[nodiscard]] std::string_view nameOf(DeliveryOutcome outcome) noexcept;
/// True if the gate refused the condition because of the impedance or the amplitude.
[[nodiscard]] constexpr bool isRefused(DeliveryOutcome outcome) noexcept {
    return outcome == DeliveryOutcome::ImpedanceOutOfRange || outcome == DeliveryOutcome::RefusedByLimits ||
           outcome == DeliveryOutcome::Uncomfortable;
}

struct PredictedStimulus {
    DeliveryOutcome outcome = DeliveryOutcome::NoRange;
    std::string reason;  ///< short text without values, equal for all participants concerned; empty if presented
    Volts command{0};    ///< the encoder's amplitude
    Seconds interval{0};
    Milliamps current{0};  ///< mean of the leading phase, delivered or refused; 0 if there was no command
    Volts voltage{0};      ///< at the end of the leading phase
    bool felt = false;     ///< true if presented and `current` reaches the detection threshold
};

struct Delivery {
    Ohms impedance{0};                       ///< |Z| at the end of the leading phase for the source's kind of drive
    std::vector<PredictedStimulus> stimuli;  ///< one per condition, in the order of the encoding
};

/// `stimulation` must have passed validate().
[[nodiscard]] Delivery deliverTo(const VirtualParticipant& who, const VirtualStimulation& stimulation);

}  // namespace tacto
