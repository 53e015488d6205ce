// SrReader.h - reads the samples of a .sr file through libsigrok, and checks them against the archive's checksums.
//
// Thread-safety: pure functions on files; libsigrok is locked while it reads.
#pragma once

#include <string>

#include "core/formats/CaptureFormat.h"
#include "drivers/sigrok/session_file/SrLayout.h"

namespace tacto::sigrok_driver {

/// Reads the samples of `file`, which has the layout `layout`. Cuts channels of unequal length to the shortest, with a
/// warning. The sampling rate is 0 if the file states none. Errors: ParseError for damaged or missing samples and with
/// libsigrok's message; those of `watch`.
[[nodiscard]] Result<CaptureReading> readSr(const SrLayout& layout, const ReadWatch& watch, const std::string& file);

}  // namespace tacto::sigrok_driver
