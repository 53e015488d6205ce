// Chain.h - one row of the log and the hash that ties it to all rows before it.
//
// hash = SHA-256 over the previous row's hash (32 bytes; zeros before the first row) followed by the text
//   seq \n t_ns \n kind \n <bytes of name>:name \n <bytes of body>:body \n digest in hexadecimal, or - \n
// so that anyone can recompute it without this program.
//
// Thread-safety: pure functions.
#pragma once

#include <cstdint>
#include <optional>
#include <string_view>

#include "core/session/Digest.h"

namespace tacto {

struct Entry {
    std::int64_t seq = 0;
    std::string_view kind;
    std::int64_t t_ns = 0;
    std::string_view name;
    std::string_view body;         ///< JSON
    std::optional<Digest> digest;  ///< digest of the chunk or capture that belongs to the row
};

[[nodiscard]] Digest chainHash(const Digest& previous, const Entry& entry);

}  // namespace tacto
