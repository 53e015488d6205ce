// LedgerEnd.h - the end of a study's ledger, as noted by this computer next to the study's keys, in the key file and in
// each session. This reveals a ledger that was cut short or recomputed, or that is an older copy: such a ledger is
// consistent in itself (hazards H8, H11).
//
// A note may be out of date (another computer's, or a key file restored from a copy) and then refuses nothing: the
// newest note counts. Someone who can write all of the notes can make them agree.
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

/// The event of a session that records where the ledger ended when the part was begun: {row, head}.
inline constexpr const char* kLedgerEvent = "ledger";

struct LedgerEnd {
    std::int64_t row = 0;           ///< number of the last row; 0: not known
    std::string head;               ///< the last row's hash, 64 hexadecimal digits
    std::chrono::sys_seconds at{};  ///< when the last row was written; 1970 if not known
    std::vector<std::string> rows;  ///< names of all events up to the last row, in order; empty if not known
};

/// Replaces the note in `file`, which only its owner may access. If it cannot be written, the old note stays.
void noteLedgerEnd(const std::filesystem::path& file, const LedgerEnd& end);
/// Returns nothing if there is no such file. Errors: kGateRefused for a file that does not hold a note.
[[nodiscard]] Result<std::optional<LedgerEnd>> notedLedgerEnd(const std::filesystem::path& file);
/// Returns where the ledger ended when a session's file began; nothing if the file does not say.
[[nodiscard]] std::optional<LedgerEnd> ledgerEndOf(const std::filesystem::path& session);
/// Whether the ledger contains the row in `end`.
[[nodiscard]] bool reaches(const SessionReader& ledger, const LedgerEnd& end);

}  // namespace tacto
