// WalScan.h - looks for damage in the journal (*-wal) that a killed session left behind.
//
// SQLite reads a journal up to the first frame whose checksum is wrong and silently ignores the rest, since a crash
// leaves exactly that: an unfinished last transaction. But every acknowledged commit was synced before the next one
// began, so frames of a further transaction beyond the bad one cannot come from a crash. They are lost evidence.
//
// Thread-safety: pure function of the file, which it only reads. Format: sqlite.org/walformat.html.
#pragma once

#include <cstdint>
#include <filesystem>

#include "core/base/Result.h"

namespace tacto {

struct WalFindings {
    std::uint64_t readableFrames = 0;
    bool headerDamaged = false;     ///< there are frames, and what says how to read them is not valid
    std::uint64_t lostCommits = 0;  ///< commits behind the first bad frame, without the unfinished last transaction
};

/// Errors: Io.
[[nodiscard]] Result<WalFindings> scanWal(const std::filesystem::path& wal);

}  // namespace tacto
