// RowSeal.h - hides the contents of a session's rows from readers without a key.
//
// SessionWriter and SessionReader take a RowSeal; without a RowSeal a session is stored in the clear. SealedRow.h
// defines what a sealed row still shows: its number, its kind, its time in whole seconds, and what a safety reviewer
// must read (devices, limit sets, interlock, faults, stops, refusals). The hash chain covers the stored form, so
// verifySession() needs no key.
//
// Each seal is bound to its row: what was sealed as row 7 does not open as row 8, in another session, or as another
// kind of row (core/study/StudyKeys.h).
//
// Thread-safety: any thread; implementations do not change any state.
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

    /// Returns the sealed text in printable characters without quotes or escapes, ready for a JSON string. The same
    /// text sealed twice gives two different seals. A seal shows the length of `text` only in whole blocks.
    [[nodiscard]] virtual std::string sealText(std::int64_t seq, std::string_view kind,
                                               std::string_view text) const = 0;
    /// Errors: ParseError if this seal did not make `sealed` for this row: it was altered, moved, or has another key.
    [[nodiscard]] virtual Result<std::string> openText(std::int64_t seq, std::string_view kind,
                                                       std::string_view sealed) const = 0;

    /// Seals the bytes of a chunk or capture, which are `parts` joined together.
    [[nodiscard]] virtual std::vector<std::byte> sealBytes(std::int64_t seq, std::string_view kind,
                                                           std::span<const std::span<const std::byte>> parts) const = 0;
    [[nodiscard]] virtual Result<std::vector<std::byte>> openBytes(std::int64_t seq, std::string_view kind,
                                                                   std::span<const std::byte> sealed) const = 0;
};

}  // namespace tacto
