// VariationDelivery.h - what reaches a virtual participant at each condition, and what is withheld and why.
//
// The chain is the bench's: encoder, A / |Z| on a current source, rounding onto the device's grid, the limits' worst
// case over the load range, the exact response of the skin's circuit. What would be refused is refused here too and
// keeps its reason; nothing is made smaller so that it fits.
//
// A participant's |Z|, thresholds and the range between them are taken as known without error, and skin as linear: its
// R_p does not fall with intensity, it does not drift, contact is not lost.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "core/analysis/variation/VirtualParticipant.h"
#include "core/encoding/Encoder.h"
#include "core/safety/GateSetup.h"

namespace tacto {

/// The amplitudes that a participant gets.
enum class AmplitudeLevels {
    Profile,   ///< the profile's A_min to A_max, the same for everybody
    Personal,  ///< from what the participant feels to what is too strong, as far as it lies in the profile's range
};
[[nodiscard]] std::string_view nameOf(AmplitudeLevels levels) noexcept;  // "profile", "personal"
[[nodiscard]] Result<AmplitudeLevels> amplitudeLevelsFrom(std::string_view name);

struct VirtualStimulation {
    EncodingProfile encoding;
    SourceTraits source;
    std::vector<LimitSet> limits;
    Ceilings ceilings;
    std::optional<SquareCentimetres> electrodeArea;  ///< > 0; nothing: that for which the skin is given
    Ohms loadLow{500};                               ///< a person's |Z| must lie between these two
    Ohms loadHigh{10'000};
    AmplitudeLevels levels = AmplitudeLevels::Personal;
    /// Personal: A_min is this times the detection threshold, clear of it by 4 differences of 10 % (choice) ...
    double aboveDetection = 1.5;
    double belowDiscomfort = 0.8;  ///< ... and A_max this times what is too strong (choice)
};
/// A source without flaws of its own: continuous, far from its compliance.
[[nodiscard]] SourceTraits idealSource(Drive drive) noexcept;

/// Errors: InvalidArgument naming the field, its value and what is accepted; of the encoding as validate().
[[nodiscard]] Result<void> validate(const VirtualStimulation& stimulation);

enum class DeliveryOutcome {
    Presented,
    ImpedanceOutOfRange,  ///< the check pulse would end it: |Z| outside the profile's range
    NotSettable,          ///< below the device's smallest step, above its range, or rounded by more than 10 %
    RefusedByLimits,      ///< a limit set or a ceiling of the profile
    Uncomfortable,        ///< too strong for the participant: the gate's ceiling in person mode
    NoRange,              ///< personal levels: nothing between the participant's two levels lies in the profile's range
};
[[nodiscard]] std::string_view nameOf(DeliveryOutcome outcome) noexcept;
/// Whether the gate refused it: an impedance or an amplitude that is not permitted.
[[nodiscard]] constexpr bool isRefused(DeliveryOutcome outcome) noexcept {
    return outcome == DeliveryOutcome::ImpedanceOutOfRange || outcome == DeliveryOutcome::RefusedByLimits ||
           outcome == DeliveryOutcome::Uncomfortable;
}

struct PredictedStimulus {
    DeliveryOutcome outcome = DeliveryOutcome::NoRange;
    std::string reason;  ///< in short, without values: the same for everybody whom it concerns; empty where presented
    Volts command{0};    ///< the encoder's amplitude
    Seconds interval{0};
    Milliamps current{0};  ///< mean of the leading phase, as delivered (or as refused); 0 if there was no command
    Volts voltage{0};      ///< at the end of the leading phase
    bool felt = false;     ///< presented, and `current` reaches the detection threshold: it counts
};

struct Delivery {
    Ohms impedance{0};                       ///< |Z| at the end of the leading phase, with the source's kind of drive
    std::vector<PredictedStimulus> stimuli;  ///< one per condition of the encoding, in its order
};

/// `stimulation` has passed validate().
[[nodiscard]] Delivery deliverTo(const VirtualParticipant& who, const VirtualStimulation& stimulation);

}  // namespace tacto
