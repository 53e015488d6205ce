#include "core/session/SessionReader.h"

#include <algorithm>
#include <cstring>
#include <limits>
#include <map>
#include <numeric>
#include <optional>

#include "core/base/JsonText.h"
#include "core/packing/PackedColumns.h"
#include "core/session/Chunk.h"
#include "core/session/Digest.h"
#include "core/session/Schema.h"
#include "core/session/SealedRow.h"
#include "core/session/SessionLabels.h"
#include "core/session/SessionSource.h"
#include "core/session/SessionTypes.h"

namespace tacto {

namespace {

Result<nlohmann::json> parsed(std::string_view text, std::int64_t seq) {
    return parseJson(text, fmt::format("row {} of the session", seq), kRowLimits);
}

std::string hexOf(std::span<const std::byte> bytes) {
    std::string text;
    for (const std::byte byte : bytes) text += fmt::format("{:02x}", static_cast<unsigned>(byte));
    return text;
}

}  // namespace

struct SessionReader::State {
    State(SessionSource opened, std::shared_ptr<const RowSeal> key) : source(std::move(opened)), seal(std::move(key)) {}
    SessionSource source;
    std::shared_ptr<const RowSeal> seal;  // null if there is none or none is needed
    std::filesystem::path path;
    SessionAbout about;
    std::string head;
    Instant lastAt{0};
    bool closed = false;
    bool damaged = false;                                                           // opened to read what can be read
    mutable std::map<std::string, std::vector<std::int64_t>, std::less<>> fewRows;  // by kind, from findFewRows()
    mutable std::int64_t foundTo = 0;                                               // the last row it has seen

    [[nodiscard]] bool locked() const noexcept { return source.sealed() && seal == nullptr; }
    [[nodiscard]] Result<void> unlocked(std::string_view what) const {
        if (!locked()) return {};
        return fail(ErrorCode::Unsupported, "{} of session {} are sealed; they open with the study's passphrase", what,
                    path.filename().string());
    }

    [[nodiscard]] Result<SessionRow> row(std::int64_t seq, std::string_view kind, Instant at, std::string_view name,
                                         std::string_view text) const {
        auto body = parsed(text, seq);
        if (!body) return failure(body);
        if (!source.sealed()) return SessionRow{seq, at, std::string(name), std::move(*body)};
        auto inside = openedRow(seal.get(), seq, kind, at, name, std::move(*body));
        if (!inside) return failure(inside);
        return SessionRow{seq, inside->at, std::move(inside->name), std::move(inside->body), inside->sealed};
    }

    using Wanted = std::function<bool(std::string_view name)>;

    /// Calls `visit(seq, kind, at, name, text)` for every row that can be read in a damaged session.
    template <class Visit>
    [[nodiscard]] Result<void> forEachReadable(const Visit& visit) const {
        for (std::int64_t after = 0;;) {
            auto read = forEachAfter(after, visit);
            if (read || read.error().code != ErrorCode::ParseError) return read;
            const auto next = readableAfter(after);
            if (!next) return {};
            after = *next;
        }
    }
    /// The same for rows behind row `after`, which becomes the last that was read, of whatever kind: each row is read
    /// once, however many cannot be.
    template <class Visit>
    [[nodiscard]] Result<void> forEachAfter(std::int64_t& after, const Visit& visit) const {
        auto rows = source.database().prepare(
            "SELECT seq, kind, t_ns, name, body FROM entries WHERE seq>? AND seq<=? ORDER BY seq");
        if (!rows) return failure(rows);
        rows->bind(1, after);
        rows->bind(2, kLastSeq);
        for (;;) {
            auto more = rows->step();
            if (!more) return failure(more);
            if (!*more) return {};
            after = rows->integer(0);
            visit(after, rows->text(1), Instant(rows->integer(2)), rows->text(3), rows->text(4));
        }
    }

    /// Finds the rows that are neither chunks nor commands, in one pass: those are few, and of many kinds.
    [[nodiscard]] Result<void> findFewRows() const {
        const auto last = source.database().number("SELECT coalesce(max(seq), 0) FROM entries");
        if (!last) return failure(last);
        auto rows = source.database().prepare(
            "SELECT seq, kind FROM entries WHERE seq>? AND seq<=? AND kind NOT IN ('chunk', 'command') ORDER BY seq");
        if (!rows) return failure(rows);
        rows->bind(1, foundTo);
        rows->bind(2, *last);
        for (;;) {
            auto more = rows->step();
            if (!more) return failure(more);
            if (!*more) break;
            fewRows[std::string(rows->text(1))].push_back(rows->integer(0));
            foundTo = rows->integer(0);
        }
        foundTo = *last;
        return {};
    }

    /// Calls `visit(SessionRow)` for every row of a kind whose name is `wanted`, if that is not empty.
    template <class Visit>
    [[nodiscard]] Result<void> forEach(std::string_view kind, Visit visit, const Wanted& wanted = {}) const {
        if (damaged) {
            return forEachReadable(
                [&](std::int64_t seq, std::string_view its, Instant at, std::string_view name, std::string_view text) {
                    if (its != kind) return;
                    auto found = row(seq, kind, at, name, text);
                    if (found && (!wanted || wanted(found->name))) visit(std::move(*found));
                });
        }
        const bool many = kind == kind::kChunk || kind == kind::kCommand;
        auto rows = source.database().prepare(
            fmt::format("SELECT seq, t_ns, name, body FROM entries WHERE {}=? ORDER BY seq", many ? "kind" : "seq"));
        if (!rows) return failure(rows);
        const auto visitRows = [&]() -> Result<void> {
            for (;;) {
                auto more = rows->step();
                if (!more) return failure(more);
                if (!*more) return {};
                if (wanted && !source.sealed() && !wanted(rows->text(2))) continue;
                auto found = row(rows->integer(0), kind, Instant(rows->integer(1)), rows->text(2), rows->text(3));
                if (!found) return failure(found);
                if (!wanted || wanted(found->name)) visit(std::move(*found));
            }
        };
        if (many) {
            rows->bind(1, kind);
            return visitRows();
        }
        if (auto done = findFewRows(); !done) return done;
        const auto of = fewRows.find(kind);
        if (of == fewRows.end()) return {};
        for (const auto seq : of->second) {
            rows->reset();
            rows->bind(1, seq);
            if (auto done = visitRows(); !done) return done;
        }
        return {};
    }

    /// Finds the end of a damaged part behind row `after`: the least number behind which a row can be read. Returns
    /// nothing if none can; what it returns is greater than `after`.
    [[nodiscard]] std::optional<std::int64_t> readableAfter(std::int64_t after) const {
        const auto readable = [&](std::int64_t from) -> std::optional<bool> {  // nothing: no rows are left
            auto row = source.database().prepare(
                "SELECT t_ns, name, body FROM entries WHERE seq>? AND seq<=? ORDER BY seq LIMIT 1");
            if (!row) return false;
            row->bind(1, from);
            row->bind(2, kLastSeq);
            const auto there = row->step();
            if (!there) return false;
            return *there ? std::optional(true) : std::nullopt;
        };
        constexpr std::int64_t kMaxJump = std::int64_t{1} << 40;
        std::int64_t damagedTo = after, jump = 1;
        for (; jump <= kMaxJump; jump *= 2) {
            const auto found = readable(after + jump);
            if (!found) break;
            if (*found) break;
            damagedTo = after + jump;
        }
        if (jump > kMaxJump) return std::nullopt;
        std::int64_t readableFrom = after + jump;
        while (readableFrom - damagedTo > 1) {
            const auto middle = std::midpoint(damagedTo, readableFrom);
            (readable(middle).value_or(true) ? readableFrom : damagedTo) = middle;
        }
        return readableFrom;
    }

    [[nodiscard]] Result<std::vector<SessionRow>> rows(const char* kind) const {
        std::vector<SessionRow> rows;
        auto read = forEach(kind, [&](SessionRow row) { rows.push_back(std::move(row)); });
        if (!read) return failure(read);
        return rows;
    }

    [[nodiscard]] Result<void> forEachChunk(const SessionStreamInfo& info, const char* order,
                                            const std::function<bool(const ChunkHead&, const SampleBlock&)>& visit,
                                            std::int64_t each = 1) const {
        if (damaged) return forEachReadableChunk(info, visit, each);
        auto rows = source.database().prepare(
            fmt::format("SELECT e.seq, e.body, c.stamps, c.data FROM chunks c JOIN entries e ON e.seq = c.seq "
                        "WHERE c.stream=? AND c.idx % ?=0 ORDER BY c.idx {}",
                        order));
        if (!rows) return failure(rows);
        rows->bind(1, std::int64_t{info.id});
        rows->bind(2, each);
        SampleBlock block;
        for (;;) {
            auto more = rows->step();
            if (!more) return failure(more);
            if (!*more) return {};
            const auto chunk = chunkHead(rows->integer(0), rows->text(1));
            if (!chunk) return failure(chunk);
            auto unpacked =
                unpack(rows->integer(0), *chunk, info.stream.columns.size(), rows->blob(2), rows->blob(3), block);
            if (!unpacked) return unpacked;
            if (!visit(*chunk, block)) return {};
        }
    }

    [[nodiscard]] Result<void> forEachStamps(const SessionStreamInfo& info,
                                             const std::function<bool(std::span<const double>)>& visit) const {
        if (damaged)
            return forEachReadableChunk(
                info, [&](const ChunkHead&, const SampleBlock& block) { return visit(block.t_s); }, 1);
        auto rows = source.database().prepare(
            "SELECT e.seq, e.body FROM chunks c JOIN entries e ON e.seq = c.seq WHERE c.stream=? ORDER BY c.idx");
        if (!rows) return failure(rows);
        auto rest = source.database().prepare("SELECT stamps, data FROM chunks WHERE seq=?");
        if (!rest) return failure(rest);
        rows->bind(1, std::int64_t{info.id});
        SampleBlock block;
        for (;;) {
            auto more = rows->step();
            if (!more) return failure(more);
            if (!*more) return {};
            const auto seq = rows->integer(0);
            const auto chunk = chunkHead(seq, rows->text(1));
            if (!chunk) return failure(chunk);
            if (chunk->line && chunk->samples <= kMaxPackedNumbers) {
                stampsOf(*chunk, block);
            } else {
                rest->reset();
                rest->bind(1, seq);
                if (auto there = rest->step(); !there) return failure(there);
                auto unpacked = unpack(seq, *chunk, info.stream.columns.size(), rest->blob(0), rest->blob(1), block);
                if (!unpacked) return unpacked;
            }
            if (!visit(block.t_s)) return {};
        }
    }

    /// Reads the chunks of a damaged session by their rows, and leaves out those that are not what was recorded.
    [[nodiscard]] Result<void> forEachReadableChunk(
        const SessionStreamInfo& info, const std::function<bool(const ChunkHead&, const SampleBlock&)>& visit,
        std::int64_t each) const {
        SampleBlock block;
        std::int64_t found = 0;
        bool going = true;
        return forEach(kind::kChunk, [&](const SessionRow& row) {
            const auto chunk = chunkHeadFrom(row.body);
            if (!going || !chunk || chunk->stream != info.id || found++ % each != 0) return;
            auto data = source.database().prepare("SELECT stamps, data FROM chunks WHERE seq=?");
            if (!data) return;
            data->bind(1, row.seq);
            if (const auto there = data->step(); !there || !*there) return;
            const std::span<const std::byte> parts[] = {data->blob(0), data->blob(1)};
            if (!unpack(row.seq, *chunk, info.stream.columns.size(), parts[0], parts[1], block)) return;
            const auto crc = chunk->packing ? crc32(recordedBytes(block, !chunk->line)) : crc32(parts);
            if (source.sealed() || crc == chunk->crc) going = visit(*chunk, block);
        });
    }

    [[nodiscard]] Result<ChunkHead> chunkHead(std::int64_t seq, std::string_view text) const {
        if (!source.sealed()) return parseChunkHead(text);
        auto body = parsed(text, seq);
        if (!body) return failure(body);
        const auto inside = sealedText(seq, *body);
        if (!inside) return failure(inside);
        return chunkHeadFrom(*inside);
    }
    [[nodiscard]] Result<nlohmann::json> sealedText(std::int64_t seq, const nlohmann::json& body) const {
        auto at = source.database().number(fmt::format("SELECT t_ns FROM entries WHERE seq={}", seq));
        if (!at) return failure(at);
        auto inside = openedRow(seal.get(), seq, kind::kChunk, Instant(*at), "", body);
        if (!inside) return failure(inside);
        return std::move(inside->body);
    }
    [[nodiscard]] Result<void> unpack(std::int64_t seq, const ChunkHead& chunk, std::size_t columns,
                                      std::span<const std::byte> stamps, std::span<const std::byte> data,
                                      SampleBlock& into) const {
        if (!source.sealed()) return unpackChunk(chunk, columns, stamps, data, into);
        const auto opened = openedBulk(*seal, seq, kind::kChunk, data);
        if (!opened) return failure(opened);
        return unpackOpenedChunk(chunk, columns, *opened, into);
    }

    /// The streams, the first with id 1. Of a damaged session those that cannot be read have no columns: each keeps
    /// its place, since the samples of the others go by theirs.
    [[nodiscard]] Result<std::vector<SessionStreamInfo>> declared() const {
        std::vector<SessionStreamInfo> streams;
        const auto add = [&](SessionStream stream) {
            streams.push_back({static_cast<int>(streams.size()) + 1, std::move(stream), 0,
                               std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::quiet_NaN()});
        };
        if (damaged) {
            auto read = forEachReadable(
                [&](std::int64_t seq, std::string_view its, Instant at, std::string_view name, std::string_view text) {
                    const bool known = std::ranges::find(kind::kAll, its) != std::end(kind::kAll);
                    if (known && its != kind::kStream) return;
                    const auto found = row(seq, kind::kStream, at, name, text);
                    auto stream = found ? streamFrom(found->body) : SessionStream{};
                    // A row whose kind itself was altered is a stream's if it holds one.
                    if (known || !stream.columns.empty()) add(std::move(stream));
                });
            if (!read) return failure(read);
            return streams;
        }
        auto read = forEach(kind::kStream, [&](const SessionRow& row) { add(streamFrom(row.body)); });
        if (!read) return failure(read);
        for (const auto& each : streams) {
            if (each.stream.columns.empty()) {
                return fail(ErrorCode::ParseError, "stream '{}' has no columns", each.stream.name);
            }
        }
        return streams;
    }

    [[nodiscard]] Result<SessionStreamInfo> stream(int id) const {
        auto streams = declared();
        if (!streams) return failure(streams);
        if (id < 1 || static_cast<std::size_t>(id) > streams->size()) {
            return fail(ErrorCode::NotFound, "there is no stream {}; the session has {}", id, streams->size());
        }
        auto& found = (*streams)[static_cast<std::size_t>(id) - 1];
        if (found.stream.columns.empty()) return fail(ErrorCode::NotFound, "stream {} cannot be read", id);
        return std::move(found);
    }
};

SessionReader::SessionReader(std::unique_ptr<State> state) : state_(std::move(state)) {}
SessionReader::SessionReader(SessionReader&&) noexcept = default;
SessionReader& SessionReader::operator=(SessionReader&&) noexcept = default;
SessionReader::~SessionReader() = default;

Result<SessionReader> SessionReader::open(const std::filesystem::path& path, std::shared_ptr<const RowSeal> seal) {
    return open(path, std::move(seal), false);
}

Result<SessionReader> SessionReader::openDamaged(const std::filesystem::path& path,
                                                 std::shared_ptr<const RowSeal> seal) {
    return open(path, std::move(seal), true);
}

Result<SessionReader> SessionReader::open(const std::filesystem::path& path, std::shared_ptr<const RowSeal> seal,
                                          bool damaged) {
    auto source = SessionSource::open(path);
    if (!source) return failure(source);
    auto state = std::make_unique<State>(std::move(*source), std::move(seal));
    state->path = path;
    state->damaged = damaged;
    bool found = false;
    auto about = state->forEach(kind::kAbout, [&](const SessionRow& row) {
        if (!found) state->about = aboutFrom(row.body);
        if (!found && row.sealed) state->about.parameters = {{"sealed", true}};
        found = true;
    });
    if (!about) return failure(about);
    if (!found) return fail(ErrorCode::ParseError, "{} is damaged: its first row is missing", path.string());
    auto last = state->source.database().prepare(
        "SELECT hash, kind, t_ns, seq, name, body FROM entries WHERE kind<>'annotation' AND seq<=? ORDER BY seq DESC "
        "LIMIT 1");
    if (!last) return failure(last);
    last->bind(1, kLastSeq);
    if (auto row = last->step(); !row) {
        if (damaged) return SessionReader(std::move(state));
        return failure(row);
    }
    state->head = hexOf(last->blob(0));
    state->closed = last->text(1) == kind::kEnd;
    state->lastAt = Instant(last->integer(2));
    if (state->source.sealed()) {
        const auto row = state->row(last->integer(3), last->text(1), state->lastAt, last->text(4), last->text(5));
        if (!row) return failure(row);
        state->lastAt = row->at;
    }
    return SessionReader(std::move(state));
}

bool SessionReader::sealed() const noexcept { return state_->source.sealed(); }
bool SessionReader::locked() const noexcept { return state_->locked(); }
const SessionAbout& SessionReader::about() const noexcept { return state_->about; }
bool SessionReader::closed() const noexcept { return state_->closed; }
const std::string& SessionReader::chainHead() const noexcept { return state_->head; }
Instant SessionReader::lastAt() const noexcept { return state_->lastAt; }

Result<std::string> SessionReader::hashOf(std::int64_t seq) const {
    auto row = state_->source.database().prepare("SELECT hash FROM entries WHERE seq=?");
    if (!row) return failure(row);
    row->bind(1, seq);
    const auto found = row->step();
    if (!found) return failure(found);
    if (!*found) return fail(ErrorCode::NotFound, "{} has no row {}", state_->path.filename().string(), seq);
    return hexOf(row->blob(0));
}

Result<void> SessionReader::checkChain() const {
    auto rows = state_->source.database().prepare(
        "SELECT seq, kind, t_ns, name, body, digest, prev, hash FROM entries ORDER BY seq");
    if (!rows) return failure(rows);
    const auto isDigest = [&](int column, const Digest& digest) {
        const auto stored = rows->blob(column);
        return std::ranges::equal(stored, std::as_bytes(std::span(digest)));
    };
    Digest previous{};
    for (std::int64_t expected = 1;; ++expected) {
        auto more = rows->step();
        if (!more) return failure(more);
        if (!*more) return {};
        std::optional<Digest> bulk;
        if (const auto stored = rows->blob(5); stored.size() == std::tuple_size_v<Digest>)
            std::memcpy(bulk.emplace().data(), stored.data(), stored.size());
        const auto hash = chainHash(
            previous, {rows->integer(0), rows->text(1), rows->integer(2), rows->text(3), rows->text(4), bulk});
        if (rows->integer(0) != expected || !isDigest(6, previous) || !isDigest(7, hash)) {
            return fail(ErrorCode::ParseError,
                        "the record {} was changed: its row {} is missing or altered; put it back from your copy",
                        state_->path.filename().string(), expected);
        }
        previous = hash;
    }
}

Result<SessionLabels> SessionReader::labels() const {
    SessionLabels labels;
    if (state_->locked()) labels.note = "sealed";
    const auto apply = [&](const SessionRow& row) { applyLabels(row.body, labels); };
    auto read = state_->forEach(kind::kReport, apply, [](std::string_view name) { return name == "notes"; });
    if (read && !state_->source.sealed()) read = state_->forEach(kind::kAnnotation, apply);
    if (!read) return failure(read);
    return labels;
}

Result<std::vector<SessionRow>> SessionReader::events() const { return state_->rows(kind::kEvent); }
Result<std::vector<SessionRow>> SessionReader::commands() const { return state_->rows(kind::kCommand); }
Result<void> SessionReader::forEachCommand(const std::function<void(const SessionRow&)>& visit,
                                           const std::function<bool(std::string_view name)>& wanted) const {
    return state_->forEach(kind::kCommand, visit, wanted);
}
Result<std::vector<SessionRow>> SessionReader::measurements() const { return state_->rows(kind::kMeasurement); }
Result<std::vector<SessionRow>> SessionReader::log() const { return state_->rows(kind::kLog); }
Result<std::vector<SessionRow>> SessionReader::reportItems() const { return state_->rows(kind::kReport); }

Result<std::vector<SessionTrial>> SessionReader::trials() const {
    std::vector<SessionTrial> trials;
    auto read = state_->forEach(kind::kTrial, [&](const SessionRow& row) {
        trials.push_back({row.seq, static_cast<int>(countOr(row.body, "number")), row.at, row.name,
                          valueOr(row.body, "measured"), row.sealed});
    });
    if (!read) return failure(read);
    return trials;
}

Result<std::vector<SessionVerdict>> SessionReader::verdicts() const {
    std::vector<SessionVerdict> verdicts;
    auto read = state_->forEach(kind::kVerdict, [&](const SessionRow& row) {
        verdicts.push_back({row.seq, row.at, row.name, row.sealed ? row.name : textOr(row.body, "verdict"),
                            textsOr(row.body, "reasons"), valueOr(row.body, "results"), row.sealed});
    });
    if (!read) return failure(read);
    return verdicts;
}

Result<std::vector<SessionCaptureInfo>> SessionReader::captures() const {
    std::vector<SessionCaptureInfo> captures;
    auto read = state_->forEach(kind::kCapture, [&](const SessionRow& row) {
        SessionCaptureInfo info;
        info.seq = row.seq;
        info.at = row.at;
        if (const auto trial = countOr(row.body, "trial"); trial != 0) info.trial = static_cast<int>(trial);
        info.rate_hz = numberOr(row.body, "rate_hz");
        info.start_s = numberOr(row.body, "start_s");
        info.trigger_s = numberOr(row.body, "trigger_s");
        info.samples = countOr(row.body, "samples");
        info.simulated = flagOr(row.body, "simulated");
        info.sealed = row.sealed;
        for (const auto& channel : valueOr(row.body, "channels")) info.channels.push_back(textOr(channel, "name"));
        captures.push_back(std::move(info));
    });
    if (!read) return failure(read);
    return captures;
}

Result<Capture> SessionReader::capture(std::int64_t seq) const {
    if (auto open = state_->unlocked("the captures"); !open) return failure(open);
    auto rows = state_->source.database().prepare(
        "SELECT e.body, c.data, e.t_ns FROM captures c JOIN entries e ON e.seq = c.seq WHERE c.seq=?");
    if (!rows) return failure(rows);
    rows->bind(1, seq);
    auto found = rows->step();
    if (!found) return failure(found);
    if (!*found) return fail(ErrorCode::NotFound, "row {} of the session is not a capture", seq);
    const auto row = state_->row(seq, kind::kCapture, Instant(rows->integer(2)), "", rows->text(0));
    if (!row) return failure(row);
    if (!state_->source.sealed()) {
        const std::span<const std::byte> parts[] = {rows->blob(1)};
        if (state_->damaged && crc32(parts) != countOr(row->body, "crc32"))
            return fail(ErrorCode::ParseError, "capture {} does not match its CRC-32", seq);
        return unpackCapture(row->body, rows->blob(1));
    }
    const auto opened = openedBulk(*state_->seal, seq, kind::kCapture, rows->blob(1));
    if (!opened) return failure(opened);
    return unpackCapture(row->body, *opened);
}

Result<std::vector<SessionStreamInfo>> SessionReader::streams() const {
    if (auto open = state_->unlocked("the samples"); !open) return failure(open);
    auto streams = state_->declared();
    if (!streams) return streams;
    std::erase_if(*streams, [](const SessionStreamInfo& info) { return info.stream.columns.empty(); });
    for (auto& info : *streams) {
        if (state_->damaged) {  // the number recorded, read or not, as far as is known
            auto counted = state_->forEach(kind::kChunk, [&](const SessionRow& row) {
                const auto head = chunkHeadFrom(row.body);
                if (head && head->stream == info.id) info.samples = head->firstSample + head->samples;
            });
            if (!counted) return failure(counted);
            continue;
        }
        auto first = state_->forEachChunk(info, "ASC", [&](const ChunkHead&, const SampleBlock& block) {
            if (block.samples() > 0) info.first_s = block.t_s.front();
            return false;
        });
        if (!first) return failure(first);
        auto last = state_->forEachChunk(info, "DESC", [&](const ChunkHead& head, const SampleBlock& block) {
            if (block.samples() > 0) info.last_s = block.t_s.back();
            info.samples = head.firstSample + head.samples;
            return false;
        });
        if (!last) return failure(last);
    }
    return streams;
}

Result<SampleBlock> SessionReader::samples(int stream) const {
    SampleBlock all;
    auto read = forEachChunk(stream, [&](const SampleBlock& block) {
        all.t_s.insert(all.t_s.end(), block.t_s.begin(), block.t_s.end());
        all.values.insert(all.values.end(), block.values.begin(), block.values.end());
        return true;
    });
    if (!read) return failure(read);
    return all;
}

Result<void> SessionReader::forEachChunk(int stream, const std::function<bool(const SampleBlock&)>& visit) const {
    if (auto open = state_->unlocked("the samples"); !open) return failure(open);
    const auto info = state_->stream(stream);
    if (!info) return failure(info);
    return state_->forEachChunk(*info, "ASC", [&](const ChunkHead&, const SampleBlock& block) { return visit(block); });
}

Result<void> SessionReader::forEachStamps(int stream, const std::function<bool(std::span<const double>)>& visit) const {
    if (auto open = state_->unlocked("the samples"); !open) return failure(open);
    const auto info = state_->stream(stream);
    if (!info) return failure(info);
    return state_->forEachStamps(*info, visit);
}

Result<StreamOutline> SessionReader::outline(int stream, std::uint64_t most) const {
    if (auto open = state_->unlocked("the samples"); !open) return failure(open);
    const auto info = state_->stream(stream);
    if (!info) return failure(info);
    const auto columns = info->stream.columns.size();
    std::uint64_t samples = 0;
    auto counted = state_->damaged
                       ? state_->forEach(kind::kChunk,
                                         [&](const SessionRow& row) {
                                             const auto head = chunkHeadFrom(row.body);
                                             if (head && head->stream == info->id) samples += head->samples;
                                         })
                       : state_->forEachChunk(*info, "DESC", [&](const ChunkHead& head, const SampleBlock&) {
                             samples = head.firstSample + head.samples;
                             return false;
                         });
    if (!counted) return failure(counted);
    StreamOutline outline;
    const auto kept = std::max<std::uint64_t>(1, most / columns);
    outline.oneIn = static_cast<std::int64_t>(samples / kept + (samples % kept != 0 || samples == 0 ? 1 : 0));
    auto& into = outline.samples;
    const auto take = [&](const ChunkHead&, const SampleBlock& block) {
        if (outline.oneIn > 1 && into.samples() > 0) {
            into.t_s.push_back(into.t_s.back());
            into.values.insert(into.values.end(), columns, std::numeric_limits<double>::quiet_NaN());
        }
        into.t_s.insert(into.t_s.end(), block.t_s.begin(), block.t_s.end());
        into.values.insert(into.values.end(), block.values.begin(), block.values.end());
        return true;
    };
    if (auto read = state_->forEachChunk(*info, "ASC", take, outline.oneIn); !read) return failure(read);
    return outline;
}

Result<std::string> SessionReader::reproducibleText() const {
    if (auto open = state_->unlocked("the rows"); !open) return failure(open);
    std::string text = dumpJson(reproducible(state_->about)) + "\n";
    auto rows = state_->source.database().prepare(
        "SELECT e.seq, e.kind, e.t_ns, e.name, e.body, e.digest, c.stream, c.stamps, c.data FROM entries e "
        "LEFT JOIN chunks c ON c.seq=e.seq WHERE kind NOT IN ('about', 'annotation') ORDER BY e.seq");
    if (!rows) return failure(rows);
    std::vector<SessionStreamInfo> streams;
    if (!state_->source.sealed()) {
        auto declared = state_->declared();
        if (!declared) return failure(declared);
        streams = std::move(*declared);
    }
    SampleBlock block;
    for (;;) {
        auto more = rows->step();
        if (!more) return failure(more);
        if (!*more) return text;
        if (!state_->source.sealed()) {
            auto body = std::string(rows->text(4));
            auto digest = hexOf(rows->blob(5));
            if (rows->text(1) == kind::kChunk) {  // as if it were not packed: another zstd packs in another way
                auto head = parseChunkHead(body);
                if (!head) return failure(head);
                const auto stream = static_cast<std::size_t>(rows->integer(6)) - 1;
                if (stream >= streams.size())
                    return fail(ErrorCode::ParseError, "row {} has no samples of a stream", rows->integer(0));
                auto done =
                    unpackChunk(*head, streams[stream].stream.columns.size(), rows->blob(7), rows->blob(8), block);
                if (!done) return failure(done);
                head->packing.reset();
                body = toJsonText(*head);
                digest = hexText(bulkDigest(recordedBytes(block, !head->line)));
            }
            text += fmt::format("{} {} {} {} {} {}\n", rows->integer(0), rows->text(1), rows->integer(2), rows->text(3),
                                body, digest);
            continue;
        }
        const auto row =
            state_->row(rows->integer(0), rows->text(1), Instant(rows->integer(2)), rows->text(3), rows->text(4));
        if (!row) return failure(row);
        // The row of a chunk or capture contains the CRC-32 of the data before sealing; the digest covers the sealed
        // data, which differ in each run.
        text +=
            fmt::format("{} {} {} {} {}\n", row->seq, rows->text(1), row->at.count(), row->name, dumpJson(row->body));
    }
}

}  // namespace tacto
