// ProcedureWords.h - what an approval covers of the procedure, in words, for people who read a report or a terminal.
//
// Thread-safety: pure functions.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "core/study/StudySettings.h"

namespace tacto {

struct ProcedureFact {
    std::string what;   ///< "Train"
    std::string words;  ///< "biphasic, 1 pulse of 200 µs a phase"
};
/// Site, electrodes and train (not with a massager), intervals, conditions, detection and test, as approved. Where the
/// approval keeps no procedure, that is said in the place of intervals, conditions and detection.
[[nodiscard]] std::vector<ProcedureFact> approvedProcedure(const StudySettings& settings);

/// What a key of study.json that an amendment changed is called; the key itself where it has no other name, and with a
/// massager where it is about current.
[[nodiscard]] std::string amendedWords(std::string_view key, Modality modality);

}  // namespace tacto
