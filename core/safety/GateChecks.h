// GateChecks.h - internal: every check of the gate by name, so that the mutation test can take each away in turn and
// see a test fail. In the product checks() is the constant true and this header leaves no trace.
//
// A new check in the gate gets a name here; GateMutationTest then demands a case that only it refuses.
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
    BadSource,
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
    MeterFull,
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
    ImpedanceDisowned,
    PersonMonophasic,
    PersonNoImpedance,
    PersonStaleImpedance,
    PersonBeyondCalibration,
    PersonLevel,
    CheckDiscomfort,
    BurstIntensity,
    BurstDuration,
    // isCurrent()
    Epoch,
    Expiry,
    kNamedChecks,
    // One per quantity from here: a limit set's row or a ceiling, on the request alone and with the meter
    RequestLimit = 100,
    RequestCeiling = 120,
    MeterLimit = 140,
    MeterCeiling = 160,
};

[[nodiscard]] constexpr int limitCheck(Check base, Quantity q) noexcept { return base + static_cast<int>(q); }

#ifdef TACTO_GATE_MUTATION
inline std::atomic<int> skippedCheck{-1};
[[nodiscard]] inline bool checks(int check) noexcept { return check != skippedCheck.load(); }
#else
[[nodiscard]] constexpr bool checks(int) noexcept { return true; }
#endif

}  // namespace tacto::gate
