#include "core/bench/CaptureLoad.h"

#include <algorithm>
#include <cmath>

#include "core/measure/LoadMeasurement.h"

namespace tacto {

namespace {

/// Below this a current is not told from none (the limit of the load-safety check too).
constexpr double kFewestSteps = 10;

/// The least that |Z| can be where `current` stays within its channel's last steps.
std::optional<Ohms> leastImpedance(const Capture& capture, std::size_t voltage, const CaptureChannel& current) {
    const double visible = kFewestSteps * current.lsb;
    if (!(visible > 0) || current.samples.empty()) return std::nullopt;
    const auto [low, high] = std::minmax_element(current.samples.begin(), current.samples.end());
    const double swing = static_cast<double>(*high) - static_cast<double>(*low);
    if (!(swing < visible)) return std::nullopt;
    const double amplitude = measureChannel(capture, voltage).amplitude.mean;
    if (!(amplitude > 0)) return std::nullopt;
    return Ohms(amplitude / visible);
}

}  // namespace

std::optional<SeenLoad> loadSeenIn(const Capture& capture) {
    if (capture.untriggered || !std::isfinite(capture.trigger_s)) return std::nullopt;
    const auto channels = loadChannels(capture);
    if (!channels) return std::nullopt;
    const Instant at = toInstant(Seconds(capture.trigger_s));
    const auto load = measureLoad(capture, channels->first, channels->second);
    if (load && load->load_ohm.mean > 0) return SeenLoad{Ohms(load->load_ohm.mean), false, at};
    const auto least = leastImpedance(capture, channels->first, capture.channels[channels->second]);
    if (!least) return std::nullopt;
    return SeenLoad{*least, true, at};
}

}  // namespace tacto
