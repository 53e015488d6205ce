#include "core/measure/PhasePairs.h"

#include <algorithm>
#include <cmath>

namespace tacto {

namespace {

constexpr std::size_t kFewestPhaseSamples = 10;
constexpr std::size_t kAmplePhaseSamples = 40;

/// From the end of one phase to the start of the next; by samples where the edges could not be placed.
double gapBetween(const FoundPhase& a, const FoundPhase& b) {
    const double gap = b.measured.onset_s - a.measured.end_s;
    if (std::isfinite(gap)) return gap;
    return b.from_s() - a.to_s();
}

void flagPhase(const FoundPhase& phase, PulseFlags& flags) {
    flags.clipped = flags.clipped || phase.clipped;
    flags.truncated = flags.truncated || phase.truncated;
    flags.incomplete = flags.incomplete || phase.incomplete;
    flags.underSampled = flags.underSampled || phase.measured.samples < kFewestPhaseSamples;
    flags.coarse = flags.coarse || phase.measured.samples < kAmplePhaseSamples;
}

PulseMeasurement pulseOf(const FoundPhase& leading, const FoundPhase* second, bool biphasic, bool truncated) {
    PulseMeasurement pulse;
    pulse.seenFrom_s = leading.from_s();
    pulse.seenTo_s = (second == nullptr ? leading : *second).to_s();
    pulse.flags.truncated = truncated;
    flagPhase(leading, pulse.flags);
    if (second != nullptr) flagPhase(*second, pulse.flags);
    pulse.leading.samples = leading.measured.samples;
    if (!pulse.flags.measured()) return pulse;

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
    return pulse;
}

}  // namespace

std::vector<PulseMeasurement> pairPhases(const Capture& capture, const std::vector<FoundPhase>& phases, bool biphasic,
                                         double gapMax_s) {
    const double end_s = capture.start_s + static_cast<double>(capture.samples()) / capture.rate_hz;
    const auto gapAfter = [&](std::size_t k) {
        if (!biphasic || k + 1 >= phases.size() || phases[k].sign == phases[k + 1].sign) return kNotMeasured;
        const double gap = gapBetween(phases[k], phases[k + 1]);
        return gap <= gapMax_s ? gap : kNotMeasured;
    };
    std::vector<PulseMeasurement> pulses;
    pulses.reserve(phases.size());
    for (std::size_t k = 0; k < phases.size(); ++k) {
        const double gap = gapAfter(k);
        const double next = gapAfter(k + 1);
        const double step = 1.0 / capture.rate_hz;
        const bool pairs = std::isfinite(gap) && !(std::isfinite(next) && gap > 2 * next + step && k == 0);
        if (pairs) {
            pulses.push_back(pulseOf(phases[k], &phases[k + 1], biphasic, false));
            ++k;
            continue;
        }
        // The phase that belongs to this one may lie beyond the record.
        const double sinceStart = phases[k].from_s() - capture.start_s;
        const double untilEnd = end_s - phases[k].to_s();
        const bool cut =
            biphasic && ((k == 0 && sinceStart <= gapMax_s) || (k + 1 == phases.size() && untilEnd <= gapMax_s));
        pulses.push_back(pulseOf(phases[k], nullptr, biphasic, cut));
    }
    return pulses;
}

}  // namespace tacto
