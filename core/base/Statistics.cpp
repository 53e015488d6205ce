#include "core/base/Statistics.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

namespace tacto {

namespace {

/// Returns the mean of the readings with two ranks, which are equal or neighbours. Reorders `readings`.
double meanOfRanks(std::vector<double>& readings, std::size_t lower, std::size_t upper) {
    const auto at = readings.begin() + static_cast<std::ptrdiff_t>(upper);
    std::nth_element(readings.begin(), at, readings.end());
    return lower == upper ? *at : 0.5 * (*std::max_element(readings.begin(), at) + *at);
}

/// The readings inside a window, in their order, and the number of readings below the window.
struct Within {
    std::size_t below = 0;
    std::vector<double> readings;

    Within(std::span<const double> all, double least, double most) {
        std::array<double, 1024> chunk;
        for (std::size_t first = 0; first < all.size(); first += chunk.size()) {
            std::size_t kept = 0;
            // Without a branch, since the processor could not predict whether the next reading is kept.
            for (const double x : all.subspan(first, std::min(chunk.size(), all.size() - first))) {
                const std::size_t isBelow = x < least ? 1 : 0;
                const std::size_t isAbove = x > most ? 1 : 0;
                chunk[kept] = x;
                kept += 1 - isBelow - isAbove;
                below += isBelow;
            }
            readings.insert(readings.end(), chunk.begin(), chunk.begin() + static_cast<std::ptrdiff_t>(kept));
        }
    }
};

/// If there are many readings, about a thousand of them show roughly where the median is, and only readings near it are
/// sorted. If the median is elsewhere (readings repeat in step with the thousand), all readings are used.
double medianOf(std::span<const double> readings) {
    constexpr std::size_t kAsked = 1024;
    constexpr std::size_t kReach = 64;  // in ranks of the sample: four standard deviations of its median's rank
    const std::size_t upper = readings.size() / 2;
    const std::size_t lower = (readings.size() - 1) / 2;
    if (readings.size() > 8 * kAsked) {
        std::vector<double> asked(kAsked);
        for (std::size_t k = 0; k < kAsked; ++k) asked[k] = readings[k * (readings.size() / kAsked)];
        std::sort(asked.begin(), asked.end());
        Within near(readings, asked[kAsked / 2 - kReach], asked[kAsked / 2 + kReach]);
        if (lower >= near.below && upper < near.below + near.readings.size()) {
            return meanOfRanks(near.readings, lower - near.below, upper - near.below);
        }
    }
    std::vector<double> all(readings.begin(), readings.end());
    return meanOfRanks(all, lower, upper);
}

}  // namespace

Statistics statisticsOf(std::span<const double> readings) {
    Statistics result;
    result.n = readings.size();
    if (readings.empty()) return result;
    const auto n = static_cast<double>(readings.size());
    // Sums differences from the first reading, so that a large common offset costs no precision.
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
    result.median = medianOf(readings);
    return result;
}

}  // namespace tacto
