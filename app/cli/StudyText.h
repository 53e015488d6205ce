// StudyText.h - a study as `study` shows it: JSON (cli.md), and lines for people.
//
// Thread-safety: pure but for what is printed.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>

#include "core/study/Study.h"

namespace tacto::cli {

[[nodiscard]] nlohmann::json participantJson(const Participant& participant);
[[nodiscard]] nlohmann::json amendmentJson(const StudyAmendment& amendment);
[[nodiscard]] nlohmann::json studyJson(const Study& study);

/// What an amendment changed, in words.
[[nodiscard]] std::string changesText(const StudyAmendment& amendment, Modality modality);
/// Prints all of it; what is sealed, as "(sealed)".
void sayStudy(const Study& study);

}  // namespace tacto::cli
