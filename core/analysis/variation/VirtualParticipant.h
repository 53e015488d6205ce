// VirtualParticipant.h - virtual people, drawn from stated distributions: skin, thresholds, discrimination.
//
// Everything drawn is log-normal, given by its median and its geometric standard deviation (1.5: two thirds of all
// people lie between median / 1.5 and median · 1.5), except lapses, which are uniform. What comes out is a prediction,
// never a measurement. premisesOf() (VariationJson.h) says about each default where it is from and which are choices.
//
// Three thresholds are told apart, each a distribution of its own: perception (felt at all), attention (draws attention
// to itself) and intolerance (not borne). A person's three are correlated and in this order.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string_view>

#include "core/base/JustNoticeable.h"
#include "core/base/Random.h"
#include "core/base/Result.h"
#include "core/base/Units.h"
#include "core/base/ValueKind.h"
#include "core/electrode/Load.h"

namespace tacto {

/// Log-normal. `median` in the unit its name says.
struct LogNormal {
    double median = 1;
    double spread = 1;  ///< geometric standard deviation; 1: all alike

    /// `z`: a draw from the standard normal distribution.
    [[nodiscard]] double at(double z) const noexcept;
    [[nodiscard]] double draw(Random& random) const noexcept { return at(random.normal()); }
    bool operator==(const LogNormal&) const = default;
};

/// The accepted values of each figure stand in populationFields().
struct PopulationModel {
    LogNormal series_ohm{200, 1.5};     ///< R_s
    LogNormal parallel_ohm{10e3, 1.5};  ///< R_p under `skinArea`: falls with the area
    LogNormal capacitance_nf{50, 1.3};  ///< C under `skinArea`: grows with the area
    SquareCentimetres skinArea{1};
    /// Thresholds at `thresholdWidth` per phase; the medians rise in this order.
    LogNormal detection_ma{3.5, 1.4};     ///< perception
    LogNormal attention_ma{6.9, 1.4};     ///< attention
    LogNormal intolerance_ma{13.8, 1.4};  ///< intolerance
    double thresholdCorrelation = 0.8;    ///< between the logarithms of a person's thresholds
    /// The level from which stimulation is too strong for a median person, above the median of detection. 9.8: the
    /// geometric mean of attention and intolerance.
    double discomfort_ma = 9.8;
    LogNormal amplitudeWeber{kAmplitudeWeberFraction, 1.25};
    LogNormal intervalWeber{kIntervalWeberFraction, 1.25};
    double lapseMost = 0.06;       ///< a participant's lapse rate is uniform from 0 to this
    double noise_jnd = 1;          ///< standard deviation of what is felt, in just-noticeable differences
    Micros thresholdWidth{150};    ///< phase width that the thresholds hold for
    Micros strengthDuration{151};  ///< time constant of Weiss' law; 0: thresholds do not depend on the width
};

/// Errors: InvalidArgument naming the field, its value and what is accepted.
[[nodiscard]] Result<void> validate(const PopulationModel& model);

/// Threshold current at `width` over that at `thresholdWidth` by Weiss' law, (1 + τ/width) / (1 + τ/thresholdWidth).
[[nodiscard]] double thresholdScale(const PopulationModel& model, Micros width) noexcept;

struct VirtualParticipant {
    std::size_t index = 0;
    Load skin;  ///< the skin under the electrode they get
    /// For pulses of the `width` that drawParticipant() got: detection < attention < intolerance.
    Milliamps detection{0};
    Milliamps attention{0};
    Milliamps intolerance{0};
    /// Too strong from here; > detection. Where the median person's lies between two of the thresholds, this one lies
    /// in the same proportion between their own, on a logarithmic scale.
    Milliamps discomfort{0};
    double amplitudeWeber = kAmplitudeWeberFraction;
    double intervalWeber = kIntervalWeberFraction;
    double lapse = 0;  ///< share of trials in which any answer is given
    double noise_jnd = 1;
};

/// Participant `index` of the population that `seed` makes: the same for any others drawn before or beside it.
/// `model` has passed validate(); `width` > 0 is the phase width of the pulses they will get, `area` > 0 that of each
/// electrode (nothing: `skinArea`). Thresholds do not depend on the area.
[[nodiscard]] VirtualParticipant drawParticipant(const PopulationModel& model, std::uint64_t seed, std::size_t index,
                                                 Micros width, std::optional<SquareCentimetres> area = {});

// The figures that a population of virtual people is given by: what each is called, its unit and what is accepted.
// validate() and the script function analysis.variation() both take them from here.

struct PopulationField {
    std::string_view key;       ///< "detection_ma"
    std::string_view name;      ///< "median perception threshold"
    std::string_view holdsFor;  ///< what the name leaves out: "at 150 us per phase"; may be empty
    AcceptedNumbers accepted;
    LogNormal PopulationModel::*drawn = nullptr;  ///< what each person draws, with this as its median; else:
    double PopulationModel::*single = nullptr;

    [[nodiscard]] double& in(PopulationModel& model) const { return drawn ? (model.*drawn).median : model.*single; }
    [[nodiscard]] double of(const PopulationModel& model) const {
        return drawn ? (model.*drawn).median : model.*single;
    }
};

/// One for each figure that is set individually. Geometric standard deviations are set for several at once.
[[nodiscard]] std::span<const PopulationField> populationFields() noexcept;

/// Geometric standard deviations; 1: all people are alike.
inline constexpr AcceptedNumbers kAcceptedSpread{.low = 1, .high = 10};

}  // namespace tacto
