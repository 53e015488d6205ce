// VirtualObserver.h - the answers of a virtual participant, one question at a time (pilot.md section 8).
//
// What is felt is signal detection, as in VariationObserver.h: the level in just-noticeable differences plus normal
// noise, "none" below detection, the nearest of the conditions learned above it, lapses any name, "not sure" never.
// In two-interval trials the right interval is known with the probability of QUEST+'s own Weibull function at the
// participant's threshold, its slope that of the noise there; in a lapse either interval is said. Ascending limits have
// no lapses: "too strong" is never said by accident. Thresholds rise with stimulation to 1 + a, with τ = 5 min of it,
// and do not recover. Ratings follow the level between the participant's thresholds, with noise (choice).
//
// Every answer draws from its own stream (seed, key), so an answer depends on nothing but the question and its key: a
// session that was killed and resumed has the answers of an undisturbed one. A key names session and trial and no
// attempt.
//
// Thread-safety: const functions only; any number of callers.
#pragma once

#include <cstdint>
#include <span>
#include <string_view>
#include <vector>

#include "core/analysis/psychophysics/AscendingLimits.h"
#include "core/analysis/psychophysics/TwoIntervalTrials.h"
#include "core/analysis/variation/VariationObserver.h"
#include "core/analysis/variation/VirtualParticipant.h"

namespace tacto {

/// A massager's full intensity feels to a virtual participant like this current (choice: no data; it puts the median
/// thresholds at 0.2 and 0.6 of the range).
inline constexpr Milliamps kVirtualFullIntensity{15};

struct VirtualObserverSettings {
    VirtualParticipant who;
    std::uint64_t seed = 1;
    double adaptation = 0;        ///< a, 0 to 10: thresholds rise to 1 + a
    Seconds adaptationTime{300};  ///< τ, of stimulation; > 0
    LevelUnit unit = LevelUnit::Current;
};

/// One condition as it is delivered.
struct DeliveredCondition {
    double level = 0;     ///< in the observer's unit; > 0
    Seconds interval{1};  ///< > 0
};

enum class Naturalness { TotallyNatural, AlmostNatural, PossiblyNatural, RatherUnnatural, TotallyUnnatural };
inline constexpr Word<Naturalness> kNaturalness[] = {{"totally-natural", Naturalness::TotallyNatural},
                                                     {"almost-natural", Naturalness::AlmostNatural},
                                                     {"possibly-natural", Naturalness::PossiblyNatural},
                                                     {"rather-unnatural", Naturalness::RatherUnnatural},
                                                     {"totally-unnatural", Naturalness::TotallyUnnatural}};
[[nodiscard]] constexpr std::string_view nameOf(Naturalness word) noexcept { return wordFor(kNaturalness, word); }

/// Scales from 0 to 10.
struct VirtualRating {
    int intensity = 0;
    int unpleasantness = 0;
    int pain = 0;
    Naturalness naturalness = Naturalness::PossiblyNatural;
    std::vector<std::string_view> qualities;  ///< words such as "touch"; empty where nothing is felt
};

class VirtualObserver {
public:
    /// Errors: InvalidArgument naming the setting, its value and what is accepted.
    [[nodiscard]] static Result<VirtualObserver> create(const VirtualObserverSettings& settings);

    // `stimulated`: how long trains were given in this session before, ≥ 0. Levels ≥ 0, in the observer's unit.

    [[nodiscard]] StrengthWord strength(std::string_view key, double level, Seconds stimulated) const;
    [[nodiscard]] TrialInterval detect(std::string_view key, double level, TrialInterval interval,
                                       Seconds stimulated) const;
    /// The interval in which the stronger of two levels seemed to be; both > 0. `interval` holds it.
    [[nodiscard]] TrialInterval compare(std::string_view key, double weaker, double stronger,
                                        TrialInterval interval) const;
    /// Index of the condition that is named, or `conditions.size()` for "none". `presented`: which of them; nothing: a
    /// catch trial.
    [[nodiscard]] std::size_t identify(std::string_view key, std::span<const DeliveredCondition> conditions,
                                       std::optional<std::size_t> presented, Seconds stimulated) const;
    /// "Half an hour of this?": yes up to the level that is too strong.
    [[nodiscard]] bool acceptable(std::string_view key, double level, Seconds stimulated) const;
    [[nodiscard]] VirtualRating rate(std::string_view key, double level, Seconds stimulated) const;

    /// [condition][response] with "none" last: what identify() does in the long run.
    [[nodiscard]] std::vector<std::vector<double>> predicted(std::span<const DeliveredCondition> conditions,
                                                             Seconds stimulated) const;
    /// Probability of the right interval in detect().
    [[nodiscard]] double probabilityRight(double level, Seconds stimulated) const noexcept;

    /// Thresholds in the observer's unit, as they were before any stimulation.
    [[nodiscard]] double detection() const noexcept { return detection_; }
    [[nodiscard]] double tooStrong() const noexcept { return tooStrong_; }
    [[nodiscard]] const VirtualObserverSettings& settings() const noexcept { return settings_; }
    /// The factor by which thresholds have risen: 1 to 1 + a.
    [[nodiscard]] double risen(Seconds stimulated) const noexcept;

private:
    explicit VirtualObserver(const VirtualObserverSettings& settings) noexcept;
    [[nodiscard]] Random randomFor(std::string_view question, std::string_view key) const;
    [[nodiscard]] double jnd(double level) const noexcept;
    /// The level as it is felt, with the observer's noise.
    [[nodiscard]] double noisy(Random random, double level) const noexcept;
    [[nodiscard]] IdentificationTask taskFor(std::span<const DeliveredCondition> conditions) const;
    [[nodiscard]] Observer observerAfter(Seconds stimulated) const;

    VirtualObserverSettings settings_;
    double detection_;
    double attention_;
    double tooStrong_;
    double intolerance_;
    double slope_;  // The Weibull function's
};

}  // namespace tacto
