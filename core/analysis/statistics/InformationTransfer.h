// InformationTransfer.h - how much information the answers contain about the stimuli, in bits (science.md section 11).
#pragma once

#include <span>
#include <vector>

#include "core/analysis/statistics/Estimate.h"

namespace tacto {

/// Mutual information of rows and columns in bits, from counts or from probabilities (rows with equal weight). NaN for
/// an empty table. From counts the value is too high on average: see correctedInformation().
[[nodiscard]] double informationTransfer(std::span<const std::vector<double>> table);

/// Mutual information in bits from counts, corrected for chance, with a 95 % interval. Rows are stimuli with known
/// shares, as planned; the answers to each row are a separate sample. The entropy of all answers is corrected by the
/// jackknife over these rows. The entropy of each row's answers is corrected by the second-order jackknife, leaving out
/// one and two trials (Efron & Tibshirani 1993; Schucany, Gray & Owen 1971, JASA 66:524). Unlike Miller and Madow's
/// constant, it is unbiased if nearly all answers are right. The interval is ± 1.96 standard deviations, the larger of
/// two: that of the jackknife, and that of the derivative (Moddemeijer 1989) with second-order variance for a table
/// with two more answers per row, distributed like all answers (Agresti & Coull 1998). Value and ends are limited to 0
/// and the maximum, the entropy of the stimuli or of that many answers. All NaN for an empty table.
[[nodiscard]] Estimate correctedInformation(std::span<const std::vector<double>> counts);

}  // namespace tacto
