// SensorScale.h - a sensor's reading against known references: how much one unit of it stands for, and from where.
//
// Force against weights, and each taxel against force over contact area, are the same question. The readings are fitted
// against the references (the references are what is known), by fitCalibration(), and the line is turned round:
//   reference = scale · reading + offset, scale = 1 / gain, offset = -(fitted offset) / gain.
// The uncertainties are type A from the repeatability, and the tolerance that all references share, rectangular: of the
// scale, and times the offset of the offset. U is combine()'s, for 95 %. There may be several such tolerances (of the
// weights, of local gravity, of the contact area); one that is not known leaves U unknown.
//
// Thread-safety: pure function.
#pragma once

#include <limits>
#include <span>
#include <string_view>
#include <vector>

#include "core/analysis/calibration/Calibration.h"
#include "core/base/Result.h"

namespace tacto {

struct SensorScale {
    double scale = 0;  ///< reference per unit of reading: N per count, Pa per count
    double scaleU = std::numeric_limits<double>::quiet_NaN();  ///< 95 %; NaN where nothing was repeated
    double offset = 0;  ///< in the reference's unit: what a reading of 0 stands for
    double offsetU = std::numeric_limits<double>::quiet_NaN();
    Calibration fit;  ///< readings against references
};

/// `readings`: commanded is the reference, measured the sensor's reading. `tolerances` of the references are relative
/// half-widths, 0 to below 1; NaN: not known.
/// Errors: as fitCalibration(); Device where the reading does not follow the reference: the slope's 95 % interval
/// reaches 0. `what` names the sensor in that sentence.
[[nodiscard]] Result<SensorScale> fitSensorScale(std::span<const CalibrationReading> readings,
                                                 const std::vector<double>& tolerances, std::string_view what);

}  // namespace tacto
