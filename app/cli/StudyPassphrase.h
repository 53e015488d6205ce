// StudyPassphrase.h - how a command gets the passphrase of a study: --passphrase-file, or typed where there is a
// terminal. There is no option that takes it as a word: the command line is shown to everyone on the computer.
#pragma once

#include <filesystem>
#include <optional>

#include "app/cli/Command.h"
#include "core/seal/Passphrase.h"
#include "core/study/Study.h"

namespace tacto::cli {

/// Declares --passphrase-file.
void declarePassphrase(QCommandLineParser& parser);

/// Errors: NotFound where there is neither, or the file lies inside the study.
[[nodiscard]] Result<Passphrase> passphraseFor(const QCommandLineParser& parser, const std::filesystem::path& study);

/// The study in `folder`. A rehearsal needs no passphrase; with Access::Read it is opened without one, too, where none
/// was given. Errors: as Study::open() and passphraseFor().
[[nodiscard]] Result<Study> openStudy(const QCommandLineParser& parser, const std::filesystem::path& folder,
                                      Study::Access access);

}  // namespace tacto::cli
