#include "core/acquisition/Recording.h"

#include <algorithm>
#include <array>
#include <limits>
#include <nlohmann/json.hpp>
#include <system_error>

#include "core/acquisition/RecordingTable.h"
#include "core/base/Csv.h"
#include "core/base/JsonText.h"

namespace tacto {

namespace {

using Json = nlohmann::json;
namespace fs = std::filesystem;

constexpr double kStandardGravity = 9.80665;

struct UnitEntry {
    std::string_view text;
    StreamKind kind;
    StreamUnit unit;
    double factor;
};
constexpr std::array<UnitEntry, 8> kUnits{{
    {"m/s2", StreamKind::Acceleration, StreamUnit::MetrePerSecondSquared, 1},
    {"g", StreamKind::Acceleration, StreamUnit::MetrePerSecondSquared, kStandardGravity},
    {"count", StreamKind::Acceleration, StreamUnit::Count, 1},
    {"N", StreamKind::Force, StreamUnit::Newton, 1},
    {"count", StreamKind::Force, StreamUnit::Count, 1},
    {"Pa", StreamKind::Taxels, StreamUnit::Pascal, 1},
    {"kPa", StreamKind::Taxels, StreamUnit::Pascal, 1000},
    {"count", StreamKind::Taxels, StreamUnit::Count, 1},
}};
constexpr std::array kKinds{StreamKind::Acceleration, StreamKind::Force, StreamKind::Taxels};

/// Reads one JSON file's entries; every message begins with `where`.
class Description {
public:
    explicit Description(fs::path file) : file_(std::move(file)) {}

    Result<Recording> read(const Json& root) const {
        // A recording may carry more keys than are read here; none of them can loosen a limit.
        if (!root.is_object())
            return refuse("the file holds {}; an object with \"streams\" was expected", typeOf(root));
        Recording recording;
        recording.path = file_;
        for (auto [key, target] :
             {std::pair{"title", &recording.title}, std::pair{"source", &recording.source},
              std::pair{"licence", &recording.licence}, std::pair{"fingertip", &recording.fingertip}}) {
            if (!root.contains(key)) continue;
            if (!root[key].is_string()) return refuse("\"{}\" is {}; a text was expected", key, typeOf(root[key]));
            *target = root[key].get<std::string>();
        }
        if (root.contains("simulated")) {
            if (!root["simulated"].is_boolean())
                return refuse("\"simulated\" is {}; true or false was expected", typeOf(root["simulated"]));
            recording.simulated = root["simulated"].get<bool>();
        }
        if (recording.title.empty()) recording.title = file_.stem().string();
        if (const auto done = readDeclared(root, recording.declared); !done) return failure(done);
        if (!root.contains("streams") || !root["streams"].is_array() || root["streams"].empty()) {
            return refuse("\"streams\" is missing or empty; a list of at least one stream was expected");
        }
        for (const auto& entry : root["streams"]) {
            auto stream = readStream(entry, recording.streams.size() + 1);
            if (!stream) return failure(stream);
            if (recording.find(stream->info.kind) != nullptr) {
                return refuse("there are two {} streams; at most one of each kind was expected",
                              nameOf(stream->info.kind));
            }
            recording.streams.push_back(std::move(*stream));
        }
        if (const auto done = checkDeclared(recording); !done) return failure(done);
        return recording;
    }

private:
    template <class... Args>
    tl::unexpected<Error> refuse(fmt::format_string<Args...> text, Args&&... args) const {
        return tl::unexpected<Error>(
            Error{ErrorCode::ParseError,
                  fmt::format("{}: {}", file_.string(), fmt::format(text, std::forward<Args>(args)...))});
    }

    static std::string typeOf(const Json& value) {
        if (value.is_array()) return "a list";
        if (value.is_object()) return "an object";
        return fmt::format("{} {}", value.type_name(), value.dump(-1, ' ', true, Json::error_handler_t::replace));
    }

    Result<TimeInterval> interval(const Json& value, const char* key) const {
        if (!value.is_array() || value.size() != 2 || !value[0].is_number() || !value[1].is_number() ||
            !(value[0].get<double>() < value[1].get<double>())) {
            return refuse("\"{}\" is {}; two times in seconds, [begin, end] with begin < end, were expected", key,
                          value.is_array() ? value.dump(-1, ' ', true, Json::error_handler_t::replace) : typeOf(value));
        }
        return TimeInterval{value[0].get<double>(), value[1].get<double>()};
    }

    Result<void> readDeclared(const Json& root, DeclaredIntervals& out) const {
        if (root.contains("baseline") && !root["baseline"].is_null()) {
            const auto baseline = interval(root["baseline"], "baseline");
            if (!baseline) return failure(baseline);
            out.baseline = *baseline;
        }
        if (!root.contains("contact") || root["contact"].is_null()) return {};
        if (!root["contact"].is_array()) {
            return refuse("\"contact\" is {}; a list of [begin, end] in seconds was expected", typeOf(root["contact"]));
        }
        out.contact.emplace();
        for (const auto& entry : root["contact"]) {
            const auto contact = interval(entry, "contact");
            if (!contact) return failure(contact);
            out.contact->push_back(*contact);
        }
        std::ranges::sort(*out.contact, {}, &TimeInterval::begin_s);
        return {};
    }

    Result<void> checkDeclared(const Recording& recording) const {
        const auto extent = recording.extent();
        const auto outside = [&](const TimeInterval& t) {
            return t.end_s < extent.begin_s || t.begin_s > extent.end_s;
        };
        if (recording.declared.baseline && outside(*recording.declared.baseline)) {
            return refuse("\"baseline\" [{}, {}] lies outside the data; times from {} to {} s were expected",
                          recording.declared.baseline->begin_s, recording.declared.baseline->end_s, extent.begin_s,
                          extent.end_s);
        }
        if (!recording.declared.contact) return {};
        for (const auto& contact : *recording.declared.contact) {
            if (!outside(contact)) continue;
            return refuse("\"contact\" [{}, {}] lies outside the data; times from {} to {} s were expected",
                          contact.begin_s, contact.end_s, extent.begin_s, extent.end_s);
        }
        return {};
    }

    Result<std::string> text(const Json& entry, std::size_t number, const char* key, std::string_view expected) const {
        if (!entry.contains(key) || !entry[key].is_string() || entry[key].get_ref<const std::string&>().empty()) {
            return refuse("stream {}: \"{}\" is {}; {} was expected", number, key,
                          entry.contains(key) ? typeOf(entry[key]) : "missing", expected);
        }
        return entry[key].get<std::string>();
    }

    Result<StreamKind> kindOf(const Json& entry, std::size_t number) const {
        const auto kind = text(entry, number, "kind", "acceleration, force or taxels");
        if (!kind) return failure(kind);
        for (const auto candidate : kKinds) {
            if (*kind == nameOf(candidate)) return candidate;
        }
        return refuse("stream {}: \"kind\" is \"{}\"; acceleration, force or taxels was expected", number, *kind);
    }

    Result<UnitEntry> unitOf(const Json& entry, std::size_t number, StreamKind kind) const {
        std::string known;
        for (const auto& unit : kUnits) {
            if (unit.kind == kind) known += fmt::format("{}{}", known.empty() ? "" : ", ", unit.text);
        }
        const auto unit = text(entry, number, "unit", known);
        if (!unit) return failure(unit);
        for (const auto& candidate : kUnits) {
            if (candidate.kind == kind && candidate.text == *unit) return candidate;
        }
        return refuse("stream {}: \"unit\" is \"{}\"; for {} one of {} was expected", number, *unit, nameOf(kind),
                      known);
    }

    Result<double> timeDivisorOf(const Json& entry, std::size_t number) const {
        const auto unit = text(entry, number, "time_unit", "s, ms or us");
        if (!unit) return failure(unit);
        if (*unit == "s") return 1.0;
        if (*unit == "ms") return 1e3;
        if (*unit == "us") return 1e6;
        return refuse("stream {}: \"time_unit\" is \"{}\"; s, ms or us was expected", number, *unit);
    }

    Result<std::vector<std::string>> columnsOf(const Json& entry, std::size_t number, StreamKind kind) const {
        if (!entry.contains("columns") || !entry["columns"].is_array()) {
            return refuse("stream {}: \"columns\" is missing or no list; the names of the value columns were expected",
                          number);
        }
        std::vector<std::string> columns;
        for (const auto& column : entry["columns"]) {
            if (!column.is_string()) {
                return refuse("stream {}: \"columns\" holds {}; column names were expected", number, typeOf(column));
            }
            columns.push_back(column.get<std::string>());
        }
        const std::size_t fewest = kind == StreamKind::Taxels ? 2 : 1;
        const std::size_t most = kind == StreamKind::Taxels ? 1024 : kind == StreamKind::Force ? 1 : 3;
        if (columns.size() < fewest || columns.size() > most) {
            return refuse("stream {}: \"columns\" names {} columns; for {} {} to {} were expected", number,
                          columns.size(), nameOf(kind), fewest, most);
        }
        return columns;
    }

    /// The file beside the JSON, or a refusal: the description may come from anyone (hazard H10).
    Result<fs::path> fileOf(const Json& entry, std::size_t number) const {
        const auto name = text(entry, number, "file", "the name of a CSV file beside it");
        if (!name) return failure(name);
        const fs::path relative(*name);
        const auto folder = file_.has_parent_path() ? file_.parent_path() : fs::path(".");
        std::error_code error;
        const auto inside = [&] {
            if (relative.is_absolute() || name->find('\0') != std::string::npos) return false;
            for (const auto& part : relative) {
                if (part == "..") return false;
            }
            // A link may climb out too.
            const auto root = fs::weakly_canonical(folder, error);
            const auto target = fs::weakly_canonical(folder / relative, error);
            return !error && std::mismatch(root.begin(), root.end(), target.begin(), target.end()).first == root.end();
        };
        if (!inside()) {
            return tl::unexpected<Error>(Error{
                ErrorCode::ParseError,
                fmt::format("{}: stream {}: \"file\" is \"{}\"; a file inside the recording's folder was expected, "
                            "not an absolute path or one that climbs out of it",
                            file_.string(), number, *name)});
        }
        const auto path = folder / relative;
        if (!fs::is_regular_file(path, error)) {
            return tl::unexpected<Error>(Error{
                ErrorCode::NotFound, fmt::format("{}: stream {}: \"file\" is \"{}\", and there is no such file in {}",
                                                 file_.string(), number, *name, folder.string())});
        }
        return path;
    }

    Result<RecordedStream> readStream(const Json& entry, std::size_t number) const {
        if (!entry.is_object()) return refuse("stream {} is {}; an object was expected", number, typeOf(entry));
        const auto kind = kindOf(entry, number);
        if (!kind) return failure(kind);
        const auto unit = unitOf(entry, number, *kind);
        if (!unit) return failure(unit);
        const auto divisor = timeDivisorOf(entry, number);
        if (!divisor) return failure(divisor);
        const auto timeColumn = text(entry, number, "time_column", "the name of the column with time stamps");
        if (!timeColumn) return failure(timeColumn);
        const auto columns = columnsOf(entry, number, *kind);
        if (!columns) return failure(columns);
        const auto path = fileOf(entry, number);
        if (!path) return failure(path);
        const auto content = readTextFile(*path);
        if (!content) return failure(content);
        auto samples = readTable(*content, path->string(), {*timeColumn, *divisor, *columns, unit->factor});
        if (!samples) return failure(samples);

        RecordedStream stream{{*kind, unit->unit, columns->size(), 0, path->filename().string()}, {}, {}, *path};
        stream.samples = std::move(*samples);
        return examined(std::move(stream));
    }

    Result<RecordedStream> examined(RecordedStream stream) const {
        const bool coarse = stampsAreCoarse(stream.samples.t_s);
        if (coarse) spreadCoarseStamps(stream.samples.t_s);
        const double rough = roughRate_hz(stream.samples.t_s);
        if (!(rough > 0)) {
            return tl::unexpected<Error>(
                Error{ErrorCode::ParseError, fmt::format("{}:2: time never moves forward in the file; rising time "
                                                         "stamps were expected",
                                                         stream.file.string())});
        }
        StreamHealth health(rough);
        health.feed(stream.samples, stream.info.channels);
        stream.health = health.report();
        stream.health.coarseStamps = coarse;
        stream.info.rate_hz = stream.health.rate_hz > 0 ? stream.health.rate_hz : rough;
        return stream;
    }

    fs::path file_;
};

}  // namespace

Result<Recording> Recording::open(const std::filesystem::path& path) {
    std::error_code error;
    auto file = path;
    if (fs::is_directory(path, error)) {
        file = path / "recording.json";
        if (!fs::exists(file, error)) {
            return fail(ErrorCode::NotFound,
                        "{} has no recording.json, which says what its files hold: write one like this and fill it "
                        "in:\n{}",
                        path.string(), recordingTemplate());
        }
    }
    const auto content = readTextFile(file);
    if (!content) return failure(content);
    const auto root = parseJson(*content, file.string());
    if (!root) return failure(root);
    return Description(file).read(*root);
}

const RecordedStream* Recording::find(StreamKind kind) const noexcept {
    const auto found = std::ranges::find_if(streams, [&](const auto& stream) { return stream.info.kind == kind; });
    return found == streams.end() ? nullptr : &*found;
}

TimeInterval Recording::extent() const noexcept {
    TimeInterval whole{std::numeric_limits<double>::infinity(), -std::numeric_limits<double>::infinity()};
    for (const auto& stream : streams) {
        for (const double t : stream.samples.t_s) {
            whole.begin_s = std::min(whole.begin_s, t);
            whole.end_s = std::max(whole.end_s, t);
        }
    }
    return whole;
}

std::vector<StreamInfo> Recording::infos() const {
    std::vector<StreamInfo> out;
    for (const auto& stream : streams) out.push_back(stream.info);
    return out;
}

std::vector<SampleBlock> Recording::blocks() const {
    std::vector<SampleBlock> out;
    for (const auto& stream : streams) out.push_back(stream.samples);
    return out;
}

std::string recordingTemplate() {
    return R"({
  "title": "what was recorded",
  "source": "who made it, and where it is from",
  "licence": "what one may do with it",
  "baseline": [0.0, 1.0],
  "contact": [[1.2, 9.0]],
  "streams": [
    {"kind": "acceleration", "file": "acceleration.csv", "time_column": "time", "time_unit": "s",
     "columns": ["X", "Y", "Z"], "unit": "g"},
    {"kind": "force", "file": "force.csv", "time_column": "time", "time_unit": "s",
     "columns": ["force"], "unit": "N"},
    {"kind": "taxels", "file": "taxels.csv", "time_column": "timestamp", "time_unit": "ms",
     "columns": ["channel1", "channel2"], "unit": "count"}
  ]
}
)";
}

}  // namespace tacto
