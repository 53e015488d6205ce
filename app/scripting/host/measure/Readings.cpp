#include "app/scripting/host/measure/Readings.h"

#include <cmath>

namespace tacto::host::measure {

Result<GivenCaptures> capturesGiven(ScriptSession& session, const nlohmann::json& handles) {
    const auto held = session.held(handles);
    if (!held) return failure(held);
    GivenCaptures given;
    for (const auto* capture : *held) given.captures.push_back(*capture);
    for (const auto& handle : handles) given.ids.push_back(handle.is_object() ? handle["capture"] : handle);
    return given;
}

MeasureOptions optionsFor(const PulseTrain& expected) {
    MeasureOptions options;
    if (expected.pulses > 1) options.intraTrainRate = expected.rate;
    return options;
}

double meanOfTrains(const ChannelMeasurement& channel, double TrainMeasurement::*member) {
    std::vector<double> readings;
    for (const auto& train : channel.trains) {
        if (std::isfinite(train.*member)) readings.push_back(train.*member);
    }
    return statisticsOf(readings).mean;
}

namespace {
/// Removes `part` from an uncertainty. If `part` is unknown, so is the result.
double without(double part, double all) noexcept {
    const double rest = all * all - part * part;
    return std::sqrt(rest < 0 ? 0 : rest);
}
}  // namespace

double withoutGain(const ChannelMeasurement& measured, const CaptureChannel& channel) noexcept {
    return without(channel.gainTolerance / std::sqrt(3.0) * measured.amplitude.mean, measured.uncertainty.amplitude);
}

double ofLevelAlone(const ChannelMeasurement& measured, const CaptureChannel& channel) noexcept {
    const double step = channel.lsb / std::sqrt(12.0), bend = channel.linearityTolerance / std::sqrt(3.0);
    return without(std::hypot(step, bend), withoutGain(measured, channel));
}

}  // namespace tacto::host::measure
