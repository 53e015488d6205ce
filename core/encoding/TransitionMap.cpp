#include "core/encoding/TransitionMap.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace tacto {

Result<TransitionMap> mapOf(const std::vector<TransitionStep>& steps, int cells) {
    if (cells < 2 || cells > 101) return fail(ErrorCode::InvalidArgument, "{} cells are not 2 to 101", cells);
    const auto n = static_cast<std::size_t>(cells);
    const std::vector<std::vector<double>> nothing(n, std::vector<double>(n, std::numeric_limits<double>::quiet_NaN()));
    TransitionMap map{nothing, nothing};
    const auto cellOf = [cells](double x) {
        return static_cast<std::size_t>(std::lround(std::clamp(x, 0.0, 1.0) * (cells - 1)));
    };
    for (const auto& step : steps) {
        for (std::size_t p = cellOf(step.way.lowP); p <= cellOf(step.way.highP); ++p) {
            for (std::size_t r = cellOf(step.way.lowR); r <= cellOf(step.way.highR); ++r) {
                map.amplitude[p][r] = std::fmax(map.amplitude[p][r], step.amplitude);  // fmax passes NaN over
                map.interval[p][r] = std::fmax(map.interval[p][r], step.interval);
            }
        }
    }
    return map;
}

}  // namespace tacto
