#include "core/measure/PulseMeasurement.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <fmt/format.h>

#include "core/measure/CaptureFile.h"
#include "core/measure/PhaseFinder.h"
#include "core/measure/TrainSummary.h"

namespace tacto {

namespace {

constexpr std::size_t kFewestPhaseSamples = 10;
constexpr std::size_t kAmplePhaseSamples = 40;

/// From the end of one phase to the start of the next; by samples where the edges could not be placed.
double gapBetween(const FoundPhase& a, const FoundPhase& b, double rate_hz) {
    const double gap = b.measured.onset_s - a.measured.end_s;
    if (std::isfinite(gap)) return gap;
    return (static_cast<double>(b.begin) - static_cast<double>(a.end)) / rate_hz;
}

void flagPhase(const FoundPhase& phase, PulseFlags& flags) {
    flags.clipped = flags.clipped || phase.clipped;
    flags.truncated = flags.truncated || phase.truncated;
    flags.incomplete = flags.incomplete || phase.incomplete;
    flags.underSampled = flags.underSampled || phase.measured.samples < kFewestPhaseSamples;
    flags.coarse = flags.coarse || phase.measured.samples < kAmplePhaseSamples;
}

FoundPulse pulseOf(const Capture& capture, const FoundPhase& leading, const FoundPhase* second, bool biphasic,
                   bool truncated) {
    FoundPulse found;
    auto& pulse = found.pulse;
    found.approximateOnset_s = std::isfinite(leading.measured.onset_s)
                                   ? leading.measured.onset_s
                                   : capture.start_s + static_cast<double>(leading.begin) / capture.rate_hz;
    pulse.seenFrom_s = capture.start_s + static_cast<double>(leading.begin) / capture.rate_hz;
    pulse.seenTo_s =
        capture.start_s + static_cast<double>((second == nullptr ? leading : *second).end) / capture.rate_hz;
    pulse.flags.truncated = truncated;
    flagPhase(leading, pulse.flags);
    if (second != nullptr) flagPhase(*second, pulse.flags);
    pulse.leading.samples = leading.measured.samples;
    if (!pulse.flags.measured()) return found;

    pulse.leading = leading.measured;
    if (second != nullptr) {
        pulse.second = second->measured;
        pulse.gap_s = second->measured.onset_s - leading.measured.end_s;
    }
    if (biphasic) {
        const double q1 = leading.measured.charge;
        const double q2 = second == nullptr ? 0 : second->measured.charge;
        pulse.imbalance = std::abs(q1 + q2) / std::max(std::abs(q1), std::abs(q2));
    }
    return found;
}

/// Pairs opposite phases. Where a phase could belong to either neighbour, the clearly shorter gap wins: a record may
/// begin between the phases of a pulse.
std::vector<FoundPulse> pairPhases(const Capture& capture, const std::vector<FoundPhase>& phases, bool biphasic,
                                   double gapMax_s) {
    const double n = static_cast<double>(capture.samples());
    const auto gapAfter = [&](std::size_t k) {
        if (!biphasic || k + 1 >= phases.size() || phases[k].sign == phases[k + 1].sign) return kNotMeasured;
        const double gap = gapBetween(phases[k], phases[k + 1], capture.rate_hz);
        return gap <= gapMax_s ? gap : kNotMeasured;
    };
    std::vector<FoundPulse> pulses;
    for (std::size_t k = 0; k < phases.size(); ++k) {
        const double gap = gapAfter(k);
        const double next = gapAfter(k + 1);
        const double step = 1.0 / capture.rate_hz;
        const bool pairs = std::isfinite(gap) && !(std::isfinite(next) && gap > 2 * next + step && k == 0);
        if (pairs) {
            pulses.push_back(pulseOf(capture, phases[k], &phases[k + 1], biphasic, false));
            ++k;
            continue;
        }
        // The phase that belongs to this one may lie beyond the record.
        const double sinceStart = static_cast<double>(phases[k].begin) * step;
        const double untilEnd = (n - static_cast<double>(phases[k].end)) * step;
        const bool cut =
            biphasic && ((k == 0 && sinceStart <= gapMax_s) || (k + 1 == phases.size() && untilEnd <= gapMax_s));
        pulses.push_back(pulseOf(capture, phases[k], nullptr, biphasic, cut));
    }
    return pulses;
}

/// A signal whose edges fill its pulses (a sine, a triangle) has no states, whatever its histogram says.
bool restsOnPlateaus(const std::vector<FoundPulse>& pulses) {
    std::vector<double> edgeShares;
    for (const auto& found : pulses) {
        const auto& m = found.pulse.leading;
        const double share = (m.rise_s + m.fall_s) / m.width_s;
        if (std::isfinite(share)) edgeShares.push_back(share);
    }
    return edgeShares.empty() || statisticsOf(edgeShares).median <= 1;
}

std::vector<FoundPulse> findPulses(const Capture& capture, const CaptureChannel& channel, const MeasureOptions& options,
                                   StateLevels& levels) {
    const bool logic = channel.unit.empty() && std::all_of(channel.samples.begin(), channel.samples.end(),
                                                           [](float x) { return x == 0.0F || x == 1.0F; });
    levels = findStateLevels(channel.samples, channel.lsb, logic);
    if (levels.count != StateCount::None && !(capture.rate_hz > 0)) {
        levels = {};
        levels.why = "its sampling rate is unknown";
    }
    if (levels.count == StateCount::None) return {};
    const auto phases = findPhases(capture, channel, levels);
    auto pulses = pairPhases(capture, phases, levels.count == StateCount::Three, options.interPhaseGapMax.count());
    if (!restsOnPlateaus(pulses)) {
        levels = {};
        levels.why = "its edges are longer than its pulses";
        return {};
    }
    return pulses;
}

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
    auto pulses = findPulses(capture, samples, options, result.states);
    if (result.states.count == StateCount::None) {
        result.warnings.push_back(
            fmt::format("channel '{}' has no two states, so no pulses: {}", result.name, result.states.why));
    }
    if (result.states.count != StateCount::None && pulses.empty()) {
        result.warnings.push_back(fmt::format("channel '{}' has states but no pulse between them", result.name));
    }
    summarise(std::move(pulses), samples, options, result);
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
    if (captures.empty()) return fail(ErrorCode::InvalidArgument, "no captures to measure; at least one was expected");
    std::vector<FoundPulse> pulses;
    ChannelMeasurement result;
    const CaptureChannel* described = nullptr;  // the channel whose range and resolution the uncertainty is from
    std::size_t empty = 0;
    std::size_t disordered = 0;
    std::string why;
    bool broken = false;
    double previousEnd_s = -std::numeric_limits<double>::infinity();
    for (const auto& capture : captures) {
        const auto index = findChannel(capture, channel);
        if (!index) return failure(index);
        const auto& samples = capture.channels[*index];
        StateLevels levels;
        auto found = findPulses(capture, samples, options, levels);
        if (described == nullptr || (result.states.count == StateCount::None && levels.count != StateCount::None)) {
            const std::size_t total = result.samples;
            result = headOf(capture, samples);
            result.samples = total;
            result.states = levels;
            described = &samples;
        }
        result.samples += samples.samples.size();
        const double step = capture.rate_hz > 0 ? 1.0 / capture.rate_hz : 0;
        if (capture.start_s < previousEnd_s - step) {
            ++disordered;
            broken = true;
        }
        previousEnd_s = capture.start_s + static_cast<double>(samples.samples.size()) * step;
        // A capture without pulses hides how many trains it missed.
        if (found.empty()) {
            ++empty;
            if (levels.count == StateCount::None) why = levels.why;
            broken = true;
            continue;
        }
        found.front().afterBreak = broken;
        broken = false;
        pulses.insert(pulses.end(), std::make_move_iterator(found.begin()), std::make_move_iterator(found.end()));
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
    assert(described != nullptr);  // there is at least one capture
    summarise(std::move(pulses), *described, options, result);
    return result;
}

}  // namespace tacto
