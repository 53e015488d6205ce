#include "app/gui/scope/model/TriggerCrossing.h"

#include <algorithm>
#include <cmath>
#include <optional>

namespace tacto::gui {

namespace {

constexpr double kCrossingReach =
    1;  ///< samples: what an oscilloscope knows of its trigger without looking between them
constexpr double kSameMoment = 1e-3;  ///< share of a sample

/// Where |signal| rises through `level` nearest to `stated`, in samples from the record's begin.
std::optional<double> crossingNear(const std::vector<float>& samples, double level, double stated) {
    std::optional<double> nearest;
    const double size = static_cast<double>(samples.size());
    const auto first = static_cast<std::size_t>(std::clamp(std::floor(stated) - kCrossingReach, 0.0, size));
    const auto last = static_cast<std::size_t>(std::clamp(std::ceil(stated) + kCrossingReach, -1.0, size - 1) + 1);
    for (std::size_t i = first + 1; i < last; ++i) {
        const auto before = static_cast<double>(samples[i - 1]), after = static_cast<double>(samples[i]);
        if (!(std::abs(before) < level) || !(std::abs(after) >= level)) continue;
        const double at = static_cast<double>(i - 1) + (std::copysign(level, after) - before) / (after - before);
        if (!nearest || std::abs(at - stated) < std::abs(*nearest - stated)) nearest = at;
    }
    return nearest;
}

}  // namespace

std::shared_ptr<const Capture> triggeredAtCrossing(std::shared_ptr<const Capture> capture,
                                                   const ScopeSettings& settings) {
    if (!std::isfinite(capture->trigger_s) || !(settings.triggerLevel > 0)) return capture;
    const auto* unit = settings.triggerOnCurrent ? "A" : "V";
    const auto source = std::find_if(capture->channels.begin(), capture->channels.end(),
                                     [unit](const CaptureChannel& channel) { return channel.unit == unit; });
    if (source == capture->channels.end()) return capture;
    const double stated = (capture->trigger_s - capture->start_s) * capture->rate_hz;
    const auto at = crossingNear(source->samples, settings.triggerLevel, stated);
    if (!at || std::abs(*at - stated) > kCrossingReach || std::abs(*at - stated) < kSameMoment) return capture;
    auto moved = std::make_shared<Capture>(*capture);
    moved->trigger_s = moved->start_s + *at / moved->rate_hz;
    return moved;
}

}  // namespace tacto::gui
