// LedgerEnd.h - how far a study's ledger goes, noted beside its keys: a ledger that was cut short, an older copy of it,
// or one whose chain was recomputed is whole in itself and is found by this.
//
// A note that is missing or that lags behind (the study was made before there was one, or changed on another computer)
// refuses nothing. Someone who can write both can make them agree.
//
// Thread-safety: one caller at a time, who holds the study's lock.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>

#include "core/base/Result.h"

namespace tacto {

class SessionReader;

struct LedgerEnd {
    std::int64_t row = 0;  ///< number of the last one
    std::string head;      ///< its hash, 64 hexadecimal digits
};

/// Takes the place of what `file` said. Where it cannot be written, what it said stays.
void noteLedgerEnd(const std::filesystem::path& file, const LedgerEnd& end);
/// Whether the ledger has the row that was noted. Errors: kGateRefused naming it, or a note that cannot be read.
[[nodiscard]] Result<void> reachesEnd(const SessionReader& ledger, const std::filesystem::path& file);

}  // namespace tacto
