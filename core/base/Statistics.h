// Statistics.h - the six figures that are reported for every repeated reading.
#pragma once

#include <cstddef>
#include <limits>
#include <span>

namespace tacto {

/// A value that does not exist, was not measured or is not stated.
inline constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();

/// Statistics of n readings, in the readings' unit. A figure that does not exist is NaN: all figures for n = 0, the
/// standard deviation for n = 1. A reading of NaN makes all but n NaN. NaN is null in JSON and empty in CSV.
struct Statistics {
    double mean = kNaN;
    double sd = kNaN;  ///< standard deviation of the sample, with n - 1
    double median = kNaN;
    double min = kNaN;
    double max = kNaN;
    std::size_t n = 0;
};

[[nodiscard]] Statistics statisticsOf(std::span<const double> readings);

}  // namespace tacto
