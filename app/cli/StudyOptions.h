// StudyOptions.h - what the options of `study` say: a new study, an amendment, a participant, an adverse
// event, the day after a session.
//
// Errors of all: InvalidArgument naming the option, its value and what is accepted.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>

#include "app/cli/Command.h"
#include "core/study/Study.h"

namespace tacto::cli {

void declareStudyOptions(QCommandLineParser& parser);

/// Trimmed; empty where it was not given.
[[nodiscard]] std::string given(const QCommandLineParser& parser, const char* name);
[[nodiscard]] Result<CalibrationDate> dateGiven(const QCommandLineParser& parser, const char* name);

/// The settings, with the limit sets and pilot scripts of this program.
[[nodiscard]] Result<StudySettings> settingsGiven(const QCommandLineParser& parser);
/// `settings` with what the options change, and this program's limit sets and pilot scripts.
[[nodiscard]] Result<StudySettings> settingsAmended(const QCommandLineParser& parser, StudySettings settings);
[[nodiscard]] Result<NextDay> nextDayGiven(const QCommandLineParser& parser);
/// A new participant, without what `virtual` says. The study checks it. Errors: InvalidArgument for another group.
[[nodiscard]] Result<Participant> participantGiven(const QCommandLineParser& parser);
[[nodiscard]] Result<AdverseEvent> adverseEventGiven(const QCommandLineParser& parser);

// A study as `study` shows it: JSON (cli.md), and lines for people.

[[nodiscard]] nlohmann::json participantJson(const Participant& participant);
[[nodiscard]] nlohmann::json amendmentJson(const StudyAmendment& amendment);
[[nodiscard]] nlohmann::json studyJson(const Study& study);

/// The changes of an amendment, in words.
[[nodiscard]] std::string changesText(const StudyAmendment& amendment, Modality modality);
/// Prints all of it; what is sealed, as "(sealed)".
void sayStudy(const Study& study);

}  // namespace tacto::cli
