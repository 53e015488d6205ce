#include "core/base/Statistics.h"

#include <algorithm>
#include <cmath>
#include <vector>

namespace tacto {

Statistics statisticsOf(std::span<const double> readings) {
    Statistics result;
    result.n = readings.size();
    if (readings.empty()) return result;
    const auto n = static_cast<double>(readings.size());
    // Deviations from the first reading: a large common offset costs no digits.
    const double origin = readings.front();
    double sum = 0, least = origin, most = origin;
    for (const double x : readings) {
        sum += x - origin;
        least = x < least ? x : least;
        most = x > most ? x : most;
    }
    if (std::isnan(sum) && std::any_of(readings.begin(), readings.end(), [](double x) { return std::isnan(x); })) {
        return result;
    }
    const double mean = sum / n;
    double squares = 0;
    for (const double x : readings) squares += (x - origin - mean) * (x - origin - mean);
    result.mean = origin + mean;
    if (readings.size() > 1) result.sd = std::sqrt(squares / (n - 1));
    result.min = least;
    result.max = most;

    // Not sorted throughout: of hundreds of thousands of readings only the middle is asked for.
    std::vector<double> partly(readings.begin(), readings.end());
    const auto middle = partly.begin() + static_cast<std::ptrdiff_t>(partly.size() / 2);
    std::nth_element(partly.begin(), middle, partly.end());
    result.median = partly.size() % 2 == 1 ? *middle : 0.5 * (*std::max_element(partly.begin(), middle) + *middle);
    return result;
}

}  // namespace tacto
