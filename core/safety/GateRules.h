// GateRules.h - internal: the gate's rules for its setup and for trains; SafetyGate.cpp applies them in order.
//
// Thread-safety: pure functions. Nothing allocates while a train is permitted; a refusal allocates its message.
#pragma once

#include <array>
#include <span>
#include <string>
#include <vector>

#include "core/safety/GateSetup.h"
#include "core/safety/TrainExposure.h"

namespace tacto::gate {

struct State;
struct JudgedTrain;

inline constexpr Instant kApprovalLife = std::chrono::milliseconds(100);

/// Rounding of decimal numbers in binary, too small for any device to notice.
inline constexpr double kRounding = 1e-9;

/// SetupRules.cpp. Errors: InvalidArgument naming the missing or impossible value.
[[nodiscard]] Result<void> checkSetup(const GateSetup& setup);

/// A requested train and the gate's state.
struct AskedTrain {
    const State& state;
    const PulseTrain& train;
    Seconds interval;
    Instant onset;
    Instant now;
};

// TrainRules.cpp.
/// Checks form, source and grid, but no limits. Errors: InvalidArgument.
[[nodiscard]] Result<void> checkRequest(const PulseTrain& train, Seconds interval, const SourceTraits& source);
/// Checks what the person, the impedance and the calibration permit. Errors: InvalidArgument, LimitExceeded.
[[nodiscard]] Result<void> checkAsked(const AskedTrain& asked);
/// Checks a requested impedance check.
[[nodiscard]] Result<void> checkAskedCheck(const AskedTrain& asked);
/// Checks the train's times as they may come out, and that the unit's past is known. Errors: as checkAsked().
[[nodiscard]] Result<void> checkTimes(const AskedTrain& asked);
/// Checks that the meter has room for another train.
[[nodiscard]] Result<void> checkMeter(const State& state);

// LimitRules.cpp.
/// One limit row or ceiling, prepared for comparison.
struct ActiveLimit {
    LimitRow row;
    FixedText<31> set;
    bool ceiling = false;
};
/// Returns every row of every set, in order, then the ceilings.
[[nodiscard]] std::vector<ActiveLimit> activeLimits(const GateSetup& setup);
/// True if `value` keeps the row; a computed command (I·|Z|, or through a calibration) may exceed "≤" by rounding.
[[nodiscard]] bool keepsLimit(const LimitRow& row, double value, bool commandComputed) noexcept;
/// Checks every limit for the train alone, then with the trains before it, and notes the nearest. Errors: LimitExceeded
/// naming the first broken limit: "RMS current over 5 s would be 14.1 mA in the worst case (11.3 mA into 100 ohm);
/// paper allows less than 10 mA (...)".
[[nodiscard]] Result<void> checkLimits(const State& state, JudgedTrain& train, Instant now);

/// Returns NaN without an area.
[[nodiscard]] double areaOf(const GateSetup& setup) noexcept;

/// TrainExposure.cpp: makes one line of a table; not evaluated if the row needs an area that is not known.
[[nodiscard]] ExposureRow rowOf(const ActiveLimit& limit, double value, bool areaKnown, bool commandComputed) noexcept;
/// Shown in every table, without a limit if no set or ceiling has one.
inline constexpr std::array kShown{Quantity::NetCharge, Quantity::RmsCurrentTrain, Quantity::RmsCurrent1s};
[[nodiscard]] ExposureRow shownRow(Quantity quantity, double value) noexcept;
[[nodiscard]] bool hasRow(std::span<const ExposureRow> rows, Quantity quantity) noexcept;

}  // namespace tacto::gate
