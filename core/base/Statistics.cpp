#include "core/base/Statistics.h"

#include <algorithm>
#include <cmath>
#include <vector>

namespace tacto {

Statistics statisticsOf(std::span<const double> readings) {
    Statistics result;
    result.n = readings.size();
    if (readings.empty()) return result;
    if (std::any_of(readings.begin(), readings.end(), [](double x) { return std::isnan(x); })) return result;

    const auto n = static_cast<double>(readings.size());
    // Deviations from the first reading: a large common offset costs no digits.
    const double origin = readings.front();
    double sum = 0;
    for (const double x : readings) sum += x - origin;
    const double mean = sum / n;
    double squares = 0;
    for (const double x : readings) squares += (x - origin - mean) * (x - origin - mean);
    result.mean = origin + mean;
    if (readings.size() > 1) result.sd = std::sqrt(squares / (n - 1));

    std::vector<double> sorted(readings.begin(), readings.end());
    std::sort(sorted.begin(), sorted.end());
    const std::size_t half = sorted.size() / 2;
    result.median = sorted.size() % 2 == 1 ? sorted[half] : 0.5 * (sorted[half - 1] + sorted[half]);
    result.min = sorted.front();
    result.max = sorted.back();
    return result;
}

}  // namespace tacto
