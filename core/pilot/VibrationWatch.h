// VibrationWatch.h - what a massager really did while something was presented, where the bench's sensor has an
// accelerometer that is fastened to its motor.
//
// The program does not know where a sensor is fastened. A board that lies beside the motor measures bursts in which
// nothing moves, and this is said; without a sensor nothing is measured.
#pragma once

#include <memory>
#include <optional>
#include <vector>

#include "core/analysis/vibration/BurstFigures.h"
#include "core/bench/Bench.h"
#include "core/bench/sensing/BenchTap.h"

namespace tacto {

class VibrationWatch {
public:
    /// `bench` outlives every call, and may end before this does.
    explicit VibrationWatch(Bench& bench);
    VibrationWatch(const VibrationWatch&) = delete;
    VibrationWatch& operator=(const VibrationWatch&) = delete;

    /// Whether there is an accelerometer to look at, and a massager.
    [[nodiscard]] bool canLook() const noexcept { return stream_.has_value(); }
    /// Forgets what was seen; from now on samples are kept, until end(), which always follows. Neither does anything
    /// where it cannot look.
    void begin();
    void end();
    /// Takes what has come: at least once in two seconds, or samples are missing.
    void look();
    /// The bursts that were seen. Nothing where it cannot look, for an empty presentation, and where the quiet before
    /// it was not seen.
    [[nodiscard]] std::optional<BurstFigures> measured(const Presented& presented) const;

private:
    Bench& bench_;
    std::unique_ptr<BenchTap> tap_;
    std::optional<std::uint32_t> stream_;
    std::vector<AccelerationSample> samples_;
};

}  // namespace tacto
