// TrainPlanner.h - from a wanted roughness and pressure to the next approved train: encode, schedule, round, and let
// the gate judge.
//
// Thread-safety: none; the control loop owns it. Does not allocate when a train is approved.
#pragma once

#include <optional>

#include "core/devices/EncodingSensor.h"
#include "core/encoding/Encoder.h"
#include "core/encoding/Rounding.h"
#include "core/encoding/StimulatorCalibration.h"
#include "core/encoding/TrainSeries.h"
#include "core/safety/SafetyGate.h"

namespace tacto {

struct PlannedTrain {
    ApprovedTrain approved;
    Instant onset;
    Command command;        ///< the command in volts
    Volts held;             ///< the command's amplitude, adapted to this impedance
    RoundedTrain rounding;  ///< how far rounding to the device's step moved the amplitude
    double expected;        ///< the command rounded to the device's step: V or mA that should come out
};

/// A train at a level on the device's own grid, without encoding.
struct PlannedLevel {
    ApprovedTrain approved;
    Instant onset;
    double expected;  ///< amplitude that should come out, mA
};

struct PlannedBurst {
    ApprovedBurst approved;
    Instant onset;
    Command command;  ///< the command in volts
};

class TrainPlanner {
public:
    /// `profile` has passed validate(); `gate` outlives the planner. With a `calibration`, trains are programmed so
    /// that the command comes out; the gate must use the same calibration.
    TrainPlanner(const EncodingProfile& profile, const SourceTraits& source, SafetyGate& gate,
                 const KnownLines& calibration = {});

    /// Sets |Z| at arming: the reference of a profile that holds charge or energy, used as the load until a newer |Z|
    /// was measured.
    void armedOn(std::optional<Ohms> impedance) noexcept { armed_ = impedance; }

    /// Sets the wanted values from now on. Without a pressure, the longest interval is used. Errors: as
    /// Encoder::encode(); then nothing is wanted.
    [[nodiscard]] Result<void> want(double roughness, std::optional<double> pressure, Instant now);
    /// Wants this one train of the fingertip's board, in place of one that still waits, and none of the bench's own.
    void want(const EncodedTrain& train, Instant due) noexcept;
    /// Wants no train until the next want().
    void wantNothing() noexcept;

    /// Returns when the next train is due; nothing while none is wanted.
    [[nodiscard]] std::optional<Instant> due() const noexcept {
        return waiting_ ? std::optional(waiting_->due) : series_.due();
    }
    /// Returns the command of the next train; nothing while none is wanted.
    [[nodiscard]] const std::optional<Command>& command() const noexcept { return series_.command(); }

    /// Has the due train judged, for an onset at max(due, now). Approved or refused, the next follows one interval
    /// later, or when the board sends it. Errors: as heldAmplitude(), trainFor(), roundToDevice() and
    /// SafetyGate::approve(); LimitExceeded if the calibration changes the command by more than 20 % (hazard H1: it may
    /// be wrong), for a board's train that is not of the profile's form and range or further than 30 % from the bench's
    /// own for its command (H4), and for a step that the profile forbids (TrainSeries::follow()).
    [[nodiscard]] Result<PlannedTrain> plan(Instant now, std::optional<Ohms> impedance);

    /// Has a train at `level` judged for the given onset. Does not change what want() set. Errors: as levelTrain() and
    /// SafetyGate::approve().
    [[nodiscard]] Result<PlannedLevel> planLevel(Milliamps level, Seconds interval, Instant onset);

    /// Plans a burst for a massager: a vibration of A / A_max. Errors: as SafetyGate::approve().
    [[nodiscard]] Result<PlannedBurst> planBurst(Instant now);

    /// Returns the time that must be programmed so that `wanted` comes out.
    [[nodiscard]] Seconds programmed(Seconds wanted) const noexcept { return programmedFor(wanted, calibration_); }

private:
    struct Waiting {
        EncodedTrain train;
        Instant due{0};
    };
    [[nodiscard]] const Encoder& encoder() const noexcept { return series_.encoder(); }
    [[nodiscard]] Result<PlannedTrain> planWaiting(const Waiting& waiting, Instant now, std::optional<Ohms> impedance);
    [[nodiscard]] Result<PlannedTrain> approve(const Result<RoundedTrain>& rounded, const Command& command, Volts held,
                                               Instant onset);

    const SourceTraits source_;
    const KnownLines calibration_;
    SafetyGate& gate_;
    TrainSeries series_;  // the wanted trains, within the limits on a step
    std::optional<Ohms> armed_;
    std::optional<Waiting> waiting_;  // the board's train
};

/// Returns the train that is programmed so that `amplitude` comes out into `impedance`: corrected by the calibration,
/// and rounded to the device's step. What is predicted of a command is computed from this train, which plan() delivers.
/// Errors: as trainFor() and roundToDevice(); LimitExceeded if the calibration changes the command by more than 20 %.
[[nodiscard]] Result<RoundedTrain> programmedTrain(const EncodingProfile& profile, const SourceTraits& source,
                                                   const KnownLines& calibration, Volts amplitude,
                                                   std::optional<Ohms> impedance);

/// Returns the profile's train at a level that the device can set, with the amplitude unchanged, and phase width and
/// gap corrected by the calibration and rounded to the device's step. A person's accepted levels were found with this
/// kind of train. Errors: Unsupported for a voltage source; InvalidArgument for a level not above 0 or off the grid;
/// as roundToDevice().
[[nodiscard]] Result<PulseTrain> levelTrain(const EncodingProfile& profile, const SourceTraits& source,
                                            const KnownLines& calibration, Milliamps level);

}  // namespace tacto
