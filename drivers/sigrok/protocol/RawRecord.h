// RawRecord.h - samples as libsigrok delivered them, and the functions that cut a Capture out of them.
#pragma once

#include <optional>
#include <vector>

#include "core/measure/Capture.h"
#include "drivers/sigrok/protocol/RecordPlan.h"

namespace tacto::sigrok_driver {

struct RawRecord {
    double rate_hz = 0;
    double end_s = 0;            ///< session time at the end of the last sample
    std::vector<float> voltage;  ///< V
    std::vector<float> current;  ///< volts across the shunt; empty without a current channel
    double resolution = 0;       ///< resolution in volts that the driver states; 0 if unknown
};

/// Returns the place nearest to `near` where a signal crosses `level` (upward if `level` is positive, downward if
/// negative), in samples with a fraction; nothing if the signal never crosses it.
[[nodiscard]] std::optional<double> crossing(const std::vector<float>& samples, double level, double near);

/// Returns the size of the converter's steps: the smallest difference between two values, if all values are multiples
/// of that difference and there are at least four values; otherwise 0.
[[nodiscard]] double stepOf(const std::vector<float>& samples);

/// Cuts out the wanted record around `trigger` (in raw samples), averaged down to the wanted rate. Returns nothing if
/// the raw record is too short. Errors: Device naming the rate or length that does not fit the plan.
[[nodiscard]] Result<Capture> cut(const RawRecord& raw, const RecordPlan& plan, const Wiring& wiring, double trigger);

}  // namespace tacto::sigrok_driver
