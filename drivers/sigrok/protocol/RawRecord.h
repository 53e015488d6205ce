// RawRecord.h - samples as libsigrok gave them, and the Capture that is cut out of them.
#pragma once

#include <optional>
#include <vector>

#include "core/measure/Capture.h"
#include "drivers/sigrok/protocol/RecordPlan.h"

namespace tacto::sigrok_driver {

struct RawRecord {
    double rate_hz = 0;
    double end_s = 0;            ///< session time of the end of the last sample
    std::vector<float> voltage;  ///< V
    std::vector<float> current;  ///< V across the shunt; empty without a current channel
    double resolution = 0;       ///< the resolution that the driver states, V; 0 unknown
};

/// The place where a signal goes through `level` (up where it is positive, down where it is negative), nearest to
/// `near`, in samples with the fraction between two; nothing where it never does.
[[nodiscard]] std::optional<double> crossing(const std::vector<float>& samples, double level, double near);

/// The size of the converter's steps: the smallest difference of two values when all are multiples of it and there are
/// at least four; 0 otherwise.
[[nodiscard]] double stepOf(const std::vector<float>& samples);

/// The record wanted around `trigger` (in raw samples), averaged down to the rate wanted. Nothing where the raw record
/// is too short for it. Errors: Device naming the rate or the length that does not fit the plan.
[[nodiscard]] Result<Capture> cut(const RawRecord& raw, const RecordPlan& plan, const Wiring& wiring, double trigger);

}  // namespace tacto::sigrok_driver
