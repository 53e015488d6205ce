// ArmingTerms.h - the terms on which the output is armed into a load: the values by which the gate judges every train,
// the evidence that arming needs, and the text that the operator must have confirmed.
//
// Thread-safety: one caller, the bench's.
#pragma once

#include <string>

#include "core/bench/Bench.h"
#include "core/bench/BenchNotes.h"
#include "core/bench/arming/ArmingSequence.h"
#include "core/bench/delivery/BenchOutput.h"
#include "core/devices/EncodingSensor.h"

namespace tacto {

// The known calibration of the stimulator, and whether it is applied: the gate judges every train with the known
// calibration; the planner programs trains with the applied one.

class BenchCalibration {
public:
    /// `config` outlives this object.
    explicit BenchCalibration(const BenchConfig& config)
        : config_(config), applied_(config.calibrationHolds ? config.calibration : std::nullopt) {}

    /// True if a calibration is known and holds.
    [[nodiscard]] bool held() const noexcept { return config_.calibration && config_.calibrationHolds; }
    /// Nothing while the calibration is not applied.
    [[nodiscard]] const KnownLines& applied() const noexcept { return applied_; }
    /// Applies the calibration, if it holds, or stops applying it. Returns false if that changes nothing.
    [[nodiscard]] bool apply(bool wanted);
    /// Errors: NotArmed in person mode after the calibration's last valid day.
    [[nodiscard]] Result<void> checkDate() const;
    /// Records the applied calibration in the session.
    void note(const BenchNotes& notes) const;

private:
    const BenchConfig& config_;
    KnownLines applied_;
};

class ArmingTerms {
public:
    /// All arguments outlive this; they are read at each call, because profile and calibration change.
    ArmingTerms(const BenchConfig& config, const BenchOutput& output, const BenchCalibration& calibration) noexcept
        : config_(config), output_(output), calibration_(calibration) {}

    [[nodiscard]] GateSetup setupFor(const Load& load) const;
    /// Returns the text that the operator confirms (CommandPreview.h); empty without an output.
    [[nodiscard]] std::string text(const Load& load) const;
    /// Errors: NotArmed unless the request confirms text(load); for a simulated output the confirmation may be empty.
    [[nodiscard]] Result<void> checkConfirmed(const ArmRequest& request, const Load& load) const;
    /// The encoder of the fingertip's board; nothing if it does not encode.
    [[nodiscard]] std::optional<BoardEncoder> boardEncoder() const noexcept;
    /// True if the trains of the fingertip's board are played while it drives.
    [[nodiscard]] bool boardDrives() const noexcept;
    /// Returns the profile that the board must have to encode for this load. Errors: NotArmed, naming what no board
    /// can do.
    [[nodiscard]] Result<BoardProfile> boardProfile(const Load& load) const;
    /// Checks that the trains of the board, if it drives, may be played into this load. Errors: NotArmed if this is a
    /// person, no stimulator is open, or the board has another profile than boardProfile().
    [[nodiscard]] Result<void> checkEncoder(const Load& load) const;
    /// Prepares the second step of arming, for the order given at `asked`.
    [[nodiscard]] ArmCommand commandFor(const ArmRequest& request, const Load& load, StopMark asked) const;

private:
    const BenchConfig& config_;
    const BenchOutput& output_;
    const BenchCalibration& calibration_;
};

// Checks which devices may stimulate a participant, human or virtual, and what replaces a missing calibration.

/// Errors, in one sentence: InvalidArgument for a virtual participant on a real device, and for a human being on a
/// simulated device outside a rehearsal.
[[nodiscard]] Result<void> checkWhere(const BenchConfig& config);

/// In person mode, gives a simulated stimulator without a known calibration the calibration that it states itself.
/// Changes nothing else and asks no other device.
[[nodiscard]] BenchConfig withStatedCalibration(BenchConfig config);

}  // namespace tacto
