// SourceTraits.h - the driver's description of its stimulator's output: the gate judges, rounding calculates and the
// bench plans with it. Constant while the device is open.
//
// Thread-safety: values.
#pragma once

#include <optional>

#include "core/encoding/PulseTrain.h"
#include "core/encoding/Rounding.h"
#include "core/encoding/StimulatorCalibration.h"

namespace tacto {

/// How far the output may differ from the programmed value, as the maker or the driver's document states it. Nothing:
/// not stated; then ± 5 % is assumed (kUnknownSpread).
struct StatedAccuracy {
    std::optional<Spread> amplitude{};   ///< V or mA
    std::optional<Spread> phaseWidth{};  ///< s
    std::optional<Spread> gap{};         ///< s
    std::optional<Spread> interval{};    ///< s
    std::optional<Spread> rate{};        ///< Hz, of the pulses within a train; no calibration measures it
    /// The accuracy of an ideal source.
    [[nodiscard]] static StatedAccuracy exact() noexcept { return {Spread{}, Spread{}, Spread{}, Spread{}, Spread{}}; }
};

/// The longest train of a source without a dead-man switch: nothing ends such a train if the program is gone.
inline constexpr Seconds kLongestWithoutDeadMan{2};

struct SourceTraits {
    Drive drive = Drive::Voltage;        ///< Voltage or Current; never HighImpedance
    GapState gap = GapState::HoldsZero;  ///< its state between the phases, and after the pulse
    double amplitudeStep = 0;            ///< V or mA by `drive`; 0 = continuous
    double amplitudeMax = 0;             ///< V or mA by `drive`
    Volts compliance{0};                 ///< largest voltage the output can reach
    Milliamps currentLimit{0};           ///< largest current the output can reach; 0 = not stated
    Micros widthStep{1};
    Micros widthMin{10};
    Micros widthMax{4000};
    int pulsesMax = 1000;
    Seconds deadMan{0};           ///< the output stops by itself this long after the last keep-alive; 0 = never
    bool readsBack = true;        ///< status() reports open, short and impedance after each train
    Milliamps checkCurrent{0.5};  ///< amplitude of the impedance check on a current source
    Volts checkVoltage{1};        ///< the check pulse's voltage, on a voltage source
    StatedAccuracy accuracy;
};

// A train in the unit of the source, and the grid to which core/encoding rounds the train.

/// Returns `shape` with `amplitude`: in mA for a current source, in V for any other.
[[nodiscard]] inline PulseTrain trainAt(PulseTrain shape, Drive drive, double amplitude) noexcept {
    if (drive == Drive::Current) {
        shape.amplitude = Milliamps(amplitude);
    } else {
        shape.amplitude = Volts(amplitude);
    }
    return shape;
}

[[nodiscard]] inline DeviceGrid gridOf(const SourceTraits& source) noexcept {
    return {.amplitudeStep = source.amplitudeStep,
            .amplitudeMax = source.amplitudeMax,
            .widthStep = source.widthStep,
            .widthMin = source.widthMin,
            .widthMax = source.widthMax,
            .pulsesMax = source.pulsesMax};
}

}  // namespace tacto
