#include "core/bench/arming/CheckCapture.h"

#include <algorithm>
#include <cmath>
#include <optional>

namespace tacto {

namespace {
constexpr double kCheckRecord = 4;  // length of the record, in lengths of the pulse
}

CheckCapture::CheckCapture(ScopeSession& scope, BenchTime& time, ControlLoop& loop, const ArmCommand& command)
    : scope_(scope),
      time_(time),
      loop_(loop),
      check_(checkTrainOf(command.setup)),
      ohm_(command.declared.value_or(Ohms(1000)).value()) {}

ScopeSettings CheckCapture::settings() const {
    const double volts = siValue(check_.amplitude) * (isCurrent(check_.amplitude) ? ohm_ : 1);
    const auto& traits = scope_.device().traits();
    ScopeSettings settings;
    settings.sampleRate = std::min(settings.sampleRate, traits.maxRate);
    const double wanted = std::ceil(kCheckRecord * check_.pulseDuration().count() * settings.sampleRate.value());
    settings.samples = std::clamp<std::size_t>(static_cast<std::size_t>(wanted), 1, traits.memoryDepth);
    settings.preTrigger = 0.3;
    settings.triggerLevel = 0.3 * volts;
    settings.voltageRange = Volts(2 * volts);
    settings.currentRange = Milliamps(4e3 * volts / ohm_);  // shows a load far below the declared one, too
    return settings;
}

Result<void> CheckCapture::begin() {
    scope_.request(settings(), time_.now(), 1);
    const auto waiting =
        time_.advance(time_.now() + toInstant(kTimeout), [this] { return scope_.waiting() || scope_.failed(); });
    if (!waiting) return failure(waiting);
    if (const auto taken = scope_.take(); !taken) {
        return fail(ErrorCode::NotArmed, "not armed: the oscilloscope that confirms the check pulse failed: {}",
                    taken.error().message);
    }
    if (*waiting) return {};
    return fail(ErrorCode::NotArmed, "not armed: the oscilloscope that confirms the check pulse is not ready");
}

bool CheckCapture::passOn() {
    if (scope_.ready() == 0 && !scope_.failed()) return false;
    const auto taken = scope_.take();
    loop_.confirmCheck(taken ? loadConfirmedBy(taken->front(), check_) : Result<Ohms>(failure(taken)));
    return true;
}

}  // namespace tacto
