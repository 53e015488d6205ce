// Rounding.h - rounds a train to values that a device can set, before the gate judges it.
//
// Rounds toward zero, so that rounding never adds exposure, and by at most 10 %, so that the train remains the
// requested one. A value already corrected by a calibration is rounded to the nearest step, so that the output is at
// most half a step too low. The gate then judges the rounded train, and the rounding is recorded with it.
//
// Thread-safety: pure functions. A successful call does not allocate.
#pragma once

#include "core/encoding/PulseTrain.h"

namespace tacto {

/// The values that a device can set. A step of 0 means continuous.
struct DeviceGrid {
    double amplitudeStep = 0;  ///< V or mA, in the train's own unit
    double amplitudeMax = 0;   ///< V or mA
    Micros widthStep{0};       ///< step of the phase width and of the gap
    Micros widthMin{0};
    Micros widthMax{0};
    int pulsesMax = 1;
};

inline constexpr double kLargestRounding = 0.10;

struct RoundedTrain {
    PulseTrain train;
    /// Relative decrease of each value: 0 = unchanged, at most 0.1, negative if the value grew.
    double amplitude = 0;
    double phaseWidth = 0;
    double gap = 0;
    double pulses = 0;
    [[nodiscard]] bool changed() const noexcept { return amplitude != 0 || phaseWidth != 0 || gap != 0 || pulses != 0; }
};

/// Rounds `value` toward zero to a multiple of `step`. A value less than a billionth of a step below a multiple is
/// taken as that multiple (0.3 / 0.1 is 2.9999999999999996).
[[nodiscard]] double towardZero(double value, double step) noexcept;

/// Rounds `value` to the nearest multiple of `step`.
[[nodiscard]] double toNearest(double value, double step) noexcept;

enum class RoundedTo {
    Zero,     ///< for a requested value
    Nearest,  ///< for a value corrected by a calibration
};

/// Errors: InvalidArgument as validate(); Unsupported, naming the value and what the device can set, if the value is
/// below the device's smallest or would change by more than 10 %.
[[nodiscard]] Result<RoundedTrain> roundToDevice(const PulseTrain& wanted, const DeviceGrid& grid,
                                                 RoundedTo to = RoundedTo::Zero);

}  // namespace tacto
