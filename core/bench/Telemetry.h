// Telemetry.h - what the bench is doing right now, for displays and scripts. The control loop publishes it, and readers
// need no lock: most values change once a step, the exposure table ten times a second and after each train.
#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>

#include "core/base/Units.h"
#include "core/dsp/RoughnessFlags.h"
#include "core/safety/FixedText.h"
#include "core/safety/Interlock.h"
#include "core/safety/LimitSet.h"

namespace tacto {

/// What drives the output: sets R (roughness) and P (pressure).
enum class DriveSource { Off, Manual, Sensor };

/// Whether the fingertip's values may drive the output (hazard H7).
enum class FingerStanding {
    None,         ///< no fingertip is open
    Fresh,        ///< values may drive the output
    Stale,        ///< values are old, or their time stamps lie in the future
    Implausible,  ///< values are not numbers, or are beyond the range of a fingertip
};

struct DriveCommand {
    DriveSource source = DriveSource::Off;
    double roughness = 0;  ///< 0..1, Manual only
    double pressure = 0;
};

/// The programmed values of a train or a check pulse, published before it is handed over.
struct ProgrammedTrain {
    Instant onset{0};           ///< as planned
    double amplitude = NAN;     ///< V or mA, depending on its drive; NaN: no train, or it was taken back
    double expected = NAN;      ///< the command rounded to the device's step: the value that should come out
    Instant from{0}, until{0};  ///< earliest and latest time of output; exact once the device has reported
    bool isCheck = false;
    bool acknowledged = false;  ///< true once the device has confirmed delivery
};

/// A train's amplitude as an instrument measured it, and the set value; V or mA, depending on the train's drive.
struct MeasuredOutput {
    const char* by = "";  ///< a literal: "the oscilloscope shows"
    Instant at{0};        ///< the train's onset
    double amplitude = NAN;
    double uncertainty = NAN;  ///< half-width
    double set = NAN;          ///< the value that should have come out
    double volts = NAN;        ///< `amplitude` as the commanded voltage A; NaN if |Z| is not known
    bool beyond = false;       ///< true if the stated accuracy of the source does not explain the difference
};

/// Trivially copyable; NaN means absent.
struct StepTelemetry {
    Instant at{0};
    InterlockState state = InterlockState::Disconnected;
    FixedText<200> reason;            ///< the reason for a fault or the last stop; otherwise empty
    std::optional<FaultCause> fault;  ///< nothing unless faulted, or if the cause is not known
    std::optional<FaultCause> grave;  ///< Interlock::grave(): only a safety check resets the fault
    std::uint64_t causesCame = 0;     ///< CausesCame::news of this bench, as of its last fault
    bool paused = false;
    DriveSource driving = DriveSource::Off;  ///< every stop, disarm and fault turns it off

    double roughness = NAN;  ///< R, 0..1
    double pressure = NAN;   ///< P, 0..1
    double h = NAN;          ///< spectral feature of the last frame
    double v = NAN;          ///< spatial feature of the last frame
    double pressure_pa = NAN;
    bool contact = false;
    bool sliding = false;
    RoughnessFlags flags;      ///< flags for R and P as shown now, and as they have driven the output
    double sensorAge_s = NAN;  ///< the newest sample's age
    FingerStanding finger = FingerStanding::None;
    bool sensorFinished = false;      ///< true if a replayed sensor has no more samples
    std::uint64_t slidingFrames = 0;  ///< number of frames with a spectral feature so far; sumH adds up that feature:
    double sumH = 0;                  ///< the difference of two readings gives the mean between them
    std::uint64_t contactFrames = 0;  ///< number of frames with the spatial feature
    double sumV = 0;

    bool boardDrives = false;     ///< true if the trains of the fingertip's board are played while it drives
    double boardRoughness = NAN;  ///< R and P as its encoder sees them, if it encodes
    double boardPressure = NAN;
    FixedText<200> boardSilent;  ///< why its encoder sends no train; empty: nothing keeps trains back

    double amplitude_v = NAN;  ///< the encoder's commanded voltage A
    double interval_s = NAN;   ///< the encoder's commanded interval T
    double intensity = NAN;    ///< intensity of the last burst, 0 to 1; only with a massager
    double nextTrain_s = NAN;  ///< time of the next train; NaN if none is pending

    double impedance_ohm = NAN;  ///< last measured |Z|
    double impedanceAge_s = NAN;
    double imbalance = NAN;             ///< |net charge| / phase charge of the last pulse
    double imbalanceUncertainty = NAN;  ///< uncertainty of the imbalance, 95 %

    bool uncalibratedStimulator = false;  ///< true if a stimulator is open that no valid calibration covers
    double trainAmplitude = NAN;          ///< programmed amplitude of the last train, V or mA depending on its drive
    std::array<ProgrammedTrain, 16> programmed{};  ///< the last trains, in any order; an empty place has no amplitude
    MeasuredOutput measured;                       ///< largest of the last 5 s, from trains since arming
    std::uint64_t trainsDelivered = 0;             ///< trains, or bursts of a massager
    std::uint64_t trainsRefused = 0;               ///< trains that the limits refused
    std::uint64_t trainsSkipped = 0;  ///< trains skipped because sensor data, or a board's trains, came late
    FixedText<200> lastRefusal;
    std::uint64_t samplesLost = 0;  ///< ring overflows since the start
    std::uint64_t gaps = 0;         ///< gaps found in the sensor streams
    std::uint64_t steps = 0;        ///< control-loop steps
};

/// The telemetry of a step, with the exposure table of the same step or a later step.
struct Telemetry : StepTelemetry {
    std::array<ExposureRow, kMaxExposureRows> exposureRows{};
    std::size_t exposureCount = 0;
    [[nodiscard]] std::span<const ExposureRow> exposure() const noexcept {
        return {exposureRows.data(), exposureCount};
    }
};

// What displays may show while the operator is blind.

/// Returns what is the same for every condition and level (hazard H9): whether the output is armed, paused, off or
/// faulted and why, and which limits are broken, without the train's numbers in a fault. Omits every train, level,
/// reading and age, because each of these appears or changes with a train.
[[nodiscard]] Telemetry blinded(const Telemetry& telemetry);

}  // namespace tacto
