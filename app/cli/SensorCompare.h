// SensorCompare.h - sensor compare: the bench's chain and the board's own encoder on the same samples
// (app/run/EncoderComparison.h), with a verdict.
#pragma once

#include <QCommandLineParser>

namespace tacto::cli {

/// Compares on the recording or device that the second word names. Returns the exit code: a verdict's, or a refusal's.
[[nodiscard]] int compareSensor(const QCommandLineParser& parser, double seconds);

}  // namespace tacto::cli
