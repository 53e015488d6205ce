#include "core/pilot/PilotSettings.h"

#include <cmath>

namespace tacto {

std::vector<PresentedCondition> presentedConditions(const PilotSettings& settings, double min, double max,
                                                    double step) {
    std::vector<PresentedCondition> out;
    const bool swapped = settings.assignment == Assignment::Swapped;
    for (const auto& condition : settings.conditions) {
        const double x = swapped ? condition.P : condition.R, y = swapped ? condition.R : condition.P;
        const double level = x == 0 ? min : x == 1 ? max : std::round((min + x * (max - min)) / step) * step;
        const auto interval = settings.longest + y * (settings.shortest - settings.longest);
        out.push_back({condition.name, level, y == 0 ? settings.longest : y == 1 ? settings.shortest : interval});
    }
    return out;
}

}  // namespace tacto
