// LedgerEnd.h - how far a study's ledger goes, as far as this computer knows: noted beside its keys, in the key file
// and in each session. A ledger that was cut short, an older copy of it, or one whose chain was recomputed is whole in
// itself and is found by this (hazards H8, H11).
//
// A note that lags behind (another computer's, or a key file put back from a copy) refuses nothing: the newest of all
// counts. Someone who can write each of them can make them agree.
//
// Thread-safety: one caller at a time, who holds the study's lock.
#pragma once

#include <chrono>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "core/base/Result.h"

namespace tacto {

class SessionReader;

/// A session's event that states where the ledger ended when the part was begun: {row, head}.
inline constexpr const char* kLedgerEvent = "ledger";

struct LedgerEnd {
    std::int64_t row = 0;           ///< number of the last one; 0: not known
    std::string head;               ///< the newest row's hash, 64 hexadecimal digits
    std::chrono::sys_seconds at{};  ///< when it was written; 1970 where that is not known
    std::vector<std::string> rows;  ///< the name of each event up to it, in order; empty where they are not known
};

/// Takes the place of what `file` said; the file is its owner's alone. Where it cannot be written, what it said stays.
void noteLedgerEnd(const std::filesystem::path& file, const LedgerEnd& end);
/// Nothing where no such file exists. Errors: kGateRefused for a file that does not say it.
[[nodiscard]] Result<std::optional<LedgerEnd>> notedLedgerEnd(const std::filesystem::path& file);
/// Where the ledger ended when a session's file began; nothing where the file does not say it.
[[nodiscard]] std::optional<LedgerEnd> ledgerEndOf(const std::filesystem::path& session);
/// Whether the ledger has that row.
[[nodiscard]] bool reaches(const SessionReader& ledger, const LedgerEnd& end);

}  // namespace tacto
