// SourceTraits.h - what a driver declares about its stimulator's output: the gate judges with it, the
// rounding uses it, the bench plans by it. Constant while the device is open.
//
// Thread-safety: values.
#pragma once

#include <optional>

#include "core/encoding/PulseTrain.h"
#include "core/encoding/Rounding.h"
#include "core/encoding/StimulatorCalibration.h"

namespace tacto {

/// How far the output may be from the programmed value, as the maker or the driver's document states it. Nothing: not
/// stated, and ± 5 % is judged (kUnknownSpread).
struct StatedAccuracy {
    std::optional<Spread> amplitude{};   ///< V or mA
    std::optional<Spread> phaseWidth{};  ///< s
    std::optional<Spread> gap{};         ///< s
    std::optional<Spread> interval{};    ///< s
    std::optional<Spread> rate{};        ///< Hz, of the pulses within a train; no calibration measures it
    /// The accuracy of an ideal source.
    [[nodiscard]] static StatedAccuracy exact() noexcept { return {Spread{}, Spread{}, Spread{}, Spread{}, Spread{}}; }
};

/// The longest train of a source without a dead-man: nothing ends it when the program is gone.
inline constexpr Seconds kLongestWithoutDeadMan{2};

struct SourceTraits {
    Drive drive = Drive::Voltage;        ///< Voltage or Current; never HighImpedance
    GapState gap = GapState::HoldsZero;  ///< what it does between phases, and after the pulse
    double amplitudeStep = 0;            ///< V or mA by `drive`; 0 = continuous
    double amplitudeMax = 0;             ///< V or mA by `drive`
    Volts compliance{0};                 ///< largest voltage the output can reach
    Milliamps currentLimit{0};           ///< largest current the output can reach; 0 = not stated
    Micros widthStep{1};
    Micros widthMin{10};
    Micros widthMax{4000};
    int pulsesMax = 1000;
    Seconds deadMan{0};           ///< output stops by itself this long after the last keep-alive; 0 = none
    bool readsBack = true;        ///< status() reports open, short and impedance after each train
    Milliamps checkCurrent{0.5};  ///< amplitude of the impedance check on a current source
    Volts checkVoltage{1};        ///< the check pulse's voltage, on a voltage source
    StatedAccuracy accuracy;
};

// A train in the unit of a source, and the grid of the source that core/encoding rounds it to.

/// `shape` at `amplitude`: mA of a current source, V of any other.
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
