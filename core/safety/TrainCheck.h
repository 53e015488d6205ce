// TrainCheck.h - judges what a stimulator reads back after a train; only a good answer releases the next one (H3, H5).
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
    Instant at{0};            ///< when the device was read
    bool delivering = false;  ///< the device says that a train is still in progress
    ElectrodeReading electrode = ElectrodeReading::NotMeasured;
    std::optional<double> imbalance;             ///< |net charge| / phase charge, tail included
    std::optional<double> imbalanceUncertainty;  ///< the uncertainty of the imbalance, 95 %
};

enum class TrainFinding {
    Pending,        ///< there is no status yet, and its 50 ms are not over
    Ok,             ///< the next train is released
    Open,           ///< output stops before the next train
    Short,          ///< output stops before the next train
    NetCharge,      ///< person mode: above 1 % of phase charge beyond its uncertainty: fault
    StatusMissing,  ///< no status came within 50 ms after the train: fault
    StuckOn,        ///< still delivering 50 ms after the train's end: fault
    Garbage,        ///< values that no measurement gives (NaN, negative): fault
};
[[nodiscard]] std::string_view nameOf(TrainFinding finding) noexcept;

/// The live imbalance display: green < 1 %, amber < 10 %, red ≥ 10 %, grey when not evaluated.
enum class ChargeBalance { NotEvaluated, Green, Amber, Red };
[[nodiscard]] std::string_view nameOf(ChargeBalance balance) noexcept;

struct TrainJudgement {
    TrainFinding finding = TrainFinding::Pending;
    ChargeBalance balance = ChargeBalance::NotEvaluated;
    FixedText<159> reason;  ///< one sentence unless Ok or Pending
    /// True when output must go off now.
    [[nodiscard]] bool stops() const noexcept {
        return finding != TrainFinding::Ok && finding != TrainFinding::Pending;
    }
};

inline constexpr Instant kStatusDeadline = std::chrono::milliseconds(50);
inline constexpr double kNetChargeLimit = 0.01;         ///< share of phase charge
inline constexpr double kNetChargeUncertainty = 0.005;  ///< above it the net charge reads not evaluated

/// `status` is the newest read-back, or nothing; `trainEnd` when the train ended; `now` when this is asked. A status
/// read before the train's end shows open and short, but does not release. A device that cannot read back is
/// not judged here: the bench skips the rule where there is no status.
[[nodiscard]] TrainJudgement judgeTrain(OutputMode mode, const std::optional<TrainReadBack>& status, Instant trainEnd,
                                        Instant now) noexcept;

/// The fault that a finding is: of one that stops.
[[nodiscard]] FaultCause causeOf(TrainFinding finding) noexcept;

/// The display alone. An uncertainty that is missing or above 0.5 % reads not evaluated.
[[nodiscard]] ChargeBalance chargeBalance(const std::optional<double>& imbalance,
                                          const std::optional<double>& uncertainty) noexcept;

}  // namespace tacto
