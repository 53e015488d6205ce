#include "app/gui/sessions/SessionExport.h"

#include <QTemporaryDir>
#include <cmath>
#include <nlohmann/json.hpp>

#include "app/gui/theme/TableText.h"
#include "app/gui/theme/Text.h"
#include "core/base/JsonText.h"
#include "core/base/WholeFile.h"
#include "core/measure/CaptureDescription.h"
#include "core/measure/CaptureFile.h"
#include "core/session/Origin.h"
#include "core/session/SessionReader.h"

namespace tacto::gui {

namespace {

namespace fs = std::filesystem;
using Json = nlohmann::json;

/// A new folder, made inside a temporary folder next to the target: existing files are not touched, and the folder is
/// removed unless kept.
class Draft {
public:
    explicit Draft(fs::path target)
        : target_(std::move(target)),
          holder_(QString::fromStdString((fs::absolute(target_).parent_path() / "tactoscope-export-XXXXXX").string())) {
    }
    [[nodiscard]] const fs::path& path() const { return path_; }

    [[nodiscard]] Result<void> begin() {
        std::error_code error;
        if (fs::exists(fs::symlink_status(target_, error))) return isThere();
        if (!holder_.isValid())
            return fail(ErrorCode::Io, "{} could not be written: {}", target_.string(),
                        holder_.errorString().toStdString());
        path_ = fs::path(holder_.path().toStdString()) / "draft";
        fs::create_directory(path_, error);
        if (error) return fail(ErrorCode::Io, "{} could not be written: {}", target_.string(), error.message());
        return {};
    }
    [[nodiscard]] Result<void> keep() {
        std::error_code error, ignored;
        // A rename would replace an empty folder made meanwhile by others, so we create our own empty target first.
        if (!fs::create_directory(target_, error)) {
            if (error) return fail(ErrorCode::Io, "{} could not be written: {}", target_.string(), error.message());
            return isThere();
        }
        fs::rename(path_, target_, error);
        if (!error) return {};
        fs::remove(target_, ignored);  // remains if it is not empty
        return fail(ErrorCode::Io, "{} could not be written: {}", target_.string(), error.message());
    }

    /// Returns the error with the path of the folder that the operator asked for.
    [[nodiscard]] Error asked(Error error) const {
        const auto drawn = path_.string();
        if (const auto at = error.message.find(drawn); !drawn.empty() && at != std::string::npos)
            error.message.replace(at, drawn.size(), target_.string());
        return error;
    }

private:
    [[nodiscard]] Result<void> isThere() const {
        return fail(ErrorCode::InvalidArgument, "{} exists already; a new folder is expected", target_.string());
    }
    fs::path target_, path_;
    QTemporaryDir holder_;  ///< removed with its remaining contents
};

class TextFile {
public:
    explicit TextFile(fs::path path) : path_(std::move(path)), file_(FileOut::create(path_)) {}
    template <class... Parts>
    void write(fmt::format_string<Parts...> format, Parts&&... parts) {
        fmt::format_to(std::back_inserter(text_), format, std::forward<Parts>(parts)...);
        constexpr std::size_t kPiece = 1UL << 20;
        if (text_.size() >= kPiece) flush();
    }
    [[nodiscard]] Result<void> close() {
        flush();
        return namedAs(path_, file_ ? std::move(written_) : failure(file_));
    }

private:
    void flush() {
        if (file_ && written_) written_ = file_->write({text_.data(), text_.size()});
        text_.clear();
    }
    fs::path path_;
    Result<FileOut> file_;
    Result<void> written_;
    fmt::memory_buffer text_;
};

/// Empty if the value is missing; otherwise all digits of a double.
std::string cell(double value) { return std::isfinite(value) ? fmt::format("{:.17g}", value) : std::string(); }

std::string quoted(const std::string& text) {
    std::string out = "\"";
    for (const char c : inertCell(qtext(text)).toStdString()) {
        if (c == '"') out += '"';
        out += c;
    }
    return out + '"';
}

std::string fileName(std::string name) {
    for (auto& c : name) {
        const bool plain = (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9');
        if (!plain) c = '-';
    }
    return name;
}

Result<void> writeStream(const SessionReader& reader, const SessionStreamInfo& info, const fs::path& path,
                         const WorkPort& port) {
    TextFile file(path);
    std::string header = "time_s";
    for (const auto& column : info.stream.columns) header += "," + column;
    file.write("{}\n", header);
    const auto columns = info.stream.columns.size();
    auto read = reader.forEachChunk(info.id, [&](const SampleBlock& block) {
        for (std::size_t i = 0; i < block.samples(); ++i) {
            std::string line = cell(block.t_s[i]);
            for (std::size_t c = 0; c < columns; ++c) line += "," + cell(block.values[i * columns + c]);
            file.write("{}\n", line);
        }
        return !port.stopped();
    });
    if (!read) return read;
    if (port.stopped()) return fail(ErrorCode::Stopped, "cancelled; nothing was written");
    return file.close();
}

Result<void> writeTrials(const SessionReader& reader, const fs::path& path) {
    const auto trials = reader.trials();
    if (!trials) return failure(trials);
    TextFile file(path);
    file.write("trial,time_s,condition,amplitude_v,interval_s,width_s,charge_uc,imbalance\n");
    for (const auto& trial : *trials) {
        const auto value = [&](const char* key) {
            const auto at = trial.measured.find(key);
            return at != trial.measured.end() && at->is_number() ? cell(at->get<double>()) : std::string();
        };
        file.write("{},{},{},{},{},{},{},{}\n", trial.number, cell(toSeconds(trial.at)), quoted(trial.condition),
                   value("amplitude_v"), value("interval_s"), value("width_s"), value("charge_uc"), value("imbalance"));
    }
    return file.close();
}

/// Writes the marks that qualify every file of the export.
Result<void> writeMarks(const SessionReader& reader, const fs::path& path) {
    const auto marks = sessionMarks(reader);
    if (!marks) return failure(marks);
    TextFile file(path);
    file.write("mark\n");
    for (const auto& mark : *marks) file.write("{}\n", quoted(mark));
    return file.close();
}

Result<void> writeRows(const Result<std::vector<SessionRow>>& rows, const char* what, const fs::path& path) {
    if (!rows) return failure(rows);
    TextFile file(path);
    file.write("time_s,{},details\n", what);
    for (const auto& row : *rows)
        file.write("{},{},{}\n", cell(toSeconds(row.at)), quoted(row.name), quoted(dumpJson(row.body)));
    return file.close();
}

Result<void> writeTables(const SessionReader& reader, const fs::path& folder, const WorkPort& port) {
    const auto streams = reader.streams();
    if (!streams) return failure(streams);
    const auto captures = reader.captures();
    if (!captures) return failure(captures);
    if (auto written = writeMarks(reader, folder / "marks.csv"); !written) return written;
    const int total = int(streams->size() + captures->size()) + 3;
    int done = 0;
    for (const auto& stream : *streams) {
        const auto name = fmt::format("stream-{}-{}.csv", stream.id, fileName(stream.stream.name));
        if (auto written = writeStream(reader, stream, folder / name, port); !written) return written;
        port.progress(++done, total);
    }
    if (auto written = writeTrials(reader, folder / "trials.csv"); !written) return written;
    port.progress(++done, total);
    if (auto written = writeRows(reader.events(), "event", folder / "events.csv"); !written) return written;
    port.progress(++done, total);
    if (auto written = writeRows(reader.commands(), "command", folder / "commands.csv"); !written) return written;
    port.progress(++done, total);
    std::error_code error;
    if (!captures->empty()) fs::create_directories(folder / "captures", error);
    for (const auto& info : *captures) {
        if (port.stopped()) return fail(ErrorCode::Stopped, "cancelled; nothing was written");
        const auto capture = reader.capture(info.seq);
        if (!capture) return failure(capture);
        const auto name = fmt::format("trial-{:04}-{:05}.csv", info.trial.value_or(0), info.seq);
        if (auto written = writeCapture(folder / "captures" / name, *capture); !written) return written;
        if (auto stated = stateCaptureOrigin(folder / "captures", capture->simulated); !stated) return stated;
        port.progress(++done, total);
    }
    return {};
}

Result<void> writeRecording(const SessionReader& reader, const fs::path& session, const fs::path& folder,
                            const WorkPort& port) {
    const auto streams = reader.streams();
    if (!streams) return failure(streams);
    Json described = Json::array();
    int done = 0;
    for (const auto& stream : *streams) {
        const auto& kind = stream.stream.kind;
        if ((kind != "acceleration" && kind != "force" && kind != "taxels") || stream.samples == 0) continue;
        const auto file = kind + ".csv";
        if (auto written = writeStream(reader, stream, folder / file, port); !written) return written;
        described.push_back({{"kind", kind},
                             {"file", file},
                             {"time_column", "time_s"},
                             {"time_unit", "s"},
                             {"columns", stream.stream.columns},
                             {"unit", stream.stream.unit}});
        port.progress(++done, int(streams->size()));
    }
    if (described.empty())
        return fail(ErrorCode::NotFound, "{} holds no sensor stream to replay", session.filename().string());
    Json recording{
        {"title", session.stem().string()},
        {"source", fmt::format("session {}, chain head {}", session.filename().string(), reader.chainHead())},
        {"licence", "the lab's own"},
        {"streams", described}};
    for (const auto& device : reader.about().devices) {
        const auto from = originOf(device);
        if (device.is(Role::Sensor) && !device.serial.empty()) recording["fingertip"] = device.serial;
        if (device.is(Role::Sensor) && from != origin::kReplayedUnknown)
            recording["simulated"] = from == origin::kSimulated || from == origin::kReplayedSimulated;
    }
    TextFile file(folder / "recording.json");
    file.write("{}\n", dumpJson(recording, 2));
    return file.close();
}

/// Lets `write` fill a draft that then becomes `folder`.
template <class Write>
Result<void> exportTo(const fs::path& session, const fs::path& folder, Write&& write) {
    const auto reader = SessionReader::open(session);
    if (!reader) return failure(reader);
    Draft draft(folder);
    if (auto begun = draft.begin(); !begun) return begun;
    if (auto written = write(*reader, draft.path()); !written) return tl::unexpected(draft.asked(written.error()));
    return draft.keep();
}

}  // namespace

Result<void> exportCsv(const fs::path& session, const fs::path& folder, const WorkPort& port) {
    return exportTo(session, folder, [&](const SessionReader& reader, const fs::path& draft) {
        return writeTables(reader, draft, port);
    });
}

Result<void> exportRecording(const fs::path& session, const fs::path& folder, const WorkPort& port) {
    return exportTo(session, folder, [&](const SessionReader& reader, const fs::path& draft) {
        return writeRecording(reader, session, draft, port);
    });
}

}  // namespace tacto::gui
