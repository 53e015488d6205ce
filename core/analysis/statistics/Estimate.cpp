#include "core/analysis/statistics/Estimate.h"

#include <algorithm>
#include <cmath>

namespace tacto {

Estimate wilsonInterval(std::size_t successes, std::size_t n) noexcept {
    if (n == 0) return {std::numeric_limits<double>::quiet_NaN(), 0, 1};
    constexpr double kZ = 1.959963984540054;  // 97.5 % point of the normal distribution
    constexpr double kZ2 = kZ * kZ;
    const double count = static_cast<double>(n);
    const double p = static_cast<double>(successes) / count;
    const double centre = (p + kZ2 / (2 * count)) / (1 + kZ2 / count);
    const double half = kZ / (1 + kZ2 / count) * std::sqrt(p * (1 - p) / count + kZ2 / (4 * count * count));
    return {p, std::max(0.0, centre - half), std::min(1.0, centre + half)};
}

}  // namespace tacto
