// VirtualParticipant.h - draws virtual people from stated distributions: skin, thresholds, discrimination.
//
// Every drawn figure is log-normal, given by its median and geometric standard deviation (1.5: two thirds of people lie
// between median / 1.5 and median · 1.5). Only lapses are uniform. Results are predictions, never measurements.
// premisesOf() (VariationJson.h) states the source of each default, or that it is a choice.
//
// There are three thresholds, each with its own distribution: perception (felt at all), attention (draws attention to
// itself) and intolerance (not tolerated). A person's three thresholds are correlated and in this order.
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

/// A log-normal distribution. `median` has the unit that the member's name states.
struct LogNormal {
    double median = 1;
    double spread = 1;  ///< geometric standard deviation; 1: all draws are equal

    /// `z`: a draw from the standard normal distribution.
    [[nodiscard]] double at(double z) const noexcept;
    [[nodiscard]] double draw(Random& random) const noexcept { return at(random.normal()); }
    bool operator==(const LogNormal&) const = default;
};

/// populationFields() lists the accepted values of each figure.
struct PopulationModel {
    LogNormal series_ohm{200, 1.5};     ///< series resistance R_s
    LogNormal parallel_ohm{10e3, 1.5};  ///< parallel resistance R_p under `skinArea`; falls with the area
    LogNormal capacitance_nf{50, 1.3};  ///< capacitance C under `skinArea`; grows with the area
    SquareCentimetres skinArea{1};
    /// Thresholds at `thresholdWidth` per phase; the medians rise in this order.
    LogNormal detection_ma{3.5, 1.4};     ///< perception threshold
    LogNormal attention_ma{6.9, 1.4};     ///< attention threshold
    LogNormal intolerance_ma{13.8, 1.4};  ///< intolerance threshold
    double thresholdCorrelation = 0.8;    ///< between the logarithms of a person's thresholds
    /// Level from which stimulation is too strong for a median person; must exceed the median of detection. Default:
    /// the geometric mean of attention and intolerance.
    double discomfort_ma = 9.8;
    LogNormal amplitudeWeber{kAmplitudeWeberFraction, 1.25};
    LogNormal intervalWeber{kIntervalWeberFraction, 1.25};
    double lapseMost = 0.06;       ///< a participant's lapse rate is uniform from 0 to this
    double noise_jnd = 1;          ///< standard deviation of the felt stimulus, in just-noticeable differences
    Micros thresholdWidth{150};    ///< phase width at which the thresholds apply
    Micros strengthDuration{151};  ///< time constant of Weiss' law; 0: thresholds do not depend on the width
};

/// Errors: InvalidArgument naming the field, its value and what is accepted.
[[nodiscard]] Result<void> validate(const PopulationModel& model);

/// Threshold at `width` / threshold at `thresholdWidth` by Weiss' law: (1 + τ/width) / (1 + τ/thresholdWidth).
[[nodiscard]] double thresholdScale(const PopulationModel& model, Micros width) noexcept;

struct VirtualParticipant {
    std::size_t index = 0;
    Load skin;  ///< skin under this participant's electrode
    /// For pulses of the `width` given to drawParticipant(): detection < attention < intolerance.
    Milliamps detection{0};
    Milliamps attention{0};
    Milliamps intolerance{0};
    /// Too strong from this level; > detection. It lies between this person's thresholds in the same logarithmic
    /// proportion as the model's discomfort_ma lies between the median thresholds.
    Milliamps discomfort{0};
    double amplitudeWeber = kAmplitudeWeberFraction;
    double intervalWeber = kIntervalWeberFraction;
    double lapse = 0;  ///< share of trials with a random answer
    double noise_jnd = 1;
};

/// Draws participant `index` of the population with this seed, independently of any others that are drawn. `model` must
/// have passed validate(). `width` > 0: phase width of the pulses. `area` > 0: area of each electrode (if absent:
/// `skinArea`). Thresholds do not depend on the area.
[[nodiscard]] VirtualParticipant drawParticipant(const PopulationModel& model, std::uint64_t seed, std::size_t index,
                                                 Micros width, std::optional<SquareCentimetres> area = {});

// The settable figures of a virtual population with name, unit and accepted values, as used by validate() and by the
// script function analysis.variation().

struct PopulationField {
    std::string_view key;       ///< "detection_ma"
    std::string_view name;      ///< "median perception threshold"
    std::string_view holdsFor;  ///< addition to the name: "at 150 us per phase"; may be empty
    AcceptedNumbers accepted;
    LogNormal PopulationModel::*drawn = nullptr;  ///< drawn figure whose median this field sets; else see `single`
    double PopulationModel::*single = nullptr;

    [[nodiscard]] double& in(PopulationModel& model) const { return drawn ? (model.*drawn).median : model.*single; }
    [[nodiscard]] double of(const PopulationModel& model) const {
        return drawn ? (model.*drawn).median : model.*single;
    }
};

/// One field for each figure that is set individually. Geometric standard deviations are set for several at once.
[[nodiscard]] std::span<const PopulationField> populationFields() noexcept;

/// Accepted geometric standard deviations; 1: all people are alike.
inline constexpr AcceptedNumbers kAcceptedSpread{.low = 1, .high = 10};

}  // namespace tacto
