// StudyOptions.h - reads the options of `study`: a new study, an amendment, a participant, an adverse event, the day
// after a session.
//
// Errors of all functions: InvalidArgument naming the option, its value and what is accepted.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>

#include "app/cli/Command.h"
#include "core/study/Study.h"

namespace tacto::cli {

void declareStudyOptions(QCommandLineParser& parser);

/// Returns the trimmed value; empty if the option was not given.
[[nodiscard]] std::string given(const QCommandLineParser& parser, const char* name);
[[nodiscard]] Result<CalibrationDate> dateGiven(const QCommandLineParser& parser, const char* name);

/// Returns the settings, with the limit sets and pilot scripts of this program.
[[nodiscard]] Result<StudySettings> settingsGiven(const QCommandLineParser& parser);
/// Returns `settings` as changed by the options, with this program's limit sets and pilot scripts.
[[nodiscard]] Result<StudySettings> settingsAmended(const QCommandLineParser& parser, StudySettings settings);
[[nodiscard]] Result<NextDay> nextDayGiven(const QCommandLineParser& parser);
/// Returns a new participant; `virtual` is not read. The study checks it. Errors: InvalidArgument for another group.
[[nodiscard]] Result<Participant> participantGiven(const QCommandLineParser& parser);
[[nodiscard]] Result<AdverseEvent> adverseEventGiven(const QCommandLineParser& parser);
/// Returns the note of that kind with the fields that --set gives.
[[nodiscard]] Result<StudyNote> noteGiven(const QCommandLineParser& parser, const std::string& kind);

// A study as `study` prints it: JSON (cli.md), and lines for people.

[[nodiscard]] nlohmann::json participantJson(const Participant& participant);
[[nodiscard]] nlohmann::json noteJson(const StudyNote& note);
[[nodiscard]] nlohmann::json amendmentJson(const StudyAmendment& amendment);
[[nodiscard]] nlohmann::json studyJson(const Study& study);

/// Returns the changes of an amendment in words.
[[nodiscard]] std::string changesText(const StudyAmendment& amendment, Modality modality);
/// Prints the whole study; sealed values appear as "(sealed)".
void sayStudy(const Study& study);

}  // namespace tacto::cli
