// NibsFiles.h - what was put out in a session, in the form of the draft NIBS-BIDS (BEP037): a row for each train, with
// what was commanded, what the device and the oscilloscope measured, and what caused it.
//
// The draft moves, so all that follows it stands in NibsFiles.cpp, with its version. The validator of BIDS does not
// know its folder yet: kNibsIgnored names it.
//
// Thread-safety: as ExportSource.
#pragma once

#include "core/exchange/bids/BidsFolder.h"

namespace tacto {

/// Whether the session has electrical output to describe: not with a massager alone.
[[nodiscard]] bool hasNibsFiles(const ExportSource& source) noexcept;
/// The draft, its version and the commit that was followed.
[[nodiscard]] nlohmann::json nibsVersion();
/// The line of .bidsignore for these files.
inline constexpr const char* kNibsIgnored = "sub-*/nibs\n";

/// The identifier of the `number`-th train of a session, from 1, here and in _events.tsv.
[[nodiscard]] inline std::string bidsEventId(std::uint64_t number) { return fmt::format("train-{}", number); }
/// From a train's onset to the end of its last pulse, or of a burst; NaN where the session does not say.
[[nodiscard]] double outputDuration_s(const ExportTrain& train);

/// Errors: Io; Stopped.
[[nodiscard]] Result<void> writeNibsFiles(const ExportSource& source, const BidsFolder& folder);

}  // namespace tacto
