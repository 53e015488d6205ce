// GateChecks.h - internal: every check of the gate, the interlock, the heartbeat and the train's read-back by name, so
// that the mutation test can take each away in turn and see a test fail. In the product checks() is the constant true
// and this header leaves no trace.
//
// A new check gets a name here; the tests do not build until it stands in their table (tests/safety/CheckNames.h), and
// fail until there is a case that only it refuses. A refusal that asks for no check fails EveryRefusalHasItsCheck.
#pragma once

#include <array>
#include <string_view>

#ifdef TACTO_GATE_MUTATION
#include <atomic>
#endif

#include "core/safety/Quantity.h"

namespace tacto::gate {

enum Check : int {
    // configure()
    NoLimitSet,
    BadLimitRow,
    BadCeiling,
    LoosenedCeiling,
    SourceDrive,
    SourceAmplitudeMax,
    SourceAmplitudeStep,
    SourceWidths,
    SourcePulses,
    SourceCompliance,
    SourceCurrentLimit,
    SourceNoCompliance,
    SourceAccuracy,
    BadLoad,
    BadArea,
    BadCheckTrain,
    PersonMissing,
    PersonConsent,
    PersonPseudonym,
    PersonArea,
    PersonDiscomfort,
    PersonRampStep,
    PersonImpedanceBounds,
    PersonVoltageSource,
    PersonMonophasicCheck,
    PersonCalibration,
    BadCalibration,
    // updateImpedance()
    ImpedanceValue,
    ImpedanceFromFuture,
    ImpedanceOutOfRange,
    ImpedanceJump,
    // approve()
    MoreThanTold,
    Uncertainty,
    PulseBeyondPeriod,
    LongWithoutDeadMan,
    PastUnknown,
    MeterFull,
    MeterBooking,
    RecordBooking,
    MalformedTrain,
    SourceKind,
    AmplitudeMax,
    AmplitudeGrid,
    WidthRange,
    WidthGrid,
    GapGrid,
    PulsesMax,
    IntervalValue,
    IntervalBelowTrain,
    OnsetAhead,
    ImpedanceRejected,
    PersonMonophasic,
    PersonNoImpedance,
    PersonStaleImpedance,
    PersonBeyondCalibration,
    PersonLevel,
    CheckDiscomfort,
    // Accepted levels
    LevelOfPerson,
    LevelMalformed,
    LevelInVolts,
    LevelDiscomfort,
    LevelRamp,
    LevelAccept,
    DiscomfortValue,
    // approve() of a vibration
    BurstIntensity,
    BurstDuration,
    // isCurrent()
    Epoch,
    Expiry,
    // Interlock
    InterlockMove,
    ArmRequestState,
    ArmConfirmState,
    ArmTicket,
    ArmState,
    ArmLimits,
    ArmIdentity,
    ArmOperator,
    ArmImpedanceMissing,
    ArmImpedanceRange,
    ArmImpedanceAge,
    ResetState,
    ResetCause,
    // Train check
    TrainNoStatus,
    TrainGarbage,
    TrainOpen,
    TrainShort,
    TrainNetCharge,
    TrainStuckOn,
    TrainStatusLate,
    TrainReadEarly,
    // Heartbeat
    HeartSilent,
    HeartNever,
    HeartLate,
    kNamedChecks,
    // One per quantity from here: a limit set's row or a ceiling, on the request alone and with the meter
    RequestLimit = 200,
    RequestCeiling = 220,
    MeterLimit = 240,
    MeterCeiling = 260,
};
static_assert(kNamedChecks < RequestLimit && kQuantityCount <= 20);

[[nodiscard]] constexpr int limitCheck(Check base, Quantity q) noexcept { return base + static_cast<int>(q); }

#ifdef TACTO_GATE_MUTATION
inline std::atomic<int> skippedCheck{-1};
[[nodiscard]] inline bool checks(int check) noexcept { return check != skippedCheck.load(); }
#else
[[nodiscard]] constexpr bool checks(int) noexcept { return true; }
#endif

}  // namespace tacto::gate
