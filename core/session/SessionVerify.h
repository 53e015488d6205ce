// SessionVerify.h - checks that a session file is what was recorded (hazard H8, `tactoscope-cli verify`).
//
// Checks every page, row, checksum and hash. An altered row breaks the hash chain. If someone recomputed the whole
// chain, the file is consistent in itself, but its head differs from the head printed in the report.
//
// Thread-safety: a pure function of the file and of the reports signed in it, which stay unchanged.
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <string>
#include <string_view>
#include <vector>

#include "core/base/Result.h"
#include "core/session/SessionSignature.h"

namespace tacto {

enum class SessionStatus { Intact, Damaged, NotASession };
[[nodiscard]] std::string_view nameOf(SessionStatus status) noexcept;  // "intact", "damaged", "not a session"

struct VerifyReport {
    SessionStatus status = SessionStatus::NotASession;
    bool closed = false;                       ///< the session was ended in order
    bool recovered = false;                    ///< some rows come from a journal that a crash left behind
    std::vector<std::string> notes;            ///< sentences: not closed, recovered from the journal, annotated, signed
    std::vector<std::string> problems;         ///< sentences; empty if the session is intact
    std::vector<CheckedSignature> signatures;  ///< of its reports; a changed report does not damage the session
    std::string head;  ///< hash of the recording's last row, 64 hexadecimal digits; empty if not a session
    std::uint64_t rows = 0;
    std::uint64_t events = 0;
    std::uint64_t trials = 0;
    std::uint64_t captures = 0;
    std::uint64_t verdicts = 0;
    std::uint64_t chunks = 0;
    std::uint64_t samples = 0;
};

/// True if a report was changed after it was signed, and not signed again.
[[nodiscard]] bool reportChanged(const VerifyReport& report);

/// Every readable file gets a report. `stopped` is asked at every row, and while the database is checked at least every
/// 0.2 s, then by another thread too. Errors: NotFound; Io if the file cannot be read; Stopped.
[[nodiscard]] Result<VerifyReport> verifySession(const std::filesystem::path& path,
                                                 const std::function<bool()>& stopped = {});

}  // namespace tacto
