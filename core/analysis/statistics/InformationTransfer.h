// InformationTransfer.h - how many bits the answers carry about the stimuli (science.md section 11).
//
// Thread-safety: pure functions.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

namespace tacto {

/// Mutual information of rows and columns in bits, from counts or from probabilities with rows of equal weight; NaN
/// for a table without entries.
[[nodiscard]] double informationTransfer(std::span<const std::vector<double>> table);

/// How much informationTransfer() of counts is too high on average: (r - 1)(c - 1)/(2 n ln 2) bits (Miller and Madow)
/// with r stimuli, c answers offered (chosen or not) and n trials. NaN for n = 0.
[[nodiscard]] double informationBias(std::size_t rows, std::size_t columns, std::size_t n) noexcept;

}  // namespace tacto
