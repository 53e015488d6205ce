// LslClock.h - the session's clock on liblsl's: both count seconds of the computer's steady clock, from different
// moments, so that the difference is measured once.
//
// Thread-safety: values.
#pragma once

#include "core/base/Clock.h"
#include "core/exchange/lsl/LslLibrary.h"

namespace tacto {

class LslClock {
public:
    /// Reads both clocks in turn until the two readings of one that stand around the other's are within 20 µs, at most
    /// 1000 times. Errors: Timeout if they never are within 0.5 ms; Unsupported if liblsl's clock is no number.
    [[nodiscard]] static Result<LslClock> match(const LslLibrary& library, const Clock& session);

    [[nodiscard]] double stampOf(double session_s) const noexcept { return session_s + offset_s_; }
    [[nodiscard]] double sessionTime_s(double stamp_s) const noexcept { return stamp_s - offset_s_; }

private:
    explicit LslClock(double offset_s) : offset_s_(offset_s) {}
    double offset_s_;
};

}  // namespace tacto
