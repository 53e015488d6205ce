// CalibrationTrend.h - one quantity of a stimulator over its stored calibrations, and where it changed by more than the
// uncertainties explain.
//
// A calibration states one U (95 %) of the delivered value, in % of the command. The gain has this U; the offset has
// the U of the lowest calibrated command, where it matters most. Two calibrations differ if their difference exceeds
// the root of the sum of the squares of both U. A U that is 0 or not stated is unknown: it gets no bar and judges no
// difference (hazard H9).
#pragma once

#include <span>
#include <vector>

#include "core/calibration/CalibrationStore.h"

namespace tacto {

/// Returns the line of the calibrated quantity with that id; null if there is none.
[[nodiscard]] const StoredLine* lineOf(const StoredCalibration& stored, std::string_view quantity);

struct TrendPoint {
    CalibrationDate made{};
    double gain = 0;
    double offset = 0;           ///< in the quantity's unit
    double uncertainty_pct = 0;  ///< U, in % of the command; NaN: unknown
    double gainU = 0;            ///< U of the gain; NaN: unknown
    double offsetU = 0;          ///< U of the offset, in its unit; NaN: unknown
};
/// Returns the points, oldest first. `of` holds calibrations of one stimulator, in the order in which they were stored.
/// Skips calibrations in another unit, without that quantity, or whose simulated mark differs from `simulated`.
[[nodiscard]] std::vector<TrendPoint> trendOf(std::span<const StoredCalibration> of, std::string_view unit,
                                              bool simulated, std::string_view quantity);

struct TrendJump {
    enum class What { Gain, Offset };
    What what = What::Gain;
    CalibrationDate from{}, to{};
    double change = 0;     ///< later minus earlier; relative for the gain, else in the quantity's unit
    double explained = 0;  ///< the change that both U together explain, in the same unit
};
/// Returns the changes between neighbouring points that their U do not explain, oldest first.
[[nodiscard]] std::vector<TrendJump> jumpsIn(std::span<const TrendPoint> points);

}  // namespace tacto
