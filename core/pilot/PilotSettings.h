// PilotSettings.h - what one pilot session is: its participant, its study, its seed, how its conditions are made, and
// what holds it.
//
// Thread-safety: values; pure functions.
#pragma once

#include <cstdint>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "core/analysis/psychophysics/LevelGrid.h"
#include "core/base/Units.h"
#include "core/encoding/EncodingProfile.h"
#include "core/study/Participant.h"
#include "core/study/StudySettings.h"

namespace tacto {

class Study;

// The events that hold a session until the operator has answered them by name (pilot.md section 4): a level that was
// too strong, pain at or above the study's ceiling, an adverse event that is serious or was not reported.

/// Name of the question that the operator answers.
inline constexpr const char* kHoldPrompt = "answer-by-name";

struct PilotHold {
    std::string name;  ///< the name in its row: one answer is enough
    std::string said;  ///< what happened: one sentence without its full stop
};

/// The participant called the level of `trial` too strong.
[[nodiscard]] PilotHold tooStrongHold(std::string_view trial);
/// Nothing where the row "rating" is about something else, or lies below `ceiling`.
[[nodiscard]] std::optional<PilotHold> painHold(const nlohmann::json& rating, int ceiling);
/// Everything unanswered: in each session of the participant, a resumed one included, and in events of the whole study.
/// A session of theirs whose record is gone or does not open holds, too: it may have ended with pain. What the program
/// answered in a virtual participant's session counts for virtual participants alone.
[[nodiscard]] std::vector<PilotHold> openHolds(const Study& study, const Participant& who);

struct PilotSettings {
    std::string code;  ///< the participant's code
    SessionBasis basis = SessionBasis::Person;
    int session = 1;         ///< number of the participant's session
    std::uint64_t seed = 1;  ///< for order, plan and pauses; a resumed session has its plan's seed
    std::string encoding = "standard";
    std::string earlierEncoding;  ///< another encoding that the participant had in a complete session; empty: none
    LevelUnit unit = LevelUnit::Current;
    double cap = 15;        ///< highest level of the study, in `unit`
    Seconds shortest{0.5};  ///< T_min
    Seconds longest{2};     ///< T_max
    Seconds window{4};      ///< a presentation's window, 2 T_max
    Assignment assignment = Assignment::TextureToAmplitude;
    std::vector<Condition> conditions = EncodingProfile::fourConditions(0, 1);
    std::vector<std::string> answers;  ///< conditions by their place and key, in every phase; empty: as kAnswerPlaces
    int blocks = 5;
    int perCondition = 4;   ///< in a block
    int catchTrials = 2;    ///< in a block
    std::string runSha256;  ///< hash of what it is run with (runHash()); stands in the plan, for resuming with the same
    int painCeiling = kPainCeiling;
    std::vector<PilotHold> holds;  ///< holds from earlier sessions: answered before anything is presented
    double adaptation = 0;         ///< goes into the record; the virtual participant applies it

    /// The modality through which the participant feels it, as the record names it.
    [[nodiscard]] std::string_view modality() const noexcept {
        return nameOf(unit == LevelUnit::Intensity ? Modality::Massager : Modality::Electrodes);
    }
};

/// One condition as this participant gets it: level x of the way from `min` to `max`, interval y of the way from T_max
/// to T_min, where x and y are the condition's texture and pressure, or pressure and texture when swapped.
struct PresentedCondition {
    std::string name;
    double level = 0;  ///< on the device's grid, in the settings' unit
    Seconds interval{0};
};
/// `step` of the device's grid; levels between are rounded to it. Conditions at 0 and 1 are `min` and `max` exactly.
[[nodiscard]] std::vector<PresentedCondition> presentedConditions(const PilotSettings& settings, double min, double max,
                                                                  double step);

}  // namespace tacto
