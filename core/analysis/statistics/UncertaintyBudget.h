// UncertaintyBudget.h - how well a value is known: the contributions, one row each, and what they come to.
//
// After the GUM (JCGM 100): a row's standard uncertainty is its half-width (or s) over its divisor; times the magnitude
// of its sensitivity coefficient it is the row's contribution; the contributions are added in quadrature to u_c. The
// coverage factor for 95 % comes from Student's t at the Welch-Satterthwaite degrees of freedom. Where one rectangular
// contribution exceeds half of u_c the sum is not near normal and that factor is too wide: there the interval comes
// from propagating the distributions themselves (JCGM 101, GUM Supplement 1), with 200 000 draws (its rule: 10^4 times
// 1/(1 - p)). Contributions are taken to be independent of each other. A contribution that is not stated is NaN: the
// budget then has no u_c and no U (science.md section 12), and lists its rows all the same.
//
// Thread-safety: pure functions; the same seed gives the same interval.
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
    Student,      ///< type A: from repeated readings, with their degrees of freedom
    Rectangular,  ///< type B: nothing known but limits
};
[[nodiscard]] std::string_view nameOf(Distribution distribution) noexcept;  // "normal", "Student's t", "rectangular"

/// One line of a budget, as it is printed.
struct Contribution {
    std::string name;
    Distribution distribution = Distribution::Normal;
    double value =
        0;  ///< half-width, full resolution, or s of the readings, in the source's unit; ≥ 0; NaN: not stated
    double divisor = 1;      ///< √3 for a half-width, √12 for a resolution, √n for s of n readings; > 0
    double sensitivity = 1;  ///< result's unit per source's unit
    double degreesOfFreedom = std::numeric_limits<double>::infinity();  ///< ≥ 1; infinite for what is stated

    [[nodiscard]] double standardUncertainty() const noexcept { return value / divisor; }
    /// The contribution, in the result's unit.
    [[nodiscard]] double contribution() const noexcept;
};

enum class CoverageMethod { WelchSatterthwaite, MonteCarlo };
[[nodiscard]] std::string_view nameOf(CoverageMethod method) noexcept;  // "Welch-Satterthwaite", "Monte Carlo"

struct UncertaintyBudget {
    std::vector<Contribution> rows;
    double combined = 0;          ///< u_c; NaN: a row is not stated
    double degreesOfFreedom = 0;  ///< effective; infinite when no row has finite ones
    double coverageFactor = 0;    ///< U / u_c; NaN when u_c is 0
    double expanded = 0;          ///< U, 95 %; NaN: a row is not stated
    CoverageMethod method = CoverageMethod::WelchSatterthwaite;
};

struct BudgetOptions {
    std::uint64_t seed = 1;
    std::size_t draws = 200'000;  ///< draws of the Monte Carlo; at least 1000
};

/// Errors: InvalidArgument for no rows, a value that is infinite or negative, a divisor or degrees of freedom that
/// are not above 0, or fewer than 1000 draws.
[[nodiscard]] Result<UncertaintyBudget> combine(std::vector<Contribution> rows, const BudgetOptions& options = {});

/// The p-quantile of Student's t; `degreesOfFreedom` > 0, infinite for the normal; 0 < p < 1, otherwise NaN.
[[nodiscard]] double studentQuantile(double p, double degreesOfFreedom) noexcept;

}  // namespace tacto
