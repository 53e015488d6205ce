#include "core/measure/PulseMeasurement.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <fmt/format.h>
#include <iterator>

#include "core/measure/CaptureFile.h"
#include "core/measure/PulseFinder.h"
#include "core/measure/TrainSummary.h"

namespace tacto {

namespace {

ChannelMeasurement headOf(const Capture& capture, const CaptureChannel& channel) {
    ChannelMeasurement result;
    result.name = channel.name;
    result.unit = channel.unit;
    result.rate_hz = capture.rate_hz;
    result.samples = channel.samples.size();
    return result;
}

}  // namespace

ChannelMeasurement measureChannel(const Capture& capture, std::size_t channel, const MeasureOptions& options) {
    const auto& samples = capture.channels[channel];
    auto result = headOf(capture, samples);
    auto found = findPulses(capture, samples, options);
    result.states = std::move(found.levels);
    result.quality = found.quality;
    if (result.states.count == StateCount::None) {
        result.warnings.push_back(
            fmt::format("channel '{}' has no two states, so no pulses: {}", result.name, result.states.why));
    }
    if (result.states.count != StateCount::None && found.pulses.empty()) {
        result.warnings.push_back(fmt::format("channel '{}' has states but no pulse between them", result.name));
    }
    summarise(std::move(found.pulses), {}, samples, {capture.timeBaseTolerance, 0}, options, result);
    return result;
}

CaptureMeasurement measureCapture(const Capture& capture, std::optional<std::size_t> channel,
                                  const MeasureOptions& options) {
    CaptureMeasurement result;
    for (std::size_t c = 0; c < capture.channels.size(); ++c) {
        if (channel && *channel != c) continue;
        result.channels.push_back(measureChannel(capture, c, options));
        const auto& warnings = result.channels.back().warnings;
        result.warnings.insert(result.warnings.end(), warnings.begin(), warnings.end());
    }
    return result;
}

Result<ChannelMeasurement> measureTrains(std::span<const Capture> captures, std::string_view channel,
                                         const MeasureOptions& options) {
    if (captures.empty()) return invalid("no captures to measure; at least one was expected");
    std::vector<PulseMeasurement> pulses;
    std::vector<std::size_t> breaks;  // pulses before which an unknown time has passed
    ChannelMeasurement result;
    const CaptureChannel* described = nullptr;  // channel with the range and resolution for the uncertainty
    std::size_t empty = 0;
    std::size_t disordered = 0;
    std::string why;
    bool broken = false;
    double previousEnd_s = -std::numeric_limits<double>::infinity();
    for (const auto& capture : captures) {
        const auto index = findChannel(capture, channel);
        if (!index) return failure(index);
        const auto& samples = capture.channels[*index];
        result.warnings.insert(result.warnings.end(), capture.warnings.begin(), capture.warnings.end());
        auto found = findPulses(capture, samples, options);
        const auto& levels = found.levels;
        if (described == nullptr || (result.states.count == StateCount::None && levels.count != StateCount::None)) {
            const std::size_t total = result.samples;
            auto warnings = std::move(result.warnings);
            result = headOf(capture, samples);
            result.warnings = std::move(warnings);
            result.samples = total;
            result.states = levels;
            result.quality = found.quality;
            described = &samples;
        }
        // The worst capture sets the quality of the result.
        result.quality.mean = std::max(result.quality.mean, found.quality.mean);
        result.quality.meanOfSecond = std::max(result.quality.meanOfSecond, found.quality.meanOfSecond);
        result.quality.drift = std::max(result.quality.drift, found.quality.drift);
        result.quality.unrest = std::max(result.quality.unrest, found.quality.unrest);
        result.quality.leaps += described == &samples ? 0 : found.quality.leaps;
        result.quality.foundStep = std::max(result.quality.foundStep, found.quality.foundStep);
        if (std::abs(found.quality.levelAfter) > std::abs(result.quality.levelAfter)) {
            result.quality.levelAfter = found.quality.levelAfter;
        }
        result.quality.doubtful = result.quality.doubtful || found.quality.doubtful;
        result.samples += samples.samples.size();
        const double step = capture.rate_hz > 0 ? 1.0 / capture.rate_hz : 0;
        if (capture.start_s < previousEnd_s - step) {
            ++disordered;
            broken = true;
        }
        previousEnd_s = capture.start_s + static_cast<double>(samples.samples.size()) * step;
        // A capture without pulses does not show how many trains it missed.
        if (found.pulses.empty()) {
            ++empty;
            if (levels.count == StateCount::None) why = levels.why;
            broken = true;
            continue;
        }
        if (broken) breaks.push_back(pulses.size());
        broken = false;
        std::move(found.pulses.begin(), found.pulses.end(), std::back_inserter(pulses));
    }
    if (empty > 0) {
        result.warnings.push_back(fmt::format("channel '{}' shows no pulses in {} of {} captures{}{}", result.name,
                                              empty, captures.size(), why.empty() ? "" : ": ", why));
    }
    if (disordered > 0) {
        result.warnings.push_back(
            fmt::format("channel '{}': {} of {} captures begin before the one before them ended; intervals across them "
                        "are not reported",
                        result.name, disordered, captures.size()));
    }
    assert(described != nullptr);  // at least one capture exists
    const TimeTolerance time{captures.front().timeBaseTolerance,
                             captures.size() > 1 ? captures.front().stampTolerance_s : 0};
    summarise(std::move(pulses), breaks, *described, time, options, result);
    return result;
}

}  // namespace tacto
