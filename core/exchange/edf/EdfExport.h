// EdfExport.h - an EDF+C or BDF+C file: the streams on a common grid in 16 or 24 bits, what happened as annotations.
//
// The file is what EDFlib reads and would write, within its limits (one annotation of 40 bytes for a record and
// annotation signal); it is written here, since EDFlib needs the samples of all streams at once.
//
// Thread-safety: pure functions.
#pragma once

#include "core/exchange/Export.h"

namespace tacto {

[[nodiscard]] const ExportFormat& edfExport();
[[nodiscard]] const ExportFormat& bdfExport();

}  // namespace tacto
