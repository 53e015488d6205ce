#include "drivers/sigrok/protocol/RecordPlan.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "core/devices/ScopeRange.h"

namespace tacto::sigrok_driver {

namespace {

constexpr double kFastest_hz = 500e6;             // see the header
constexpr double kDivisionsUp = 4;                // divisions above the middle of a screen of eight divisions
constexpr double kSmallestScale_V = 1e-3;         // libsigrok sends three decimals
constexpr double kSmallestLevel_V = 1e-3;         // libsigrok sends three decimals
constexpr std::size_t kStreamDepth = 10'000'000;  // samples of a stream that are kept: 80 MB for two channels

bool offers(const std::vector<std::string>& list, std::string_view one) {
    return std::ranges::find(list, one) != list.end();
}

Result<std::size_t> channelCalled(const std::string& name, const char* role, const Abilities& abilities) {
    const auto found = std::ranges::find(abilities.channels, name, &ChannelAbilities::name);
    if (found != abilities.channels.end()) return static_cast<std::size_t>(found - abilities.channels.begin());
    std::vector<std::string> names;
    for (const auto& channel : abilities.channels) names.push_back(channel.name);
    return invalid("{}={}: this instrument has no such channel; there are {}", role, name, fmt::join(names, ", "));
}

Result<void> checkProbe(std::optional<std::uint64_t> probe, const ChannelAbilities& channel, const char* role) {
    if (!probe || std::ranges::find(channel.probes, *probe) != channel.probes.end()) return {};
    if (channel.probes.empty()) {
        return invalid("{}={}: the probe factor of {} cannot be set through this driver; set it on the instrument",
                       role, *probe, channel.name);
    }
    return invalid("{}={}: {} takes {}", role, *probe, channel.name, fmt::join(channel.probes, ", "));
}

Result<std::optional<Fraction>> scaleFor(double range_V, const ChannelAbilities& channel, std::string_view what) {
    if (channel.voltsPerDivision.empty()) return std::optional<Fraction>{};
    std::optional<Fraction> best;
    double largest = 0;
    for (const auto& scale : channel.voltsPerDivision) {
        largest = std::max(largest, scale.value());
        if (scale.value() < kSmallestScale_V || kDivisionsUp * scale.value() < range_V * (1 - 1e-9)) continue;
        if (!best || scale.value() < best->value()) best = scale;
    }
    if (best) return best;
    return invalid("oscilloscope {} range ±{:.6g} V at {}: above 0, at most ±{:.6g} V", what, range_V, channel.name,
                   kDivisionsUp * largest);
}

bool isMultiple(double of, double what) {
    const double times = of / what;
    return times >= 1 - 1e-9 && std::abs(times - std::round(times)) < 1e-6 * times;
}

/// Chooses the shortest screen that holds the record at a multiple of the record's rate.
Result<void> chooseScreen(RecordPlan& plan, const Abilities& abilities, std::size_t record) {
    const double wanted_s = static_cast<double>(plan.settings.samples) / plan.settings.sampleRate.value();
    std::optional<Fraction> best;
    for (const auto& timebase : abilities.timebases) {
        const double screen_s = timebase.value() * abilities.divisions;
        if (screen_s < wanted_s * (1 - 1e-9) || (best && best->value() <= timebase.value())) continue;
        const double rate = static_cast<double>(record) / screen_s;
        if (record != 0 && (rate > kFastest_hz * (1 + 1e-9) || !isMultiple(rate, plan.settings.sampleRate.value()))) {
            continue;
        }
        best = timebase;
    }
    if (!best) {
        return invalid(
            "oscilloscope record of {} samples at {} Hz: its records have {} samples, {} divisions long; fewer samples "
            "or a lower rate (in steps of 1, 2, 5) are expected",
            plan.settings.samples, plan.settings.sampleRate.value(), record, abilities.divisions);
    }
    plan.timebase = *best;
    plan.screen_s = best->value() * abilities.divisions;
    return {};
}

void placeTrigger(RecordPlan& plan, const Abilities& abilities) {
    plan.triggerAt_s = 0.5 * plan.screen_s;
    plan.triggerPosition = plan.settings.preTrigger;
    if (!abilities.triggerPosition) return;
    plan.triggerAt_s = plan.settings.preTrigger * plan.screen_s;
    if (abilities.driver != "rigol-ds") return;
    // libsigrok 0.5.2 multiplies by the number of time bases in its table instead of the number of divisions, and sends
    // whole microseconds.
    const double right = (0.5 - plan.settings.preTrigger) * plan.screen_s;
    const double sent = std::round(right * 1e6) * 1e-6;
    plan.triggerPosition = 0.5 - right / (plan.timebase.value() * static_cast<double>(abilities.timebases.size()));
    plan.triggerAt_s = 0.5 * plan.screen_s - sent;
}

}  // namespace

std::size_t memoryOf(std::string_view driver, std::string_view model) noexcept {
    if (driver != "rigol-ds") return 0;
    if (model.starts_with("DSO1")) return 20'480;
    if (model.starts_with("DS2") || model.starts_with("MSO2")) return 14'000;
    const bool series1000 = model.starts_with("DS1") || model.starts_with("MSO1");
    if (series1000 && model.find('Z') != std::string_view::npos) return 12'000'000;
    return series1000 ? 1'048'576 : 0;
}

Result<Wiring> wire(const ScopeUri& uri, const Abilities& abilities) {
    if (abilities.channels.empty()) {
        return fail(ErrorCode::Unsupported, "{} {} has no analog channel; an oscilloscope was expected",
                    abilities.vendor, abilities.model);
    }
    Wiring wiring;
    wiring.shunt = uri.shunt;
    wiring.falling = uri.falling;
    wiring.ownTrigger = uri.ownTrigger;
    wiring.live = uri.live;
    wiring.voltageProbe = uri.voltageProbe;
    wiring.currentProbe = uri.currentProbe;
    if (uri.voltage) {
        const auto found = channelCalled(*uri.voltage, "voltage", abilities);
        if (!found) return failure(found);
        wiring.voltage = *found;
    }
    if (uri.current) {
        const auto found = channelCalled(*uri.current, "current", abilities);
        if (!found) return failure(found);
        wiring.current = *found;
        if (wiring.current == wiring.voltage) {
            return invalid("current={}: that is the voltage channel too; name another with voltage=", *uri.current);
        }
    }
    if (const auto probe = checkProbe(uri.voltageProbe, abilities.channels[wiring.voltage], "probe"); !probe) {
        return failure(probe);
    }
    if (wiring.current) {
        const auto probe = checkProbe(uri.currentProbe, abilities.channels[*wiring.current], "currentprobe");
        if (!probe) return failure(probe);
    }
    if (abilities.streams() && uri.live) return invalid("record=live: this device streams; leave it out");
    if (uri.live && !offers(abilities.dataSources, "Live"))
        return invalid("record=live: this driver has no such choice");
    if (!abilities.streams() && !uri.ownTrigger && !(abilities.triggerLevel && !abilities.triggerSources.empty())) {
        return fail(ErrorCode::Unsupported,
                    "libsigrok's {} driver cannot set what this instrument triggers on; set it on the instrument and "
                    "add trigger=instrument",
                    abilities.driver);
    }
    return wiring;
}

ScopeTraits traitsOf(const Abilities& abilities, const Wiring& wiring) {
    ScopeTraits traits;
    if (abilities.streams()) {
        traits.maxRate = Hertz(abilities.rateMax_hz);
        traits.memoryDepth = kStreamDepth;
        traits.bits = 8;
        return traits;
    }
    const std::size_t channels = wiring.current ? 2 : 1;
    traits.memoryDepth = abilities.memory > 0 ? abilities.memory / channels : kStreamDepth;
    double fastest = 0;
    for (const auto& timebase : abilities.timebases) {
        const double rate = static_cast<double>(traits.memoryDepth) / (timebase.value() * abilities.divisions);
        if (rate <= kFastest_hz * (1 + 1e-9)) fastest = std::max(fastest, rate);
    }
    traits.maxRate = Hertz(fastest > 0 ? fastest : kFastest_hz);
    return traits;
}

Result<RecordPlan> planRecord(const ScopeSettings& settings, const Abilities& abilities, const Wiring& wiring) {
    const ScopeTraits traits = traitsOf(abilities, wiring);
    if (const auto checked = checkScopeRange(settings, traits); !checked) return failure(checked);
    RecordPlan plan;
    plan.settings = settings;

    if (settings.triggerOnCurrent && !wiring.current) {
        return invalid(
            "oscilloscope trigger on current: no current channel is named; current=NAME&shunt=OHMS is expected");
    }
    const auto& volts = abilities.channels[wiring.voltage];
    const double ampsRange_V = settings.currentRange.value() * 1e-3 * wiring.shunt.value();
    plan.triggerLevel_V = settings.triggerLevel * (settings.triggerOnCurrent ? wiring.shunt.value() : 1);
    if (plan.triggerLevel_V < kSmallestLevel_V) {
        return invalid("oscilloscope trigger level {} V at the instrument: at least {} V", plan.triggerLevel_V,
                       kSmallestLevel_V);
    }
    if (wiring.falling) plan.triggerLevel_V = -plan.triggerLevel_V;

    if (abilities.streams()) {
        const double rate = settings.sampleRate.value();
        const bool listed = std::ranges::any_of(abilities.rates_hz, [&](double one) { return one == rate; });
        const bool stepped = abilities.rateStep_hz > 0 && rate >= abilities.rateMin_hz &&
                             std::abs(std::remainder(rate, abilities.rateStep_hz)) < 1e-6;
        if (!listed && !stepped) {
            if (abilities.rates_hz.empty()) {
                return invalid("oscilloscope sample rate {} Hz: {} to {} Hz in steps of {}", rate, abilities.rateMin_hz,
                               abilities.rateMax_hz, abilities.rateStep_hz);
            }
            return invalid("oscilloscope sample rate {} Hz: this device has {}", rate,
                           fmt::join(abilities.rates_hz, ", "));
        }
    } else {
        // The length of a live record is known only after the first has come; see the header.
        plan.record = wiring.live || abilities.memory == 0 ? 0 : traits.memoryDepth;
        if (const auto screen = chooseScreen(plan, abilities, plan.record); !screen) return failure(screen);
        placeTrigger(plan, abilities);
        plan.triggerSource = abilities.channels[settings.triggerOnCurrent ? *wiring.current : wiring.voltage].name;
        if (!wiring.ownTrigger && !offers(abilities.triggerSources, plan.triggerSource)) {
            return invalid("oscilloscope trigger on {}: this instrument triggers on {}", plan.triggerSource,
                           fmt::join(abilities.triggerSources, ", "));
        }
        if (wiring.falling && !wiring.ownTrigger && !abilities.triggerSlope) {
            return invalid("slope=fall: libsigrok's {} driver cannot set the slope", abilities.driver);
        }
    }
    auto voltageScale = scaleFor(settings.voltageRange.value(), volts, "voltage");
    if (!voltageScale) return failure(voltageScale);
    plan.voltageScale = *voltageScale;
    if (wiring.current) {
        auto currentScale = scaleFor(ampsRange_V, abilities.channels[*wiring.current], "current");
        if (!currentScale) return failure(currentScale);
        plan.currentScale = *currentScale;
    }
    return plan;
}

}  // namespace tacto::sigrok_driver
