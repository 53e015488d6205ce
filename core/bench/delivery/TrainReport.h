// TrainReport.h - the result of one train: made by the stimulator's session, judged by the control loop.
//
// Thread-safety: values.
#pragma once

#include <cmath>

#include "core/base/Result.h"
#include "core/base/Units.h"
#include "core/devices/Stimulator.h"
#include "core/safety/FixedText.h"

namespace tacto {

enum class TrainOutcome {
    Delivered,   ///< delivered, and the device's status was read afterwards
    Voided,      ///< a stop, a new configuration or expiry voided the approval; nothing was written
    Failed,      ///< the device refused, vanished or did not answer; it was switched off
    LoopSilent,  ///< no train: the control loop was silent for 100 ms and the output was switched off
};

/// Trivially copyable, because it passes between threads in a ring.
struct TrainReport {
    TrainOutcome outcome = TrainOutcome::Voided;
    bool isCheck = false;          ///< true for an impedance check
    Instant onset{0};              ///< when the train was written
    Instant end{0};                ///< end of the train's last pulse
    bool stillDelivering = false;  ///< the device's answer when its status was read
    double amplitude = 0;          ///< V or mA, as delivered
    double measured = NAN;         ///< the value that the device read back; NaN if it does not read back
    double interval_s = 0;         ///< the interval for which it was approved
    PulseTrain train{};            ///< all programmed values, as approved; unused for a massager
    Instant approvedUntil{0};      ///< when the approval would have expired
    ElectrodeState electrode = ElectrodeState::NotMeasured;
    double impedance_ohm = NAN;
    double imbalance = NAN;
    double imbalanceUncertainty = NAN;
    Instant statusAt{0};
    FixedText<160> error;                ///< empty unless Failed
    ErrorCode code = ErrorCode::Device;  ///< the code of `error`

    void fail(const Error& why) noexcept {
        outcome = TrainOutcome::Failed;
        error = std::string_view(why.message);
        code = why.code;
    }
};

}  // namespace tacto
