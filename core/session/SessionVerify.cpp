#include "core/session/SessionVerify.h"

#include <algorithm>
#include <limits>

#include "core/base/JsonText.h"
#include "core/base/Words.h"
#include "core/session/Chunk.h"
#include "core/session/CommitThread.h"
#include "core/session/Database.h"
#include "core/session/Digest.h"
#include "core/session/Schema.h"
#include "core/session/SealedRow.h"
#include "core/session/SessionIndex.h"
#include "core/session/SessionSource.h"
#include "core/session/SessionTypes.h"

namespace tacto {

namespace {

/// Enough to see what happened; one broken row could otherwise cause a problem in every row after it.
constexpr std::size_t kMaxProblems = 40;

/// So many bytes of samples are checked at once: passing each chunk alone to another thread would cost more.
constexpr std::size_t kHandedOver = 1'000'000;

std::optional<Digest> digestFrom(std::span<const std::byte> bytes) {
    Digest digest;
    if (bytes.size() != digest.size()) return std::nullopt;
    std::transform(bytes.begin(), bytes.end(), digest.begin(),
                   [](std::byte b) { return static_cast<unsigned char>(b); });
    return digest;
}

struct StreamSeen {
    std::string name;
    std::size_t columns;
    std::int64_t nextIndex = 0;
    std::uint64_t nextSample = 0;
};

/// Checks the rows in one pass, in the order of writing.
class Inspection {
public:
    Inspection(const Database& database, bool sealed, VerifyReport& report, const std::function<bool()>& stopped)
        : database_(database), sealed_(sealed), report_(report), stopped_(stopped) {}

    [[nodiscard]] Result<void> run() {
        if (auto done = checkPages(); !done) return done;
        if (auto done = checkSchema(); !done) return done;
        if (auto done = checkRows(); !done) return done;
        return checkOrphans();
    }

    template <class... Args>
    void problem(fmt::format_string<Args...> text, Args&&... args) {
        problems_.add(row_, text, std::forward<Args>(args)...);
    }
    /// Puts the problems into the report, in the order of the rows.
    void report() {
        handOver();
        static_cast<void>(other_.wait());
        auto first = problems_.texts;
        first.insert(first.end(), samples_.texts.begin(), samples_.texts.end());
        std::ranges::stable_sort(first, {}, &Problems::Text::row);
        for (auto& each : first)
            if (report_.problems.size() < kMaxProblems) report_.problems.push_back(std::move(each.text));
        const auto found = problems_.found + samples_.found;
        if (found > kMaxProblems) report_.problems.push_back(fmt::format("and {} more", found - kMaxProblems));
    }
    [[nodiscard]] const std::vector<SessionSignature>& signatures() const noexcept { return signatures_; }

private:
    struct Problems {
        struct Text {
            std::int64_t row;
            std::string text;
        };
        std::vector<Text> texts;  // the first kMaxProblems
        std::size_t found = 0;
        template <class... Args>
        void add(std::int64_t row, fmt::format_string<Args...> text, Args&&... args) {
            ++found;
            if (texts.size() < kMaxProblems) texts.push_back({row, fmt::format(text, std::forward<Args>(args)...)});
        }
    };
    /// A chunk whose samples have yet to be checked.
    struct ReadChunk {
        std::int64_t row = 0;
        ChunkHead head;
        std::string name;
        std::size_t columns = 0;
        std::optional<Digest> digest;
        std::vector<std::byte> stamps, data;
    };

    [[nodiscard]] Result<void> checkPages() {
        auto lines = database_.prepare("PRAGMA integrity_check(20)");
        if (!lines) return failure(lines);
        const auto asked = database_.interruptedBy(stopped_);
        for (;;) {
            auto more = lines->step();
            if (!more) return failure(more);
            if (!*more) return {};
            if (lines->text(0) != "ok") problem("the database is damaged: {}", lines->text(0));
        }
    }

    /// An altered trigger or view is no row, but makes the file different from what was recorded.
    [[nodiscard]] Result<void> checkSchema() {
        static constexpr const char* kObjects =
            "SELECT group_concat(type || ' ' || name || ' ' || tbl_name || ' ' || coalesce(sql, ''), char(10)) FROM "
            "(SELECT * FROM sqlite_schema ORDER BY name)";
        auto fresh = Database::open(":memory:", 0x6 /* SQLITE_OPEN_READWRITE | SQLITE_OPEN_CREATE */);
        if (!fresh) return failure(fresh);
        if (auto made = createSchema(*fresh, kNewestVersion); !made) return made;
        auto wanted = fresh->prepare(kObjects);
        auto actual = database_.prepare(kObjects);
        if (!wanted) return failure(wanted);
        if (!actual) return failure(actual);
        auto first = wanted->step();
        auto second = actual->step();
        if (!first) return failure(first);
        if (!second) return failure(second);
        if (wanted->text(0) != actual->text(0)) problem("the tables, views or triggers are not those of a session");
        return {};
    }

    [[nodiscard]] Result<void> checkRows() {
        auto rows =
            database_.prepare("SELECT seq, kind, t_ns, name, body, digest, prev, hash FROM entries ORDER BY seq");
        if (!rows) return failure(rows);
        auto chunk = database_.prepare("SELECT stream, idx, stamps, data FROM chunks WHERE seq=?");
        if (!chunk) return failure(chunk);
        auto capture = database_.prepare("SELECT data FROM captures WHERE seq=?");
        if (!capture) return failure(capture);
        Digest previous{};
        std::string lastKind;
        std::int64_t expected = 1;
        for (;;) {
            auto more = rows->step();
            if (!more) return failure(more);
            if (!*more) break;
            if (stopped_ && stopped_()) return fail(ErrorCode::Stopped, "cancelled");
            const Entry entry{rows->integer(0), rows->text(1), rows->integer(2),
                              rows->text(3),    rows->text(4), digestFrom(rows->blob(5))};
            row_ = entry.seq;
            if (entry.seq < expected || entry.seq > kLastSeq) {
                problem("row {} has a number that no session gives", entry.seq);
                break;
            }
            if (entry.seq == expected + 1) problem("row {} is missing", expected);
            if (entry.seq > expected + 1) problem("rows {} to {} are missing", expected, entry.seq - 1);
            expected = entry.seq + 1;
            if (report_.rows == 0 && entry.kind != kind::kAbout) problem("the first row does not say what was used");
            const bool annotates = entry.kind == kind::kAnnotation;
            if (lastKind == kind::kEnd && !annotates)
                problem("row {} ({}) comes after the end mark", entry.seq, entry.kind);
            if (lastKind != kind::kEnd && annotates)
                problem("row {} (annotation) comes before the end mark", entry.seq);
            const auto stored = digestFrom(rows->blob(7));
            if (digestFrom(rows->blob(6)) != previous) {
                problem("row {} ({}) does not continue the hash chain", entry.seq, entry.kind);
            }
            const Digest hash = chainHash(previous, entry);
            if (stored != hash)
                problem("row {} ({} {}) was altered: its hash is wrong", entry.seq, entry.kind, entry.name);
            // Goes on from the stored hash, so that one altered row is reported as one problem.
            previous = stored.value_or(hash);
            const auto body = parseJson(entry.body, fmt::format("row {} ({})", entry.seq, entry.kind), kRowLimits);
            if (!body) problem("{}", body.error().message);
            if (sealed_ && isSealedKind(entry.kind)) {
                if (body && !textOr(*body, "sealed").empty())
                    ++sealedRows_;
                else
                    problem("row {} ({}) is not sealed, and the session is", entry.seq, entry.kind);
            }
            if (sealed_ && entry.t_ns % 1'000'000'000 != 0)
                problem("row {} ({}) states its time finer than a second", entry.seq, entry.kind);
            if (auto done = checkKind(entry, body ? *body : nlohmann::json(), *chunk, *capture); !done) return done;
            ++report_.rows;
            if (annotates) {
                auto signature = signatureIn(body ? *body : nlohmann::json());
                if (!signature || body->size() > 2) ++annotations_;  // a signature stands beside its time alone
                if (signature) signatures_.push_back(std::move(*signature));
                continue;  // not part of the recording, which ended before
            }
            head_ = previous;
            lastKind = entry.kind;
        }
        row_ = std::numeric_limits<std::int64_t>::max();
        if (report_.rows == 0) problem("the session has no rows");
        report_.head = hexText(head_);
        if (annotations_ > 0)
            report_.notes.push_back(
                fmt::format("Operator, sample, tags or note were changed {} {} after the recording ended.",
                            annotations_, annotations_ == 1 ? "time" : "times"));
        report_.closed = lastKind == kind::kEnd;
        if (sealed_)
            report_.notes.push_back(
                fmt::format("{} of its rows are sealed: that they are those recorded is known, what they say is not.",
                            sealedRows_));
        return {};
    }

    [[nodiscard]] Result<void> checkKind(const Entry& entry, const nlohmann::json& body, Statement& chunk,
                                         Statement& capture) {
        if (entry.kind == kind::kStream) {
            const auto stream = streamFrom(body);
            streams_.push_back({stream.name, stream.columns.size()});
        } else if (entry.kind == kind::kEvent) {
            ++report_.events;
        } else if (entry.kind == kind::kVerdict) {
            ++report_.verdicts;
        } else if (entry.kind == kind::kTrial) {
            ++report_.trials;
            if (countOr(body, "number") != report_.trials) {
                problem("row {} is trial {} where trial {} belongs", entry.seq, countOr(body, "number"),
                        report_.trials);
            }
        } else if (entry.kind == kind::kChunk) {
            ++report_.chunks;
            return sealed_ ? checkSealedChunk(entry, body, chunk) : checkChunk(entry, body, chunk);
        } else if (entry.kind == kind::kCapture) {
            ++report_.captures;
            return checkCapture(entry, body, capture);
        } else if (entry.kind == kind::kEnd) {
            if (countOr(body, "rows") != report_.rows + 1 || countOr(body, "trials") != report_.trials) {
                problem("the end mark counts {} rows and {} trials; there are {} and {}", countOr(body, "rows"),
                        countOr(body, "trials"), report_.rows + 1, report_.trials);
            }
        }
        return {};
    }

    [[nodiscard]] Result<void> checkChunk(const Entry& entry, const nlohmann::json& body, Statement& row) {
        const auto head = body.is_null() ? parseChunkHead(entry.body) : chunkHeadFrom(body);
        if (!head) {
            problem("row {}: {}", entry.seq, head.error().message);
            return {};
        }
        if (head->stream < 1 || static_cast<std::size_t>(head->stream) > streams_.size()) {
            problem("row {} holds samples of stream {}, which is not declared", entry.seq, head->stream);
            return {};
        }
        auto& stream = streams_[static_cast<std::size_t>(head->stream) - 1];
        const auto name = fmt::format("chunk {} of stream '{}' (samples {} to {})", head->index, stream.name,
                                      head->firstSample, head->firstSample + head->samples - 1);
        if (head->index != stream.nextIndex || head->firstSample != stream.nextSample) {
            problem("{} follows chunk {} and sample {}: samples are missing", name, stream.nextIndex - 1,
                    stream.nextSample);
        }
        stream.nextIndex = head->index + 1;
        stream.nextSample = head->firstSample + head->samples;
        report_.samples += head->samples;

        const auto there = bulkOf(entry, name, row);
        if (!there) return failure(there);
        if (!*there) return {};
        if (row.integer(0) != head->stream || row.integer(1) != head->index ||
            row.isNull(2) != (head->packing || head->line)) {
            problem("{} is filed under stream {}, chunk {}", name, row.integer(0), row.integer(1));
        }
        const auto stamps = row.blob(2), data = row.blob(3);
        read_.push_back({entry.seq,
                         *head,
                         name,
                         stream.columns,
                         entry.digest,
                         {stamps.begin(), stamps.end()},
                         {data.begin(), data.end()}});
        readBytes_ += stamps.size() + data.size();
        if (readBytes_ > kHandedOver) handOver();
        return {};
    }

    /// Lets the other thread check the samples read so far, while this one reads on.
    void handOver() {
        static_cast<void>(other_.wait());
        std::swap(read_, checked_);
        read_.clear();
        readBytes_ = 0;
        other_.start([this] {
            for (const auto& chunk : checked_) checkSamples(chunk);
            return Result<void>();
        });
    }

    /// Runs on the other thread, which alone uses scratch_, checked_ and samples_ until it has ended.
    void checkSamples(const ReadChunk& chunk) {
        const auto& head = chunk.head;
        const std::span<const std::byte> parts[] = {chunk.stamps, chunk.data};
        auto unpacked = Result<void>();
        if (chunk.columns > 0) unpacked = unpackChunk(head, chunk.columns, parts[0], parts[1], scratch_);
        bool same = true;
        if (!head.packing)
            same = crc32(parts) == head.crc;
        else if (chunk.columns > 0 && (unpacked || unpacked.error().code != ErrorCode::Unsupported))
            same = unpacked && crc32(recordedBytes(scratch_, !head.line)) == head.crc;
        if (!same) samples_.add(chunk.row, "{} does not match its CRC-32", chunk.name);
        if (chunk.digest != bulkDigest(parts))
            samples_.add(chunk.row, "the samples of {} were altered: their hash is wrong", chunk.name);
        if (!unpacked) samples_.add(chunk.row, "row {}: {}", chunk.row, unpacked.error().message);
    }

    /// Moves `row` to the samples of an entry. If they are missing, adds a problem and returns false.
    [[nodiscard]] Result<bool> bulkOf(const Entry& entry, std::string_view name, Statement& row) {
        row.reset();
        row.bind(1, entry.seq);
        auto there = row.step();
        if (there && !*there) problem("the samples of {} are missing", name);
        return there;
    }

    /// The number of samples is sealed too.
    [[nodiscard]] Result<void> checkSealedChunk(const Entry& entry, const nlohmann::json& body, Statement& row) {
        const auto number = countOr(body, "stream");
        const auto index = static_cast<std::int64_t>(countOr(body, "index"));
        if (number < 1 || number > streams_.size()) {
            problem("row {} holds samples of stream {}, which is not declared", entry.seq, number);
            return {};
        }
        auto& stream = streams_[number - 1];
        const auto name = fmt::format("chunk {} of stream '{}'", index, stream.name);
        if (index != stream.nextIndex) problem("{} follows chunk {}: samples are missing", name, stream.nextIndex - 1);
        stream.nextIndex = index + 1;
        const auto there = bulkOf(entry, name, row);
        if (!there) return failure(there);
        if (!*there) return {};
        if (row.integer(0) != static_cast<std::int64_t>(number) || row.integer(1) != index || !row.isNull(2))
            problem("{} is filed under stream {}, chunk {}", name, row.integer(0), row.integer(1));
        const std::span<const std::byte> parts[] = {row.blob(3)};
        if (entry.digest != bulkDigest(parts)) problem("the samples of {} were altered: their hash is wrong", name);
        return {};
    }

    [[nodiscard]] Result<void> checkCapture(const Entry& entry, const nlohmann::json& body, Statement& row) {
        if (countOr(body, "trial") > report_.trials) {
            problem("capture {} belongs to trial {}, which is missing", entry.seq, countOr(body, "trial"));
        }
        const auto there = bulkOf(entry, fmt::format("capture {}", entry.seq), row);
        if (!there) return failure(there);
        if (!*there) return {};
        const std::span<const std::byte> parts[] = {row.blob(0)};
        if (entry.digest != bulkDigest(parts)) problem("capture {} was altered: its hash is wrong", entry.seq);
        if (sealed_) return {};
        if (crc32(parts) != countOr(body, "crc32")) problem("capture {} does not match its CRC-32", entry.seq);
        if (auto unpacked = unpackCapture(body, parts[0]); !unpacked) {
            problem("capture {}: {}", entry.seq, unpacked.error().message);
        }
        return {};
    }

    /// Finds samples without a row: somebody added them later.
    [[nodiscard]] Result<void> checkOrphans() {
        for (const char* table : {"chunk", "capture"}) {
            const auto count = database_.number(fmt::format(
                "SELECT count(*) FROM {0}s WHERE seq NOT IN (SELECT seq FROM entries WHERE kind='{0}')", table));
            if (!count) return failure(count);
            if (*count != 0) problem("{} {}s belong to no row", *count, table);
        }
        return {};
    }

    const Database& database_;
    const bool sealed_;
    VerifyReport& report_;
    const std::function<bool()>& stopped_;
    std::vector<StreamSeen> streams_;
    Digest head_{};  // hash of the recording's last row, without annotations
    int annotations_ = 0;
    std::vector<SessionSignature> signatures_;
    std::uint64_t sealedRows_ = 0;
    std::int64_t row_ = 0;  // being checked; 0 before the first
    Problems problems_;
    std::vector<ReadChunk> read_;
    std::size_t readBytes_ = 0;
    // For the other thread, as long as it runs.
    std::vector<ReadChunk> checked_;
    SampleBlock scratch_;
    Problems samples_;    // of the samples
    CommitThread other_;  // the last member, since its thread uses the others
};

constexpr Word<SessionStatus> kSessionStatusWords[] = {{"intact", SessionStatus::Intact},
                                                       {"damaged", SessionStatus::Damaged},
                                                       {"not a session", SessionStatus::NotASession}};
}  // namespace

std::string_view nameOf(SessionStatus status) noexcept { return wordFor(kSessionStatusWords, status); }

bool reportChanged(const VerifyReport& report) {
    return std::ranges::any_of(report.signatures, [](const auto& each) { return each.state == SignedReport::Changed; });
}

Result<VerifyReport> verifySession(const std::filesystem::path& path, const std::function<bool()>& stopped) {
    VerifyReport report;
    const auto source = SessionSource::open(path);
    if (!source) {
        const auto& error = source.error();
        if (error.code != ErrorCode::Unsupported && error.code != ErrorCode::ParseError) return failure(source);
        report.status = error.code == ErrorCode::ParseError ? SessionStatus::Damaged : SessionStatus::NotASession;
        report.problems.push_back(error.message);
        return report;
    }
    Inspection inspection(source->database(), source->sealed(), report, stopped);
    if (auto done = inspection.run(); !done) {
        if (done.error().code != ErrorCode::ParseError) return failure(done);
        inspection.problem("the database is damaged: {}", done.error().message);
    }
    auto wal = path;
    wal += "-wal";
    if (source->hadJournal()) {
        const auto findings = scanWal(wal);
        if (!findings) return failure(findings);
        report.recovered = findings->readableFrames > 0;
        if (findings->headerDamaged) inspection.problem("the journal {} is damaged and cannot be read", wal.string());
        if (findings->lostCommits > 0) {
            inspection.problem("the journal {} is damaged: {} commits behind the damage are lost", wal.string(),
                               findings->lostCommits);
        }
    }
    report.signatures = checkSignatures(path, inspection.signatures());
    for (const auto& signature : report.signatures) report.notes.push_back(sentenceOf(signature));
    if (!report.closed && report.rows > 0) {
        report.notes.push_back(openElsewhere(path)
                                   ? "The session is being recorded by another program."
                                   : "The session ended without closing (crash or power loss), or is still being "
                                     "written.");
    }
    if (report.recovered) {
        report.notes.push_back("Rows were recovered from the journal beside the file; keep both together.");
    }
    inspection.report();
    report.status = report.problems.empty() ? SessionStatus::Intact : SessionStatus::Damaged;
    return report;
}

}  // namespace tacto
