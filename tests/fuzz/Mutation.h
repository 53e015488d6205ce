// Mutation.h - new inputs made of old ones: what a fuzzer does, without its feedback.
//
// Thread-safety: pure function of its arguments; the same state of `random` gives the same input.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "core/base/Random.h"

namespace tacto::fuzz {

using Bytes = std::vector<std::uint8_t>;

/// The longest file of a corpus.
inline constexpr std::size_t kMaxFile = 65'536;

/// One of `corpus` (not empty, files of kMaxFile bytes at most) after 1 to 8 changes: a bit flipped, a byte replaced,
/// bytes inserted, deleted, cut off or repeated, or the end of another. Never longer than kMaxFile.
[[nodiscard]] Bytes mutated(const std::vector<Bytes>& corpus, Random& random);

}  // namespace tacto::fuzz
