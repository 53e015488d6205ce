// Mutation.h - new inputs made of old ones: what a fuzzer does, without its feedback.
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

/// One of `corpus` (not empty, files of kMaxFile bytes at most) after 1 to 8 changes: a bit flipped, a byte replaced,
/// bytes or a word of `dictionary` (may be empty) inserted, bytes deleted, cut off or repeated, or the end of another.
/// Never longer than kMaxFile.
[[nodiscard]] Bytes mutated(const std::vector<Bytes>& corpus, const std::vector<Bytes>& dictionary, Random& random);

/// The words of a dictionary in libFuzzer's format: a line `"word"` or `name="word"` each, with \\, \" and \xAB; lines
/// that are empty or begin with # are passed over. Nothing where a line is none of these.
[[nodiscard]] std::optional<std::vector<Bytes>> dictionaryFrom(std::string_view text);

}  // namespace tacto::fuzz
