#include "core/exchange/csv/CsvExport.h"

#include <charconv>
#include <cmath>

#include "core/base/JsonText.h"
#include "core/exchange/PieceOut.h"
#include "core/measure/CaptureDescription.h"
#include "core/measure/CaptureFile.h"
#include "core/session/Origin.h"

namespace tacto {

namespace {

namespace fs = std::filesystem;
using nlohmann::json;

class CsvOut : public PieceOut {
public:
    using PieceOut::PieceOut;

    void number(double value) {
        separate();
        if (std::isnan(value)) return;
        char digits[32];
        const auto end = std::to_chars(digits, digits + sizeof digits, value).ptr;
        text_.append(digits, end);
    }
    void text(std::string_view value) {
        separate();
        if (value.find_first_of(",\"\r\n") == value.npos) {
            text_ += value;
            return;
        }
        text_ += '"';
        for (const char c : value) {
            if (c == '"') text_ += '"';
            text_ += c;
        }
        text_ += '"';
    }
    void raw(std::string_view value) { text_ += value; }
    [[nodiscard]] Result<void> endRow() {
        text_ += '\n';
        begun_ = false;
        return flushIfFull();
    }

private:
    void separate() {
        if (begun_) text_ += ',';
        begun_ = true;
    }

    bool begun_ = false;
};

/// Returns the columns of a stream between `time_s` and `simulated`; `R_calibrated` stands beside R.
std::vector<std::string> columnsOf(const ExportStream& stream) {
    std::vector<std::string> names;
    for (std::size_t c = 0; c < stream.channels.size(); ++c) {
        names.push_back(csvColumn(stream.channels[c].name, stream.channels[c].unit));
        if (c == stream.channelR()) names.emplace_back("R_calibrated");
    }
    return names;
}

Result<void> writeStream(const ExportSource& source, const ExportStream& stream, const fs::path& path) {
    CsvOut out(path);
    out.text("time_s");
    for (const auto& name : columnsOf(stream)) out.text(name);
    out.text("simulated");
    if (auto ended = out.endRow(); !ended) return ended;
    const auto columns = stream.channels.size();
    const auto r = stream.channelR();
    const double simulated = stream.simulated ? 1 : 0;
    auto read = source.forEachChunk(stream, [&](const SampleBlock& block) -> Result<void> {
        for (std::size_t i = 0; i < block.samples(); ++i) {
            out.number(block.t_s[i]);
            for (std::size_t c = 0; c < columns; ++c) {
                out.number(block.values[i * columns + c]);
                if (c == r) out.number(source.calibratedR(block.t_s[i]) ? 1 : 0);
            }
            out.number(simulated);
            if (auto ended = out.endRow(); !ended) return ended;
        }
        return {};
    });
    return read ? out.flush() : read;
}

Result<void> writeTable(const ExportSource& source, const ExportTable& table, const fs::path& path) {
    CsvOut out(path);
    for (const auto& column : table.columns) out.text(column.at);
    if (auto ended = out.endRow(); !ended) return ended;
    auto read = source.forEachRow(table, [&](std::span<const ExportCell> cells) {
        for (const auto& cell : cells) {
            if (const auto* number = std::get_if<double>(&cell))
                out.number(*number);
            else
                out.text(std::get<std::string>(cell));
        }
        return out.endRow();
    });
    return read ? out.flush() : read;
}

Result<void> writeJson(const json& value, const fs::path& path) {
    CsvOut out(path);
    out.raw(dumpJson(value, 2));
    if (auto ended = out.endRow(); !ended) return ended;
    return out.flush();
}

Result<void> writeCaptures(const ExportSource& source, const fs::path& folder) {
    if (source.captures().empty()) return {};
    std::error_code error;
    fs::create_directory(folder, error);
    if (error) return fail(ErrorCode::Io, "{} could not be written: {}", folder.string(), error.message());
    for (const auto& each : source.captures()) {
        const auto capture = source.capture(each);
        if (!capture) return failure(capture);
        if (!*capture) continue;
        if (auto written = writeCapture(folder / (each.name + ".csv"), **capture); !written) return written;
        if (auto stated = stateCaptureOrigin(folder, (*capture)->simulated); !stated) return stated;
    }
    return {};
}

/// recording.json, by which the folder opens as a recording; null without a sensor stream that can be one.
json recordingOf(const ExportSource& source) {
    constexpr std::uint64_t kMinRows = 2;  // a recording has at least so many rows
    auto streams = json::array();
    for (const auto& stream : source.streams()) {
        const bool isSensor = stream.name == "acceleration" || stream.name == "force" || stream.name == "taxels";
        if (!isSensor || stream.samples < kMinRows) continue;
        streams.push_back({{"kind", stream.kind},
                           {"file", stream.name + ".csv"},
                           {"time_column", "time_s"},
                           {"time_unit", "s"},
                           {"columns", columnsOf(stream)},
                           {"unit", stream.channels.front().unit}});
    }
    if (streams.empty()) return {};
    json recording = {{"title", source.name()},
                      {"source", fmt::format("session {}, chain head {}", source.name(), source.chainHead())},
                      {"licence", "the lab's own"},
                      {"streams", streams}};
    for (const auto& device : source.about().devices) {
        if (!device.is(Role::Sensor)) continue;
        if (!device.serial.empty()) recording["fingertip"] = device.serial;
        if (const auto from = originOf(device); from != origin::kReplayedUnknown)
            recording["simulated"] = from == origin::kSimulated || from == origin::kReplayedSimulated;
    }
    return recording;
}

Result<void> writeCsv(const ExportSource& source, const fs::path& folder, ExportReport& report) {
    for (const auto& stream : source.streams()) {
        if (auto written = writeStream(source, stream, folder / (stream.name + ".csv")); !written) return written;
        report.wroteExactly(stream);
    }
    for (const auto* table : source.tables()) {
        if (auto written = writeTable(source, *table, folder / (table->name + ".csv")); !written) return written;
    }
    if (auto written = writeCaptures(source, folder / "captures"); !written) return written;
    if (const auto recording = recordingOf(source); !recording.is_null()) {
        if (auto written = writeJson(recording, folder / "recording.json"); !written) return written;
    }
    return writeJson(source.description(), folder / "session.json");
}

std::uint64_t csvSize(const ExportSource& source) {
    constexpr std::uint64_t kOfNumber = 14, kOfRow = 14, kOfSample = 12;  // bytes, about
    std::uint64_t bytes = 0;
    for (const auto& stream : source.streams()) bytes += stream.samples * (kOfRow + kOfNumber * stream.channels.size());
    for (const auto& capture : source.captures())
        bytes += capture.samples * (kOfRow + kOfSample * capture.channels.size());
    return bytes;
}

}  // namespace

std::string csvColumn(std::string_view name, std::string_view unit) {
    std::string suffix;
    for (const char c : unit == "1" ? std::string_view() : unit) {
        const bool large = c >= 'A' && c <= 'Z';
        const bool plain = (c >= 'a' && c <= 'z') || (c >= '0' && c <= '9');
        suffix += large ? static_cast<char>(c - 'A' + 'a') : plain ? c : '_';
    }
    std::string column(name);
    if (!suffix.empty() && !name.ends_with("_" + suffix)) column += "_" + suffix;
    return column;
}

const ExportFormat& csvExport() {
    static const ExportFormat format{.name = "csv",
                                     .title = "CSV: a folder of tables",
                                     .suffix = "",
                                     .cannot = {},
                                     .write = writeCsv,
                                     .size = csvSize};
    return format;
}

}  // namespace tacto
