// PhysioFiles.h - a session's streams as BIDS's recordings of physiology: a gzipped table without a heading on a
// regular grid of its own, beginning at the stream's first stamp, and its sidecar.
//
// A place on the grid without a sample holds n/a; the counts of ExportedStream say what did not fit.
//
// Thread-safety: as ExportSource.
#pragma once

#include "core/exchange/Export.h"
#include "core/exchange/bids/BidsFolder.h"

namespace tacto {

/// Writes every stream that is sampled regularly; names the others in the report. Errors: Io; Stopped.
[[nodiscard]] Result<void> writePhysioFiles(const ExportSource& source, const BidsFolder& folder, ExportReport& report);

}  // namespace tacto
