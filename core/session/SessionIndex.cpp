#include "core/session/SessionIndex.h"

#include <algorithm>
#include <chrono>
#include <fmt/format.h>
#include <limits>
#include <optional>
#include <sqlite3.h>
#include <sys/stat.h>
#include <unordered_map>

#include "core/base/RecordFields.h"
#include "core/base/WholeFile.h"
#include "core/session/Database.h"
#include "core/session/Digest.h"
#include "core/session/SessionReader.h"

namespace tacto {

namespace {

namespace fs = std::filesystem;

constexpr int kIndexVersion = 1;
/// A file that changed less than this before it was read may change again within the same tick of its file system's
/// clock: its summary is not kept.
constexpr std::int64_t kTick_ns = 50'000'000;

/// Size and time of change of a session and its journal.
struct Stamp {
    std::uintmax_t bytes = 0;
    std::string text;
    std::int64_t newest_ns = 0;
};

std::optional<Stamp> stampOf(const fs::path& session) {
    Stamp stamp;
    auto journal = session;
    journal += "-wal";
    for (const auto* file : {&session, static_cast<const fs::path*>(&journal)}) {
        struct stat found {};
        if (::stat(file->c_str(), &found) != 0) {
            if (file == &session) return std::nullopt;
            continue;
        }
        const auto changed = std::int64_t{found.st_mtim.tv_sec} * 1'000'000'000 + found.st_mtim.tv_nsec;
        stamp.bytes += static_cast<std::uintmax_t>(found.st_size);
        stamp.newest_ns = std::max(stamp.newest_ns, changed);
        stamp.text += fmt::format("{} {} {};", found.st_ino, found.st_size, changed);
    }
    return stamp;
}

bool hasSettled(const Stamp& stamp) {
    const auto now = std::chrono::system_clock::now().time_since_epoch();
    return std::chrono::nanoseconds(now).count() - stamp.newest_ns > kTick_ns;
}

/// Returns the checksum of a row of the index, to notice accidental changes.
std::string checkOf(std::string_view path, std::string_view stamp, std::string_view body) {
    return sha256Hex(fmt::format("{}\n{}\n{}", path, stamp, body));
}

Result<Database> openTable(const fs::path& file) {
    auto database = Database::open(file.string(), SQLITE_OPEN_READWRITE | SQLITE_OPEN_CREATE);
    if (!database) return failure(database);
    // This is safe: the index is only a cache.
    if (auto set = database->execute("PRAGMA synchronous=OFF; PRAGMA journal_mode=MEMORY; PRAGMA busy_timeout=500;");
        !set)
        return failure(set);
    const auto version = database->number("PRAGMA user_version");
    if (!version) return failure(version);
    if (*version != 0 && *version != kIndexVersion) return fail(ErrorCode::ParseError, "another version");
    auto made = database->execute(fmt::format(
        "CREATE TABLE IF NOT EXISTS summaries(path TEXT PRIMARY KEY, stamp TEXT NOT NULL, body TEXT NOT NULL, "
        "checked TEXT NOT NULL) STRICT, WITHOUT ROWID; PRAGMA user_version={}",
        kIndexVersion));
    if (!made) return failure(made);
    return database;
}

/// Opens the index; rebuilds a damaged one. Returns nothing if there can be no index.
std::optional<Database> openIndex(const fs::path& file) {
    std::error_code ignored;
    fs::create_directories(file.parent_path(), ignored);
    auto opened = openTable(file);
    if (!opened && opened.error().code == ErrorCode::ParseError) {
        removeDraft(file);
        opened = openTable(file);
    }
    if (!opened) return std::nullopt;
    return std::move(*opened);
}

struct KnownSummary {
    std::string stamp, body, checked;
};
using Known = std::unordered_map<std::string, KnownSummary>;

/// Errors: ParseError if a later part of the index is damaged.
Result<Known> knownIn(const Database& database) {
    auto rows = database.prepare("SELECT path, stamp, body, checked FROM summaries");
    if (!rows) return failure(rows);
    Known known;
    for (;;) {
        const auto more = rows->step();
        if (!more) return failure(more);
        if (!*more) return known;
        known[std::string(rows->text(0))] = {std::string(rows->text(1)), std::string(rows->text(2)),
                                             std::string(rows->text(3))};
    }
}

void forget(Database& database, const std::string& path) {
    auto remove = database.prepare("DELETE FROM summaries WHERE path=?");
    if (!remove) return;
    remove->bind(1, std::string_view(path));
    static_cast<void>(remove->run());
}

void keep(Database& database, const std::string& path, const Stamp& stamp, const ListedSession& session) {
    if (!session.problem.empty() || !hasSettled(stamp)) return forget(database, path);
    auto insert = database.prepare("INSERT OR REPLACE INTO summaries VALUES(?,?,?,?)");
    if (!insert) return;
    const auto body = toJsonText(session.summary);
    const auto checked = checkOf(path, stamp.text, body);
    insert->bind(1, std::string_view(path));
    insert->bind(2, std::string_view(stamp.text));
    insert->bind(3, std::string_view(body));
    insert->bind(4, std::string_view(checked));
    static_cast<void>(insert->run());  // after an error the session is read again next time
}

ListedSession fromFile(const fs::path& path, const Stamp& stamp) {
    ListedSession session{path, stamp.bytes, {}, {}};
    if (auto summary = summarise(path))
        session.summary = std::move(*summary);
    else
        session.problem = summary.error().message;
    return session;
}

}  // namespace

std::vector<ListedSession> SessionIndex::list(const std::vector<fs::path>& sessions,
                                              const std::function<bool(std::size_t done)>& going) const {
    auto database = openIndex(file_);
    Known known;
    if (database) {
        if (auto read = knownIn(*database)) {
            known = std::move(*read);
        } else {
            database.reset();
            removeDraft(file_);
            database = openIndex(file_);
        }
    }
    if (database) static_cast<void>(database->execute("BEGIN"));
    std::vector<ListedSession> all;
    all.reserve(sessions.size());
    bool whole = true;
    for (const auto& path : sessions) {
        const auto stamp = stampOf(path);
        if (!stamp) continue;
        const auto name = path.string();
        const auto before = known.find(name);
        if (before != known.end()) {
            const auto row = std::move(before->second);
            known.erase(before);
            if (row.stamp == stamp->text && row.checked == checkOf(name, row.stamp, row.body)) {
                if (auto summary = summaryFrom(row.body)) {
                    all.push_back({path, stamp->bytes, std::move(*summary), {}});
                    continue;
                }
            }
        }
        all.push_back(fromFile(path, *stamp));
        if (database) keep(*database, name, *stamp, all.back());
        if (whole = going(all.size()); !whole) break;
    }
    if (database) {
        for (const auto& [name, row] : known)
            if (whole || !fs::exists(name)) forget(*database, name);
        static_cast<void>(database->execute("COMMIT"));
    }
    return all;
}

ListedSession SessionIndex::read(const fs::path& session) const {
    const auto stamp = stampOf(session);
    if (!stamp) return {session, 0, {}, fmt::format("there is no file {}", session.string())};
    auto listed = fromFile(session, *stamp);
    if (auto database = openIndex(file_)) keep(*database, session.string(), *stamp, listed);
    return listed;
}

namespace {

RecordFields<SessionSummary> buildSummaryFields() {
    using S = SessionSummary;
    constexpr AcceptedText any{.mayBeEmpty = true};
    constexpr auto many = std::numeric_limits<std::size_t>::max();
    RecordFields<S> all;
    all.texts({{"wall_start", &S::wallStart}, {"protocol", &S::protocol}, {"verdict", &S::verdict}}, any);
    all.list("devices", &S::devices, textKind(any), 0, many);
    all.text("operator", in(&S::labels, &SessionLabels::operatorName), any);
    all.text("sample", in(&S::labels, &SessionLabels::sample), any);
    all.text("note", in(&S::labels, &SessionLabels::note), any);
    all.list("tags", in(&S::labels, &SessionLabels::tags), textKind(any), 0, many);
    all.number("duration_s", &S::duration_s);
    all.flag("simulated", &S::simulated);
    all.flag("closed", &S::closed);
    all.flag("faulted", &S::faulted);
    return all;
}

const RecordFields<SessionSummary>& summaryFields() { return builtOnce<buildSummaryFields>(); }

}  // namespace

Result<SessionSummary> summarise(const std::filesystem::path& session) {
    const auto reader = SessionReader::open(session);
    if (!reader) return failure(reader);
    const auto verdicts = reader->verdicts();
    if (!verdicts) return failure(verdicts);
    auto labels = reader->labels();
    if (!labels) return failure(labels);
    const auto events = reader->events();
    if (!events) return failure(events);
    const auto& about = reader->about();
    SessionSummary summary;
    summary.wallStart = about.wallStart;
    summary.protocol = about.protocol;
    for (const auto& device : about.devices) summary.devices.push_back(device.name);
    if (!verdicts->empty()) summary.verdict = verdicts->back().verdict;
    summary.labels = std::move(*labels);
    summary.duration_s = toSeconds(reader->lastAt());
    summary.simulated = about.simulated;
    summary.closed = reader->closed();
    summary.faulted = std::ranges::any_of(*events, [](const auto& event) { return event.name == "fault"; });
    return summary;
}

std::string toJsonText(const SessionSummary& summary) { return dumpJson(summaryFields().write(summary)); }

Result<SessionSummary> summaryFrom(std::string_view text) {
    const auto json = parseJson(text, "the summary");
    if (!json) return failure(json);
    auto read = summaryFields().read(*json, RecordPlace{});
    if (!read) return fail(ErrorCode::ParseError, "{}", read.error().message);
    return read;
}

bool openElsewhere(const std::filesystem::path& session) {
    // SQLite holds such a lock as long as a database with a journal of this kind is open.
    return lockHolder(session, "POSIX", LockedBy::Another).has_value();
}

}  // namespace tacto
