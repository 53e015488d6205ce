// CaptureOptions.h - what the command line says about a capture file better than the file does, and reading it.
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

/// Reads with every format that the programs know. On a terminal a bar on stderr shows what takes over a second.
/// Errors: of CaptureFormats::read().
[[nodiscard]] Result<CaptureReading> readCaptureFile(const std::string& path, const ReadOptions& options);

// The profile that a command is run with.

/// The profile of --profile, else the shipped one. Errors: as loadProfile().
[[nodiscard]] Result<Profile> profileOption(const QCommandLineParser& parser);

}  // namespace tacto::cli
