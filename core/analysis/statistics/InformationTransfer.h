// InformationTransfer.h - how many bits the answers carry about the stimuli (science.md section 11).
#pragma once

#include <span>
#include <vector>

#include "core/analysis/statistics/Estimate.h"

namespace tacto {

/// Mutual information of rows and columns in bits, from counts or from probabilities with rows of equal weight; NaN
/// for a table without entries. From counts it is too high on average: correctedInformation().
[[nodiscard]] double informationTransfer(std::span<const std::vector<double>> table);

/// The same of counts, without what chance adds, and a 95 % interval; bits. Rows are stimuli, presented as often as was
/// planned: their shares are known, and what each was answered is a sample of its own. The entropy of all answers is
/// corrected by the jackknife over such rows, that of each row's answers by the jackknife of second order, of trials
/// left out one at a time and two at a time (Efron & Tibshirani 1993; Schucany, Gray & Owen 1971, JASA 66:524), which
/// is unbiased where nearly all answers are right, as Miller and Madow's constant is not. The interval is ± 1.96
/// standard deviations: the larger of the jackknife's and of what the derivative (Moddemeijer 1989) gives for the table
/// with two more answers in each row, spread as those of all rows (Agresti & Coull 1998 for a share), with the
/// second-order variance beside it. Value and ends lie within 0 and what can be told, the entropy of the stimuli or of
/// that many answers. NaN throughout for a table without entries.
[[nodiscard]] Estimate correctedInformation(std::span<const std::vector<double>> counts);

}  // namespace tacto
