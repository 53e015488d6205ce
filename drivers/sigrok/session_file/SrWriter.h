// SrWriter.h - writes a capture as a .sr file through libsigrok.
//
// Thread-safety: pure functions on files; libsigrok is locked while it writes.
#pragma once

#include <filesystem>

#include "core/base/Result.h"
#include "core/measure/Capture.h"

namespace tacto::sigrok_driver {

/// Replaces the file at `path` only once all of it is written. Errors: InvalidArgument for a rate that is not a whole
/// number of Hz (to a millionth of itself), or for too many samples; Io with what libsigrok says.
[[nodiscard]] Result<void> writeSr(const std::filesystem::path& path, const Capture& capture);

}  // namespace tacto::sigrok_driver
