#include "drivers/simulated/World.h"

namespace tacto::sim {

Result<void> CircuitFitter::fitLoad(std::string_view load) {
    const auto parsed = parseLoad(load);
    if (!parsed) return failure(parsed);
    world_->circuit().fit(*parsed, world_->clock().now());
    return {};
}

}  // namespace tacto::sim
