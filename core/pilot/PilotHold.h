// PilotHold.h - what holds a session until the operator has answered it by name (pilot.md section 4): a level that was
// too strong, pain at or above the study's ceiling, an adverse event that is serious or was not reported.
//
// Thread-safety: values; pure functions but for reading a study.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace tacto {

class Study;
struct Participant;

/// Name of the question that the operator answers.
inline constexpr const char* kHoldPrompt = "answer-by-name";

struct PilotHold {
    std::string name;  ///< of its row: one answer is enough
    std::string said;  ///< what happened: one sentence without its full stop
};

/// The participant called the level of `trial` too strong.
[[nodiscard]] PilotHold tooStrongHold(std::string_view trial);
/// Nothing where the row "rating" is about something else, or lies below `ceiling`.
[[nodiscard]] std::optional<PilotHold> painHold(const nlohmann::json& rating, int ceiling);
/// What is unanswered: of each session of the participant, one that goes on among them, and of events in the
/// whole study. A session of theirs whose record is gone or does not open holds too: it may have ended with pain. What
/// the program answered in a virtual participant's session counts for virtual participants alone.
[[nodiscard]] std::vector<PilotHold> openHolds(const Study& study, const Participant& who);

}  // namespace tacto
