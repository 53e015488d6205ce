#include "core/analysis/statistics/UncertaintyBudget.h"

#include <algorithm>
#include <cmath>

#include "core/base/Random.h"
#include "core/base/Words.h"

namespace tacto {

namespace {

constexpr double kCoverage = 0.95;
constexpr std::size_t kMinDraws = 1000;

Result<void> check(const Contribution& row) {
    if (row.value < 0 || std::isinf(row.value)) {
        return invalid("uncertainty of {}: {} was given; 0 or more was expected", row.name, row.value);
    }
    if (!(row.divisor > 0) || !std::isfinite(row.divisor)) {
        return invalid("uncertainty of {}: divisor {}; above 0 was expected", row.name, row.divisor);
    }
    if (!std::isfinite(row.sensitivity)) {
        return invalid("uncertainty of {}: sensitivity {}; a finite one was expected", row.name, row.sensitivity);
    }
    if (!(row.degreesOfFreedom > 0)) {
        return invalid("uncertainty of {}: {} degrees of freedom; above 0 were expected", row.name,
                       row.degreesOfFreedom);
    }
    return {};
}

/// Draws Student's t by Bailey's polar method, which is exact for any ν and needs no gamma draw.
double drawStudent(Random& random, double nu) {
    if (std::isinf(nu)) return random.normal();
    for (;;) {
        const double u = 2 * random.uniform() - 1;
        const double v = 2 * random.uniform() - 1;
        const double w = u * u + v * v;
        if (w > 0 && w <= 1) return u * std::sqrt(nu * (std::pow(w, -2 / nu) - 1) / w);
    }
}

/// Half-width of the symmetric 95 % interval of the sum of all rows, each drawn from its own distribution around 0.
double propagate(const std::vector<Contribution>& rows, const BudgetOptions& options) {
    Random random(options.seed, "uncertainty budget");
    // Normal rows are combined into one normal row, which needs only one draw.
    double normalSquares = 0;
    for (const auto& row : rows) {
        if (row.distribution == Distribution::Normal) normalSquares += row.contribution() * row.contribution();
    }
    const double normal = std::sqrt(normalSquares);
    std::vector<double> sums(options.draws);
    for (auto& sum : sums) {
        sum = normal > 0 ? normal * random.normal() : 0;
        for (const auto& row : rows) {
            if (row.distribution == Distribution::Rectangular) {
                sum += row.contribution() * std::sqrt(3.0) * (2 * random.uniform() - 1);
            } else if (row.distribution == Distribution::Student) {
                sum += row.contribution() * drawStudent(random, row.degreesOfFreedom);
            }
        }
        sum = std::abs(sum);
    }
    const auto at = sums.begin() + static_cast<std::ptrdiff_t>(kCoverage * static_cast<double>(options.draws));
    std::nth_element(sums.begin(), at, sums.end());
    return *at;
}

}  // namespace

double Contribution::contribution() const noexcept { return std::abs(sensitivity) * standardUncertainty(); }

namespace {
constexpr Word<Distribution> kDistributionWords[] = {{"normal", Distribution::Normal},
                                                     {"Student's t", Distribution::Student},
                                                     {"rectangular", Distribution::Rectangular}};
constexpr Word<CoverageMethod> kCoverageMethods[] = {{"Welch-Satterthwaite", CoverageMethod::WelchSatterthwaite},
                                                     {"Monte Carlo", CoverageMethod::MonteCarlo}};
}  // namespace

std::string_view nameOf(Distribution distribution) noexcept { return wordFor(kDistributionWords, distribution); }

std::string_view nameOf(CoverageMethod method) noexcept { return wordFor(kCoverageMethods, method); }

Result<UncertaintyBudget> combine(std::vector<Contribution> rows, const BudgetOptions& options) {
    if (rows.empty()) {
        return invalid("an uncertainty budget without rows; at least one was expected");
    }
    if (options.draws < kMinDraws) {
        return invalid("{} draws for an uncertainty budget; at least {} were expected", options.draws, kMinDraws);
    }
    UncertaintyBudget budget;
    double squares = 0, widestRectangle = 0;
    for (const auto& row : rows) {
        if (auto sane = check(row); !sane) return failure(sane);
        const double part = row.contribution();
        squares += part * part;
        if (row.distribution == Distribution::Rectangular) widestRectangle = std::max(widestRectangle, part);
    }
    budget.combined = std::sqrt(squares);
    if (std::isnan(budget.combined)) {
        budget.degreesOfFreedom = budget.coverageFactor = budget.expanded = std::numeric_limits<double>::quiet_NaN();
        budget.rows = std::move(rows);
        return budget;
    }
    double fourthPowers = 0;  // Σ (contribution / u_c)⁴ / degrees of freedom; ratios avoid overflow
    if (budget.combined > 0) {
        for (const auto& row : rows) {
            const double share = row.contribution() / budget.combined;
            if (std::isfinite(row.degreesOfFreedom)) fourthPowers += std::pow(share, 4) / row.degreesOfFreedom;
        }
    }
    budget.degreesOfFreedom = fourthPowers > 0 ? 1 / fourthPowers : std::numeric_limits<double>::infinity();
    if (widestRectangle > 0.5 * budget.combined) {
        budget.method = CoverageMethod::MonteCarlo;
        budget.expanded = propagate(rows, options);
        budget.coverageFactor = budget.expanded / budget.combined;
    } else {
        budget.coverageFactor = studentQuantile(0.5 + kCoverage / 2, budget.degreesOfFreedom);
        budget.expanded = budget.combined > 0 ? budget.coverageFactor * budget.combined : 0;
        if (!(budget.combined > 0)) budget.coverageFactor = std::numeric_limits<double>::quiet_NaN();
    }
    budget.rows = std::move(rows);
    return budget;
}

}  // namespace tacto
