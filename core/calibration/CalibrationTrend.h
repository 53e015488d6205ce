// CalibrationTrend.h - how one quantity of a stimulator came out over its stored calibrations, and where it moved by
// more than its uncertainties explain.
//
// A calibration states one U (95 %), in % of the command, for what is delivered. So the gain is known to U, and the
// offset to U of the lowest command that was calibrated, where it counts most. Two calibrations differ when what lies
// between them is more than both U together, as the root of the sum of their squares. A U that is not stated, or 0, is
// unknown: it draws no bar and no difference is judged by it (hazard H9).
#pragma once

#include <span>
#include <vector>

#include "core/calibration/CalibrationStore.h"

namespace tacto {

/// The line with the id of a calibrated quantity. Null where there is none.
[[nodiscard]] const StoredLine* lineOf(const StoredCalibration& stored, std::string_view quantity);

struct TrendPoint {
    CalibrationDate made{};
    double gain = 0;
    double offset = 0;           ///< in the quantity's unit
    double uncertainty_pct = 0;  ///< U, in % of the command; NaN: unknown
    double gainU = 0;            ///< U of the gain; NaN: unknown
    double offsetU = 0;          ///< U of the offset, in its unit; NaN: unknown
};
/// The oldest first. `of` holds calibrations of one stimulator, in the order in which they were stored; those in
/// another unit, of a simulated bench where `simulated` is not set (or the other way round), and those without that
/// quantity are passed over.
[[nodiscard]] std::vector<TrendPoint> trendOf(std::span<const StoredCalibration> of, std::string_view unit,
                                              bool simulated, std::string_view quantity);

struct TrendJump {
    enum class What { Gain, Offset };
    What what = What::Gain;
    CalibrationDate from{}, to{};
    double change = 0;     ///< later less earlier; relative for the gain, else in the quantity's unit
    double explained = 0;  ///< how much both U together explain, in the same unit
};
/// The jumps between neighbours that differ by more than their U explains, the oldest first.
[[nodiscard]] std::vector<TrendJump> jumpsIn(std::span<const TrendPoint> points);

}  // namespace tacto
