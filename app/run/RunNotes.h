// RunNotes.h - a report's notes in addition to measurements: who made them, on which sample, who checks them, and the
// ambient conditions. They are printed as entered; nothing here is measured or used for a judgement.
//
// Thread-safety: pure functions; keepNotes() as SessionWriter.
#pragma once

#include <string>

#include "core/base/Result.h"
#include "core/session/SessionWriter.h"

namespace tacto {

/// Each note is one line of at most kNoteLimit characters (Unicode code points); empty: not recorded.
struct RunNotes {
    std::string operatorName;
    std::string sample;  ///< the measured sample, by the laboratory's own id
    std::string reviewer;
    std::string ambient;  ///< "22.5 °C, 45 % RH"
};

inline constexpr std::size_t kNoteLimit = 200;

/// Errors: InvalidArgument for a text that is too long, is not UTF-8 or contains a control character.
[[nodiscard]] Result<void> checkNotes(const RunNotes& notes);
/// Writes the notes for the session's report, unless all are empty. Errors: as SessionWriter::reportItem().
[[nodiscard]] Result<void> keepNotes(const RunNotes& notes, SessionWriter& session, Instant at);

}  // namespace tacto
