#include "core/bench/Telemetry.h"

#include "core/base/Printable.h"
#include "core/safety/TrainExposure.h"

namespace tacto {

Telemetry blinded(const Telemetry& telemetry) {
    Telemetry seen;
    seen.at = telemetry.at;
    // Delivering shows as Armed: otherwise the display would tell a train from an empty presentation.
    seen.state = telemetry.state == InterlockState::Delivering ? InterlockState::Armed : telemetry.state;
    if (seen.state != InterlockState::Armed) seen.reason = std::string_view(withoutNumbers(telemetry.reason.view()));
    seen.fault = telemetry.fault;
    seen.grave = telemetry.grave;
    seen.causesCame = telemetry.causesCame;
    seen.paused = telemetry.paused;
    seen.uncalibratedStimulator = telemetry.uncalibratedStimulator;
    for (const auto& row : telemetry.exposure()) {
        if (!forbids(row)) continue;
        ExposureRow broken = row;
        broken.value = broken.limit;  // shows the limit itself, to hide how far the value is beyond it
        seen.exposureRows[seen.exposureCount++] = broken;
    }
    return seen;
}

}  // namespace tacto
