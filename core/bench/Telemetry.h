// Telemetry.h - what the bench is doing right now, for displays and scripts. Published by the control loop, read
// without a lock: most of it once a step, the exposure table ten times a second and after each train.
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

/// The source of R and P.
enum class DriveSource { Off, Manual, Sensor };

/// Whether what the fingertip shows may drive the output (hazard H7).
enum class FingerStanding {
    None,         ///< no fingertip is open
    Fresh,        ///< it may
    Stale,        ///< old, or stamped ahead of time
    Implausible,  ///< values that are not numbers, or beyond what a fingertip can give
};

struct DriveCommand {
    DriveSource source = DriveSource::Off;
    double roughness = 0;  ///< 0..1, Manual only
    double pressure = 0;
};

/// The programmed values of a train or a check pulse: published before it is handed over.
struct ProgrammedTrain {
    Instant onset{0};           ///< as planned
    double amplitude = NAN;     ///< V or mA by its drive; NaN: there is none, or it was taken back
    double expected = NAN;      ///< the value that should come out: the command, to the device's step
    Instant from{0}, until{0};  ///< when it is put out: the earliest and latest time, until the device has reported it
    bool isCheck = false;
    bool acknowledged = false;  ///< the device said that it was delivered
};

/// An instrument's view of a train, beside what was set; V or mA by its drive.
struct MeasuredOutput {
    const char* by = "";  ///< a literal: "the oscilloscope shows"
    Instant at{0};        ///< the train's onset
    double amplitude = NAN;
    double uncertainty = NAN;  ///< half-width
    double set = NAN;          ///< the value that should have come out
    double volts = NAN;        ///< `amplitude` as the commanded voltage A; NaN where |Z| is not known
    bool beyond = false;       ///< the source's stated accuracy does not explain it
};

/// Trivially copyable; NaN means absent.
struct StepTelemetry {
    Instant at{0};
    InterlockState state = InterlockState::Disconnected;
    FixedText<200> reason;            ///< why a fault or the last stop came; otherwise empty
    std::optional<FaultCause> fault;  ///< nothing unless faulted, or where the cause is not known
    bool paused = false;
    DriveSource driving = DriveSource::Off;  ///< every stop, disarm and fault turns it off

    double roughness = NAN;  ///< R, 0..1
    double pressure = NAN;   ///< P, 0..1
    double h = NAN;          ///< spectral feature of the last frame
    double v = NAN;          ///< spatial feature of the last frame
    double pressure_pa = NAN;
    bool contact = false;
    bool sliding = false;
    RoughnessFlags flags;      ///< flags for R and P, both as shown now and as they have driven the output
    double sensorAge_s = NAN;  ///< the newest sample's age
    FingerStanding finger = FingerStanding::None;
    bool sensorFinished = false;      ///< a replayed sensor has no more samples
    std::uint64_t slidingFrames = 0;  ///< frames with a spectral feature so far, and the sum of it:
    double sumH = 0;                  ///< the difference of two readings gives the mean between them
    std::uint64_t contactFrames = 0;  ///< counts frames with the spatial feature
    double sumV = 0;

    double amplitude_v = NAN;  ///< command A of the encoder
    double interval_s = NAN;   ///< command T of the encoder
    double intensity = NAN;    ///< the last burst's, 0 to 1, with a massager in place of the electrodes
    double nextTrain_s = NAN;  ///< due time; NaN when none is pending

    double impedance_ohm = NAN;  ///< last measured |Z|
    double impedanceAge_s = NAN;
    double imbalance = NAN;             ///< the last pulse's |net charge| / phase charge
    double imbalanceUncertainty = NAN;  ///< its uncertainty, 95 %

    bool uncalibratedStimulator = false;  ///< a stimulator is open, and no calibration of it holds
    double trainAmplitude = NAN;          ///< the programmed amplitude of the last train, V or mA by its drive
    std::array<ProgrammedTrain, 16>
        programmed{};                   ///< the last trains, in no order; those that are not there have no amplitude
    MeasuredOutput measured;            ///< the largest of the last 5 s, of trains since the output was armed
    std::uint64_t trainsDelivered = 0;  ///< or bursts
    std::uint64_t trainsRefused = 0;    ///< trains that the limits refused
    std::uint64_t trainsSkipped = 0;    ///< trains skipped because sensor data were stale or missing
    FixedText<200> lastRefusal;
    std::uint64_t samplesLost = 0;  ///< ring overflows since the start
    std::uint64_t gaps = 0;         ///< found in the sensor streams
    std::uint64_t steps = 0;        ///< control-loop steps
};

/// The telemetry with the exposure table of that step or of a later one.
struct Telemetry : StepTelemetry {
    std::array<ExposureRow, kMaxExposureRows> exposureRows{};
    std::size_t exposureCount = 0;
    [[nodiscard]] std::span<const ExposureRow> exposure() const noexcept {
        return {exposureRows.data(), exposureCount};
    }
};

// The part of a bench that displays may know while the operator is blind.

/// The same for every condition and level (hazard H9): whether the output is armed, paused, off or faulted and why, and
/// which limits are broken, without the numbers that a fault has of its train. It has no train, level, reading or age,
/// for each of them comes or changes with a train.
[[nodiscard]] Telemetry blinded(const Telemetry& telemetry);

}  // namespace tacto
