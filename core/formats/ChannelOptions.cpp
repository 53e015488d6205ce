#include "core/formats/ChannelOptions.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <cmath>
#include <fmt/ranges.h>

#include "core/base/GivenOnce.h"
#include "core/base/Text.h"

namespace tacto {

namespace {

struct KnownUnit {
    std::string_view spelled;  // lower case
    SpelledUnit means;
};
constexpr std::array<KnownUnit, 36> kUnits{{{"", {"", 1}},
                                            {"s", {"s", 1}},
                                            {"sec", {"s", 1}},
                                            {"second", {"s", 1}},
                                            {"seconds", {"s", 1}},
                                            {"ms", {"s", 1e-3}},
                                            {"us", {"s", 1e-6}},
                                            {"ns", {"s", 1e-9}},
                                            {"ps", {"s", 1e-12}},
                                            {"v", {"V", 1}},
                                            {"volt", {"V", 1}},
                                            {"volts", {"V", 1}},
                                            {"mv", {"V", 1e-3}},
                                            {"uv", {"V", 1e-6}},
                                            {"kv", {"V", 1e3}},
                                            {"a", {"A", 1}},
                                            {"amp", {"A", 1}},
                                            {"amps", {"A", 1}},
                                            {"ampere", {"A", 1}},
                                            {"amperes", {"A", 1}},
                                            {"ma", {"A", 1e-3}},
                                            {"ua", {"A", 1e-6}},
                                            {"na", {"A", 1e-9}},
                                            {"ka", {"A", 1e3}},
                                            {"value", {"", 1}},
                                            {"logic", {"", 1}},
                                            {"none", {"", 1}},
                                            {"msec", {"s", 1e-3}},
                                            {"usec", {"s", 1e-6}},
                                            {"nsec", {"s", 1e-9}},
                                            {"milliseconds", {"s", 1e-3}},
                                            {"microseconds", {"s", 1e-6}},
                                            {"nanoseconds", {"s", 1e-9}},
                                            {"picoseconds", {"s", 1e-12}},
                                            {"v dc", {"V", 1}},
                                            {"a dc", {"A", 1}}}};

std::string namesOf(const std::vector<ChannelPlan>& channels) {
    std::vector<std::string> names;
    for (const auto& channel : channels) names.push_back(fmt::format("{} ({})", channel.name, channel.number));
    return fmt::format("{}", fmt::join(names, ", "));
}

/// By name first: a channel may be called "1" and be the second column.
std::optional<std::size_t> indexOf(const std::vector<ChannelPlan>& channels, std::string_view wanted) {
    for (std::size_t i = 0; i < channels.size(); ++i) {
        const auto& channel = channels[i];
        const auto asColumn = channel.unit.empty() ? channel.name : fmt::format("{}_{}", channel.name, channel.unit);
        if (folded(channel.name) == folded(wanted) || folded(asColumn) == folded(wanted)) return i;
    }
    const auto number = parseNumber(wanted);
    for (std::size_t i = 0; i < channels.size() && number; ++i) {
        if (static_cast<double>(channels[i].number) == *number) return i;
    }
    return std::nullopt;
}

tl::unexpected<Error> noChannel(const std::vector<ChannelPlan>& channels, std::string_view option,
                                std::string_view wanted, std::string_view file) {
    return fail(ErrorCode::InvalidArgument, "{}: there is no channel '{}', which {} names; there are {}", file, wanted,
                option, channels.empty() ? "none" : namesOf(channels));
}

}  // namespace

std::string folded(std::string_view text) {
    std::string result(trimmed(text));
    std::ranges::transform(result, result.begin(), [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
    return result;
}

std::optional<SpelledUnit> spelledUnit(std::string_view text) {
    auto wanted = folded(text);
    for (const std::string_view micro : {"µ", "μ"}) {
        if (wanted.starts_with(micro)) wanted.replace(0, micro.size(), "u");
    }
    if (wanted.starts_with('\xB5')) wanted[0] = 'u';  // the micro sign of Latin-1
    const auto found = std::ranges::find(kUnits, wanted, &KnownUnit::spelled);
    return found == kUnits.end() ? std::nullopt : std::optional(found->means);
}

std::optional<SpelledUnit> channelUnit(std::string_view text) {
    const auto unit = spelledUnit(text);
    return unit && unit->unit == "s" ? std::nullopt : unit;
}

Result<std::vector<ChannelPlan>> planChannels(std::vector<ChannelPlan> channels, const ReadOptions& options,
                                              std::string_view file) {
    for (const auto& [name, spelled] : options.units) {
        const auto index = indexOf(channels, name);
        if (!index) return noChannel(channels, "the unit", name, file);
        const auto unit = channelUnit(spelled);
        if (!unit) {
            return fail(ErrorCode::InvalidArgument,
                        "the unit '{}' of channel '{}' is unknown; V or A with k, m, u or n were expected", spelled,
                        name);
        }
        channels[*index].unit = unit->unit;
        channels[*index].factor = unit->factor;
        channels[*index].unknownUnit.clear();
    }
    for (const auto& [name, factor] : options.probeFactors) {
        const auto index = indexOf(channels, name);
        if (!index) return noChannel(channels, "the probe factor", name, file);
        if (!std::isfinite(factor) || factor == 0) {
            return fail(ErrorCode::InvalidArgument,
                        "the probe factor of channel '{}' is {}; a finite number other than 0 was expected", name,
                        factor);
        }
        channels[*index].factor *= factor;
    }
    for (const auto& [name, range] : options.ranges) {
        const auto index = indexOf(channels, name);
        if (!index) return noChannel(channels, "the range", name, file);
        const auto& [low, high] = range;
        if (!(low < high) || !std::isfinite(low) || !std::isfinite(high)) {
            return fail(ErrorCode::InvalidArgument,
                        "the range of channel '{}' is {} to {}; two finite numbers, the lower first, were expected",
                        name, low, high);
        }
        channels[*index].low = low;
        channels[*index].high = high;
    }
    std::vector<ChannelPlan> kept;
    for (const auto& name : options.columns) {
        const auto index = indexOf(channels, name);
        if (!index) return noChannel(channels, "the choice of columns", name, file);
        kept.push_back(channels[*index]);
        if (secondIn(kept, &ChannelPlan::number))
            return fail(ErrorCode::InvalidArgument, "{}: {}", file, givenTwice("column '{}'", name));
    }
    if (options.columns.empty()) kept = std::move(channels);
    return kept;
}

Result<void> applyChannelOptions(Capture& capture, std::vector<ChannelPlan> plans, const ReadOptions& options,
                                 std::string_view file) {
    if (!options.timeColumn.empty() || options.skipRows != 0) {
        return fail(ErrorCode::InvalidArgument,
                    "{}: a time column and rows to skip belong to tables of text; this is none", file);
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
        return fail(ErrorCode::InvalidArgument, "the sampling rate is {} Hz; a finite number above 0 was expected",
                    rate);
    }
    return rate;
}

}  // namespace tacto
