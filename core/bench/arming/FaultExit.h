// FaultExit.h - the way out of Faulted. Each cause is looked at again, here or before anything else can be delivered:
//   device lost, device fault, status missing   the device is asked, and must answer and deliver nothing
//   stale sensor, a failed sensor               the sensor is asked
//   loop silent                                 the loop must take its steps again
//   open, short, net charge, limit broken       the check pulse with which arming begins: see
//   ControlLoop::judgeCheck().
//                                               A source that does not read back arms on the operator's word for the
//                                               load
//   internal error                              is never gone: the program is restarted
//
// Thread-safety: one caller, the bench's.
#pragma once

#include "core/bench/BenchTime.h"
#include "core/safety/Interlock.h"

namespace tacto {

class FaultExit {
public:
    /// `sensor` may be null.
    FaultExit(Interlock& interlock, ControlLoop& loop, BenchTime& time, const BenchOutput& output,
              SensorSession* sensor) noexcept
        : interlock_(interlock), loop_(loop), time_(time), output_(output), sensor_(sensor) {}

    /// Errors: NotArmed while the cause persists.
    [[nodiscard]] Result<void> leave();

private:
    template <class Session>
    [[nodiscard]] Result<void> ask(Session& session, Role role, Instant within, const char* who);
    [[nodiscard]] Result<void> letReportsBeJudged();

    Interlock& interlock_;
    ControlLoop& loop_;
    BenchTime& time_;
    const BenchOutput& output_;
    SensorSession* const sensor_;
};

}  // namespace tacto
