#include "core/devices/ScopeRange.h"

namespace tacto {

Result<void> checkScopeRange(const ScopeSettings& settings, const ScopeTraits& traits) {
    const double rate = settings.sampleRate.value(), most = traits.maxRate.value();
    if (!(rate >= kMinScopeRate_hz) || !(rate <= most))
        return invalid("oscilloscope sample rate {} Hz: {} to {} Hz", rate, kMinScopeRate_hz, most);
    if (settings.samples < 2 || settings.samples > traits.memoryDepth)
        return invalid("oscilloscope record of {} samples: 2 to {}", settings.samples, traits.memoryDepth);
    if (!(settings.preTrigger >= 0) || !(settings.preTrigger <= 1))
        return invalid("oscilloscope pre-trigger {}; 0 to 1 is accepted", settings.preTrigger);
    const double volts = settings.voltageRange.value(), amps = settings.currentRange.value() * 1e-3;
    if (!(volts > 0) || !(volts <= kMaxScopeRange_V))
        return invalid("oscilloscope voltage range {} V: above 0, at most {} V", volts, kMaxScopeRange_V);
    if (!(amps > 0) || !(amps <= kMaxScopeRange_A))
        return invalid("oscilloscope current range {} A: above 0, at most {} A", amps, kMaxScopeRange_A);
    const double level = settings.triggerLevel, range = settings.triggerOnCurrent ? amps : volts;
    if (!(level > 0) || !(level <= range)) {
        return invalid("oscilloscope trigger level {} {}: above 0, at most the range of {}", level,
                       settings.triggerOnCurrent ? "A" : "V", range);
    }
    return {};
}

}  // namespace tacto
