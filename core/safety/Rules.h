// Rules.h - internal: names every rule of the gate, the interlock, the heartbeat and the train's read-back, and
// evaluates tables of rules.
//
// The refusals are in constexpr tables, in order: a rule's name, its test, its sentence. firstBroken() evaluates a
// table; no other code asks whether a rule is in force. The mutation test disables one rule at a time and expects a
// failing test; in the product inForce() is the constant true and costs nothing.
//
// A new rule gets its own name here. The tests do not build until the name is in their table
// (tests/safety/CheckNames.h), and fail until one case is refused by this rule alone, or with its words. A refusal
// outside the tables makes EveryRefusalHasItsRule fail, and so does a second rule of the same name.
//
// Thread-safety: pure functions. Nothing allocates unless a rule is broken.
#pragma once

#ifdef TACTO_GATE_MUTATION
#include <atomic>
#endif

#include "core/base/Result.h"
#include "core/safety/LimitSet.h"

namespace tacto::gate {

enum Check : int {
    // configure()
    NoLimitSet,
    BadLimitRow,
    BadCeiling,
    LoosenedCeiling,
    TooManyLimits,
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
    PersonCap,
    PersonImpedanceBounds,
    PersonVoltageSource,
    PersonMonophasicCheck,
    PersonCalibration,
    PersonVibrationLimit,
    PersonVibrationStep,
    BadCalibration,
    // updateImpedance()
    ImpedanceValue,
    ImpedanceFromFuture,
    ImpedanceOutOfRange,
    ImpedanceJump,
    // approve()
    MoreThanProgrammed,
    LevelMoreThanProgrammed,
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
    IntervalMayBeBelowTrain,
    OnsetAhead,
    CheckOnsetAhead,
    ImpedanceRejected,
    PersonMonophasic,
    PersonNoImpedance,
    PersonStaleImpedance,
    PersonBeyondAmplitude,
    PersonBeyondWidth,
    PersonBeyondInterval,
    PersonLevel,
    CheckDiscomfort,
    // Accepted levels
    LevelOfPerson,
    DiscomfortOfPerson,
    LevelMalformed,
    LevelInVolts,
    LevelDiscomfort,
    LevelCap,
    LevelRamp,
    LevelAccept,
    DiscomfortValue,
    // approve() of a vibration
    BurstIntensity,
    BurstDuration,
    BurstAtElectrodes,
    BurstDiscomfort,
    BurstRamp,
    IntensityOfPerson,
    IntensityMalformed,
    IntensityAccept,
    IntensityDiscomfort,
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
    ResetSeen,
    ResetGrave,
    // Train check
    TrainNoStatus,
    TrainGarbage,
    TrainOpen,
    TrainShort,
    TrainNetCharge,
    TrainStuckOn,
    TrainStatusLate,
    TrainNeverRead,
    TrainReadEarly,
    // Heartbeat
    HeartSilent,
    HeartNever,
    HeartLate,
    kNamedChecks,
    // From here one per quantity: a row of a limit set or a ceiling, for the request alone and with the meter
    RequestLimit = 200,
    RequestCeiling = 220,
    MeterLimit = 240,
    MeterCeiling = 260,
};
static_assert(kNamedChecks < RequestLimit && kQuantityCount <= 20);

[[nodiscard]] constexpr int limitCheck(Check base, Quantity q) noexcept { return base + static_cast<int>(q); }

#ifdef TACTO_GATE_MUTATION
inline std::atomic<int> removedRule{-1};
[[nodiscard]] inline bool inForce(int id) noexcept { return id != removedRule.load(); }
#else
[[nodiscard]] constexpr bool inForce(int) noexcept { return true; }
#endif

/// Refuses an `Input` with a sentence.
template <class Input>
struct Rule {
    int id;
    bool (*broken)(const Input&);
    tl::unexpected<Error> (*sentence)(const Input&);
};

/// Refuses an `Input` without a message.
template <class Input>
struct Condition {
    int id;
    bool (*broken)(const Input&) noexcept;
};

/// An action on which a limit depends, and which must therefore be done.
template <class Input>
struct Duty {
    int id;
    void (*fulfil)(Input&) noexcept;
};

/// Returns the first rule of a table that `input` breaks; null if none. The elements of a table need an id and a
/// predicate `broken`.
template <class AnyRule, std::size_t N, class Input>
[[nodiscard]] constexpr const AnyRule* firstBroken(const AnyRule (&rules)[N], const Input& input) {
    for (const AnyRule& rule : rules) {
        if (inForce(rule.id) && rule.broken(input)) return &rule;
    }
    return nullptr;
}

/// Returns success, or the error of the first broken rule.
template <std::size_t N, class Input>
[[nodiscard]] Result<void> judge(const Rule<Input> (&rules)[N], const Input& input) {
    if (const auto* broken = firstBroken(rules, input)) return broken->sentence(input);
    return {};
}

template <std::size_t N, class Input>
void fulfil(const Duty<Input> (&duties)[N], Input& input) noexcept {
    for (const auto& duty : duties) {
        if (inForce(duty.id)) duty.fulfil(input);
    }
}

}  // namespace tacto::gate
