#include "core/bench/LoopInbox.h"

#include <cmath>
#include <utility>

namespace tacto {

template <class Put>
void LoopInbox::put(Put into) {
    const std::scoped_lock lock(mutex_);
    into(settings_);
    full_.store(true, std::memory_order_release);
}

void LoopInbox::arm(ArmCommand command) {
    put([&](Settings& s) { s.arm = std::move(command); });
}

void LoopInbox::drive(const DriveCommand& command) {
    put([&](Settings& s) { s.drive = command; });
}

void LoopInbox::present(Presentation presentation) {
    put([&](Settings& s) { s.presentation = std::move(presentation); });
}

void LoopInbox::finger(NextFinger next) {
    put([&](Settings& s) {
        if (s.finger) next.before = s.finger->before;
        s.finger = std::move(next);
    });
}

void LoopInbox::planner(std::unique_ptr<TrainPlanner> next) {
    put([&](Settings& s) { s.planner = std::move(next); });
}

void LoopInbox::confirm(const Result<Ohms>& seen) {
    put([&](Settings& s) { s.confirmed = seen; });
}

void LoopInbox::load(const SeenLoad& seen) {
    put([&](Settings& s) { s.load = seen; });
}

void LoopInbox::amplitude(const SeenAmplitude& seen) {
    const auto off = [](const SeenAmplitude& one) { return std::abs(one.amplitude / one.expected - 1); };
    put([&](Settings& s) {
        if (std::isnan(seen.expected)) {
            if (!s.unasked || seen.amplitude > s.unasked->amplitude) s.unasked = seen;
        } else if (!s.amplitude || off(seen) > off(*s.amplitude)) {
            s.amplitude = seen;
        }
    });
}

std::optional<LoopInbox::Settings> LoopInbox::take() noexcept {
    if (!full_.load(std::memory_order_acquire)) return std::nullopt;
    const std::unique_lock lock(mutex_, std::try_to_lock);
    if (!lock) return std::nullopt;
    full_.store(false, std::memory_order_release);
    return std::exchange(settings_, {});
}

std::optional<NextFinger> LoopInbox::takeFinger() noexcept {
    const std::scoped_lock lock(mutex_);
    return std::exchange(settings_.finger, std::nullopt);
}

}  // namespace tacto
