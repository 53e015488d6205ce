// Gunzip.h - unpacks gzip (RFC 1952), also several members in a row, in bounded memory.
//
// What would be too large is found while nothing of it is kept: the content is unpacked twice, once to count it.
//
// Thread-safety: pure functions.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>

#include "core/base/Result.h"

namespace tacto {

[[nodiscard]] bool isGzip(std::string_view content) noexcept;

/// Whether gzip whose first bytes are `head` holds something that begins with `wanted` (at most 64 bytes).
[[nodiscard]] bool gzipHolds(std::string_view head, std::string_view wanted) noexcept;

struct Unpacked {
    std::string content;
    bool cut = false;  ///< the gzip ends before its content does; what came before is there
};

/// Errors: LimitExceeded for more than `most` bytes unpacked; ParseError for what is damaged, or followed by something
/// that is not gzip. The message goes on behind the name of a file: "holds more than ...".
[[nodiscard]] Result<Unpacked> gunzip(std::string_view packed, std::uint64_t most);

}  // namespace tacto
