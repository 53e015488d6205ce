// TrainCheck.h - judges what a stimulator reads back after a train; only a good answer releases the next (H3, H5).
//
// Thread-safety: pure functions; nothing allocates.
#pragma once

#include <optional>

#include "core/safety/FixedText.h"
#include "core/safety/GateSetup.h"
#include "core/safety/Interlock.h"

namespace tacto {

enum class ElectrodeReading { NotMeasured, Ok, Open, Short };

/// A stimulator's status in plain values, read after a train.
struct TrainReadBack {
    Instant at{0};            ///< when the status was read
    bool delivering = false;  ///< the device says that a train is still in progress
    ElectrodeReading electrode = ElectrodeReading::NotMeasured;
    std::optional<double> imbalance;             ///< |net charge| / phase charge, tail included
    std::optional<double> imbalanceUncertainty;  ///< uncertainty of the imbalance, 95 %
};

enum class TrainFinding {
    Pending,        ///< no status yet, and the 50 ms have not passed
    Ok,             ///< the next train is released
    Open,           ///< output stops before the next train
    Short,          ///< output stops before the next train
    NetCharge,      ///< person mode: over 1 % of phase charge, beyond its uncertainty: fault
    StatusMissing,  ///< no status came within 50 ms after the train: fault
    StuckOn,        ///< still delivering 50 ms after the train's end: fault
    Garbage,        ///< impossible values (NaN, negative): fault
};
[[nodiscard]] std::string_view nameOf(TrainFinding finding) noexcept;

/// The live display of the imbalance: green < 1 %, amber < 10 %, red ≥ 10 %, grey if not evaluated.
enum class ChargeBalance { NotEvaluated, Green, Amber, Red };
[[nodiscard]] std::string_view nameOf(ChargeBalance balance) noexcept;

struct TrainJudgement {
    TrainFinding finding = TrainFinding::Pending;
    ChargeBalance balance = ChargeBalance::NotEvaluated;
    FixedText<159> reason;  ///< one sentence; empty if Ok or Pending
    /// True if output must go off now.
    [[nodiscard]] bool stops() const noexcept {
        return finding != TrainFinding::Ok && finding != TrainFinding::Pending;
    }
};

inline constexpr Instant kStatusDeadline = std::chrono::milliseconds(50);
inline constexpr double kNetChargeLimit = 0.01;         ///< as a share of the phase charge
inline constexpr double kNetChargeUncertainty = 0.005;  ///< with a larger uncertainty, the net charge is not evaluated

/// Judges `status`, the newest read-back or nothing; `trainEnd` is when the train ended. A status read earlier shows
/// open and short, but does not release the next train. The bench does not call this for a device that cannot read
/// back.
[[nodiscard]] TrainJudgement judgeTrain(OutputMode mode, const std::optional<TrainReadBack>& status, Instant trainEnd,
                                        Instant now) noexcept;

/// Returns the fault for a finding that stops the output.
[[nodiscard]] FaultCause causeOf(TrainFinding finding) noexcept;

/// For display only. Without an uncertainty, or with one above 0.5 %, the result is not evaluated.
[[nodiscard]] ChargeBalance chargeBalance(const std::optional<double>& imbalance,
                                          const std::optional<double>& uncertainty) noexcept;

}  // namespace tacto
