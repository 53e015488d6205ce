// PilotSettings.h - the settings of one pilot session: its participant, study and seed, how its conditions are made,
// and the events that hold it.
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
#include "core/pilot/ParticipantWords.h"
#include "core/study/Participant.h"
#include "core/study/StudySettings.h"

namespace tacto {

class Study;

// Some events hold a session until the operator has answered for them by name (pilot.md section 4): a level that was
// too strong, pain at or above the study's ceiling, an adverse event that is serious or was not reported.

/// Name of the question to the operator about such an event.
inline constexpr const char* kHoldPrompt = "answer-by-name";

struct PilotHold {
    std::string name;  ///< the name in the row; each name is answered once
    std::string said;  ///< what happened, as one sentence without its full stop
};

/// The hold after the participant called the level of `trial` too strong.
[[nodiscard]] PilotHold tooStrongHold(std::string_view trial);
/// Returns nothing if the row "rating" is not about pain, or its pain lies below `ceiling`.
[[nodiscard]] std::optional<PilotHold> painHold(const nlohmann::json& rating, int ceiling);
/// Returns all holds without an answer, from each session of the participant (also resumed sessions) and from events of
/// the whole study. A session of the participant whose record is missing or does not open holds too, because it may
/// have ended with pain. Answers by the program in a virtual participant's session count only for virtual participants.
[[nodiscard]] std::vector<PilotHold> openHolds(const Study& study, const Participant& who);

struct PilotSettings {
    std::string code;  ///< the participant's code
    SessionBasis basis = SessionBasis::Person;
    int session = 1;         ///< number of this session among the participant's sessions
    std::uint64_t seed = 1;  ///< seed for order, plan and pauses; a resumed session uses the seed of its plan
    std::string encoding = "standard";
    std::string earlierEncoding;  ///< another encoding from an earlier complete session; empty: none
    LevelUnit unit = LevelUnit::Current;
    double cap = 15;        ///< highest level of the study, in `unit`
    Seconds shortest{0.5};  ///< T_min
    Seconds longest{2};     ///< T_max
    Seconds window{4};      ///< length of a presentation's window, 2 T_max
    Assignment assignment = Assignment::TextureToAmplitude;
    std::vector<Condition> conditions = EncodingProfile::fourConditions(0, 1);
    std::vector<std::string> answers;  ///< the conditions in the order of the answer places; empty: kAnswerPlaces
    int blocks = 5;
    int perCondition = 4;                                  ///< presentations of each condition in a block
    int catchTrials = 2;                                   ///< number in a block
    ParticipantWords words = ParticipantWords::english();  ///< what the participant reads
    std::string runSha256;  ///< hash of the protocol and its inputs (runHash()); a resume must have the same hash
    int painCeiling = kPainCeiling;
    std::vector<PilotHold> holds;  ///< holds from earlier sessions; must be answered before anything is presented
    double adaptation = 0;         ///< goes into the record; only a virtual participant uses it

    /// How this participant is stimulated, as the record names it.
    [[nodiscard]] std::string_view modality() const noexcept {
        return nameOf(unit == LevelUnit::Intensity ? Modality::Massager : Modality::Electrodes);
    }
};

/// One condition as this participant gets it. Its level lies at x on the way from `min` to `max`, its interval at y on
/// the way from T_max to T_min; x and y are the condition's texture and pressure, or pressure and texture when swapped.
struct PresentedCondition {
    std::string name;
    double level = 0;  ///< on the device's grid, in the unit of the settings
    Seconds interval{0};
};
/// `step`: of the device's grid; levels are rounded to the grid. The values 0 and 1 give `min` and `max` exactly.
[[nodiscard]] std::vector<PresentedCondition> presentedConditions(const PilotSettings& settings, double min, double max,
                                                                  double step);

}  // namespace tacto
