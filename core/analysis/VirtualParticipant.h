// VirtualParticipant.h - people who do not exist, drawn from stated distributions: skin, thresholds, discrimination.
//
// Everything drawn is log-normal, given by its median and its geometric standard deviation (1.5: two thirds of all
// people lie between median / 1.5 and median · 1.5), except lapses, which are uniform. What comes out is a prediction,
// never a measurement.
//
// Sources of the defaults, and what is a choice of ours because no source was found:
// - Skin: the medians are the bench's skin equivalent (science.md section 6), 200 Ω + (10 kΩ ∥ 50 nF). The spread is a
//   choice: replace it with the laboratory's own impedance readings.
// - Thresholds: medians 3.5 mA (perceived) and 13.8 mA (not tolerated) of 81 volunteers at 150 µs, upper arm:
// Perception
//   thresholds and qualitative perceptions for electrocutaneous stimulation, Sci Rep 2022 (PMID 35513410). The
//   fingertip differs and the spread between people is a choice.
// - Strength against duration: Weiss' law with 151 µs, the time constant of fibres of the fingerpad: Kaczmarek et al.,
//   The afferent neural response to electrotactile stimuli: preliminary results, IEEE Trans Rehabil Eng 2000.
// - Weber fractions 0.10 and 0.16: science.md section 10. Their spread between people is a choice.
// - Lapses: 0 to 0.06, the range that Wichmann and Hill (2001) allow when they fit psychometric functions.
//
// Thread-safety: values and pure functions.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string_view>

#include "core/base/JustNoticeable.h"
#include "core/base/Random.h"
#include "core/base/Result.h"
#include "core/base/Units.h"
#include "core/electrode/Load.h"

namespace tacto {

/// Log-normal. `median` in the unit its name says.
struct LogNormal {
    double median = 1;  ///< > 0
    double spread = 1;  ///< geometric standard deviation, 1 (nobody differs) to 10

    [[nodiscard]] double draw(Random& random) const noexcept;
    bool operator==(const LogNormal&) const = default;
};

struct PopulationModel {
    LogNormal series_ohm{200, 1.5};     ///< R_s
    LogNormal parallel_ohm{10e3, 1.5};  ///< R_p
    LogNormal capacitance_nf{50, 1.3};  ///< C
    LogNormal detection_ma{3.5, 1.4};   ///< smallest current felt, at `thresholdWidth` per phase
    /// Discomfort over detection, less 1, so that discomfort is above detection in everybody: 13.8 / 3.5 - 1.
    LogNormal headroom{2.94, 1.3};
    LogNormal amplitudeWeber{kAmplitudeWeberFraction, 1.25};
    LogNormal intervalWeber{kIntervalWeberFraction, 1.25};
    double lapseMost = 0.06;       ///< a participant's lapse rate is uniform from 0 to this; 0 to 1
    double noise_jnd = 1;          ///< standard deviation of what is felt, in just-noticeable differences; > 0
    Micros thresholdWidth{150};    ///< phase width that the thresholds hold for
    Micros strengthDuration{151};  ///< time constant of Weiss' law; 0: thresholds do not depend on the width
};

/// Errors: InvalidArgument naming the field, its value and what is accepted.
[[nodiscard]] Result<void> validate(const PopulationModel& model);

struct VirtualParticipant {
    std::size_t index = 0;
    Load skin;
    Milliamps detection{0};   ///< for pulses of `width`, as drawParticipant() was given it
    Milliamps discomfort{0};  ///< > detection
    double amplitudeWeber = kAmplitudeWeberFraction;
    double intervalWeber = kIntervalWeberFraction;
    double lapse = 0;  ///< share of trials in which any answer is given
    double noise_jnd = 1;
};

/// Participant `index` of the population that `seed` makes: the same whoever is drawn before or beside it. `model` has
/// passed validate(); `width` > 0 is the phase width of the pulses they will get.
[[nodiscard]] VirtualParticipant drawParticipant(const PopulationModel& model, std::uint64_t seed, std::size_t index,
                                                 Micros width);

}  // namespace tacto
