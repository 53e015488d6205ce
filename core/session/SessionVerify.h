// SessionVerify.h - is this session file what was recorded? (hazard H8, `tactoscope-cli verify`)
//
// Looks at every page, row, checksum and hash. An altered row breaks the chain; a file whose chain was recomputed
// is consistent in itself and is found by its head, which differs from the one printed in the report.
//
// Thread-safety: pure function of the file, which it never changes.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "core/base/Result.h"

namespace tacto {

enum class SessionStatus { Intact, Damaged, NotASession };
[[nodiscard]] std::string_view nameOf(SessionStatus status) noexcept;  // "intact", "damaged", "not a session"

struct VerifyReport {
    SessionStatus status = SessionStatus::NotASession;
    bool closed = false;                ///< the session was ended in order
    bool recovered = false;             ///< rows were taken from a journal that a crash left behind
    std::vector<std::string> notes;     ///< sentences: not closed, recovered from the journal, annotated
    std::vector<std::string> problems;  ///< sentences; empty when intact
    std::string head;  ///< hash of the recording's last row, 64 hexadecimal digits; empty when not a session
    std::uint64_t rows = 0;
    std::uint64_t events = 0;
    std::uint64_t trials = 0;
    std::uint64_t captures = 0;
    std::uint64_t verdicts = 0;
    std::uint64_t chunks = 0;
    std::uint64_t samples = 0;
};

/// Errors: NotFound; Io when the file cannot be read. Anything readable gets a report.
[[nodiscard]] Result<VerifyReport> verifySession(const std::filesystem::path& path);

}  // namespace tacto
