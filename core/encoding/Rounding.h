// Rounding.h - fits a train to what a device can set, before it is judged.
//
// Toward zero, so that rounding never adds exposure; and never by more than 10 %, so that what is delivered is still
// what was asked for. What a calibration programs is a correction of that: it goes to the nearest step, so that what
// comes out is at most half a step short. The gate then judges the rounded train, and the rounding is recorded with it.
//
// Thread-safety: pure functions. Success does not allocate.
#pragma once

#include "core/encoding/PulseTrain.h"

namespace tacto {

/// What a device can set. A step of 0 is continuous.
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
    /// The share by which each value shrank: 0 = untouched, 0.1 at most, below 0 where it grew.
    double amplitude = 0;
    double phaseWidth = 0;
    double gap = 0;
    double pulses = 0;
    [[nodiscard]] bool changed() const noexcept { return amplitude != 0 || phaseWidth != 0 || gap != 0 || pulses != 0; }
};

/// `value` moved toward zero onto a multiple of `step`; what lies within a billionth of a step below a multiple counts
/// as on it (0.3 / 0.1 is 2.9999999999999996).
[[nodiscard]] double towardZero(double value, double step) noexcept;

/// `value` moved onto the nearest multiple of `step`.
[[nodiscard]] double toNearest(double value, double step) noexcept;

enum class RoundedTo {
    Zero,     ///< what was asked for
    Nearest,  ///< what a calibration has corrected
};

/// Errors: InvalidArgument as validate(); Unsupported naming the value, and what the device can set, when it is below
/// the device's smallest or would be rounded by more than 10 %.
[[nodiscard]] Result<RoundedTrain> roundToDevice(const PulseTrain& wanted, const DeviceGrid& grid,
                                                 RoundedTo to = RoundedTo::Zero);

}  // namespace tacto
