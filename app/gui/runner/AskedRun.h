// AskedRun.h - a run that the operator has asked for but not yet confirmed: the first of two steps to start output.
#pragma once

#include <QElapsedTimer>
#include <optional>
#include <utility>

#include "app/gui/controller/BenchController.h"

namespace tacto::gui {

class AskedRun {
public:
    void ask(RunOrder order, StopMark at) {
        order_ = std::move(order);
        at_ = at;
        since_.start();
    }
    void withdraw() { order_.reset(); }
    [[nodiscard]] bool waits() const { return order_.has_value(); }
    /// Returns the order; call this only while the run waits.
    [[nodiscard]] const RunOrder& order() const { return *order_; }
    /// True if the first step no longer holds: the output was stopped since, or too much time has passed.
    [[nodiscard]] bool isVoid(const BenchController& controller) const {
        return controller.stoppedSince(at_) || since_.nsecsElapsed() > Interlock::kConfirmWithin.count();
    }
    /// Starts the run on `controller`, unless the output was stopped since the run was asked for. Returns the run's
    /// number. Call this only while the run waits.
    std::uint64_t start(BenchController& controller) {
        return controller.run(*std::exchange(order_, std::nullopt), at_);
    }

private:
    std::optional<RunOrder> order_;
    StopMark at_;
    QElapsedTimer since_;
};

}  // namespace tacto::gui
