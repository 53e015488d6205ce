#include "core/bench/Telemetry.h"

#include "core/base/Printable.h"
#include "core/safety/TrainExposure.h"

namespace tacto {

Telemetry blinded(const Telemetry& telemetry) {
    Telemetry seen;
    seen.at = telemetry.at;
    // The output is on while a train is written, and armed in between and in an empty presentation.
    seen.state = telemetry.state == InterlockState::Delivering ? InterlockState::Armed : telemetry.state;
    if (seen.state != InterlockState::Armed) seen.reason = std::string_view(withoutNumbers(telemetry.reason.view()));
    seen.fault = telemetry.fault;
    seen.paused = telemetry.paused;
    seen.uncalibratedStimulator = telemetry.uncalibratedStimulator;
    for (const auto& row : telemetry.exposure()) {
        if (!forbids(row)) continue;
        ExposureRow broken = row;
        broken.value = broken.limit;  // it is not known how far beyond
        seen.exposureRows[seen.exposureCount++] = broken;
    }
    return seen;
}

}  // namespace tacto
