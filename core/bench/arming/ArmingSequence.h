// ArmingSequence.h - from the operator's second step to Armed: configures the gate, has the check pulse approved, and
// arms the interlock on what the check pulse, an oscilloscope or the operator's word says about the load.
//
// The control loop posts the check pulse and hands over its report; any error disarms.
//
// Thread-safety: expect() and result() any thread; the rest has one caller, the control loop.
#pragma once

#include <mutex>
#include <optional>

#include "core/bench/delivery/TrainReport.h"
#include "core/safety/Interlock.h"
#include "core/safety/SafetyGate.h"
#include "core/safety/StopCounter.h"

namespace tacto {

/// The second step of arming, prepared by the bench.
struct ArmCommand {
    GateSetup setup;
    ArmingEvidence evidence;  ///< the check pulse fills in its impedance
    /// |Z| of the declared load, where captures will tell what becomes of it and the stimulator does not: what a
    /// profile that holds charge or energy refers to.
    std::optional<Ohms> declared{};
    StopMark asked = {};  ///< when the operator gave the order to arm
    /// The source does not read back and an oscilloscope looks: the check pulse is delivered all the same, and armed is
    /// what confirm() says.
    bool confirmByCapture = false;
};

/// The load that the output was armed on, as measured then and since.
struct ArmedLoad {
    std::optional<Ohms> reference;  ///< |Z| when the output was armed: what a profile that holds charge refers to
    Instant armedAt{0};
    Ohms high{0};  ///< end of the range that was declared when arming
    std::optional<Ohms> impedance;
    Instant impedanceAt{0};
};

class ArmingSequence {
public:
    /// All arguments outlive the sequence; what is armed is written to `load`.
    ArmingSequence(SafetyGate& gate, Interlock& interlock, ArmedLoad& load) noexcept
        : gate_(gate), interlock_(interlock), load_(load) {}

    /// Another arming is asked for, which has no result yet.
    void expect();
    /// Nothing while the arming is going on, then success or why it failed. Taken once.
    [[nodiscard]] std::optional<Result<void>> result();

    void begin(ArmCommand command) noexcept;
    [[nodiscard]] bool active() const noexcept { return command_.has_value(); }
    /// The check pulse is still to be posted: checkPulse() is due.
    [[nodiscard]] bool checkDue() const noexcept { return command_ && !checkPosted_; }
    /// The approved check pulse, to be posted now. Nothing where the arming ended, with or without success: nothing
    /// measures this load, or it is refused. `hasStimulator`: else a massager is armed.
    [[nodiscard]] std::optional<ApprovedTrain> checkPulse(Instant now, bool hasStimulator) noexcept;
    /// The device has reported the check pulse, and it is sound.
    void checkRead(const TrainReport& report) noexcept;
    /// Takes the oscilloscope's view of the check pulse; arms once the device has reported, too.
    void confirm(Result<Ohms> seen) noexcept;
    void armOnCapture(Instant now) noexcept;

    /// Ends the arming without success; `reason` is the interlock's. Requires active().
    void refuse(const char* reason, Error error) noexcept;
    /// Ends it for a stop.
    void stop() noexcept;
    void finish(Result<void> result) noexcept;

private:
    void armWithoutCheck(Instant now) noexcept;
    void armOnImpedance(ArmingEvidence evidence, Instant at) noexcept;

    SafetyGate& gate_;
    Interlock& interlock_;
    ArmedLoad& load_;
    std::optional<ArmCommand> command_;
    bool checkPosted_ = false;
    bool checkRead_ = false;                 // the device has reported, the capture has not come
    std::optional<Result<Ohms>> confirmed_;  // the load that the capture showed

    std::mutex resultMutex_;
    std::optional<Result<void>> result_;
};

}  // namespace tacto
