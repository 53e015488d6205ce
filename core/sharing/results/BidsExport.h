// BidsExport.h - a study's results to a BIDS dataset, and the note of it in the ledger.
//
// Thread-safety: as Study.
#pragma once

#include <filesystem>
#include <string_view>

#include "core/sharing/BidsFiles.h"
#include "core/study/Study.h"

namespace tacto {

/// `out` is new or empty and lies outside the study. Noted first: no export is without its note, and a place inside the
/// study is refused before anything is there.
/// Errors: as readStudyRecord(), bidsFiles(), Study::exported() and writeBids().
[[nodiscard]] Result<void> exportBids(Study& study, const BidsWith& with, const std::filesystem::path& out,
                                      std::string_view version);

}  // namespace tacto
