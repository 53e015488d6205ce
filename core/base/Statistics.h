// Statistics.h - the six numbers with which every repeated reading is reported.
#pragma once

#include <cstddef>
#include <limits>
#include <span>

namespace tacto {

/// A value that does not exist, was not measured or is not stated.
inline constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();

/// Statistics of n readings, in the readings' unit. What does not exist is NaN: everything when n = 0, the standard
/// deviation when n = 1; one reading that is NaN makes everything but n NaN. NaN is null in JSON and empty in CSV.
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
