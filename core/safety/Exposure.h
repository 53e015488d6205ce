// Exposure.h - one line of an exposure table: a quantity, its value, and the limit it is held against.
//
// Never allocates and is trivially copyable: the control loop fills these while delivering.
//
// Thread-safety: values; pure functions.
#pragma once

#include <cstddef>
#include <string_view>

#include "core/base/NaN.h"
#include "core/safety/FixedText.h"
#include "core/safety/LimitSet.h"

namespace tacto {

/// A table holds no more. A setup with more limits is refused: one that no table shows would seem to be kept.
inline constexpr std::size_t kMaxExposureRows = 64;

struct ExposureRow {
    Quantity quantity = Quantity::PeakVoltage;
    double value = 0;       ///< in `unit`; meaningless when not evaluated
    double limit = 0;       ///< in `unit`; NaN for a row that is shown without a limit
    std::string_view unit;  ///< static text, as unitOf(quantity)
    double window_s = 0;    ///< 0 = of one pulse
    FixedText<31> set;      ///< id of the limit set, "profile" for a ceiling; empty without a limit
    LimitAction action = LimitAction::Refuse;
    JudgedAt judged = JudgedAt::LoadRange;
    bool strict = false;     ///< the limit is "<", not "≤"
    bool evaluated = false;  ///< false: reads "not evaluated", and is never a pass (H9)
    bool within = false;     ///< evaluated and within the limit (true without a limit)
    FixedText<95> reason;    ///< why it was not evaluated, else empty
    double measured = kNaN;  ///< in `unit`: what an instrument showed of what was set; NaN: none did
    bool beyond = false;     ///< what was measured lies beyond what the source states of its accuracy
};

}  // namespace tacto
