// Encodings.h - which of several encodings suits people: the same stimuli under other names, compared within a person.
//
// An ideal observer does equally well with each by symmetry, so what is asked is whether names fit. One session has one
// encoding, so trials of two encodings are independent samples.
//
// Thread-safety: pure functions.
#pragma once

#include <cstddef>
#include <map>
#include <span>
#include <string>
#include <vector>

#include "core/analysis/identification/Identification.h"

namespace tacto {

/// What one person did with one encoding; NaN and 0 where it was not recorded.
struct EncodingResult {
    std::string encoding;
    std::size_t n = 0;
    std::size_t hits = 0;
    std::size_t trainingBlocks = 0;
    double medianResponse_s = kNaN;
    double naturalness = kNaN;  ///< mean of the conditions' ratings
};

struct EncodingPair {
    std::string a, b;
    Estimate difference;  ///< accuracy of a less that of b, Newcombe 95 %
};

struct EncodingComparison {
    std::vector<EncodingResult> encodings;  ///< in the order in which the person had them
    std::vector<EncodingPair> pairs;        ///< the later less the earlier
    std::string preferred;                  ///< as the person said; empty: not asked
};

[[nodiscard]] EncodingComparison compareEncodings(std::vector<EncodingResult> inOrder, std::string preferred = {});

/// How many people preferred each. Shown and never tested: five alike of five have p = 0.06.
[[nodiscard]] std::map<std::string, std::size_t> preferences(std::span<const EncodingComparison> people);

/// The order in which the `enrolled`-th person (from 0) has `encodings` of them, as indices: a row of a Williams design
/// (1949), in which each encoding stands in each place and follows each other equally often. 2: AB, BA; 3: six orders.
/// Empty for 0 encodings.
[[nodiscard]] std::vector<std::size_t> williamsOrder(std::size_t encodings, std::size_t enrolled);
/// Rows of the design: `people` is balanced where it is a multiple of this. 1 for fewer than two encodings.
[[nodiscard]] std::size_t williamsRows(std::size_t encodings) noexcept;

}  // namespace tacto
