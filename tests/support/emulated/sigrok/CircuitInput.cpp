#include "tests/support/emulated/sigrok/CircuitInput.h"

#include <algorithm>
#include <cmath>

namespace tacto::sigrok_driver {

namespace {
sim::FilteredTrace::Channel kindOf(int channel) {
    return channel == 1 ? sim::FilteredTrace::Channel::Current : sim::FilteredTrace::Channel::Voltage;
}
}  // namespace

std::optional<double> CircuitInput::passes(int channel, double level_V, bool upwards, double from_s, double to_s) {
    const double level = std::abs(level_V) / factor(channel);
    if (!(level > 0) || (level_V > 0) != upwards) return std::nullopt;  // a pulse from 0 V meets no other edge
    using Found = std::optional<double>;
    return circuit_.inspect(clock_.now(), [&](const auto& pulses) -> Found {
        for (std::size_t i = 0; i < pulses.size(); ++i) {
            const double end_s = std::min(to_s, i + 1 < pulses.size() ? pulses[i + 1].onset_s : pulses[i].end_s + 1);
            if (end_s <= from_s) continue;
            double at_s = std::max(from_s, pulses[i].onset_s - 1e-6);
            const sim::FilteredTrace trace(pulses, kindOf(channel), bandwidth_.value(), at_s, end_s);
            while (const auto found = trace.risesThrough(level, at_s)) {
                if (*found >= end_s) break;
                if ((trace.at(*found + 1e-9) > 0) == upwards) return *found;
                at_s = *found + 1e-9;
            }
        }
        return std::nullopt;
    });
}

void CircuitInput::sample(int channel, double start_s, double step_s, std::vector<double>& out) {
    circuit_.inspect(clock_.now(), [&](const auto& pulses) {
        const double end_s = start_s + step_s * static_cast<double>(out.size());
        const sim::FilteredTrace trace(pulses, kindOf(channel), bandwidth_.value(), start_s, end_s);
        trace.sample(start_s, step_s, out);
        return 0;
    });
    for (double& one : out) one *= factor(channel);
}

}  // namespace tacto::sigrok_driver
