#include "core/analysis/sensor_calibration/RankCorrelation.h"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace tacto {

namespace {

constexpr double kNormal95 = 1.959963984540054;

/// Correlation of ranks; their mean is (n + 1) / 2, with or without ties. NaN if all values of one list are equal.
double correlation(const std::vector<double>& a, const std::vector<double>& b) {
    const double middle = (static_cast<double>(a.size()) + 1) / 2;
    double ab = 0, aa = 0, bb = 0;
    for (std::size_t i = 0; i < a.size(); ++i) {
        const double da = a[i] - middle, db = b[i] - middle;
        ab += da * db;
        aa += da * da;
        bb += db * db;
    }
    if (!(aa > 0) || !(bb > 0)) return std::numeric_limits<double>::quiet_NaN();
    return std::clamp(ab / std::sqrt(aa * bb), -1.0, 1.0);
}

double halfWidth(double rho, double n) { return kNormal95 * std::sqrt((1 + rho * rho / 2) / (n - 3)); }

Estimate intervalOf(double rho, double n) {
    // Rounding can move ranks in perfect order off 1 slightly; other values differ from 1 by at least 6 / (n (n² - 1)).
    const double step = 6 / (n * (n * n - 1));
    const bool perfect = 1 - std::abs(rho) < step / 1000;
    const double used = perfect ? std::copysign(1 - step, rho) : rho;
    const double z = std::atanh(used), half = halfWidth(used, n);
    Estimate out{perfect ? std::copysign(1.0, rho) : rho, std::tanh(z - half), std::tanh(z + half)};
    if (perfect) (rho > 0 ? out.high : out.low) = out.value;
    return out;
}

/// Returns ranks from 1; equal values get the mean of their ranks.
std::vector<double> midRanks(std::span<const double> values) {
    std::vector<std::size_t> order(values.size());
    std::iota(order.begin(), order.end(), std::size_t{0});
    std::sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) { return values[a] < values[b]; });
    std::vector<double> ranks(values.size());
    for (std::size_t begin = 0; begin < order.size();) {
        std::size_t end = begin + 1;
        while (end < order.size() && values[order[end]] == values[order[begin]]) ++end;
        const double rank = (static_cast<double>(begin + end) + 1) / 2;
        for (std::size_t i = begin; i < end; ++i) ranks[order[i]] = rank;
        begin = end;
    }
    return ranks;
}

}  // namespace

Result<RankCorrelation> spearman(std::span<const double> x, std::span<const double> y) {
    if (x.size() != y.size()) {
        return invalid("rank correlation: {} values against {}; as many are expected", x.size(), y.size());
    }
    if (x.size() < kMinRanked) {
        return invalid("rank correlation: {} pairs; at least {} are expected", x.size(), kMinRanked);
    }
    for (const auto side : {x, y}) {
        for (const double value : side) {
            if (!std::isfinite(value)) {
                return invalid("rank correlation: a value is {}; a finite one is expected", value);
            }
        }
    }
    const auto ranksX = midRanks(x), ranksY = midRanks(y);
    const double rho = correlation(ranksX, ranksY);
    if (std::isnan(rho)) {
        return invalid("rank correlation: all {} values of one side are equal; they cannot be ranked", x.size());
    }
    RankCorrelation out;
    out.n = x.size();
    out.rho = intervalOf(rho, static_cast<double>(out.n));
    for (const auto& ranks : {ranksX, ranksY}) {
        auto sorted = ranks;
        std::sort(sorted.begin(), sorted.end());
        out.ties = out.ties || std::adjacent_find(sorted.begin(), sorted.end()) != sorted.end();
    }
    if (out.n < kSmallRanking) {
        out.note = fmt::format("{} surfaces are few: the interval is an approximation and wide", out.n);
    }
    return out;
}

}  // namespace tacto
