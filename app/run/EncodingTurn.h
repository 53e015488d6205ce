// EncodingTurn.h - chooses the study's encoding for a session. Participants of one kind have the encodings in balanced
// orders (williamsOrder()), one per session; an encoding is repeated if its session was incomplete.
//
// Thread-safety: as Study.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "core/study/Study.h"

namespace tacto {

struct EncodingTurn {
    std::string encoding = "standard";
    std::string earlier;  ///< another encoding that the participant had in a complete session with tests; empty: none
};

/// `continued`: the session to resume; it keeps the encoding with which it began.
[[nodiscard]] EncodingTurn encodingTurn(const Study& study, const Participant& who,
                                        const std::optional<StudySession>& continued);

/// Returns the places of the four answers, the same for a participant in all sessions, drawn from the study's secret.
/// Among kAnswerWays people (or virtual participants) enrolled in succession, each arrangement occurs once.
[[nodiscard]] std::vector<std::string> answersOf(const Study& study, const Participant& who);

}  // namespace tacto
