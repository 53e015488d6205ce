#include "core/measure/InstrumentStatement.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <fmt/ranges.h>

#include "core/base/LocaleFreeText.h"
#include "core/base/RecordFields.h"

namespace tacto {

namespace {

Stated over(const Stated& under, const Stated& above) { return above.known() ? above : under; }

ChannelStatement over(const ChannelStatement& under, const ChannelStatement& above) {
    ChannelStatement out{over(under.gain, above.gain), over(under.offset, above.offset),
                         over(under.linearity, above.linearity), over(under.probe, above.probe),
                         over(under.resolution, above.resolution)};
    // A stated gain error includes linearity, unless linearity (a share of full scale) is stated with it.
    if (above.gain.known() && !above.linearity.known()) out.linearity = {};
    return out;
}

/// Builds "gain by certificate 4711" and lists other figures with the same source next to the first.
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
    // A share of an unknown range is unknown, so the gain is then not known either.
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

namespace {

using nlohmann::json;

constexpr Word<bool> kGainOf[] = {{"reading", false}, {"full scale", true}};
constexpr double kMaxPct = 50;
constexpr double kMaxPpm = 1e5;
constexpr std::size_t kMaxNames = 10'000;

bool modelMatches(std::string_view pattern, std::string_view model) {
    if (!pattern.ends_with('*')) return sameLetters(pattern, model);
    pattern.remove_suffix(1);
    return model.size() >= pattern.size() && sameLetters(pattern, model.substr(0, pattern.size()));
}

/// Reads a share that is stated in `unit`; `perUnit` is one unit as a share of the whole.
ValueKind<double> shareKind(double most, std::string_view unit, double perUnit) {
    const auto stated = numberKind<double>({.low = 0, .high = most, .unit = unit});
    ValueKind<double> kind;
    kind.info = stated.info;
    kind.reads([stated, perUnit](const json& value, double& into, const RecordPlace& place, std::string_view key) {
        auto done = stated.read(value, into, place, key);
        into *= perUnit;
        return done;
    });
    kind.writes([perUnit](double share) { return json(share / perUnit); });
    return kind;
}

/// Reads a maker or a model pattern. A pattern may have one * at its end, after other text.
ValueKind<std::string> nameKind(const char* accepted, bool pattern) {
    return codedKind<std::string>(
        accepted,
        [pattern](const json& value) -> std::optional<std::string> {
            const auto* name = value.get_ptr<const std::string*>();
            if (name == nullptr || name->empty()) return std::nullopt;
            const auto star = name->find('*');
            const bool sound = star == std::string::npos || (pattern && star > 0 && star + 1 == name->size());
            return sound ? std::optional(*name) : std::nullopt;
        },
        [](const std::string& name) { return json(name); });
}

/// Adds the keys that stand next to the value of every figure.
void addSheet(RecordFields<InstrumentProfile>& figure, SheetFigure InstrumentProfile::*member) {
    figure.text("source", in(member, &SheetFigure::source)).required = true;
    figure.text("address", in(member, &SheetFigure::address)).required = true;
    figure.word("confidence", in(member, &SheetFigure::confidence), kConfidences).required = true;
    figure.text("condition", in(member, &SheetFigure::condition));
}

RecordFields<InstrumentProfile> buildInstrumentFields() {
    using P = InstrumentProfile;
    RecordFields<P> gain, timeBase, all;
    gain.word("of", &P::gainOfFullScale, kGainOf).required = true;
    gain.add("pct", in(&P::gain, &SheetFigure::value), shareKind(kMaxPct, "%", 1e-2)).required = true;
    addSheet(gain, &P::gain);
    timeBase.add("ppm", in(&P::timeBase, &SheetFigure::value), shareKind(kMaxPpm, "ppm", 1e-6)).required = true;
    timeBase.add("ppm_per_year", in(&P::timeBase, &SheetFigure::perYear), shareKind(kMaxPpm, "ppm", 1e-6));
    addSheet(timeBase, &P::timeBase);

    all.text("id", &P::id).required = true;
    all.text("title", &P::title).required = true;
    all.list("makers", &P::makers, nameKind("a maker's name", false), 1, kMaxNames).required = true;
    all.list("models", &P::models, nameKind("a model, or its beginning and *,", true), 1, kMaxNames).required = true;
    all.note("note");
    for (const auto& [key, figure] : {std::pair("gain", gain), std::pair("time_base", timeBase)}) {
        auto& field = all.record(key, std::identity{}, figure);
        field.required = true;
        field.mayBeNull = true;  // null: no source states the value
    }
    return all;
}

}  // namespace

bool InstrumentProfile::matches(std::string_view name) const {
    return std::ranges::any_of(makers, [&](const std::string& maker) {
        if (name.size() <= maker.size() || name[maker.size()] != ' ') return false;
        if (!sameLetters(maker, name.substr(0, maker.size()))) return false;
        const auto model = name.substr(maker.size() + 1);
        return std::ranges::any_of(models, [&](const std::string& pattern) { return modelMatches(pattern, model); });
    });
}

InstrumentStatement InstrumentProfile::statement() const {
    InstrumentStatement out;
    const auto by = "data sheet of the " + title;
    if (std::isfinite(gain.value)) {
        ChannelStatement channel;
        channel.gain = {gainOfFullScale ? 0 : gain.value, by};
        if (gainOfFullScale) channel.linearity = {gain.value, by};
        out.voltage = out.current = channel;
    }
    if (std::isfinite(timeBase.value)) out.timeBase = {timeBase.value + kYearsOfDrift * timeBase.perYear, by};
    return out;
}

Result<InstrumentProfile> parseInstrumentProfile(std::string_view text, std::string_view source) {
    return parseRecord(builtOnce<buildInstrumentFields>(), text, source);
}

InstrumentStatement statementOf(const std::vector<InstrumentProfile>& profiles, std::string_view name) {
    const auto found =
        std::ranges::find_if(profiles, [&](const InstrumentProfile& profile) { return profile.matches(name); });
    return found == profiles.end() ? InstrumentStatement{} : found->statement();
}

}  // namespace tacto
