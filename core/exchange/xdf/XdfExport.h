// XdfExport.h - an XDF 1.0 file: a stream each, every sample with its own stamp as double64, one clock; trains as
// numbers, events as markers, records as JSON.
//
// Thread-safety: pure functions.
#pragma once

#include "core/exchange/Export.h"

namespace tacto {

[[nodiscard]] const ExportFormat& xdfExport();

}  // namespace tacto
