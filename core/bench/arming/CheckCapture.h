// CheckCapture.h - an oscilloscope's capture of the check pulse, for a source that does not read back: the load in the
// capture confirms the arming or ends it.
//
// Thread-safety: one caller, the bench's.
#pragma once

#include "core/bench/BenchTime.h"
#include "core/bench/ControlLoop.h"
#include "core/bench/arming/ArmingSequence.h"
#include "core/bench/sensing/ScopeSession.h"

namespace tacto {

class CheckCapture {
public:
    /// An oscilloscope may need this long to arm, and as long again to be read.
    static constexpr Seconds kTimeout{5};

    /// Captures the pulse with which `command` begins. All arguments but `command` outlive this.
    CheckCapture(ScopeSession& scope, BenchTime& time, ControlLoop& loop, const ArmCommand& command);

    /// Arms the oscilloscope and waits until it can trigger. Errors: NotArmed if the oscilloscope failed or is not
    /// ready; as BenchTime::advance().
    [[nodiscard]] Result<void> begin();
    /// Hands the oscilloscope's result to the control loop; false if there is no result yet.
    [[nodiscard]] bool passOn();

private:
    [[nodiscard]] ScopeSettings settings() const;

    ScopeSession& scope_;
    BenchTime& time_;
    ControlLoop& loop_;
    const PulseTrain check_;
    const double ohm_;
};

}  // namespace tacto
