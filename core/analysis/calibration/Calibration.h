// Calibration.h - fits a line to commands and readings and tests how well a device follows it (science.md section 9).
//
// The line measured = gain · commanded + offset is fitted by least squares to all readings. The fit is weighted only if
// every reading has a standard uncertainty. Percentages refer to the largest |command| and to level means:
//   residual       the largest distance of a level's mean from the line,
//   repeatability  s of repeats, pooled within level and direction,
//   hysteresis     the largest |mean going up - mean going down| at a level.
// Outliers are marked but stay in all computations. A reading is an outlier if it lies more than 5 robust standard
// deviations from the median of its own level and direction, and by more than the instrument's resolution. The robust
// standard deviation is 1.0483 times the median difference between two repeats, over all pairs of a level and direction
// (0.8862 times the mean difference if more than half are zero). Unlike the distance from the median of a few repeats,
// it does not shrink with their number.
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

/// Direction of the sweep when a reading was taken.
enum class SweepDirection { None, Up, Down };
inline constexpr Word<SweepDirection> kSweepDirections[] = {
    {"", SweepDirection::None}, {"up", SweepDirection::Up}, {"down", SweepDirection::Down}};
[[nodiscard]] constexpr std::string_view nameOf(SweepDirection direction) noexcept {
    return wordFor(kSweepDirections, direction);
}

inline constexpr double kOutlierDistance = 5;  ///< in robust standard deviations
inline constexpr std::size_t kWantedLevels = 11;
inline constexpr std::size_t kWantedRepeats = 5;  ///< per level and direction

/// A command and its reading, in the unit of the calibrated quantity (V, mA or s).
struct CalibrationReading {
    double commanded = 0;
    double measured = std::numeric_limits<double>::quiet_NaN();  ///< NaN: not measured
    SweepDirection direction = SweepDirection::None;
    double uncertainty = std::numeric_limits<double>::quiet_NaN();  ///< standard (k = 1); NaN or 0: not stated
    bool outlier = false;                                           ///< true if fitCalibration() found an outlier
};

struct CalibrationLevel {
    double commanded = 0;
    std::size_t n = 0;  ///< number of measured readings
    std::size_t notMeasured = 0;
    double mean = 0;  ///< the mean of all its readings
    double meanUp = std::numeric_limits<double>::quiet_NaN();
    double meanDown = std::numeric_limits<double>::quiet_NaN();
    double s = std::numeric_limits<double>::quiet_NaN();  ///< standard deviation, pooled within direction
    double degreesOfFreedom = 0;                          ///< degrees of freedom of s
    double residual = 0;                                  ///< mean minus the line
};

struct Calibration {
    double gain = 0;
    double offset = 0;
    /// Standard errors of gain and offset, from the repeatability (from the residuals without repeats), because a
    /// repeatable departure from the line is not scatter. NaN if there are neither repeats nor residuals.
    double gainStandardError = std::numeric_limits<double>::quiet_NaN();
    double offsetStandardError = std::numeric_limits<double>::quiet_NaN();
    double degreesOfFreedom = 0;  ///< degrees of freedom of both errors
    bool weighted = false;
    double fullScale = 0;  ///< magnitude of the largest command
    double residualMax_pct = 0;
    double repeatability = std::numeric_limits<double>::quiet_NaN();  ///< in the readings' unit; NaN without repeats
    double repeatability_pct = std::numeric_limits<double>::quiet_NaN();
    double hysteresis_pct = std::numeric_limits<double>::quiet_NaN();  ///< NaN: no level was measured both ways
    std::vector<CalibrationLevel> levels;                              ///< in rising order of command
    std::vector<CalibrationReading> readings;                          ///< as given, with outliers marked
    std::size_t outliers = 0;
    std::size_t notMeasured = 0;
    bool complete = false;              ///< true with 11 levels, 5 repeats up and down, and every reading measured
    std::vector<std::string> warnings;  ///< sentences on missing levels or repeats, and on marked or missing readings
};

struct CalibrationOptions {
    /// Commands within this share of the largest one form one level at their mean, and their differences are not
    /// scatter: a source that adapts its current to the measured load gets slightly different commands.
    double sameLevel = 1e-9;  ///< default: only joins numbers that differ by rounding
    double resolution = 0;    ///< one step of the instrument, in the readings' unit; 0: unknown
};

/// Upper limit, because repeats are compared in pairs.
inline constexpr std::size_t kMaxReadings = 5000;

/// Fits the line. Errors: InvalidArgument for more than kMaxReadings, an infinite or missing command, an infinite
/// reading, a negative uncertainty, fewer than two levels with a measured reading, commands that are all 0, or negative
/// options.
[[nodiscard]] Result<Calibration> fitCalibration(std::span<const CalibrationReading> readings,
                                                 const CalibrationOptions& options = {});

}  // namespace tacto
