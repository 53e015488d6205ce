#include "core/bench/arming/FaultExit.h"

#include <optional>

namespace tacto {

/// Asks one device's session how its device is, and waits for the answer.
template <class Session>
Result<void> FaultExit::ask(Session& session, Role role, Instant within, const char* who) {
    static_cast<void>(session.health());  // an old answer
    session.askHealth();
    std::optional<Result<void>> answer;
    const Instant until = time_.now() + within;
    while (!(answer = session.health()) && time_.now() < until) time_.prompt(role);
    if (!answer) return fail(ErrorCode::NotArmed, "not reset: the {} does not answer", who);
    if (!*answer) return fail(ErrorCode::NotArmed, "not reset: {}", answer->error().message);
    return {};
}

/// What a device's session reported while the device was gone (a keep-alive that failed) belongs to the fault that is
/// being left; judged after the reset it would be the next one.
Result<void> FaultExit::letReportsBeJudged() {
    constexpr std::uint64_t kSteps = 2;  // one may be under way
    constexpr Instant kStepsTimeout = std::chrono::milliseconds(500);
    constexpr Instant kPollInterval = std::chrono::milliseconds(1);
    const auto begin = loop_.telemetry().steps;
    const Instant until = time_.now() + kStepsTimeout;
    while (loop_.telemetry().steps < begin + kSteps && time_.now() < until) time_.pass(until, kPollInterval);
    if (loop_.telemetry().steps >= begin + kSteps) return {};
    return fail(ErrorCode::NotArmed, "not reset: the control loop does not run");
}

Result<void> FaultExit::leave() {
    if (interlock_.state() != InterlockState::Faulted) return {};
    if (interlock_.causePersists(FaultCause::Internal)) {
        return fail(ErrorCode::NotArmed, "a fault of the program itself is not reset: {}. Restart the program",
                    interlock_.reason().view());
    }
    // A massager is not asked anything: the next burst shows whether it is there.
    if (auto* massager = output_.massager()) massager->forceOff();
    if (auto* stimulator = output_.stimulator()) {
        constexpr Instant kStimulatorTimeout = std::chrono::milliseconds(500);
        if (const auto well = ask(*stimulator, Role::Stimulator, kStimulatorTimeout, "stimulator"); !well) return well;
    }
    if (sensor_ != nullptr) {
        constexpr Instant kSensorTimeout = std::chrono::seconds(3);
        if (const auto well = ask(*sensor_, Role::Sensor, kSensorTimeout, "fingertip sensor"); !well) return well;
    }
    if (const auto judged = letReportsBeJudged(); !judged) return judged;
    for (int cause = 0; cause < kFaultCauseCount; ++cause) interlock_.causeGone(static_cast<FaultCause>(cause));
    return interlock_.reset();
}

}  // namespace tacto
