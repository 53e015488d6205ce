#include "core/acquisition/SignalStreams.h"

#include <algorithm>
#include <cmath>
#include <fmt/ranges.h>

#include "core/acquisition/RecordingUnits.h"
#include "core/base/JsonText.h"
#include "core/base/LocaleFreeText.h"

namespace tacto {

namespace {

using Json = nlohmann::json;

std::string calledAs(const ColumnChoice& choice) {
    if (const auto* name = std::get_if<std::string>(&choice)) return "\"" + *name + "\"";
    return fmt::format("number {}", std::get<std::size_t>(choice));
}

std::string calledAs(const SignalStream& stream) {
    return stream.name.empty() ? fmt::format("stream {}", stream.id.value_or(0)) : "\"" + stream.name + "\"";
}

/// The place of a channel.
struct Found {
    const SignalStream* stream;
    std::size_t index;
    [[nodiscard]] std::string_view unit() const {
        return index < stream->channels.size() ? std::string_view(stream->channels[index].unit) : std::string_view();
    }
};

std::vector<Found> channelsCalled(const std::vector<const SignalStream*>& streams, const ColumnChoice& choice) {
    std::vector<Found> found;
    for (const auto* stream : streams) {
        for (std::size_t i = 0; i < stream->channels.size(); ++i) {
            const auto& channel = stream->channels[i];
            const auto* name = std::get_if<std::string>(&choice);
            if (name != nullptr ? channel.label == *name : channel.number == std::get<std::size_t>(choice))
                found.push_back({stream, i});
        }
        // Channels that the file does not describe are called by number.
        const auto* number = std::get_if<std::size_t>(&choice);
        if (number != nullptr && stream->id && *number > stream->channels.size() && *number <= stream->width)
            found.push_back({stream, *number - 1});
    }
    return found;
}

/// "A, B, C … and 12 more", of the first ones.
std::string shortList(const std::vector<std::string>& words) {
    constexpr std::size_t kMaxShown = 8;
    const auto shown = std::min(words.size(), kMaxShown);
    auto text = fmt::format("{}", fmt::join(words.begin(), words.begin() + static_cast<std::ptrdiff_t>(shown), ", "));
    if (words.size() > shown) text += fmt::format(" and {} more", words.size() - shown);
    return text;
}

std::string labelsOf(const std::vector<const SignalStream*>& streams) {
    std::vector<std::string> labels;
    std::size_t nameless = 0;
    for (const auto* stream : streams) {
        for (const auto& channel : stream->channels)
            labels.push_back(channel.label.empty() ? fmt::format("number {}", channel.number) : channel.label);
        nameless += stream->width - stream->channels.size();
    }
    if (nameless > 0 && labels.empty()) return fmt::format("numbers 1 to {}", nameless);
    return shortList(labels);
}

Result<std::vector<const SignalStream*>> streamsFor(const SignalFile& file, const SignalChoice& choice) {
    std::vector<const SignalStream*> streams;
    std::vector<std::string> names;
    for (const auto& stream : file.streams) {
        if (stream.id) names.push_back(calledAs(stream));
        const auto* name = choice.stream ? std::get_if<std::string>(&*choice.stream) : nullptr;
        const bool isMeant =
            !choice.stream || !stream.id ||
            (name != nullptr ? stream.name == *name : *stream.id == std::get<std::size_t>(*choice.stream));
        if (isMeant && (choice.stream || !stream.texts)) streams.push_back(&stream);
    }
    const bool several = !names.empty() && streams.size() > 1;
    if (streams.empty() && choice.stream)
        return fail(ErrorCode::ParseError, "\"stream\" is {}, and the file holds {}", calledAs(*choice.stream),
                    shortList(names));
    if (streams.empty()) return fail(ErrorCode::ParseError, "the file holds no signals");
    if (several && choice.stream)
        return fail(ErrorCode::ParseError,
                    "\"stream\" is {}, and {} streams are called so; its number in the file is expected, such as {}",
                    calledAs(*choice.stream), streams.size(), *streams.front()->id);
    if (several)
        return fail(ErrorCode::ParseError, "\"stream\" is missing, and the file holds {}; one of them is expected",
                    shortList(names));
    return streams;
}

/// Returns how a channel becomes what the entry says it holds.
Result<RecordedUnit> unitFor(const Found& channel, const ColumnChoice& column, const SignalChoice& choice) {
    const auto inFile = recordedUnit(choice.kind, channel.unit());
    const auto stated = recordedUnit(choice.kind, choice.unit);
    const auto accepted = fmt::format("{}", fmt::join(unitsOf(choice.kind), ", "));
    if (!choice.unit.empty() && !stated)
        return fail(ErrorCode::ParseError, "\"unit\" is \"{}\"; for {} one of {} was expected", choice.unit,
                    nameOf(choice.kind), accepted);
    if (!inFile && !stated)
        return fail(ErrorCode::ParseError, "\"unit\" is missing, and the file states {} for {}; one of {} is expected",
                    channel.unit().empty() ? std::string("none") : fmt::format("\"{}\"", channel.unit()),
                    calledAs(column), accepted);
    if (!stated) return *inFile;
    // Volts and counts become what a sensitivity ("factor") says.
    const bool contradicts = inFile && inFile->unit != StreamUnit::Count &&
                             (inFile->unit != stated->unit || inFile->factor != stated->factor);
    if (contradicts)
        return fail(ErrorCode::ParseError, "\"unit\" is \"{}\", and the file states \"{}\" for {}", choice.unit,
                    channel.unit(), calledAs(column));
    return *stated;
}

/// Returns the kind and whether `label` is a column of it, as our exports name them.
std::optional<StreamKind> ownKind(std::string_view label) {
    for (const auto& kind : kStreamKinds) {
        if (!label.starts_with(kind.text)) continue;
        const auto rest = label.substr(kind.text.size());
        if (rest.empty() || (rest.starts_with('_') && rest.size() > 1)) return kind.value;
    }
    return std::nullopt;
}

std::string rateText(const SignalStream& stream) {
    return stream.rate_hz > 0 ? fmt::format(" at {:.6g} Hz", stream.rate_hz) : std::string(" at no declared rate");
}

}  // namespace

Result<ChosenSignals> chooseSignals(const SignalFile& file, const SignalChoice& choice) {
    const auto streams = streamsFor(file, choice);
    if (!streams) return failure(streams);
    std::vector<Found> channels;
    std::vector<double> factors;
    ChosenSignals out;
    for (const auto& column : choice.columns) {
        const auto found = channelsCalled(*streams, column);
        if (found.empty())
            return fail(ErrorCode::ParseError, "\"columns\" names {}, and the file holds {}", calledAs(column),
                        labelsOf(*streams));
        if (found.size() > 1)
            return fail(ErrorCode::ParseError,
                        "\"columns\" names {}, and {} channels are called so; a number from 1 is expected in its place",
                        calledAs(column), found.size());
        if (!channels.empty() && found.front().stream != channels.front().stream)
            return fail(ErrorCode::ParseError,
                        "\"columns\" names {} with {} samples{} and {} with {}{}; channels of one rate are expected",
                        calledAs(choice.columns.front()), channels.front().stream->count,
                        rateText(*channels.front().stream), calledAs(column), found.front().stream->count,
                        rateText(*found.front().stream));
        const auto unit = unitFor(found.front(), column, choice);
        if (!unit) return failure(unit);
        if (!channels.empty() && unit->unit != out.unit)
            return fail(ErrorCode::ParseError, "\"columns\" names channels in {} and in {}; one unit is expected",
                        symbolOf(out.unit), symbolOf(unit->unit));
        out.unit = unit->unit;
        channels.push_back(found.front());
        factors.push_back(unit->factor);
    }
    const auto& stream = *channels.front().stream;
    if (stream.texts) return fail(ErrorCode::ParseError, "{} holds texts, no numbers", calledAs(stream));
    if (!stream.obstacle.empty()) return fail(ErrorCode::ParseError, "{}: {}", calledAs(stream), stream.obstacle);
    if (stream.count < 2)
        return fail(ErrorCode::ParseError, "{} has {}; 2 or more are expected",
                    stream.id ? calledAs(stream) : calledAs(choice.columns.front()),
                    stream.count == 1 ? "1 sample" : "no samples");
    out.name = stream.name;
    out.serial = stream.serial;
    out.samples.t_s = stream.samples.t_s;
    out.samples.values.reserve(stream.count * channels.size());
    for (std::size_t i = 0; i < stream.count; ++i)
        for (std::size_t c = 0; c < channels.size(); ++c)
            out.samples.values.push_back(stream.samples.values[i * stream.width + channels[c].index] * factors[c]);
    return out;
}

std::vector<SignalChoice> ownSignals(const SignalFile& file) {
    std::vector<SignalChoice> own;
    for (const auto& stream : file.streams) {
        if (stream.texts || stream.count < 2) continue;
        for (const auto& channel : stream.channels) {
            const auto kind = ownKind(channel.label);
            if (!kind || !recordedUnit(*kind, channel.unit)) continue;
            const auto stated = stream.id ? std::optional<ColumnChoice>(std::size_t{*stream.id}) : std::nullopt;
            auto choice = std::ranges::find(own, *kind, &SignalChoice::kind);
            if (choice == own.end()) {
                own.push_back({.kind = *kind, .stream = stated, .columns = {}});
                choice = std::prev(own.end());
            }
            if (choice->stream == stated) choice->columns.emplace_back(channel.number);
        }
    }
    return own;
}

void dropEmptySamples(SampleBlock& samples, std::size_t channels) {
    std::size_t kept = 0;
    for (std::size_t i = 0; i < samples.samples(); ++i) {
        const auto row = samples.values.begin() + static_cast<std::ptrdiff_t>(i * channels);
        const auto end = row + static_cast<std::ptrdiff_t>(channels);
        if (std::all_of(row, end, [](double value) { return std::isnan(value); })) continue;
        std::copy(row, end, samples.values.begin() + static_cast<std::ptrdiff_t>(kept * channels));
        samples.t_s[kept++] = samples.t_s[i];
    }
    samples.t_s.resize(kept);
    samples.values.resize(kept * channels);
}

std::string signalList(const SignalFile& file, const std::filesystem::path& path) {
    std::vector<std::string> parts;
    for (const auto& stream : file.streams) {
        std::vector<std::string> channels;
        for (const auto& channel : stream.channels)
            channels.push_back(
                fmt::format("{}{}", channel.label.empty() ? fmt::format("number {}", channel.number) : channel.label,
                            channel.unit.empty() ? std::string() : fmt::format(" [{}]", channel.unit)));
        if (channels.empty())
            channels.push_back(fmt::format("{} channel{} without a name", stream.width, stream.width == 1 ? "" : "s"));
        parts.push_back(fmt::format(
            "{}{}{}, {} {}{}{}", stream.id ? calledAs(stream) + " " : std::string(),
            stream.type.empty() ? std::string() : fmt::format("({}) ", stream.type),
            stream.texts ? std::string("texts") : shortList(channels), stream.count,
            stream.count == 1 ? "sample" : "samples", stream.texts ? std::string() : rateText(stream),
            stream.obstacle.empty() ? std::string() : fmt::format(", and cannot be used: {}", stream.obstacle)));
    }
    constexpr std::size_t kMaxShown = 40;
    const auto shown = static_cast<std::ptrdiff_t>(std::min(parts.size(), kMaxShown));
    return fmt::format("{} holds {}{}", path.filename().string(),
                       parts.empty() ? std::string("no signals")
                                     : fmt::format("{}", fmt::join(parts.begin(), parts.begin() + shown, "; ")),
                       parts.size() > kMaxShown ? fmt::format("; and {} more streams", parts.size() - kMaxShown) : "");
}

Result<RecordingDraft> draftSignals(const SignalFile& file, const std::filesystem::path& path) {
    struct Entry {
        std::optional<StreamKind> kind;
        const SignalStream* stream;
        std::vector<SignalChannel> channels;
    };
    RecordingDraft out;
    std::vector<Entry> entries;
    std::vector<std::string> left;
    const auto take = [&](std::optional<StreamKind> kind, const SignalStream& stream, const SignalChannel& channel) {
        const std::size_t most = kind == StreamKind::Taxels ? 1024 : kind == StreamKind::Force ? 1 : 3;
        auto entry = std::ranges::find(entries, kind, &Entry::kind);
        if (entry == entries.end()) entry = entries.insert(entries.end(), {kind, &stream, {}});
        if (entry->stream == &stream && entry->channels.size() < most)
            entry->channels.push_back(channel);
        else
            left.push_back(
                fmt::format("{}{}", stream.name.empty() ? std::string() : stream.name + ": ",
                            channel.label.empty() ? fmt::format("number {}", channel.number) : channel.label));
    };
    for (const bool known : {true, false}) {  // of what no word tells the kind, only if nothing else is there
        if (!known && !entries.empty()) break;
        for (const auto& stream : file.streams) {
            if (stream.texts || stream.count < 2 || !stream.obstacle.empty()) continue;
            auto ofStream = kindByName(lowered(stream.type));
            if (!ofStream) ofStream = kindByName(lowered(stream.name));
            auto channels = stream.channels;
            for (std::size_t i = 0; stream.channels.empty() && i < std::min<std::size_t>(stream.width, 3); ++i)
                channels.push_back({.label = "", .unit = "", .number = i + 1});
            for (const auto& channel : channels) {
                auto kind = kindByUnit(channel.unit);
                if (!kind) kind = ofStream;
                if (!kind) kind = kindByName(lowered(channel.label));
                if (kind.has_value() == known) take(kind, stream, channel);
            }
        }
    }
    if (entries.empty())
        return fail(ErrorCode::ParseError, "{}: {}; nothing in it can be a fingertip's", path.string(),
                    signalList(file, path));
    std::string streams;
    for (std::size_t i = 0; i < entries.size(); ++i) {
        const auto& entry = entries[i];
        const auto open = [&](const char* key, const std::string& accepted) {
            out.open.push_back(fmt::format("streams[{}]: \"{}\": {}", i, key, accepted));
            return std::string("null");
        };
        auto columns = Json::array();
        for (const auto& channel : entry.channels) {
            const bool alone = !channel.label.empty() &&
                               std::ranges::count(entry.stream->channels, channel.label, &SignalChannel::label) == 1;
            columns.push_back(alone ? Json(channel.label) : Json(channel.number));
        }
        const auto kind = entry.kind ? dumpJson(nameOf(*entry.kind))
                                     : open("kind", "acceleration, force or taxels, as what the columns hold");
        std::string which;
        if (entry.stream->id) {
            const bool alone = !entry.stream->name.empty() &&
                               std::ranges::count(file.streams, entry.stream->name, &SignalStream::name) == 1;
            which = ", \"stream\": " + dumpJson(alone ? Json(entry.stream->name) : Json(*entry.stream->id));
        }
        const bool stated = entry.kind && std::ranges::all_of(entry.channels, [&](const auto& channel) {
                                return recordedUnit(*entry.kind, channel.unit).has_value();
                            });
        std::string unit;
        if (!stated) {
            const auto accepted = entry.kind ? fmt::format("one of {}", fmt::join(unitsOf(*entry.kind), ", "))
                                             : std::string("the unit of its numbers, count where it is not known");
            unit = ", \"unit\": " + open("unit", accepted);
        }
        streams += fmt::format("{}    {{\"kind\": {}, \"file\": {}{},\n     \"columns\": {}{}}}", i == 0 ? "" : ",\n",
                               kind, dumpJson(path.filename().string()), which, dumpJson(columns), unit);
    }
    out.taken.push_back(signalList(file, path));
    if (!left.empty()) out.taken.push_back("not taken: " + shortList(left));
    out.json =
        fmt::format("{{\n  \"title\": {},\n  \"source\": \"\",\n  \"licence\": \"\",\n  \"streams\": [\n{}\n  ]\n}}\n",
                    dumpJson(path.stem().string()), streams);
    return out;
}

}  // namespace tacto
