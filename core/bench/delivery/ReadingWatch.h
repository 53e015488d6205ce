// ReadingWatch.h - the reading of |Z| that delivery rests on: whether the stimulator's status is overdue, and when the
// reading grows old.
//
// Thread-safety: none; the control loop owns it.
#pragma once

#include <optional>

#include "core/bench/arming/ArmingSequence.h"
#include "core/bench/delivery/DeliveryJudge.h"
#include "core/bench/delivery/StimulatorSession.h"

namespace tacto {

class ReadingWatch {
public:
    /// All outlive the watch; the stimulator may be null.
    ReadingWatch(const StimulatorSession* stimulator, const ArmedLoad& load, const DeliveryJudge& judge) noexcept
        : stimulator_(stimulator), load_(load), judge_(judge) {}

    /// A train that ended and whose status has not come in time.
    [[nodiscard]] std::optional<LoopFault> silence(Instant now) const {
        if (stimulator_ == nullptr || stimulator_->idle()) return std::nullopt;
        return judge_.silence(stimulator_->trainEnd(), stimulator_->saysItDelivers(), now);
    }
    /// When the reading grows old; nothing where none is taken.
    [[nodiscard]] std::optional<Instant> until() const noexcept {
        if (stimulator_ == nullptr || !stimulator_->device().traits().readsBack) return std::nullopt;
        return load_.impedanceAt + Interlock::kImpedanceAge;
    }
    [[nodiscard]] bool isOld(Instant now) const noexcept {
        const auto end = until();
        return end && now > *end;
    }

private:
    const StimulatorSession* stimulator_;
    const ArmedLoad& load_;
    const DeliveryJudge& judge_;
};

}  // namespace tacto
