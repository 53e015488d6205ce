// AskedRun.h - a run that the operator asked for and has not confirmed: the first of the two steps that start output.
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
    /// The order, while it waits.
    [[nodiscard]] const RunOrder& order() const { return *order_; }
    /// The first step is void after a stop, and does not wait forever.
    [[nodiscard]] bool isVoid(const BenchController& controller) const {
        return controller.stoppedSince(at_) || since_.nsecsElapsed() > Interlock::kConfirmWithin.count();
    }
    /// Starts it on `controller`, unless a stop came since it was asked for. Returns the run's number. Only while it
    /// waits.
    std::uint64_t start(BenchController& controller) {
        return controller.run(*std::exchange(order_, std::nullopt), at_);
    }

private:
    std::optional<RunOrder> order_;
    StopMark at_;
    QElapsedTimer since_;
};

}  // namespace tacto::gui
