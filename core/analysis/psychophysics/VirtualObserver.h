// VirtualObserver.h - gives the answers of a virtual participant, one question at a time (pilot.md section 8).
//
// Signal detection as in VariationObserver.h: the observer feels the level in just-noticeable differences plus normal
// noise. Below detection the answer is "none", above it the nearest learned condition, in a lapse any name; never "not
// sure". In two-interval trials the probability of the right answer is QUEST+'s Weibull function at the participant's
// threshold, with the slope of the noise there; in a lapse either interval is answered. Ascending limits have no
// lapses: "too strong" is never an accident. Thresholds rise to 1 + a with stimulation time (τ = 5 min), without
// recovery. Ratings follow the level between the thresholds, with noise (choice).
//
// Every answer uses its own random stream (seed, key) and so depends only on the question and its key. A session that
// was killed and resumed therefore gives the same answers as an undisturbed one. A key names the session and the trial
// but not the attempt.
//
// Thread-safety: only const functions; any number of threads may call them.
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

/// Current that feels like a massager's full intensity to a virtual participant (choice without data; it puts the
/// median thresholds at 0.2 and 0.6 of the range).
inline constexpr Milliamps kVirtualFullIntensity{15};

struct VirtualObserverSettings {
    VirtualParticipant who;
    std::uint64_t seed = 1;
    double adaptation = 0;        ///< a, 0 to 10: thresholds rise by a factor of 1 + a
    Seconds adaptationTime{300};  ///< τ, as time of stimulation; > 0
    LevelUnit unit = LevelUnit::Current;
};

/// One condition as delivered to the participant.
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

/// The ratings of one stimulus, on scales from 0 to 10.
struct VirtualRating {
    int intensity = 0;
    int unpleasantness = 0;
    int pain = 0;
    Naturalness naturalness = Naturalness::PossiblyNatural;
    std::vector<std::string_view> qualities;  ///< words such as "touch"; empty if nothing is felt
};

class VirtualObserver {
public:
    /// Errors: InvalidArgument naming the setting, its value and what is accepted.
    [[nodiscard]] static Result<VirtualObserver> create(const VirtualObserverSettings& settings);

    // `stimulated`: earlier stimulation time in this session, ≥ 0. Levels are ≥ 0, in the observer's unit.

    [[nodiscard]] StrengthWord strength(std::string_view key, double level, Seconds stimulated) const;
    [[nodiscard]] TrialInterval detect(std::string_view key, double level, TrialInterval interval,
                                       Seconds stimulated) const;
    /// Answers which interval felt stronger; both levels > 0. `interval` holds the stronger level.
    [[nodiscard]] TrialInterval compare(std::string_view key, double weaker, double stronger,
                                        TrialInterval interval) const;
    /// Returns the index of the named condition, or `conditions.size()` for "none". `presented`: index of the condition
    /// given; empty for a catch trial.
    [[nodiscard]] std::size_t identify(std::string_view key, std::span<const DeliveredCondition> conditions,
                                       std::optional<std::size_t> presented, Seconds stimulated) const;
    /// Answers "half an hour of this?" with yes up to the level that is too strong.
    [[nodiscard]] bool acceptable(std::string_view key, double level, Seconds stimulated) const;
    [[nodiscard]] VirtualRating rate(std::string_view key, double level, Seconds stimulated) const;

    /// Long-run probabilities of identify(): [condition][response], with "none" last.
    [[nodiscard]] std::vector<std::vector<double>> predicted(std::span<const DeliveredCondition> conditions,
                                                             Seconds stimulated) const;
    /// Probability of the right interval in detect().
    [[nodiscard]] double probabilityRight(double level, Seconds stimulated) const noexcept;

    /// The threshold in the observer's unit before any stimulation.
    [[nodiscard]] double detection() const noexcept { return detection_; }
    [[nodiscard]] double tooStrong() const noexcept { return tooStrong_; }
    [[nodiscard]] const VirtualObserverSettings& settings() const noexcept { return settings_; }
    /// Factor by which the thresholds have risen: 1 to 1 + a.
    [[nodiscard]] double risen(Seconds stimulated) const noexcept;

private:
    explicit VirtualObserver(const VirtualObserverSettings& settings) noexcept;
    [[nodiscard]] Random randomFor(std::string_view question, std::string_view key) const;
    [[nodiscard]] double jnd(double level) const noexcept;
    /// Returns the felt level, including the observer's noise.
    [[nodiscard]] double noisy(Random random, double level) const noexcept;
    [[nodiscard]] IdentificationTask taskFor(std::span<const DeliveredCondition> conditions) const;
    [[nodiscard]] Observer observerAfter(Seconds stimulated) const;

    VirtualObserverSettings settings_;
    double detection_;
    double attention_;
    double tooStrong_;
    double intolerance_;
    double slope_;  // slope of the Weibull function
};

}  // namespace tacto
