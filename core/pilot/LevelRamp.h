// LevelRamp.h - the levels that a participant accepted, and the ramp over which they are reached again, step by step,
// after electrodes may have been touched.
//
// Errors of all calls: as PilotStage.
//
// Thread-safety: one caller, the session's thread.
#pragma once

#include <limits>
#include <map>
#include <optional>
#include <string>

#include "core/base/Result.h"

namespace tacto {

class PilotStage;

class LevelRamp {
public:
    /// `stage` outlives it. `due`: the levels were accepted in an earlier part.
    LevelRamp(PilotStage& stage, bool due) : stage_(stage), due_(due) {}

    /// As PilotStage::judged().
    [[nodiscard]] Result<void> judged(double level, bool tooStrong, const std::string& trial, bool replayed);
    /// As PilotStage::settle().
    void settle(double level) noexcept { settled_ = level; }

    /// Levels are reached again before anything is presented.
    void becomeDue() noexcept { due_ = true; }
    /// Presents each accepted level that was not too strong, from the weakest up, while the participant holds; where
    /// that is not due, does nothing. One that is too strong now ends the session.
    [[nodiscard]] Result<void> reach();

private:
    [[nodiscard]] Result<void> presentAgain(const std::string& name, double level, const std::string& first);

    PilotStage& stage_;
    bool due_;
    std::map<double, std::string> accepted_;                      // Level and the trial in which it was accepted first
    double tooStrong_ = std::numeric_limits<double>::infinity();  // Lowest so far
    std::optional<double> settled_;
};

}  // namespace tacto
