// Mutation.h - makes new inputs from old ones, like a fuzzer without its feedback.
//
// Thread-safety: pure function of its arguments; the same state of `random` gives the same input.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string_view>
#include <vector>

#include "core/base/Random.h"

namespace tacto::fuzz {

using Bytes = std::vector<std::uint8_t>;

/// The longest file of a corpus.
inline constexpr std::size_t kMaxFile = 65'536;

/// Returns a file of `corpus` (not empty, files of at most kMaxFile bytes) after 1 to 8 changes: a bit flipped, a byte
/// replaced, bytes or a word of `dictionary` (may be empty) inserted, bytes deleted, cut off or repeated, or the end of
/// another file appended. Never longer than kMaxFile.
[[nodiscard]] Bytes mutated(const std::vector<Bytes>& corpus, const std::vector<Bytes>& dictionary, Random& random);

/// Parses a dictionary in libFuzzer's format: lines `"word"` or `name="word"`, with \\, \" and \xAB; empty lines and
/// lines that begin with # are skipped. Returns nothing if any line is different.
[[nodiscard]] std::optional<std::vector<Bytes>> dictionaryFrom(std::string_view text);

}  // namespace tacto::fuzz
