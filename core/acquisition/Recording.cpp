#include "core/acquisition/Recording.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <system_error>

#include "core/acquisition/RecordingTable.h"
#include "core/acquisition/RecordingUnits.h"
#include "core/acquisition/SignalStreams.h"
#include "core/base/Csv.h"
#include "core/base/RecordFields.h"

namespace tacto {

namespace {

using Json = nlohmann::json;
namespace fs = std::filesystem;

constexpr std::size_t kMaxEntries = 100'000;

/// A stream, as the JSON file describes it.
struct DescribedStream {
    StreamKind kind = StreamKind::Acceleration;
    std::string file;
    std::optional<ColumnChoice> stream;
    std::optional<ColumnChoice> timeColumn;
    std::optional<std::string> timeUnit;
    std::optional<double> rate_hz;
    std::size_t skipRows = 0;
    std::optional<char> decimal;
    double factor = 1;
    std::vector<ColumnChoice> columns;
    std::string unit;
};
struct DescribedRecording : Recording {
    std::vector<DescribedStream> described;
};

constexpr Word<char> kDecimals[] = {{".", '.'}, {",", ','}};

ValueKind<ColumnChoice> columnKind() {
    return codedKind<ColumnChoice>(
        "a name as in the file, or its number from 1,",
        [](const Json& value) -> std::optional<ColumnChoice> {
            if (value.is_string()) return value.get<std::string>();
            if (!value.is_number_unsigned() || value.get<std::uint64_t>() == 0) return std::nullopt;
            return static_cast<std::size_t>(std::min<std::uint64_t>(value.get<std::uint64_t>(), kMaxEntries));
        },
        [](const ColumnChoice& column) { return std::visit([](const auto& held) { return Json(held); }, column); });
}

RecordFields<DescribedStream> streamFields() {
    using S = DescribedStream;
    RecordFields<S> all;
    all.word("kind", &S::kind, kStreamKinds).required = true;
    all.text("file", &S::file).required = true;
    all.add("stream", &S::stream, columnKind());
    all.add("time_column", &S::timeColumn, columnKind());
    all.text("time_unit", &S::timeUnit);
    all.number("rate_hz", &S::rate_hz, {.low = 0, .high = 1e6, .openLow = true, .unit = "Hz"});
    all.number("skip_rows", &S::skipRows);
    all.word("decimal", &S::decimal, kDecimals);
    all.number("factor", &S::factor);
    all.list("columns", &S::columns, columnKind(), 1, 1024).required = true;
    all.text("unit", &S::unit);
    all.passOverUnknownKeys();
    return all;
}

RecordFields<DescribedRecording> buildRecordingFields() {
    using R = DescribedRecording;
    const auto interval = codedKind<TimeInterval>(
        "[begin, end], two times in seconds with begin < end,",
        [](const Json& value) -> std::optional<TimeInterval> {
            if (!value.is_array() || value.size() != 2 || !value[0].is_number() || !value[1].is_number() ||
                !(value[0].get<double>() < value[1].get<double>()))
                return std::nullopt;
            return TimeInterval{value[0].get<double>(), value[1].get<double>()};
        },
        [](const TimeInterval& t) {
            return Json{t.begin_s, t.end_s};
        });
    RecordFields<R> all;
    all.texts({{"title", &R::title}, {"source", &R::source}, {"licence", &R::licence}, {"fingertip", &R::fingertip}},
              {.mayBeEmpty = true});
    all.flag("simulated", &R::simulated);
    all.add("baseline", in(&R::declared, &DeclaredIntervals::baseline), interval);
    all.list("contact", in(&R::declared, &DeclaredIntervals::contact), interval, 0, kMaxEntries);
    all.list("streams", &R::described, streamFields().kind(), 1, kMaxEntries).required = true;
    all.passOverUnknownKeys();  // a recording may have other keys; none of them can loosen a limit
    return all;
}

/// For counts, no value is too large in itself. But a single value, a thousand times as far from the median as 98 % of
/// its channel, cannot be a reading. It becomes infinite, which marks it as invalid.
void markFarCounts(SampleBlock& samples, std::size_t channels) {
    constexpr std::size_t kMinSamples = 100;  // with fewer samples, their 98 % range is unreliable
    constexpr std::size_t kAlone = 3;         // most such samples in a row
    constexpr double kFar = 1000;
    for (std::size_t c = 0; c < channels && samples.samples() >= kMinSamples; ++c) {
        const auto at = [&](std::size_t i) -> double& { return samples.values[i * channels + c]; };
        std::vector<double> sorted;
        for (std::size_t i = 0; i < samples.samples(); ++i) {
            if (std::isfinite(at(i))) sorted.push_back(at(i));
        }
        if (sorted.size() < kMinSamples) continue;
        std::ranges::sort(sorted);
        const double median = sorted[sorted.size() / 2];
        const double reach =
            std::max(sorted[sorted.size() - 1 - sorted.size() / 100] - sorted[sorted.size() / 100], 1.0);
        const auto isFar = [&](std::size_t i) { return std::abs(at(i) - median) > kFar * reach; };
        for (std::size_t i = 0; i < samples.samples(); ++i) {
            const auto from = i;
            while (i < samples.samples() && isFar(i)) ++i;
            for (auto j = from; j < i && i - from <= kAlone; ++j) at(j) = std::numeric_limits<double>::infinity();
        }
    }
}

/// Reads the streams described in one JSON file. Every message begins with the file's name.
class Description {
public:
    Description(fs::path file, const SignalReader& reader) : file_(std::move(file)), reader_(reader) {}

    Result<Recording> read(const Json& root) {
        auto read = builtOnce<buildRecordingFields>().read(root, {.file = file_.string()}).map_error(asParseError);
        if (!read) return failure(read);
        Recording& recording = *read;
        recording.path = file_;
        if (recording.title.empty()) recording.title = file_.stem().string();
        if (recording.declared.contact) std::ranges::sort(*recording.declared.contact, {}, &TimeInterval::begin_s);
        for (const auto& described : read->described) {
            auto stream = readStream(described, recording.streams.size());
            if (!stream) return failure(stream);
            if (recording.find(stream->info.kind) != nullptr) {
                return refuse("there are two {} streams; at most one of each kind was expected",
                              nameOf(stream->info.kind));
            }
            recording.streams.push_back(std::move(*stream));
        }
        if (const auto done = checkDeclared(recording); !done) return failure(done);
        // A file that says that it is simulated is, whatever is said of it.
        if (signals_.simulated.value_or(false)) recording.simulated = true;
        recording.warnings = std::move(signals_.warnings);
        return std::move(recording);
    }

    /// Opens a file of signals whose channels say themselves what they are.
    Result<Recording> readOwn(SignalFile file, const std::vector<SignalChoice>& choices) {
        Recording recording;
        recording.title = file_.stem().string();
        recording.path = file_;
        recording.simulated = file.simulated;
        for (const auto& choice : choices) {
            auto chosen = chooseSignals(file, choice);
            if (!chosen) return refuse("{}", chosen.error().message);
            dropEmptySamples(chosen->samples, choice.columns.size());
            if (chosen->samples.samples() < 2) continue;
            if (recording.fingertip.empty()) recording.fingertip = chosen->serial;
            auto stream = examined(streamOf(std::move(*chosen), choice, file_));
            if (!stream) return failure(stream);
            recording.streams.push_back(std::move(*stream));
        }
        if (recording.streams.empty()) return refuse("no sensor stream in it has 2 samples or more");
        for (const auto& warning : file.warnings) recording.warnings.push_back(file_.string() + ": " + warning);
        return recording;
    }

private:
    template <class... Args>
    tl::unexpected<Error> refuse(fmt::format_string<Args...> text, Args&&... args) const {
        return fail(ErrorCode::ParseError, "{}: {}", file_.string(), fmt::format(text, std::forward<Args>(args)...));
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

    Result<RecordedUnit> unitOf(const DescribedStream& stream, std::size_t index) const {
        if (const auto unit = recordedUnit(stream.kind, stream.unit)) return *unit;
        return refuse("streams[{}]: \"unit\" is {}; for {} one of {} was expected", index,
                      stream.unit.empty() ? std::string("missing") : "\"" + stream.unit + "\"", nameOf(stream.kind),
                      fmt::join(unitsOf(stream.kind), ", "));
    }

    /// Returns the divisor from the file's time to seconds; 1 without a time column.
    Result<double> perSecondOf(const DescribedStream& stream, std::size_t index) const {
        if (stream.timeColumn.has_value() == stream.rate_hz.has_value()) {
            return refuse(
                "streams[{}]: {} \"time_column\" {} \"rate_hz\"; one of them was expected: where the times "
                "of the rows stand, or how many follow each other in a second",
                index, stream.rate_hz ? "both" : "neither", stream.rate_hz ? "and" : "nor");
        }
        if (stream.rate_hz) return 1.0;
        const auto unit = stream.timeUnit ? recordedTimeUnit(*stream.timeUnit) : std::nullopt;
        if (unit) return unit->perSecond;
        return refuse("streams[{}]: \"time_unit\" is {}; {} was expected", index,
                      stream.timeUnit ? "\"" + *stream.timeUnit + "\"" : "missing", kRecordedTimeUnits);
    }

    Result<void> checkColumns(const DescribedStream& stream, std::size_t index) const {
        const std::size_t fewest = stream.kind == StreamKind::Taxels ? 2 : 1;
        const std::size_t most = stream.kind == StreamKind::Taxels ? 1024 : stream.kind == StreamKind::Force ? 1 : 3;
        if (stream.columns.size() >= fewest && stream.columns.size() <= most) return {};
        return refuse("streams[{}]: \"columns\" names {} columns; for {} {} to {} were expected", index,
                      stream.columns.size(), nameOf(stream.kind), fewest, most);
    }

    /// Returns the path of a file next to the JSON, or refuses it: the description may come from anyone (hazard H10).
    Result<fs::path> fileOf(const std::string& name, std::size_t index) const {
        const fs::path relative(name);
        const auto folder = file_.has_parent_path() ? file_.parent_path() : fs::path(".");
        std::error_code error;
        const auto inside = [&] {
            if (relative.is_absolute() || name.find('\0') != std::string::npos) return false;
            for (const auto& part : relative) {
                if (part == "..") return false;
            }
            // A link may also lead out of the folder.
            const auto root = fs::weakly_canonical(folder, error);
            const auto target = fs::weakly_canonical(folder / relative, error);
            return !error && std::mismatch(root.begin(), root.end(), target.begin(), target.end()).first == root.end();
        };
        if (!inside()) {
            return refuse(
                "streams[{}]: \"file\" is \"{}\"; a file inside the recording's folder was expected, not an "
                "absolute path or one that climbs out of it",
                index, name);
        }
        const auto path = folder / relative;
        if (!fs::is_regular_file(path, error)) {
            return fail(ErrorCode::NotFound, "{}: streams[{}]: \"file\" is \"{}\", and there is no such file in {}",
                        file_.string(), index, name, folder.string());
        }
        return path;
    }

    /// Reads a file of signals once for all streams that it has; nothing if it is none.
    Result<const SignalFile*> signalsOf(const fs::path& path) {
        const auto known = read_.find(path.string());
        if (known != read_.end()) return known->second ? &*known->second : nullptr;
        auto file = reader_ ? reader_(path) : Result<std::optional<SignalFile>>(std::nullopt);
        if (!file) return failure(file);
        if (*file) {
            if ((*file)->simulated.value_or(false)) signals_.simulated = true;
            for (const auto& warning : (*file)->warnings) signals_.warnings.push_back(path.string() + ": " + warning);
        }
        const auto& kept = read_[path.string()] = std::move(*file);
        return kept ? &*kept : nullptr;
    }

    static RecordedStream streamOf(ChosenSignals chosen, const SignalChoice& choice, const fs::path& path) {
        auto name = path.filename().string();
        if (!chosen.name.empty()) name += ": " + chosen.name;
        RecordedStream stream{{choice.kind, chosen.unit, choice.columns.size(), 0, std::move(name)}, {}, {}, path};
        stream.samples = std::move(chosen.samples);
        stream.stamped = true;
        return stream;
    }

    Result<RecordedStream> readSignals(const DescribedStream& described, std::size_t index, const SignalFile& file,
                                       const fs::path& path) const {
        if (described.timeColumn || described.rate_hz || described.skipRows != 0 || described.decimal)
            return refuse(
                "streams[{}]: {} is given, and {} says itself when its samples were; an entry without it is expected",
                index,
                described.timeColumn ? "\"time_column\""
                : described.rate_hz  ? "\"rate_hz\""
                : described.decimal  ? "\"decimal\""
                                     : "\"skip_rows\"",
                path.filename().string());
        const SignalChoice choice{described.kind, described.stream, described.columns, described.unit};
        auto chosen = chooseSignals(file, choice);
        if (!chosen) return refuse("streams[{}]: {}: {}", index, path.filename().string(), chosen.error().message);
        auto stream = streamOf(std::move(*chosen), choice, path);
        if (file.ours) dropEmptySamples(stream.samples, stream.info.channels);
        for (auto& value : stream.samples.values) value *= described.factor;
        return examined(std::move(stream));
    }

    Result<RecordedStream> readStream(const DescribedStream& described, std::size_t index) {
        if (auto fits = checkColumns(described, index); !fits) return failure(fits);
        if (described.factor == 0)
            return refuse("streams[{}]: \"factor\" is 0; a number that turns no value into 0 was expected", index);
        const auto path = fileOf(described.file, index);
        if (!path) return failure(path);
        const auto signals = signalsOf(*path);
        if (!signals) return failure(signals);
        if (*signals != nullptr) return readSignals(described, index, **signals, *path);
        const auto unit = unitOf(described, index);
        if (!unit) return failure(unit);
        const auto perSecond = perSecondOf(described, index);
        if (!perSecond) return failure(perSecond);
        const auto content = readTextFile(*path);
        if (!content) return failure(content);
        auto samples = readTable(*content, path->string(),
                                 {.timeColumn = described.timeColumn,
                                  .timeDivisor = *perSecond,
                                  .columns = described.columns,
                                  .valueFactor = unit->factor,
                                  .rate_hz = described.rate_hz.value_or(0),
                                  .skipRows = described.skipRows,
                                  .decimal = described.decimal});
        if (!samples) return failure(samples);

        RecordedStream stream{
            {described.kind, unit->unit, described.columns.size(), 0, path->filename().string()}, {}, {}, *path};
        stream.samples = std::move(*samples);
        for (auto& value : stream.samples.values) value *= described.factor;
        return examined(std::move(stream));
    }

    Result<RecordedStream> examined(RecordedStream stream) const {
        if (stream.info.unit == StreamUnit::Count) markFarCounts(stream.samples, stream.info.channels);
        const bool coarse = !stream.stamped && stampsAreCoarse(stream.samples.t_s);
        if (coarse) spreadCoarseStamps(stream.samples.t_s);
        const double rough = roughRate_hz(stream.samples.t_s);
        if (!(rough > 0)) {
            return fail(ErrorCode::ParseError,
                        "{}{}: time never moves forward in the file; rising time stamps were expected",
                        stream.file.string(), stream.stamped ? "" : ":2");
        }
        StreamHealth health(rough);
        health.feed(stream.samples, stream.info.channels);
        stream.health = health.report();
        stream.health.coarseStamps = coarse;
        stream.info.rate_hz = stream.health.rate_hz > 0 ? stream.health.rate_hz : rough;
        return stream;
    }

    fs::path file_;
    const SignalReader& reader_;
    std::map<std::string, std::optional<SignalFile>> read_;
    SignalFile signals_;  // what all of them say of their origin and damage
};

/// Opens a file that no JSON describes: by the names of its channels, else the message describes it.
Result<Recording> openUndescribed(const fs::path& path, const SignalReader& reader) {
    auto file = reader ? reader(path) : Result<std::optional<SignalFile>>(std::nullopt);
    if (!file) return failure(file);
    if (!*file)
        return fail(ErrorCode::NotFound,
                    "{} has no recording.json beside it that names it; \"tactoscope-cli roughness {}\" prints one",
                    path.string(), path.string());
    const auto own = ownSignals(**file);
    if (!own.empty()) return Description(path, reader).readOwn(std::move(**file), own);
    const auto draft = draftSignals(**file, path);
    if (!draft) return failure(draft);
    return fail(ErrorCode::NotFound,
                "{} has no recording.json beside it that says which of its channels are a fingertip's; {}. Filled in "
                "where it says null and saved as recording.json beside it, this opens it:\n{}",
                path.string(), signalList(**file, path), draft->json);
}

}  // namespace

Result<Recording> Recording::open(const std::filesystem::path& path, const SignalReader& reader) {
    std::error_code error;
    auto file = path;
    if (fs::is_directory(path, error)) {
        file = path / "recording.json";
        if (!fs::exists(file, error)) {
            return fail(ErrorCode::NotFound,
                        "{} has no recording.json, which says what its files hold; \"tactoscope-cli roughness "
                        "--template\" prints one to fill in, and \"tactoscope-cli roughness FILE.csv\" one that fits "
                        "that file",
                        path.string());
        }
    } else if (fs::is_regular_file(path, error) && path.extension() != ".json") {
        file = descriptionBeside(path);
        if (file.empty()) return openUndescribed(path, reader);
    }
    const auto content = readTextFile(file);
    if (!content) return failure(content);
    const auto root = parseJson(*content, file.string());
    if (!root) return failure(root);
    return Description(file, reader).read(*root);
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

std::filesystem::path descriptionBeside(const std::filesystem::path& table) {
    for (auto beside : {fs::path(table).replace_extension(".json"), table.parent_path() / "recording.json"}) {
        const auto content = readTextFile(beside);
        const auto root = content ? parseJson(*content, beside.string()) : Result<Json>(Json());
        if (!root || !root->is_object()) continue;
        const auto streams = root->find("streams");
        if (streams == root->end() || !streams->is_array()) continue;
        for (const auto& stream : *streams) {
            if (stream.is_object() && stream.value("file", Json()) == table.filename().string()) return beside;
        }
    }
    return {};
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
