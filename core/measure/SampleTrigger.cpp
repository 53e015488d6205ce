#include "core/measure/SampleTrigger.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "core/base/QuantityText.h"

namespace tacto {

namespace {

constexpr Word<TriggerEdge> kEdges[] = {
    {"rising", TriggerEdge::Rising}, {"falling", TriggerEdge::Falling}, {"either", TriggerEdge::Either}};
constexpr Word<TriggerEdge> kPolarities[] = {
    {"positive", TriggerEdge::Rising}, {"negative", TriggerEdge::Falling}, {"either", TriggerEdge::Either}};

constexpr double kMaxTriggerTime_s = 10;

constexpr TriggerField kHysteresisField{"hysteresis",
                                        "Hysteresis",
                                        false,
                                        0,
                                        1,
                                        "The signal must come from this far beyond the level before it triggers again: "
                                        "noise on an edge then triggers once.",
                                        &SampleTrigger::hysteresis};
constexpr TriggerField kHoldOffField{
    "holdOff",
    "Hold-off",
    true,
    0,
    kMaxTriggerTime_s,
    "No trigger sooner than this after the last one. Longer than a burst, it shows every burst from its first pulse.",
    &SampleTrigger::holdOff_s};
constexpr TriggerField kUpperField{"upper",
                                   "Not reaching",
                                   false,
                                   -1,
                                   1,
                                   "The upper threshold: a pulse that reaches it is whole and is passed over.",
                                   &SampleTrigger::upper};
constexpr TriggerField kShortestField{
    "shortest", "Shorter limit", true, 0, kMaxTriggerTime_s, "It is itself inside.", &SampleTrigger::shortest_s};
constexpr TriggerField kLongestField{
    "longest", "Longer limit", true, 0, kMaxTriggerTime_s, "It is itself inside.", &SampleTrigger::longest_s};

/// A part of the record in which the signal exceeds a level, in samples.
struct Excess {
    double begin = 0, end = 0;
    double peak = 0;
    bool clipped = false;
};

/// Calls begun(place) and ended(stretch) for each stretch in which sign · signal exceeds `level`.
template <class Begun, class Ended>
void exceeding(const CaptureChannel& channel, double sign, double level, double hysteresis, Begun begun, Ended ended) {
    const double limit = sign > 0 ? channel.high : -channel.low;
    const bool limited = channel.low < channel.high;
    bool ready = false, above = false;
    double before = 0;
    Excess now;
    for (std::size_t i = 0; i < channel.samples.size(); ++i) {
        const double x = sign * static_cast<double>(channel.samples[i]);
        if (!std::isfinite(x)) {
            ready = above = false;
            continue;
        }
        const auto crossing = [&] { return static_cast<double>(i) - (x - level) / (x - before); };
        const bool below = x < level - hysteresis;
        if (above) {
            if (before >= level && x < level) now.end = crossing();
            now.peak = std::max(now.peak, x);
            now.clipped = now.clipped || (limited && x >= limit);
            above = !below;
            ready = below;
            if (below) ended(now);
        } else if (ready && x >= level) {
            now = {crossing(), 0, x, limited && x >= limit};
            above = true;
            begun(now.begin);
        } else {
            ready = ready || below;
        }
        before = x;
    }
}

bool triggersOn(double width_s, const SampleTrigger& trigger) {
    const bool least = width_s >= trigger.shortest_s, most = width_s <= trigger.longest_s;
    switch (trigger.widths) {
        case WidthRule::Inside:
            return least && most;
        case WidthRule::Outside:
            return !least || !most;
        case WidthRule::Less:
            return most;
        case WidthRule::Greater:
            break;
    }
    return least;
}

CaptureChannel magnitudeOf(CaptureChannel channel) {
    for (auto& x : channel.samples) x = std::abs(x);
    return channel;
}

Capture partOf(const Capture& record, std::size_t first, std::size_t samples) {
    Capture part = record;
    const auto from = static_cast<std::ptrdiff_t>(first), to = static_cast<std::ptrdiff_t>(first + samples);
    for (auto& channel : part.channels) {
        channel.samples.erase(channel.samples.begin() + to, channel.samples.end());
        channel.samples.erase(channel.samples.begin(), channel.samples.begin() + from);
    }
    part.start_s += static_cast<double>(first) / record.rate_hz;
    return part;
}

std::shared_ptr<const Capture> asUntriggered(Capture capture) {
    capture.untriggered = true;
    capture.trigger_s = kNaN;
    return std::make_shared<const Capture>(std::move(capture));
}

}  // namespace

std::span<const TriggerKindInfo> triggerKinds() {
    static const std::array kKinds{
        TriggerKindInfo{TriggerKind::Magnitude,
                        "magnitude",
                        "Magnitude",
                        "Level",
                        {},
                        {kHoldOffField},
                        "The oscilloscope's own trigger: the magnitude of the signal rises through the level."},
        TriggerKindInfo{TriggerKind::Slope,
                        "slope",
                        "Slope",
                        "Level",
                        kEdges,
                        {kHysteresisField, kHoldOffField},
                        "The signal crosses the level, with its sign. Searched for in the samples by this program."},
        TriggerKindInfo{
            TriggerKind::Width,
            "width",
            "Pulse width",
            "Level",
            kPolarities,
            {kShortestField, kLongestField, kHysteresisField, kHoldOffField},
            "A pulse ends whose width at the level is inside or outside two limits, or less or greater than "
            "one. Searched for in the samples by this program."},
        TriggerKindInfo{TriggerKind::Runt,
                        "runt",
                        "Runt",
                        "Beyond",
                        kPolarities,
                        {kUpperField, kHysteresisField, kHoldOffField},
                        "A pulse ends that passed one threshold and did not reach the other. Searched for in the "
                        "samples by this program."}};
    return kKinds;
}

const TriggerKindInfo& infoOf(TriggerKind kind) { return triggerKinds()[static_cast<std::size_t>(kind)]; }

bool uses(const SampleTrigger& trigger, const TriggerField& field) {
    if (trigger.kind != TriggerKind::Width) return true;
    return !(field.value == &SampleTrigger::shortest_s && trigger.widths == WidthRule::Less) &&
           !(field.value == &SampleTrigger::longest_s && trigger.widths == WidthRule::Greater);
}

Result<void> checkTrigger(const SampleTrigger& trigger, double fullScale, std::string_view unit) {
    const auto refused = [](std::string_view what, double value, double least, double most, std::string_view in) {
        return fail(ErrorCode::InvalidArgument, "{} {}: {} to {} is accepted", what, exactText(value, in),
                    exactText(least, in), exactText(most, in));
    };
    const auto& info = infoOf(trigger.kind);
    if (!(std::abs(trigger.level) <= fullScale))
        return refused("trigger level", trigger.level, -fullScale, fullScale, unit);
    for (const auto& field : info.fields) {
        if (!uses(trigger, field)) continue;
        const double value = trigger.*field.value, scale = field.isTime ? 1 : fullScale;
        if (!(value >= field.least * scale) || !(value <= field.most * scale))
            return refused(field.title, value, field.least * scale, field.most * scale, field.isTime ? "s" : unit);
    }
    if (trigger.kind == TriggerKind::Runt && !(trigger.upper > trigger.level)) {
        return fail(ErrorCode::InvalidArgument, "{} {}: more than the first threshold of {} is accepted",
                    kUpperField.title, exactText(trigger.upper, unit), exactText(trigger.level, unit));
    }
    const bool bothLimits = trigger.widths == WidthRule::Inside || trigger.widths == WidthRule::Outside;
    if (trigger.kind == TriggerKind::Width && bothLimits && !(trigger.longest_s >= trigger.shortest_s)) {
        return fail(ErrorCode::InvalidArgument, "{} {}: no less than the shorter one, {}, is accepted",
                    kLongestField.title, exactText(trigger.longest_s, "s"), exactText(trigger.shortest_s, "s"));
    }
    return {};
}

std::vector<double> triggersIn(const CaptureChannel& channel, double rate_hz, const SampleTrigger& trigger) {
    std::vector<double> found;
    if (!(rate_hz > 0)) return found;
    if (!searched(trigger.kind)) {
        SampleTrigger rising;
        rising.kind = TriggerKind::Slope;
        rising.level = trigger.level;
        return triggersIn(magnitudeOf(channel), rate_hz, rising);
    }
    for (const double sign : {1.0, -1.0}) {
        if (trigger.edge == (sign > 0 ? TriggerEdge::Falling : TriggerEdge::Rising)) continue;
        // A negative runt begins at the upper threshold and must not reach the lower one.
        const bool runt = trigger.kind == TriggerKind::Runt;
        const double first = sign * (runt && sign < 0 ? trigger.upper : trigger.level);
        const double second = sign * (sign < 0 ? trigger.level : trigger.upper);
        exceeding(
            channel, sign, first, trigger.hysteresis,
            [&](double begin) {
                if (trigger.kind == TriggerKind::Slope) found.push_back(begin);
            },
            [&](const Excess& its) {
                const bool wide =
                    trigger.kind == TriggerKind::Width && triggersOn((its.end - its.begin) / rate_hz, trigger);
                if (wide || (runt && its.peak < second && !its.clipped)) found.push_back(its.end);
            });
    }
    std::sort(found.begin(), found.end());
    return found;
}

void SampleTriggerSearch::set(const SampleTrigger& trigger, std::string_view unit, std::size_t samples,
                              double preTrigger) {
    trigger_ = trigger;
    unit_ = unit;
    samples_ = samples;
    preTrigger_ = preTrigger;
}

std::shared_ptr<const Capture> SampleTriggerSearch::take(std::shared_ptr<const Capture> record) {
    if (!record) return record;
    if (!searched(trigger_.kind)) {
        if (!std::isfinite(record->trigger_s)) return record;
        if (heldOff(record->trigger_s)) return asUntriggered(*record);
        last_s_ = record->trigger_s;
        return record;
    }
    const std::size_t samples = std::min(samples_, record->samples()), most = record->samples() - samples;
    const double before = std::round(preTrigger_ * static_cast<double>(samples));
    const auto channel = std::find_if(record->channels.begin(), record->channels.end(),
                                      [this](const CaptureChannel& its) { return its.unit == unit_; });
    if (channel != record->channels.end()) {
        for (const double at : triggersIn(*channel, record->rate_hz, trigger_)) {
            const double first = std::floor(at) - before, at_s = record->start_s + at / record->rate_hz;
            if (!(first >= 0) || !(first <= static_cast<double>(most)) || heldOff(at_s)) continue;
            last_s_ = at_s;
            auto part = partOf(*record, static_cast<std::size_t>(first), samples);
            part.trigger_s = at_s;
            part.untriggered = false;
            return std::make_shared<const Capture>(std::move(part));
        }
    }
    return asUntriggered(partOf(*record, most / 2, samples));
}

}  // namespace tacto
