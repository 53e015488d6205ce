// TrainReport.h - what became of one train: made by the stimulator's session, judged by the control loop.
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
    Voided,      ///< a stop, a new configuration or time took the approval back; nothing was written
    Failed,      ///< the device refused, went away or did not answer; it was switched off
    LoopSilent,  ///< no train: the control loop was silent for 100 ms and the output was switched off
};

/// Trivially copyable: it crosses threads in a ring.
struct TrainReport {
    TrainOutcome outcome = TrainOutcome::Voided;
    bool isCheck = false;          ///< the impedance check, not a train
    Instant onset{0};              ///< when the train was written
    Instant end{0};                ///< the end of its last pulse
    bool stillDelivering = false;  ///< the device's word when its status was read
    double amplitude = 0;          ///< V or mA, as delivered
    double measured = NAN;         ///< the value as the device read it back; NaN where it does not
    double interval_s = 0;         ///< the interval that it was approved for
    PulseTrain train{};            ///< all that was programmed, as approved; unused for a massager
    Instant approvedUntil{0};      ///< when the approval would have expired
    ElectrodeState electrode = ElectrodeState::NotMeasured;
    double impedance_ohm = NAN;
    double imbalance = NAN;
    double imbalanceUncertainty = NAN;
    Instant statusAt{0};
    FixedText<160> error;                ///< when Failed
    ErrorCode code = ErrorCode::Device;  ///< of `error`

    void fail(const Error& why) noexcept {
        outcome = TrainOutcome::Failed;
        error = std::string_view(why.message);
        code = why.code;
    }
};

}  // namespace tacto
