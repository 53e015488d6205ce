// SrWriter.h - writes a capture as a .sr file through libsigrok.
//
// Thread-safety: pure functions on files; libsigrok is locked while it writes.
#pragma once

#include <filesystem>

#include "core/base/Result.h"
#include "core/measure/Capture.h"

namespace tacto::sigrok_driver {

/// Replaces the file at `path` only once everything is written. Errors: InvalidArgument for a rate that is not a whole
/// number of Hz (relative tolerance 1e-6), or for too many samples; Io with libsigrok's message.
[[nodiscard]] Result<void> writeSr(const std::filesystem::path& path, const Capture& capture);

}  // namespace tacto::sigrok_driver
