#include "core/exchange/xdf/XdfExport.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <pugixml.hpp>
#include <sstream>

#include "core/base/JsonText.h"
#include "core/base/Printable.h"
#include "core/exchange/ExportMoments.h"
#include "core/exchange/ExportTables.h"
#include "core/exchange/PieceOut.h"
#include "core/exchange/xdf/XdfNames.h"

namespace tacto {

namespace {

using namespace xdf;

constexpr double kBoundaryEach_s = 10;

class XdfOut : public PieceOut {
public:
    explicit XdfOut(const std::filesystem::path& path) : PieceOut(path) { text_ += kMagic; }

    template <class Number>
    static void put(std::string& into, Number number) {
        char bytes[sizeof number];
        std::memcpy(bytes, &number, sizeof number);
        into.append(bytes, sizeof number);
    }
    static void putLength(std::string& into, std::size_t length) {
        into += '\x04';
        put(into, static_cast<std::uint32_t>(length));
    }

    /// A chunk whose content is made of these parts. No chunk is as long as 4 GiB.
    [[nodiscard]] Result<void> chunk(Tag tag, std::initializer_list<std::string_view> parts) {
        std::size_t bytes = sizeof(std::uint16_t);
        for (const auto part : parts) bytes += part.size();
        putLength(text_, bytes);
        put(text_, static_cast<std::uint16_t>(tag));
        for (const auto part : parts) text_ += part;
        return flushIfFull();
    }
    [[nodiscard]] Result<void> ofStream(Tag tag, std::uint32_t id, std::string_view content) {
        std::string number;
        put(number, id);
        return chunk(tag, {number, content});
    }
};

/// Adds <name>text</name>; characters that XML 1.0 does not have are written as escapes.
pugi::xml_node addText(pugi::xml_node to, const char* name, std::string_view text) {
    auto node = to.append_child(name);
    node.text().set(printable(text).c_str());
    return node;
}
pugi::xml_node addNumber(pugi::xml_node to, const char* name, double number) {
    return addText(to, name, fmt::format("{}", number));
}

std::string xmlText(const pugi::xml_document& document) {
    std::ostringstream out;
    out << "<?xml version=\"1.0\"?>";
    document.save(out, "", pugi::format_raw | pugi::format_no_declaration, pugi::encoding_utf8);
    return std::move(out).str();
}

/// A stream in the file: header, samples, and what its footer says.
class StreamOut {
public:
    struct Channel {
        std::string label, unit, type;
    };
    StreamOut(XdfOut& out, std::uint32_t id, double duration_s) : out_(out), id_(id), duration_s_(duration_s) {}

    /// `describe` adds to <desc>.
    template <class Describe>
    [[nodiscard]] Result<void> begin(std::string_view name, std::string_view type, Format format, double rate_hz,
                                     const std::vector<Channel>& channels, Describe&& describe) {
        pugi::xml_document document;
        auto info = document.append_child(kInfo);
        addText(info, "name", name);
        addText(info, "type", type);
        addNumber(info, "channel_count", static_cast<double>(channels.size()));
        addNumber(info, "nominal_srate", rate_hz);
        addText(info, "channel_format", wordFor(kFormats, format));
        addText(info, "source_id", "Tactoscope");
        auto desc = info.append_child("desc");
        describe(desc);
        auto list = desc.append_child("channels");
        for (const auto& channel : channels) {
            auto node = list.append_child("channel");
            addText(node, "label", channel.label);
            addText(node, "unit", channel.unit);
            addText(node, "type", channel.type);
        }
        return out_.ofStream(Tag::StreamHeader, id_, xmlText(document));
    }

    /// Adds a sample whose values stand in `value` as the format has them.
    [[nodiscard]] Result<void> add(double t_s, std::string_view values) {
        if (count_ == 0) first_s_ = t_s;
        last_s_ = t_s;
        ++count_;
        samples_ += kStamped;
        XdfOut::put(samples_, t_s);
        samples_ += values;
        if (held_++ == 0) begun_s_ = t_s;
        if (std::floor(t_s / kBoundaryEach_s) != std::floor(begun_s_ / kBoundaryEach_s)) {
            if (auto flushed = flush(); !flushed) return flushed;
            return out_.chunk(Tag::Boundary, {kBoundary});
        }
        constexpr std::size_t kPiece = std::size_t{1} << 16;
        return samples_.size() >= kPiece ? flush() : Result<void>();
    }

    [[nodiscard]] Result<void> end() {
        if (auto flushed = flush(); !flushed) return flushed;
        pugi::xml_document document;
        auto info = document.append_child(kInfo);
        if (count_ > 0) {
            addNumber(info, "first_timestamp", first_s_);
            addNumber(info, "last_timestamp", last_s_);
        }
        addNumber(info, "sample_count", static_cast<double>(count_));
        auto offsets = info.append_child("clock_offsets");
        for (const double at_s : {0.0, duration_s_}) {
            auto offset = offsets.append_child("offset");
            addNumber(offset, "time", at_s);
            addNumber(offset, "value", 0);
            std::string content;
            XdfOut::put(content, at_s);
            XdfOut::put(content, 0.0);
            if (auto written = out_.ofStream(Tag::ClockOffset, id_, content); !written) return written;
        }
        if (auto written = out_.ofStream(Tag::StreamFooter, id_, xmlText(document)); !written) return written;
        return out_.chunk(Tag::Boundary, {kBoundary});
    }

private:
    [[nodiscard]] Result<void> flush() {
        if (held_ == 0) return {};
        std::string head;
        XdfOut::put(head, id_);
        XdfOut::putLength(head, held_);
        auto written = out_.chunk(Tag::Samples, {head, samples_});
        samples_.clear();
        held_ = 0;
        return written;
    }

    XdfOut& out_;
    std::uint32_t id_;
    double duration_s_;
    std::string samples_;  // of the chunk that is being made
    std::size_t held_ = 0;
    std::uint64_t count_ = 0;
    double first_s_ = 0, last_s_ = 0;
    double begun_s_ = 0;  // the first stamp of the chunk that is being made
};

Result<void> writeStream(const ExportSource& source, const ExportStream& stream, StreamOut out) {
    std::vector<StreamOut::Channel> channels;
    for (const auto& channel : stream.channels)
        channels.push_back({channel.name, channel.unit, std::string(typeOf(channel.unit))});
    const auto describe = [&](pugi::xml_node desc) {
        addText(desc, "title", stream.title);
        if (std::isfinite(stream.rate_hz)) addNumber(desc, "rate_hz", stream.rate_hz);
        addText(desc, "regular", stream.regular ? "1" : "0");
        addText(desc, kSimulated, stream.simulated ? "1" : "0");
        if (stream.channelR()) addText(desc, "R_calibrated", source.calibratedR() ? "1" : "0");
        for (const auto& device : source.about().devices)
            if (device.is(Role::Sensor) && !device.serial.empty() && desc.child(kSerial).empty())
                addText(desc, kSerial, device.serial);
    };
    const double rate_hz = stream.regular && stream.rate_hz > 0 ? stream.rate_hz : 0;
    if (auto begun = out.begin(stream.name, stream.kind, Format::Double64, rate_hz, channels, describe); !begun)
        return begun;
    const auto width = stream.channels.size() * sizeof(double);
    auto read = source.forEachChunk(stream, [&](const SampleBlock& block) -> Result<void> {
        const std::string_view values(reinterpret_cast<const char*>(block.values.data()),
                                      block.values.size() * sizeof(double));
        for (std::size_t i = 0; i < block.samples(); ++i)
            if (auto added = out.add(block.t_s[i], values.substr(i * width, width)); !added) return added;
        return {};
    });
    return read ? out.end() : read;
}

Result<void> writeTrains(const ExportSource& source, StreamOut out) {
    const auto& table = source.trains();
    std::vector<StreamOut::Channel> channels;
    for (const auto& channel : numberChannels(table)) channels.push_back({channel.name, channel.unit, kOfTrains});
    if (auto begun = out.begin(table.name, table.name, Format::Double64, 0, channels,
                               [&](pugi::xml_node desc) { addText(desc, "title", table.title); });
        !begun)
        return begun;
    std::string values;
    auto read = source.forEachRow(table, [&](std::span<const ExportCell> cells) -> Result<void> {
        values.clear();
        for (const double number : numbersIn(cells)) XdfOut::put(values, number);
        return out.add(std::get<double>(cells[0]), values);
    });
    return read ? out.end() : read;
}

/// A stream of one text a sample; `each` hands every time and text to its argument.
template <class Each>
Result<void> writeTexts(StreamOut out, std::string_view name, std::string_view type, Each&& each) {
    const std::vector<StreamOut::Channel> channels{{std::string(name), "", std::string(type)}};
    if (auto begun = out.begin(name, type, Format::String, 0, channels, [](pugi::xml_node) {}); !begun) return begun;
    std::string value;
    auto read = each([&](double t_s, std::string_view text) {
        value.clear();
        XdfOut::putLength(value, text.size());
        value += text;
        return out.add(t_s, value);
    });
    return read ? out.end() : read;
}

Result<void> writeXdf(const ExportSource& source, const std::filesystem::path& draft, ExportReport& report) {
    XdfOut out(draft);
    pugi::xml_document document;
    auto info = document.append_child(kInfo);
    addText(info, "version", "1.0");
    addText(info, "datetime", source.wallStart());
    addText(info, kProgram, fmt::format("{} {}", kProgramName, source.version()));
    addText(info, "session", source.name());
    addText(info, "chain_head", source.chainHead());
    addText(info, kSimulated, source.simulated() ? "1" : "0");
    addText(info, "marks", source.marksText());
    addText(info, "about", dumpJson(source.description()));
    if (auto written = out.chunk(Tag::FileHeader, {xmlText(document)}); !written) return written;

    // Two moments of the one clock, apart even in a session without length.
    const double duration_s = std::max(source.duration_s(), 1.0);
    std::uint32_t id = 0;
    const auto next = [&] { return StreamOut(out, ++id, duration_s); };
    for (const auto& stream : source.streams()) {
        if (auto written = writeStream(source, stream, next()); !written) return written;
        report.wroteExactly(stream);
    }
    if (auto written = writeTrains(source, next()); !written) return written;
    auto events = writeTexts(next(), "events", "Markers", [&](auto&& add) {
        return forEachMomentInWords(source,
                                    [&](const ExportMoment& moment) { return add(moment.time_s, moment.text); });
    });
    if (!events) return events;
    auto records = writeTexts(next(), "records", "JSON", [&](auto&& add) -> Result<void> {
        for (const auto& trial : source.trialRows()) {
            const nlohmann::json record{{"kind", "trial"},
                                        {"trial", trial.number},
                                        {"condition", trial.condition},
                                        {"details", trial.measured}};
            if (auto added = add(toSeconds(trial.at), dumpJson(record)); !added) return added;
        }
        return source.forEachMoment([&](const ExportRow& row) {
            return add(row.time_s, dumpJson({{"kind", row.kind}, {"name", row.name}, {"details", row.details}}));
        });
    });
    return records ? out.flush() : records;
}

std::uint64_t sizeOfXdf(const ExportSource& source) {
    std::uint64_t bytes = 1 << 14;
    for (const auto& stream : source.streams())
        bytes += stream.samples * (1 + sizeof(double) * (1 + stream.channels.size()));
    constexpr std::uint64_t kTrain = 700;  // its numbers, marker and record
    return bytes + kTrain * source.trainCount();
}

}  // namespace

const ExportFormat& xdfExport() {
    static const ExportFormat format{.name = "xdf",
                                     .title = "XDF: streams and markers, as of Lab Streaming Layer",
                                     .suffix = ".xdf",
                                     .cannot = {{ExportContent::Captures, "XDF holds no records of microseconds"}},
                                     .write = writeXdf,
                                     .size = sizeOfXdf};
    return format;
}

}  // namespace tacto
