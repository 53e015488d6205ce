// VibrationWatch.h - measures what a massager does during a presentation, if the bench's sensor has an accelerometer
// that is fastened to the massager's motor.
//
// The program does not know where a sensor is fastened. A board that lies next to the motor measures bursts without
// motion, and the result says this. Without a sensor nothing is measured.
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
    /// `bench` must outlive every call, but may end before this object does.
    explicit VibrationWatch(Bench& bench);
    VibrationWatch(const VibrationWatch&) = delete;
    VibrationWatch& operator=(const VibrationWatch&) = delete;

    /// Whether the bench has an accelerometer and a massager.
    [[nodiscard]] bool canLook() const noexcept { return stream_.has_value(); }
    /// begin() forgets old samples and keeps new ones until end(), which must always follow. Both do nothing if
    /// canLook() is false.
    void begin();
    void end();
    /// Takes the samples that have arrived. Call this at least every two seconds, or samples are lost.
    void look();
    /// Returns the measured bursts. Returns nothing if canLook() is false, for an empty presentation, or if no quiet
    /// time before the presentation was measured.
    [[nodiscard]] std::optional<BurstFigures> measured(const Presented& presented) const;

private:
    Bench& bench_;
    std::unique_ptr<BenchTap> tap_;
    std::optional<std::uint32_t> stream_;
    std::vector<AccelerationSample> samples_;
};

}  // namespace tacto
