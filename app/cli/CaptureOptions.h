// CaptureOptions.h - options that state more about a capture file than the file itself does, and reading the file.
#pragma once

#include <QCommandLineParser>
#include <string>

#include "app/cli/Command.h"
#include "core/bench/Profile.h"
#include "core/formats/CaptureFormat.h"

namespace tacto::cli {

/// Declares --format, --skip-rows, --columns, --time-column, --unit, --probe and --sample-rate.
void declareCaptureOptions(QCommandLineParser& parser);

/// Errors: InvalidArgument naming the option, its text and what was expected.
[[nodiscard]] Result<ReadOptions> captureOptions(const QCommandLineParser& parser);

/// Reads a file in any known format. On a terminal, a bar on stderr shows the progress after one second.
/// Errors: those of CaptureFormats::read().
[[nodiscard]] Result<CaptureReading> readCaptureFile(const std::string& path, const ReadOptions& options);

// The profile that a command uses.

/// Returns the profile of --profile, else the shipped profile. Errors: as loadProfile().
[[nodiscard]] Result<Profile> profileOption(const QCommandLineParser& parser);

}  // namespace tacto::cli
