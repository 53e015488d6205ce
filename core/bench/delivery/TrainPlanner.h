// TrainPlanner.h - from a wanted roughness and pressure to the next approved train: encode, schedule, round,
// have it judged.
//
// Thread-safety: none; the control loop owns it. Does not allocate when a train is approved.
#pragma once

#include <optional>

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
    Volts held;             ///< the amplitude that it became on this impedance
    RoundedTrain rounding;  ///< how far the device's step took it from that
    double expected;        ///< amplitude that should come out, V or mA: the command, to the device's step
};

/// A train at a level of the device's own grid: nothing is encoded.
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
    /// `profile` has passed validate(); `gate` outlives the planner. With a `calibration` trains are programmed
    /// so that the command is delivered; the gate must know of the same one.
    TrainPlanner(const EncodingProfile& profile, const SourceTraits& source, SafetyGate& gate,
                 const KnownLines& calibration = {});

    /// |Z| when the output was armed: what a profile that holds charge or energy refers to, and takes until another
    /// was measured.
    void armedOn(std::optional<Ohms> impedance) noexcept { armed_ = impedance; }

    /// Sets the wish from now on. An absent pressure gives the longest interval. Errors: as Encoder::encode(); then
    /// nothing is wanted.
    [[nodiscard]] Result<void> want(double roughness, std::optional<double> pressure, Instant now);
    /// Wants no train until the next want().
    void wantNothing() noexcept;

    /// The time at which the next train is due; nothing while none is wanted.
    [[nodiscard]] std::optional<Instant> due() const noexcept { return series_.due(); }
    /// The command of the next train; nothing while none is wanted.
    [[nodiscard]] const std::optional<Command>& command() const noexcept { return series_.command(); }

    /// Has the due train judged, for an onset at max(due, now). Whether it is approved or refused, the next one is an
    /// interval later. Errors: as heldAmplitude(), trainFor(), roundToDevice() and SafetyGate::approve(); LimitExceeded
    /// where the calibration would program more than 20 % beside the command (hazard H1: it may be wrong).
    [[nodiscard]] Result<PlannedTrain> plan(Instant now, std::optional<Ohms> impedance);

    /// Has a train at `level` judged, for that onset. What is wanted by want() is not touched. Errors: as
    /// levelTrain() and SafetyGate::approve().
    [[nodiscard]] Result<PlannedLevel> planLevel(Milliamps level, Seconds interval, Instant onset);

    /// Plans a burst for a massager: a vibration of A / A_max. Errors: as SafetyGate::approve().
    [[nodiscard]] Result<PlannedBurst> planBurst(Instant now);

    /// A time as it must be kept so that it comes out as `wanted`.
    [[nodiscard]] Seconds programmed(Seconds wanted) const noexcept { return programmedFor(wanted, calibration_); }

private:
    [[nodiscard]] const Encoder& encoder() const noexcept { return series_.encoder(); }
    [[nodiscard]] Result<RoundedTrain> onGrid(PulseTrain programmed, double top) const;

    const SourceTraits source_;
    const KnownLines calibration_;
    SafetyGate& gate_;
    TrainSeries series_;  // the wanted trains, under the limits on a step
    std::optional<Ohms> armed_;
};

/// The profile's train at a level that the device can set: the amplitude is programmed as it is, phase width and gap as
/// the calibration says, to the device's step. It is the kind of train with which a person's accepted levels were
/// found. Errors: Unsupported for a voltage source; InvalidArgument for a level that is not above 0 and on the grid; as
/// roundToDevice().
[[nodiscard]] Result<PulseTrain> levelTrain(const EncodingProfile& profile, const SourceTraits& source,
                                            const KnownLines& calibration, Milliamps level);

}  // namespace tacto
