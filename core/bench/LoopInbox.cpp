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

namespace {

Result<void> tell(SafetyGate& gate, const LevelRequest& request) {
    const auto* intensity = std::get_if<VibrationIntensity>(&request.level);
    switch (request.what) {
        case LevelRequest::What::Accept:
            return intensity != nullptr ? gate.acceptIntensity(intensity->value) : gate.accept(request.train);
        case LevelRequest::What::Discomfort:
            return intensity != nullptr ? gate.reportUncomfortable(intensity->value)
                                        : gate.reportDiscomfort(std::get<Milliamps>(request.level));
        case LevelRequest::What::BeginAscending:
            gate.beginAscending();
            return {};
        case LevelRequest::What::EndAscending:
            gate.endAscending();
            return {};
        case LevelRequest::What::Ceiling:
            return {};
    }
    return {};
}

/// Returns nothing before the first arming in person mode.
std::optional<StimulusLevel> ceilingOf(const SafetyGate& gate, const LevelRequest& request) {
    if (std::holds_alternative<VibrationIntensity>(request.level)) {
        const auto intensity = gate.intensityCeiling();
        return intensity ? std::optional<StimulusLevel>(VibrationIntensity{*intensity}) : std::nullopt;
    }
    const auto current = gate.levelCeiling(request.train);
    return current ? std::optional<StimulusLevel>(*current) : std::nullopt;
}

Result<StimulusLevel> answerOf(SafetyGate& gate, const LevelRequest& request) {
    if (!ceilingOf(gate, request))
        return fail(ErrorCode::NotArmed, "levels of a person are known from the first arming in person mode on");
    if (auto told = tell(gate, request); !told) return failure(told);
    return *ceilingOf(gate, request);
}

}  // namespace

void LevelRequests::ask(const LevelRequest& request) {
    const std::scoped_lock lock(mutex_);
    request_ = request;
    answer_.reset();
    asked_.store(true, std::memory_order_release);
}

std::optional<Result<StimulusLevel>> LevelRequests::answer() {
    const std::scoped_lock lock(mutex_);
    return std::exchange(answer_, std::nullopt);
}

void LevelRequests::serve(SafetyGate& gate) noexcept {
    if (!asked_.load(std::memory_order_acquire)) return;
    const std::unique_lock lock(mutex_, std::try_to_lock);
    if (!lock) return;
    asked_.store(false, std::memory_order_release);
    if (const auto request = std::exchange(request_, std::nullopt)) answer_ = answerOf(gate, *request);
}

}  // namespace tacto
