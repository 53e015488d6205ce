// UncertaintyBudget.h - combines the contributions to a value's uncertainty, one per row.
//
// Follows the GUM (JCGM 100). The standard uncertainty of a row is its half-width (or s) divided by its divisor; the
// contribution is this times |sensitivity coefficient|. The contributions are combined in quadrature to u_c. The 95 %
// coverage factor is Student's t at the Welch-Satterthwaite degrees of freedom. If one rectangular contribution exceeds
// half of u_c, this factor is too wide because the sum is not nearly normal. The distributions are then propagated
// (JCGM 101, GUM Supplement 1) with 200 000 draws (10^4 times 1/(1 - p)). All contributions are assumed independent. A
// contribution that is not stated is NaN; the budget then lists its rows but has no u_c and no U (science.md section
// 12).
//
// Thread-safety: pure functions; the same seed always gives the same interval.
#pragma once

#include <cstddef>
#include <cstdint>
#include <limits>
#include <string>
#include <string_view>
#include <vector>

#include "core/base/Result.h"

namespace tacto {

enum class Distribution {
    Normal,       ///< type B, stated with a standard uncertainty
    Student,      ///< type A, from repeated readings with their degrees of freedom
    Rectangular,  ///< type B, only limits are known
};
[[nodiscard]] std::string_view nameOf(Distribution distribution) noexcept;  // "normal", "Student's t", "rectangular"

/// One row of a budget, as printed.
struct Contribution {
    std::string name;
    Distribution distribution = Distribution::Normal;
    double value = 0;    ///< half-width, resolution, or s of the readings, in the source's unit; ≥ 0; NaN: not stated
    double divisor = 1;  ///< √3 for a half-width, √12 for a resolution, √n for s of n readings; > 0
    double sensitivity = 1;                                             ///< unit of the result per unit of the source
    double degreesOfFreedom = std::numeric_limits<double>::infinity();  ///< ≥ 1; infinite if stated

    [[nodiscard]] double standardUncertainty() const noexcept { return value / divisor; }
    /// Returns the contribution in the unit of the result.
    [[nodiscard]] double contribution() const noexcept;
};

enum class CoverageMethod { WelchSatterthwaite, MonteCarlo };
[[nodiscard]] std::string_view nameOf(CoverageMethod method) noexcept;  // "Welch-Satterthwaite", "Monte Carlo"

struct UncertaintyBudget {
    std::vector<Contribution> rows;
    double combined = 0;          ///< u_c; NaN if a row is not stated
    double degreesOfFreedom = 0;  ///< effective; infinite if no row has a finite number
    double coverageFactor = 0;    ///< U / u_c; NaN if u_c is 0
    double expanded = 0;          ///< U, 95 %; NaN if a row is not stated
    CoverageMethod method = CoverageMethod::WelchSatterthwaite;
};

struct BudgetOptions {
    std::uint64_t seed = 1;
    std::size_t draws = 200'000;  ///< number of Monte Carlo draws; at least 1000
};

/// Errors: InvalidArgument for no rows, an infinite or negative value, a divisor or degrees of freedom that are not
/// positive, or fewer than 1000 draws.
[[nodiscard]] Result<UncertaintyBudget> combine(std::vector<Contribution> rows, const BudgetOptions& options = {});

/// The p-quantile of Student's t. `degreesOfFreedom` > 0, infinite for the normal distribution; NaN unless 0 < p < 1.
[[nodiscard]] double studentQuantile(double p, double degreesOfFreedom) noexcept;

}  // namespace tacto
