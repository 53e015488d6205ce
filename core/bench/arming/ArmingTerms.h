// ArmingTerms.h - on which terms the output is armed into a load: what the gate judges every train by, the evidence
// that arming needs, and the text that the operator has to have confirmed.
//
// Thread-safety: one caller, the bench's.
#pragma once

#include <string>

#include "core/bench/Bench.h"
#include "core/bench/BenchNotes.h"
#include "core/bench/arming/ArmingSequence.h"
#include "core/bench/delivery/BenchOutput.h"

namespace tacto {

// The known calibration of the stimulator, and whether it is applied: every train is judged by the known one, and
// programmed by the applied one.

class BenchCalibration {
public:
    /// `config` outlives this.
    explicit BenchCalibration(const BenchConfig& config)
        : config_(config), applied_(config.calibrationHolds ? config.calibration : std::nullopt) {}

    /// Whether a calibration is known, and holds.
    [[nodiscard]] bool held() const noexcept { return config_.calibration && config_.calibrationHolds; }
    /// Nothing while the calibration is left aside.
    [[nodiscard]] const KnownLines& applied() const noexcept { return applied_; }
    /// Takes it up, where it holds, or leaves it aside. False where that changes nothing.
    [[nodiscard]] bool apply(bool wanted);
    /// Errors: NotArmed in person mode, after the last day on which it holds.
    [[nodiscard]] Result<void> checkDate() const;
    /// Notes the applied calibration for the session.
    void note(const BenchNotes& notes) const;

private:
    const BenchConfig& config_;
    KnownLines applied_;
};

class ArmingTerms {
public:
    /// All arguments outlive this; they are asked each time, since profile and calibration change.
    ArmingTerms(const BenchConfig& config, const BenchOutput& output, const BenchCalibration& calibration) noexcept
        : config_(config), output_(output), calibration_(calibration) {}

    [[nodiscard]] GateSetup setupFor(const Load& load) const;
    /// The text that the operator confirms (CommandPreview.h); empty without an output.
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

// Which devices a participant, human or virtual, may be stimulated with, and what replaces a
// calibration there.

/// Errors: InvalidArgument for a virtual participant on a device, and for a human being on a simulation outside a
/// rehearsal; with one sentence.
[[nodiscard]] Result<void> checkWhere(const BenchConfig& config);

/// In person mode a simulated stimulator without a known calibration states its own. Nothing else is changed, and no
/// other device is asked.
[[nodiscard]] BenchConfig withStatedCalibration(BenchConfig config);

}  // namespace tacto
