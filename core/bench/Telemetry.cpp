#include "core/bench/Telemetry.h"

#include "core/base/Printable.h"
#include "core/safety/TrainExposure.h"

namespace tacto {

Telemetry blinded(const Telemetry& telemetry) {
    Telemetry seen;
    seen.at = telemetry.at;
    // It delivers while a train is written, and is armed in between and in an empty presentation.
    seen.state = telemetry.state == InterlockState::Delivering ? InterlockState::Armed : telemetry.state;
    if (seen.state != InterlockState::Armed) seen.reason = std::string_view(withoutNumbers(telemetry.reason.view()));
    seen.fault = telemetry.fault;
    seen.paused = telemetry.paused;
    seen.uncalibratedStimulator = telemetry.uncalibratedStimulator;
    for (const auto& row : telemetry.exposure()) {
        if (!forbids(row)) continue;
        ExposureRow broken = row;
        broken.value = broken.limit;  // not how far
        seen.exposureRows[seen.exposureCount++] = broken;
    }
    return seen;
}

}  // namespace tacto
