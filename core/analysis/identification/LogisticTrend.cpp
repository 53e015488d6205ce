#include "core/analysis/identification/LogisticTrend.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "core/base/Statistics.h"

namespace tacto {

namespace {

constexpr double kDeviance95 = 3.841458820694124;  // 95 % point of χ² with one degree of freedom
/// In units of the whole range of x: beyond it every answer lies on the curve's flat ends.
constexpr double kSteepest = 200;
constexpr int kHalvings = 200;

/// Logistic model over x from 0 to 1, its intercept always the best for the slope.
class SlopeProfile {
public:
    explicit SlopeProfile(std::vector<LogisticPoint> points) : points_(std::move(points)) {
        for (const auto& point : points_) right_ += static_cast<double>(point.hits);
    }

    [[nodiscard]] double logLikelihood(double slope) const {
        const double intercept = interceptFor(slope);
        double sum = 0;
        for (const auto& point : points_) {
            const double z = intercept + slope * point.x;
            const double hits = static_cast<double>(point.hits), misses = static_cast<double>(point.n) - hits;
            sum -= hits * softPlus(-z) + misses * softPlus(z);
        }
        return sum;
    }
    /// Derivative of the profile: falls with the slope.
    [[nodiscard]] double score(double slope) const {
        const double intercept = interceptFor(slope);
        double sum = 0;
        for (const auto& point : points_) {
            sum += point.x * (static_cast<double>(point.hits) -
                              static_cast<double>(point.n) * probability(intercept + slope * point.x));
        }
        return sum;
    }

private:
    [[nodiscard]] static double softPlus(double z) { return std::max(z, 0.0) + std::log1p(std::exp(-std::abs(z))); }
    [[nodiscard]] static double probability(double z) { return 1 / (1 + std::exp(-z)); }

    /// As many right answers expected as there are: their number rises with the intercept.
    [[nodiscard]] double interceptFor(double slope) const {
        double low = -60 - std::abs(slope), high = 60 + std::abs(slope);
        for (int i = 0; i < kHalvings && high - low > 1e-14 * (1 + std::abs(low)); ++i) {
            const double middle = low + (high - low) / 2;
            double expected = 0;
            for (const auto& point : points_) {
                expected += static_cast<double>(point.n) * probability(middle + slope * point.x);
            }
            (expected < right_ ? low : high) = middle;
        }
        return low + (high - low) / 2;
    }

    std::vector<LogisticPoint> points_;
    double right_ = 0;
};

/// Where `above` turns from true to false between `inside` and `outside`.
template <class Above>
double turnOf(double inside, double outside, Above&& above) {
    for (int i = 0; i < kHalvings && std::abs(outside - inside) > 1e-13 * (1 + std::abs(inside)); ++i) {
        const double middle = inside + (outside - inside) / 2;
        (above(middle) ? inside : outside) = middle;
    }
    return inside + (outside - inside) / 2;
}

}  // namespace

Estimate logisticSlope(std::span<const LogisticPoint> points) {
    std::vector<LogisticPoint> used;
    double least = 0, most = 0;
    std::size_t n = 0, hits = 0;
    for (const auto& point : points) {
        if (point.n == 0) continue;
        least = used.empty() ? point.x : std::min(least, point.x);
        most = used.empty() ? point.x : std::max(most, point.x);
        n += point.n;
        hits += point.hits;
        used.push_back(point);
    }
    const double range = most - least;
    if (!(range > 0) || hits == 0 || hits >= n) return {};
    for (auto& point : used) point.x = (point.x - least) / range;

    const SlopeProfile profile(std::move(used));
    constexpr double kOpen = std::numeric_limits<double>::infinity();
    const double found = turnOf(-kSteepest, kSteepest, [&](double b) { return profile.score(b) > 0; });
    // Where every answer agrees with a slope, steeper ones are as good but for rounding.
    constexpr double kAsGood = 1e-9;
    const double asGood = profile.logLikelihood(found) - kAsGood;
    const bool openAbove = profile.logLikelihood(kSteepest) >= asGood;
    const bool openBelow = profile.logLikelihood(-kSteepest) >= asGood;
    const double best = openAbove ? kSteepest : openBelow ? -kSteepest : found;
    const double needed = profile.logLikelihood(best) - kDeviance95 / 2;
    const auto plausible = [&](double slope) { return profile.logLikelihood(slope) >= needed; };
    const auto end = [&](double far) {
        if (plausible(far)) return std::copysign(kOpen, far);
        return turnOf(best, far, plausible) / range;
    };
    const double value = openAbove ? kOpen : openBelow ? -kOpen : best / range;
    return {value, end(-kSteepest), end(kSteepest)};
}

}  // namespace tacto
