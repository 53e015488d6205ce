// RunNotes.h - what a report says about a run beside what was measured: who did it, of what, who checks it, and the
// ambient conditions. As they were entered; nothing here is measured, and nothing is judged by it.
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

/// Errors: InvalidArgument for a text that is too long, is not UTF-8 or holds a control character.
[[nodiscard]] Result<void> checkNotes(const RunNotes& notes);
/// Writes them for the session's report; nothing where all are empty. Errors: as SessionWriter::reportItem().
[[nodiscard]] Result<void> keepNotes(const RunNotes& notes, SessionWriter& session, Instant at);

}  // namespace tacto
