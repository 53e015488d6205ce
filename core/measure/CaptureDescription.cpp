#include "core/measure/CaptureDescription.h"

#include <algorithm>
#include <cmath>

#include "core/base/JsonFields.h"

namespace tacto {

namespace {

using nlohmann::json;

constexpr std::string_view kMark = "# tactoscope {";
constexpr std::string_view kComment = "# tactoscope ";

/// A tolerance: stated, and not below zero.
double toleranceOr(const json& object, const char* key) {
    const double value = numberOr(object, key);
    return value >= 0 ? value : kNaN;
}

}  // namespace

json describeCapture(const Capture& capture) {
    auto channels = json::array();
    for (const auto& channel : capture.channels) {
        channels.push_back({{"name", channel.name},
                            {"unit", channel.unit},
                            {"low", channel.low},
                            {"high", channel.high},
                            {"lsb", channel.lsb},
                            {"gain_tolerance", numberOrNull(channel.gainTolerance)},
                            {"offset_tolerance", numberOrNull(channel.offsetTolerance)},
                            {"linearity_tolerance", numberOrNull(channel.linearityTolerance)},
                            {"probe_tolerance", numberOrNull(channel.probeTolerance)},
                            {"stated_by", channel.statedBy}});
    }
    return {{"rate_hz", capture.rate_hz},
            {"start_s", capture.start_s},
            {"trigger_s", numberOrNull(capture.trigger_s)},
            {"simulated", capture.simulated},
            {"timebase_tolerance", numberOrNull(capture.timeBaseTolerance)},
            {"stamp_tolerance_s", numberOrNull(capture.stampTolerance_s)},
            {"channels", std::move(channels)}};
}

std::optional<Capture> captureDescribed(const json& description) {
    if (!description.is_object()) return std::nullopt;
    const auto channels = description.find("channels");
    if (channels == description.end() || !channels->is_array()) return std::nullopt;
    Capture capture;
    capture.rate_hz = numberOr(description, "rate_hz");
    capture.start_s = numberOr(description, "start_s");
    capture.trigger_s = numberOr(description, "trigger_s");
    capture.simulated = flagOr(description, "simulated");
    capture.timeBaseTolerance = toleranceOr(description, "timebase_tolerance");
    capture.stampTolerance_s = toleranceOr(description, "stamp_tolerance_s");
    for (const auto& each : *channels) {
        if (!each.is_object()) return std::nullopt;
        auto& channel = capture.channels.emplace_back();
        channel.name = textOr(each, "name");
        channel.unit = textOr(each, "unit");
        channel.low = numberOr(each, "low");
        channel.high = numberOr(each, "high");
        channel.lsb = numberOr(each, "lsb");
        channel.gainTolerance = toleranceOr(each, "gain_tolerance");
        channel.offsetTolerance = toleranceOr(each, "offset_tolerance");
        channel.linearityTolerance =
            each.contains("linearity_tolerance") ? toleranceOr(each, "linearity_tolerance") : 0;
        channel.probeTolerance = toleranceOr(each, "probe_tolerance");
        channel.statedBy = textOr(each, "stated_by");
        // Older files have 0 where the instrument did not state a tolerance.
        if (!each.contains("stated_by") && channel.gainTolerance == 0) channel.gainTolerance = kNaN;
        if (!each.contains("stated_by") && channel.offsetTolerance == 0) channel.offsetTolerance = kNaN;
    }
    return capture;
}

std::string captureHeader(const Capture& capture) {
    const bool stated = std::any_of(capture.channels.begin(), capture.channels.end(), [](const auto& channel) {
        return !channel.statedBy.empty() || std::isfinite(channel.gainTolerance);
    });
    if (!capture.simulated && !stated) return {};
    return std::string(kComment) + dumpJson(describeCapture(capture), -1, true) + "\n";
}

std::optional<Capture> headerIn(std::string_view text) {
    const auto begin = text.find(kMark);
    if (begin == std::string_view::npos || (begin > 0 && text[begin - 1] != '\n')) return std::nullopt;
    auto line = text.substr(begin + kComment.size());
    line = line.substr(0, line.find('\n'));
    const auto description = parseJson(line, "header", {.bytes = 100'000, .depth = 4});
    return description ? captureDescribed(*description) : std::nullopt;
}

void takeHeader(Capture& capture, const Capture& header) {
    capture.simulated = header.simulated;
    if (capture.channels.size() != header.channels.size()) return;
    for (std::size_t c = 0; c < capture.channels.size(); ++c) {
        if (capture.channels[c].unit != header.channels[c].unit) return;  // read as something else
    }
    capture.trigger_s = header.trigger_s;
    capture.timeBaseTolerance = header.timeBaseTolerance;
    capture.stampTolerance_s = header.stampTolerance_s;
    for (std::size_t c = 0; c < capture.channels.size(); ++c) {
        auto& channel = capture.channels[c];
        auto samples = std::move(channel.samples);
        auto name = std::move(channel.name);
        channel = header.channels[c];
        channel.samples = std::move(samples);
        channel.name = std::move(name);
        if (!(channel.high > channel.low)) channel.low = channel.high = 0;
        if (!(channel.lsb > 0)) channel.lsb = 0;
    }
}

}  // namespace tacto
