#include "app/scripting/engine/ScopeSeen.h"

#include <cmath>
#include <fmt/format.h>

#include "core/measure/InstrumentStatement.h"

namespace tacto {

namespace {

/// NaN wins: if one capture does not state a value, no value is known for all captures.
void widen(double& largest, double value) {
    if (std::isnan(value) || value > largest) largest = value;
}

}  // namespace

void ScopeSeen::add(const Capture& capture) {
    for (const auto& channel : capture.channels) {
        if (channel.unit != "V" && channel.unit != "A") continue;
        auto& seen = channels_[channel.name];
        seen.name = channel.name;
        seen.unit = channel.unit;
        widen(seen.gain_pct, 100 * channel.gainTolerance);
        widen(seen.offset, channel.offsetTolerance);
        widen(seen.lsb, channel.lsb > 0 ? channel.lsb : kNaN);
        widen(seen.probe_pct, 100 * channel.probeTolerance);
        widen(seen.linearity, channel.linearityTolerance);
        if (!channel.statedBy.empty()) seen.statedBy = channel.statedBy;
    }
    widen(timeBase_, capture.timeBaseTolerance);
    widen(stamp_s_, capture.stampTolerance_s);
    if (auto text = notStatedText(capture); !text.empty()) notStated_ = std::move(text);
}

InstrumentSeen instrumentOf(const DeviceIdentity& device) {
    return {nameOf(device.role), device.name, device.serial, device.simulated};
}

nlohmann::json ScopeSeen::rows(const DeviceIdentity& scope) const {
    auto out = nlohmann::json::array();
    auto instrument = instrumentOf(scope);
    for (const auto& [name, channel] : channels_) {
        instrument.channel = channel;
        instrument.channel->timeBase_ppm = 1e6 * timeBase_;
        instrument.channel->stamp_s = stamp_s_;
        out.push_back(toJson(instrument));
    }
    return out;
}

std::vector<std::string> ScopeSeen::restsOn() const {
    std::vector<std::string> out;
    if (!absolute_.empty()) out.push_back("The absolute scale of the voltage was read: " + absolute_ + ".");
    for (const auto& [name, channel] : channels_) {
        if (!absolute_.empty() || channel.unit != "V" || !std::isfinite(channel.gain_pct)) continue;
        const auto by = channel.statedBy.empty() ? std::string("source not named") : channel.statedBy;
        out.push_back(
            channel.statedBy.find("certificate") != std::string::npos
                ? fmt::format("The absolute scale of {} rests on a certificate ({}).", name, by)
                : fmt::format(
                      "No absolute reference was read: a gain error that voltage and current share does not show "
                      "in a known load, and rests on the stated tolerance of ± {:.3g} % ({}).",
                      channel.gain_pct, by));
    }
    if (!notStated_.empty()) {
        std::string text = notStated_ + ": what needs it was not evaluated.";
        text[0] = 'T';
        out.push_back(std::move(text));
    }
    return out;
}

}  // namespace tacto
