// BidsExport.h - a session as a BIDS 1.11.1 dataset (https://bids-specification.readthedocs.io): trials as behaviour,
// trains and events as events, streams as recordings of physiology, and what was put out as NIBS-BIDS proposes it.
//
// Every column is described in a sidecar, which also says whether the data are simulated. The validator of BIDS finds
// no error.
//
// Thread-safety: pure functions.
#pragma once

#include "core/exchange/Export.h"

namespace tacto {

[[nodiscard]] const ExportFormat& bidsExport();

}  // namespace tacto
