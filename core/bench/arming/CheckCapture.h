// CheckCapture.h - an oscilloscope's capture of the check pulse, where the source does not read back: the load that it
// shows confirms the arming or ends it.
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
    /// An oscilloscope may be slow to arm, and as slow to read.
    static constexpr Seconds kTimeout{5};

    /// The pulse that `command` begins with. All but it outlive this.
    CheckCapture(ScopeSession& scope, BenchTime& time, ControlLoop& loop, const ArmCommand& command);

    /// Arms the oscilloscope, and waits until it takes a trigger. Errors: NotArmed, saying that it failed or is not
    /// ready; those of BenchTime::advance().
    [[nodiscard]] Result<void> begin();
    /// Hands over to the control loop what the oscilloscope shows; true when it was handed over.
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
