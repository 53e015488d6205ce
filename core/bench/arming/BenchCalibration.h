// BenchCalibration.h - the calibration of the stimulator that is known, and whether it is applied: every train is
// judged by the one that is known, and programmed by the one that is applied.
//
// Thread-safety: one caller, the bench's; held() any thread.
#pragma once

#include "core/bench/Bench.h"
#include "core/bench/BenchNotes.h"

namespace tacto {

class BenchCalibration {
public:
    /// `config` outlives this.
    explicit BenchCalibration(const BenchConfig& config)
        : config_(config), applied_(config.calibrationHolds ? config.calibration : std::nullopt) {}

    /// One is known, and holds.
    [[nodiscard]] bool held() const noexcept { return config_.calibration && config_.calibrationHolds; }
    /// Nothing while it is left aside.
    [[nodiscard]] const KnownLines& applied() const noexcept { return applied_; }
    /// Takes it up, where it holds, or leaves it aside. False where that changes nothing.
    [[nodiscard]] bool apply(bool wanted);
    /// Errors: NotArmed in person mode, after the last day on which it holds.
    [[nodiscard]] Result<void> checkDate() const;
    /// What is applied, for the session.
    void note(const BenchNotes& notes) const;

private:
    const BenchConfig& config_;
    KnownLines applied_;
};

}  // namespace tacto
