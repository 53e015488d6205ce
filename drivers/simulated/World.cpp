#include "drivers/simulated/World.h"

#include <cmath>

namespace tacto::sim {

Result<void> CircuitFitter::fitLoad(std::string_view load) {
    const auto parsed = parseLoad(load);
    if (!parsed) return failure(parsed);
    world_->circuit().fit(*parsed, world_->clock().now());
    return {};
}

Result<void> WorldReference::applyVoltage(double volts) {
    if (!(std::abs(volts) <= 500)) {
        return fail(ErrorCode::InvalidArgument, "the simulated reference source gives {} V; up to 500 V are accepted",
                    volts);
    }
    world_->setReference(volts);
    return {};
}

}  // namespace tacto::sim
