// Marks.h - what every result of a session must be read with: where it comes from, whether the stimulator and R are
// calibrated, the flags of the recording, the known limit of R (science.md section 12).
//
// The bench writes them when it closes. A session without them, of an older program or interrupted, says that they are
// not known: it never reads as one that has none (hazard H9).
//
// Thread-safety: pure functions.
#pragma once

#include <string>
#include <vector>

#include "core/base/Result.h"

namespace tacto {

class SessionReader;

/// The mark that a run has whose readings make a calibration.
inline constexpr const char* kNotCalibratedBefore = "Before this run the stimulator was not calibrated.";

/// Sentences, and the flags as science.md names them ("uncalibrated R"). Errors: as SessionReader::events() and
/// commands().
[[nodiscard]] Result<std::vector<std::string>> sessionMarks(const SessionReader& session);

}  // namespace tacto
