// RowSeal.h - how a session keeps what its rows say from readers without a key.
//
// SessionWriter and SessionReader are given one; without it a session is stored as it always was. What a sealed row
// still shows is decided in core/session/SealedRow.h: its number, its kind, its time to the whole second, and what a
// safety reviewer reads (devices, limit sets, interlock, faults, stops, refusals). The hash chain runs over what is
// stored, so verifySession() needs no key.
//
// An implementation binds each seal to its row: what was sealed as row 7 does not open as row 8, nor in another
// session, nor as another kind (core/study/StudyKeys.h).
//
// Thread-safety: any thread; implementations have no state that changes.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "core/base/Result.h"

namespace tacto {

class RowSeal {
public:
    RowSeal() = default;
    virtual ~RowSeal() = default;
    RowSeal(const RowSeal&) = delete;
    RowSeal& operator=(const RowSeal&) = delete;

    /// The sealed text as printable characters without quotes or escapes: it stands in a JSON string. The same text
    /// sealed twice gives two seals. Its length reveals the length of `text` only to a block.
    [[nodiscard]] virtual std::string sealText(std::int64_t seq, std::string_view kind,
                                               std::string_view text) const = 0;
    /// Errors: ParseError for what this seal did not make for this row: altered, moved, or of another key.
    [[nodiscard]] virtual Result<std::string> openText(std::int64_t seq, std::string_view kind,
                                                       std::string_view sealed) const = 0;

    /// Seals the bytes of a chunk or capture: `parts` one after the other.
    [[nodiscard]] virtual std::vector<std::byte> sealBytes(std::int64_t seq, std::string_view kind,
                                                           std::span<const std::span<const std::byte>> parts) const = 0;
    [[nodiscard]] virtual Result<std::vector<std::byte>> openBytes(std::int64_t seq, std::string_view kind,
                                                                   std::span<const std::byte> sealed) const = 0;
};

}  // namespace tacto
