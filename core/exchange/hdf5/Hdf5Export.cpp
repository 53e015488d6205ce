#include "core/exchange/hdf5/Hdf5Export.h"

#include <array>
#include <set>

#include "core/base/JsonText.h"
#include "core/exchange/ExportTables.h"
#include "core/exchange/hdf5/Hdf5File.h"
#include "core/measure/CaptureDescription.h"

namespace tacto {

namespace {

/// Keeps the first error of a row of calls.
class Steps {
public:
    Steps& operator<<(Result<void> step) {
        if (all_ && !step) all_ = std::move(step);
        return *this;
    }
    [[nodiscard]] explicit operator bool() const noexcept { return all_.has_value(); }
    [[nodiscard]] const Result<void>& result() const noexcept { return all_; }

private:
    Result<void> all_;
};

/// The names of the data sets of a group, whose first is `time`.
class SetNames {
public:
    [[nodiscard]] std::string add(const std::string& name) { return uniqueName(hdf5Name(name), "~", taken_); }

private:
    std::set<std::string> taken_{"time"};
};

Result<void> describeSet(Hdf5Object& set, std::string_view unit, std::string_view title, bool simulated) {
    return (Steps() << set.attribute("units", unit) << set.attribute("long_name", title)
                    << set.attribute("simulated", simulated))
        .result();
}

Result<void> writeStream(const ExportSource& source, const ExportStream& stream, Hdf5File& file) {
    auto group = file.group("streams/" + hdf5Name(stream.name));
    if (!group) return failure(group);
    Steps steps;
    steps << group->attribute("long_name", stream.title) << group->attribute("rate_hz", stream.rate_hz)
          << group->attribute("regular", stream.regular) << group->attribute("gaps", double(stream.gapCount))
          << group->attribute("simulated", stream.simulated);
    SetNames names;
    std::vector<Hdf5Column> columns;
    columns.emplace_back(file, *group, "time", Hdf5Column::Type::Double, stream.samples);
    for (const auto& channel : stream.channels)
        columns.emplace_back(file, *group, names.add(channel.name), Hdf5Column::Type::Double, stream.samples);
    const auto width = stream.channels.size();
    steps << source.forEachChunk(stream, [&](const SampleBlock& block) -> Result<void> {
        Steps added;
        added << columns[0].add(block.t_s, 1);
        for (std::size_t c = 0; added && block.samples() > 0 && c < width; ++c)
            added << columns[c + 1].add(std::span(block.values).subspan(c), width);
        return added.result();
    });
    if (!steps) return steps.result();
    std::vector<Hdf5Object> sets;
    for (std::size_t c = 0; c < columns.size(); ++c) {
        auto set = columns[c].end();
        if (!set) return failure(set);
        const auto* channel = c == 0 ? nullptr : &stream.channels[c - 1];
        steps << describeSet(*set, channel ? channel->unit : "s",
                             channel ? stream.title + ", " + channel->name : "Time since the session's start",
                             stream.simulated);
        if (channel != nullptr && c - 1 == stream.channelR())
            steps << set->attribute("calibrated", source.calibratedR());
        sets.push_back(std::move(*set));
    }
    steps << Hdf5File::onScale(sets.front(), std::span(sets).subspan(1));
    return steps.result();
}

Result<void> writeTable(const ExportSource& source, const ExportTable& table, Hdf5File& file) {
    auto group = file.group(table.name);
    if (!group) return failure(group);
    Steps steps;
    steps << group->attribute("long_name", table.title);
    SetNames names;
    std::vector<Hdf5Column> columns;
    for (const auto& column : table.columns) {
        columns.emplace_back(file, *group, columns.empty() ? "time" : names.add(column.at),
                             ExportTable::holdsText(column) ? Hdf5Column::Type::Text : Hdf5Column::Type::Double);
    }
    steps << source.forEachRow(table, [&](std::span<const ExportCell> cells) {
        Steps added;
        for (std::size_t c = 0; c < cells.size(); ++c)
            added << std::visit([&](const auto& cell) { return columns[c].add(cell); }, cells[c]);
        return added.result();
    });
    if (!steps) return steps.result();
    std::vector<Hdf5Object> sets;
    for (std::size_t c = 0; c < columns.size(); ++c) {
        auto set = columns[c].end();
        if (!set) return failure(set);
        const auto& column = table.columns[c];
        steps << describeSet(*set, column.unit.empty() ? "1" : column.unit, column.title, source.simulated(table));
        sets.push_back(std::move(*set));
    }
    steps << Hdf5File::onScale(sets.front(), std::span(sets).subspan(1));
    return steps.result();
}

Result<void> writeCapture(const Capture& capture, const ExportCapture& about, Hdf5File& file) {
    auto group = file.group("captures/" + about.name);
    if (!group) return failure(group);
    Steps steps;
    steps << group->attribute("rate_hz", capture.rate_hz) << group->attribute("start_s", capture.start_s)
          << group->attribute("trigger_s", capture.trigger_s) << group->attribute("told", about.told)
          << group->attribute("simulated", capture.simulated)
          << group->attribute("about", dumpJson(describeCapture(capture)));
    if (about.trial) steps << group->attribute("trial", double(*about.trial));
    const auto samples = capture.samples();
    Hdf5Column time(file, *group, "time", Hdf5Column::Type::Double, samples);
    for (std::size_t i = 0; steps && i < samples; ++i) steps << time.add(capture.start_s + double(i) / capture.rate_hz);
    if (!steps) return steps.result();
    auto scale = time.end();
    if (!scale) return failure(scale);
    steps << describeSet(*scale, "s", "Time since the session's start", capture.simulated);
    SetNames names;
    std::vector<Hdf5Object> sets;
    for (const auto& channel : capture.channels) {
        Hdf5Column column(file, *group, names.add(channel.name), Hdf5Column::Type::Float, samples);
        steps << column.add(channel.samples);
        if (!steps) return steps.result();
        auto set = column.end();
        if (!set) return failure(set);
        const std::array range{channel.low, channel.high};
        steps << describeSet(*set, channel.unit.empty() ? "1" : channel.unit, channel.name, capture.simulated)
              << set->attribute("lsb", channel.lsb) << set->attribute("range", range);
        sets.push_back(std::move(*set));
    }
    steps << Hdf5File::onScale(*scale, sets);
    return steps.result();
}

Result<void> writeAll(const ExportSource& source, Hdf5File& file, ExportReport& report) {
    auto& root = file.root();
    Steps steps;
    steps << root.attribute("title", "Tactoscope session " + source.name())
          << root.attribute("program", "Tactoscope " + source.version())
          << root.attribute("wall_start", source.wallStart()) << root.attribute("simulated", source.simulated())
          << root.attribute("marks", source.marksText()) << root.attribute("session", source.name())
          << root.attribute("chain_head", source.chainHead())
          << root.attribute("about", dumpJson(source.description()));
    for (const char* name : {"streams", "captures"}) {
        auto group = file.group(name);
        if (!group) return failure(group);
    }
    for (const auto& stream : source.streams()) {
        if (steps) steps << writeStream(source, stream, file);
        report.wroteExactly(stream);
    }
    for (const auto* table : source.tables()) {
        if (steps) steps << writeTable(source, *table, file);
    }
    for (const auto& each : source.captures()) {
        if (!steps) return steps.result();
        const auto capture = source.capture(each);
        if (!capture) return failure(capture);
        if (*capture) steps << writeCapture(**capture, each, file);
    }
    return steps.result();
}

Result<void> writeHdf5(const ExportSource& source, const std::filesystem::path& path, ExportReport& report) {
    auto file = Hdf5File::create(path);
    auto written = file ? writeAll(source, *file, report) : failure(file);
    // The library keeps part of the file in memory until it is closed.
    if (file) {
        auto closed = file->close();
        if (written) written = std::move(closed);
    }
    if (written || written.error().code != ErrorCode::Io) return written;
    return fail(ErrorCode::Io, "{} could not be written: {}", path.string(), written.error().message);
}

std::uint64_t hdf5Size(const ExportSource& source) {
    constexpr std::uint64_t kOfNumber = 5, kOfSample = 3, kOfSet = 2500;  // bytes, about
    std::uint64_t bytes = 0;
    for (const auto& stream : source.streams())
        bytes += (1 + stream.channels.size()) * (kOfSet + kOfNumber * stream.samples);
    for (const auto& capture : source.captures())
        bytes += (1 + capture.channels.size()) * (kOfSet + kOfSample * capture.samples);
    return bytes;
}

}  // namespace

const ExportFormat& hdf5Export() {
    static const ExportFormat format{.name = "hdf5",
                                     .title = "HDF5: one file for h5py, MATLAB and xarray",
                                     .suffix = ".h5",
                                     .cannot = {},
                                     .write = writeHdf5,
                                     .size = hdf5Size};
    return format;
}

}  // namespace tacto
