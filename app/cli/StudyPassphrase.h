// StudyPassphrase.h - gets the passphrase of a study: from --passphrase-file, or typed at a terminal. No option takes
// the passphrase itself, because everyone on the computer can see the command line.
#pragma once

#include <filesystem>
#include <optional>

#include "app/cli/Command.h"
#include "core/seal/Passphrase.h"
#include "core/study/Study.h"

namespace tacto::cli {

/// Declares --passphrase-file.
void declarePassphrase(QCommandLineParser& parser);

/// Errors: NotFound if there is neither file nor terminal, or if the file is inside the study.
[[nodiscard]] Result<Passphrase> passphraseFor(const QCommandLineParser& parser, const std::filesystem::path& study);

/// Gets a study's next passphrase: from --new-passphrase-file, or typed twice. Errors: as passphraseFor(); NotFound if
/// the two differ.
[[nodiscard]] Result<Passphrase> newPassphraseFor(const QCommandLineParser& parser, const std::filesystem::path& study);

/// Opens the study in `folder`. A rehearsal needs no passphrase, nor does Access::Read if none was given. Errors: as
/// Study::open() and passphraseFor().
[[nodiscard]] Result<Study> openStudy(const QCommandLineParser& parser, const std::filesystem::path& folder,
                                      Study::Access access);

}  // namespace tacto::cli
