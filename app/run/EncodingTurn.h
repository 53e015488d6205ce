// EncodingTurn.h - the encoding of a study that a participant's session has. Each participant has them in an order of
// their own among their kind (williamsOrder()), one a session; an encoding whose session was not completed comes again.
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

/// `continued`: the session that is resumed, with the encoding that it began with.
[[nodiscard]] EncodingTurn encodingTurn(const Study& study, const Participant& who,
                                        const std::optional<StudySession>& continued);

/// The four answers at their places: one way for a participant in all sessions, drawn from the study's secret, and each
/// of the kAnswerWays once among as many people, or virtual participants, who are enrolled one after the other.
[[nodiscard]] std::vector<std::string> answersOf(const Study& study, const Participant& who);

}  // namespace tacto
