// ArmingTerms.h - on which terms the output is armed into a load: what the gate judges every train by, the evidence
// that arming needs, and the text that the operator has to have confirmed.
//
// Thread-safety: one caller, the bench's.
#pragma once

#include <string>

#include "core/bench/Bench.h"
#include "core/bench/arming/ArmingSequence.h"
#include "core/bench/arming/BenchCalibration.h"
#include "core/bench/delivery/BenchOutput.h"

namespace tacto {

class ArmingTerms {
public:
    /// All outlive this; they are asked each time, since profile and calibration change.
    ArmingTerms(const BenchConfig& config, const BenchOutput& output, const BenchCalibration& calibration) noexcept
        : config_(config), output_(output), calibration_(calibration) {}

    [[nodiscard]] GateSetup setupFor(const Load& load) const;
    /// What the operator confirms (ArmingText.h); empty without an output.
    [[nodiscard]] std::string text(const Load& load) const;
    /// Errors: NotArmed unless the request confirms that text; for a simulated output it may confirm none.
    [[nodiscard]] Result<void> checkConfirmed(const ArmRequest& request, const Load& load) const;
    /// The second step of arming, for the order that was given at `asked`.
    [[nodiscard]] ArmCommand commandFor(const ArmRequest& request, const Load& load, StopMark asked) const;

private:
    const BenchConfig& config_;
    const BenchOutput& output_;
    const BenchCalibration& calibration_;
};

}  // namespace tacto
