// ArmingSequence.h - from the operator's second step to Armed: configures the gate, has the check pulse approved, and
// arms the interlock if the check pulse, an oscilloscope or the operator's word confirms the load.
//
// The control loop posts the check pulse and passes on the report about it; any error disarms.
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
    ArmingEvidence evidence;  ///< the check pulse adds its impedance
    /// |Z| of the declared load, if captures will show the load and the stimulator cannot. A profile that holds charge
    /// or energy refers to this value.
    std::optional<Ohms> declared{};
    StopMark asked = {};  ///< when the operator gave the order to arm
    /// True if the source does not read back and an oscilloscope can see the pulse. The check pulse is then delivered,
    /// and confirm() decides whether the output is armed.
    bool confirmByCapture = false;
};

/// The load into which the output was armed, as measured then and since.
struct ArmedLoad {
    std::optional<Ohms> reference;  ///< |Z| when the output was armed; a profile that holds charge refers to it
    Instant armedAt{0};
    Instant leftAt{0};  ///< until then the output was not disarmed, or not for longer than one step
    Ohms high{0};       ///< upper end of the range that was declared when arming
    std::optional<Ohms> impedance;
    Instant impedanceAt{0};
};

class ArmingSequence {
public:
    /// All arguments outlive the sequence, which writes the armed load to `load`.
    ArmingSequence(SafetyGate& gate, Interlock& interlock, ArmedLoad& load) noexcept
        : gate_(gate), interlock_(interlock), load_(load) {}

    /// Announces a new arming, which has no result yet.
    void expect();
    /// Returns nothing while arming continues, then success or the reason for failure. Can be taken once.
    [[nodiscard]] std::optional<Result<void>> result();

    void begin(ArmCommand command) noexcept;
    [[nodiscard]] bool active() const noexcept { return command_.has_value(); }
    /// True if the check pulse must still be posted: the caller then calls checkPulse().
    [[nodiscard]] bool checkDue() const noexcept { return command_ && !checkPosted_; }
    /// Returns the approved check pulse, to be posted now. Returns nothing if this call ended the arming: nothing can
    /// measure this load, or the load is refused. If `hasStimulator` is false, a massager is armed.
    [[nodiscard]] std::optional<ApprovedTrain> checkPulse(Instant now, bool hasStimulator) noexcept;
    /// Takes the device's report on a sound check pulse.
    void checkRead(const TrainReport& report) noexcept;
    /// Takes the oscilloscope's view of the check pulse; armed only after the device has reported, too.
    void confirm(Result<Ohms> seen) noexcept;
    void armOnCapture(Instant now) noexcept;

    /// Ends the arming without success; the interlock gets `reason`. Requires active().
    void refuse(const char* reason, Error error) noexcept;
    /// Ends the arming because of a stop.
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
    bool checkRead_ = false;                 // true once the device has reported and while the capture is missing
    std::optional<Result<Ohms>> confirmed_;  // the load that the capture showed

    std::mutex resultMutex_;
    std::optional<Result<void>> result_;
};

}  // namespace tacto
