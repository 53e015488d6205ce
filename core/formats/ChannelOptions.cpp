#include "core/formats/ChannelOptions.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <fmt/ranges.h>

#include "core/base/LocaleFreeText.h"

namespace tacto {

namespace {

struct UnitPrefix {
    std::string_view letter, word;
    double factor;
};
constexpr std::array<UnitPrefix, 6> kUnitPrefixes{{{"", "", 1},
                                                   {"k", "kilo", 1e3},
                                                   {"m", "milli", 1e-3},
                                                   {"u", "micro", 1e-6},
                                                   {"n", "nano", 1e-9},
                                                   {"p", "pico", 1e-12}}};

/// A unit, after a prefix or by itself. Words for a bare number have an empty unit.
struct UnitWord {
    std::string_view spelled;  // lower case
    SpelledUnit means;
    bool takesPrefix = true;
};
constexpr std::array<UnitWord, 21> kUnitWords{{{"v", {"V", 1}},           {"volt", {"V", 1}},
                                               {"volts", {"V", 1}},       {"a", {"A", 1}},
                                               {"amp", {"A", 1}},         {"amps", {"A", 1}},
                                               {"ampere", {"A", 1}},      {"amperes", {"A", 1}},
                                               {"s", {"s", 1}},           {"sec", {"s", 1}},
                                               {"second", {"s", 1}},      {"seconds", {"s", 1}},
                                               {"min", {"s", 60}, false}, {"minutes", {"s", 60}, false},
                                               {"h", {"s", 3600}, false}, {"hours", {"s", 3600}, false},
                                               {"", {"", 1}, false},      {"value", {"", 1}, false},
                                               {"logic", {"", 1}, false}, {"none", {"", 1}, false},
                                               {"bit", {"", 1}, false}}};

std::string namesOf(const std::vector<ChannelPlan>& channels) {
    std::vector<std::string> names;
    for (const auto& channel : channels) names.push_back(fmt::format("{} ({})", channel.name, channel.number));
    return fmt::format("{}", fmt::join(names, ", "));
}

/// Returns all channels named `wanted`, or else the channel with that number. The name comes first, because a channel
/// may be called "1" and be in the second column.
std::vector<std::size_t> indicesOf(const std::vector<ChannelPlan>& channels, std::string_view wanted) {
    std::vector<std::size_t> found;
    for (std::size_t i = 0; i < channels.size(); ++i) {
        const auto& channel = channels[i];
        const auto asColumn = channel.unit.empty() ? channel.name : fmt::format("{}_{}", channel.name, channel.unit);
        if (folded(channel.name) == folded(wanted) || folded(asColumn) == folded(wanted)) found.push_back(i);
    }
    const auto number = parseNumber(wanted);
    for (std::size_t i = 0; i < channels.size() && number && found.empty(); ++i) {
        if (static_cast<double>(channels[i].number) == *number) found.push_back(i);
    }
    return found;
}

/// Returns the only channel that `option` names. Errors: InvalidArgument if there are none or several.
Result<std::size_t> indexOf(const std::vector<ChannelPlan>& channels, std::string_view option, std::string_view wanted,
                            std::string_view file) {
    const auto found = indicesOf(channels, wanted);
    if (found.empty()) {
        return invalid("{}: there is no channel '{}', which {} names; there are {}", file, wanted, option,
                       channels.empty() ? "none" : namesOf(channels));
    }
    if (found.size() > 1) {
        return invalid("{}: '{}' names columns {} and {}; the number of one was expected", file, wanted,
                       channels[found[0]].number, channels[found[1]].number);
    }
    return found.front();
}

}  // namespace

std::string folded(std::string_view text) { return lowered(trimmed(text)); }

std::optional<SpelledUnit> spelledUnit(std::string_view text) {
    auto wanted = folded(text);
    for (const std::string_view micro : {"µ", "μ"}) {
        if (wanted.starts_with(micro)) wanted.replace(0, micro.size(), "u");
    }
    if (wanted.starts_with('\xB5')) wanted[0] = 'u';  // micro sign in Latin-1
    for (const std::string_view coupling : {"dc", "ac"}) {
        if (wanted.size() <= 2 || !wanted.ends_with(coupling)) continue;
        auto coupled = channelUnit(wanted.substr(0, wanted.size() - 2));
        return coupled && !coupled->unit.empty() ? coupled : std::nullopt;
    }
    for (const auto& word : kUnitWords) {
        if (!wanted.ends_with(word.spelled)) continue;
        const auto before = std::string_view(wanted).substr(0, wanted.size() - word.spelled.size());
        for (const auto& prefix : kUnitPrefixes) {
            if (before != prefix.letter && before != prefix.word) continue;
            if (!before.empty() && !word.takesPrefix) continue;
            return SpelledUnit{word.means.unit, word.means.factor * prefix.factor};
        }
    }
    return std::nullopt;
}

std::optional<SpelledUnit> channelUnit(std::string_view text) {
    const auto unit = spelledUnit(text);
    return unit && unit->unit == "s" ? std::nullopt : unit;
}

Result<std::vector<ChannelPlan>> planChannels(std::vector<ChannelPlan> channels, const ReadOptions& options,
                                              std::string_view file) {
    for (const auto& [name, spelled] : options.units) {
        const auto index = indexOf(channels, "the unit", name, file);
        if (!index) return failure(index);
        const auto unit = channelUnit(spelled);
        if (!unit) {
            return invalid("the unit '{}' of channel '{}' is unknown; V or A with k, m, u or n were expected", spelled,
                           name);
        }
        channels[*index].unit = unit->unit;
        channels[*index].factor = unit->factor;
        channels[*index].unknownUnit.clear();
    }
    for (const auto& [name, factor] : options.probeFactors) {
        const auto index = indexOf(channels, "the probe factor", name, file);
        if (!index) return failure(index);
        if (!std::isfinite(factor) || factor == 0) {
            return invalid("the probe factor of channel '{}' is {}; a finite number other than 0 was expected", name,
                           factor);
        }
        channels[*index].factor *= factor;
    }
    for (const auto& [name, range] : options.ranges) {
        const auto index = indexOf(channels, "the range", name, file);
        if (!index) return failure(index);
        const auto& [low, high] = range;
        if (!(low < high) || !std::isfinite(low) || !std::isfinite(high)) {
            return invalid("the range of channel '{}' is {} to {}; two finite numbers, the lower first, were expected",
                           name, low, high);
        }
        channels[*index].low = low;
        channels[*index].high = high;
    }
    std::vector<ChannelPlan> kept;
    for (const auto& name : options.columns) {
        const auto index = indexOf(channels, "the choice of columns", name, file);
        if (!index) return failure(index);
        kept.push_back(channels[*index]);
        if (secondIn(kept, &ChannelPlan::number)) return invalid("{}: {}", file, givenTwice("column '{}'", name));
    }
    if (options.columns.empty()) kept = std::move(channels);
    return kept;
}

Result<void> applyChannelOptions(Capture& capture, std::vector<ChannelPlan> plans, const ReadOptions& options,
                                 std::string_view file) {
    if (!options.timeColumn.empty() || options.skipRows != 0) {
        return invalid("{}: a time column and rows to skip belong to tables of text; this is none", file);
    }
    const auto before = plans;
    const auto planned = planChannels(std::move(plans), options, file);
    if (!planned) return failure(planned);
    std::vector<CaptureChannel> kept;
    for (const auto& plan : *planned) {
        const auto index =
            static_cast<std::size_t>(std::ranges::find(before, plan.number, &ChannelPlan::number) - before.begin());
        CaptureChannel channel = std::move(capture.channels[index]);
        channel.unit = plan.unit;
        const double ratio = plan.factor / before[index].factor;
        if (ratio != 1) {
            for (float& sample : channel.samples) sample = static_cast<float>(static_cast<double>(sample) * ratio);
            channel.low *= ratio;
            channel.high *= ratio;
            if (channel.low > channel.high) std::swap(channel.low, channel.high);
            channel.lsb *= std::abs(ratio);
            channel.offsetTolerance *= std::abs(ratio);
            channel.linearityTolerance *= std::abs(ratio);
        }
        if (plan.low < plan.high) {
            channel.low = plan.low;
            channel.high = plan.high;
        }
        kept.push_back(std::move(channel));
    }
    capture.channels = std::move(kept);
    return {};
}

Result<double> rateFrom(const ReadOptions& options) {
    const double rate = options.rate->value();
    if (!(rate > 0) || !std::isfinite(rate)) {
        return invalid("the sampling rate is {} Hz; a finite number above 0 was expected", rate);
    }
    return rate;
}

}  // namespace tacto
