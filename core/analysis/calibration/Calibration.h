// Calibration.h - commanded against measured: the line, and how far a device keeps to it. science.md section 9.
//
// The line measured = gain · commanded + offset is fitted by least squares through all readings, unweighted unless each
// of them carries its standard uncertainty. Percentages are of the largest command (its magnitude), on level means:
//   residual       the largest distance of a level's mean from the line,
//   repeatability  s of repeats, pooled within level and direction,
//   hysteresis     the largest |mean going up - mean going down| at a level.
// Readings that stand out are marked and stay in everything that is computed. A reading is marked when it lies more
// than 5 robust standard deviations from the median of its own level and direction. That deviation is 1.0483 times the
// median distance between two repeats, over all pairs of a level and direction (0.8862 times their mean where more than
// half of them are equal): unlike distances from the median of a few repeats, it does not shrink with their number.
// What lies within the instrument's resolution does not stand out.
#pragma once

#include <cstddef>
#include <limits>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "core/base/Result.h"
#include "core/base/Words.h"

namespace tacto {

/// Which way the sweep was going when a reading was taken.
enum class SweepDirection { None, Up, Down };
inline constexpr Word<SweepDirection> kSweepDirections[] = {
    {"", SweepDirection::None}, {"up", SweepDirection::Up}, {"down", SweepDirection::Down}};
[[nodiscard]] constexpr std::string_view nameOf(SweepDirection direction) noexcept {
    return wordFor(kSweepDirections, direction);
}

inline constexpr double kOutlierDistance = 5;  ///< robust standard deviations
inline constexpr std::size_t kWantedLevels = 11;
inline constexpr std::size_t kWantedRepeats = 5;  ///< per level and direction

/// A command and its reading, in the unit of the calibrated quantity: V, mA, s.
struct CalibrationReading {
    double commanded = 0;
    double measured = std::numeric_limits<double>::quiet_NaN();  ///< NaN: was not measured
    SweepDirection direction = SweepDirection::None;
    double uncertainty = std::numeric_limits<double>::quiet_NaN();  ///< standard (k = 1); NaN or 0: not stated
    bool outlier = false;                                           ///< set by fitCalibration()
};

struct CalibrationLevel {
    double commanded = 0;
    std::size_t n = 0;  ///< measured readings
    std::size_t notMeasured = 0;
    double mean = 0;  ///< the mean of all its readings
    double meanUp = std::numeric_limits<double>::quiet_NaN();
    double meanDown = std::numeric_limits<double>::quiet_NaN();
    double s = std::numeric_limits<double>::quiet_NaN();  ///< pooled within direction
    double degreesOfFreedom = 0;                          ///< degrees of freedom of s
    double residual = 0;                                  ///< mean less the line
};

struct Calibration {
    double gain = 0;
    double offset = 0;
    /// Standard errors of the two, from the repeatability (from the residuals where nothing was repeated): a departure
    /// from the line that repeats is not scatter. NaN when there is nothing to tell from.
    double gainStandardError = std::numeric_limits<double>::quiet_NaN();
    double offsetStandardError = std::numeric_limits<double>::quiet_NaN();
    double degreesOfFreedom = 0;  ///< degrees of freedom of both errors
    bool weighted = false;
    double fullScale = 0;  ///< magnitude of the largest command
    double residualMax_pct = 0;
    double repeatability = std::numeric_limits<double>::quiet_NaN();  ///< in the readings' unit; NaN: none repeated
    double repeatability_pct = std::numeric_limits<double>::quiet_NaN();
    double hysteresis_pct = std::numeric_limits<double>::quiet_NaN();  ///< NaN: no level was met both ways
    std::vector<CalibrationLevel> levels;                              ///< by rising command
    std::vector<CalibrationReading> readings;                          ///< as given, outliers marked
    std::size_t outliers = 0;
    std::size_t notMeasured = 0;
    bool complete = false;              ///< 11 levels, 5 repeats each way, up and down, every reading measured
    std::vector<std::string> warnings;  ///< sentences: fewer levels or repeats than wanted, marked or missing readings
};

struct CalibrationOptions {
    /// Commands that lie within this share of the largest are one level at their mean, and their differences are not
    /// scatter: a source whose current follows a measured load is programmed to a slightly different one each time.
    double sameLevel = 1e-9;  ///< tells numbers apart, printed and read back
    double resolution = 0;    ///< one step of the instrument, in the readings' unit; 0 = not known
};

/// Repeats are compared pair by pair.
inline constexpr std::size_t kMaxReadings = 5000;

/// Errors: InvalidArgument for more than kMaxReadings, a command or reading that is not finite (NaN readings apart), a
/// negative uncertainty, fewer than two levels with a measured reading, commands that are all 0, or options that are
/// not 0 or more.
[[nodiscard]] Result<Calibration> fitCalibration(std::span<const CalibrationReading> readings,
                                                 const CalibrationOptions& options = {});

}  // namespace tacto
