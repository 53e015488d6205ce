// EdfFile.h - reads EDF(+C) and BDF(+C) files, through EDFlib.
//
// Signals of one rate are one stream; sample k has the stamp k / rate. In our own files the lowest digital value means
// absent: such a value is NaN, and a sample without any value of its kind is a gap (SignalStreams.h).
//
// Thread-safety: reads one file at a time, whichever thread asks.
#pragma once

#include <filesystem>

#include "core/acquisition/SignalFile.h"

namespace tacto {

/// Whether `head`, a file's first 256 bytes or more, begins as EDF and BDF files do.
[[nodiscard]] bool beginsAsEdf(std::string_view head);

/// Errors: NotFound, Io; ParseError naming what stands against the format: a discontinuous file (EDF+D), a physical
/// range of nothing, sizes that the file does not have.
[[nodiscard]] Result<SignalFile> readEdf(const std::filesystem::path& path);

}  // namespace tacto
