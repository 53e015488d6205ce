// StudyWords.h - the words that a study's participants can read: those in the study's folder words/, in the folder
// words/ of the resources, and built in; the first of a language counts.
//
// Thread-safety: reads files; any thread.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "core/pilot/ParticipantWords.h"
#include "core/study/StudySettings.h"

namespace tacto {

/// `study`: the study's folder; empty if there is none. Errors: as ParticipantWords::in().
[[nodiscard]] Result<std::vector<ParticipantWords>> languagesOf(const std::filesystem::path& study);
/// Returns the words of a language. Errors: NotFound naming the language and those that there are; as languagesOf().
[[nodiscard]] Result<ParticipantWords> languageOf(const std::filesystem::path& study, std::string_view code);
/// A study whose approval states words shows no others. Errors: kGateRefused naming the words and the approved ones.
[[nodiscard]] Result<void> wordsGate(const StudySettings& settings, const ParticipantWords& words);

}  // namespace tacto
