#include "core/measure/InstrumentStatement.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <fmt/ranges.h>

namespace tacto {

namespace {

Stated over(const Stated& under, const Stated& above) { return above.known() ? above : under; }

ChannelStatement over(const ChannelStatement& under, const ChannelStatement& above) {
    ChannelStatement out{over(under.gain, above.gain), over(under.offset, above.offset),
                         over(under.linearity, above.linearity), over(under.probe, above.probe),
                         over(under.resolution, above.resolution)};
    // Who states a gain means all of it, unless a share of full scale is stated in the same breath.
    if (above.gain.known() && !above.linearity.known()) out.linearity = {};
    return out;
}

/// "gain by certificate 4711", and the others with the same source beside it.
class Sources {
public:
    void add(std::string_view what, const Stated& stated) {
        if (!stated.known()) return;
        for (auto& [by, list] : found_) {
            if (by != stated.by) continue;
            list.emplace_back(what);
            return;
        }
        found_.push_back({stated.by, {std::string(what)}});
    }
    [[nodiscard]] std::string text(std::string_view before) const {
        std::string out(before);
        for (const auto& [by, list] : found_) {
            if (!out.empty()) out += "; ";
            out += fmt::format("{}: {}", fmt::join(list, ", "), by);
        }
        return out;
    }

private:
    std::vector<std::pair<std::string, std::vector<std::string>>> found_;
};

void applyTo(CaptureChannel& channel, const ChannelStatement& stated) {
    Sources sources;
    const auto take = [&](const char* what, const Stated& from, double& into, double scale) {
        if (!from.known()) return;
        into = from.value * scale;
        sources.add(what, from);
    };
    if (stated.gain.known()) channel.linearityTolerance = 0;
    take("gain", stated.gain, channel.gainTolerance, 1);
    take("offset", stated.offset, channel.offsetTolerance, 1);
    // Nothing can be a share of an unknown range: the gain is then not known either.
    const double range = channel.high - channel.low;
    if (stated.linearity.known() && !(range > 0)) {
        channel.gainTolerance = kNaN;
    } else {
        take("share of full scale", stated.linearity, channel.linearityTolerance, range);
    }
    take(channel.unit == "A" ? "shunt" : "probe", stated.probe, channel.probeTolerance, 1);
    take("step", stated.resolution, channel.lsb, 1);
    channel.statedBy = sources.text(channel.statedBy);
}

}  // namespace

bool Stated::known() const noexcept { return std::isfinite(value); }

InstrumentStatement merged(const InstrumentStatement& under, const InstrumentStatement& above) {
    return {over(under.voltage, above.voltage), over(under.current, above.current),
            over(under.timeBase, above.timeBase), over(under.stamp_s, above.stamp_s)};
}

void applyStatement(Capture& capture, const InstrumentStatement& statement) {
    if (statement.timeBase.known()) capture.timeBaseTolerance = statement.timeBase.value;
    if (statement.stamp_s.known()) capture.stampTolerance_s = statement.stamp_s.value;
    for (auto& channel : capture.channels) {
        if (channel.unit == "V") applyTo(channel, statement.voltage);
        if (channel.unit == "A") applyTo(channel, statement.current);
    }
}

std::vector<std::string> notStated(const Capture& capture) {
    std::vector<std::string> out;
    for (const auto& channel : capture.channels) {
        if (channel.unit != "V" && channel.unit != "A") continue;
        if (!std::isfinite(channel.gainTolerance)) out.push_back("the gain of " + channel.name);
        if (!std::isfinite(channel.probeTolerance)) {
            out.push_back(fmt::format("the {} of {}", channel.unit == "A" ? "shunt" : "probe", channel.name));
        }
        if (!(channel.lsb > 0)) out.push_back("the resolution of " + channel.name);
    }
    if (!std::isfinite(capture.timeBaseTolerance)) out.emplace_back("the time base");
    return out;
}

std::string notStatedText(const Capture& capture) {
    const auto missing = notStated(capture);
    if (missing.empty()) return {};
    return fmt::format("the oscilloscope does not state {}", fmt::join(missing, ", "));
}

}  // namespace tacto
