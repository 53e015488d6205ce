#include "core/session/SessionSource.h"

#include <array>
#include <fstream>
#include <span>
#include <sqlite3.h>
#include <unistd.h>

#include "core/session/Database.h"
#include "core/session/Schema.h"

namespace tacto {

namespace {

std::filesystem::path beside(std::filesystem::path path, const char* suffix) { return path += suffix; }

std::string uriOf(const std::filesystem::path& path, const char* query) {
    std::string uri = "file:";
    for (const char c : std::filesystem::absolute(path).string()) {
        if (c == '?' || c == '#' || c == '%') {
            uri += fmt::format("%{:02x}", static_cast<unsigned char>(c));
        } else {
            uri += c;
        }
    }
    return uri + "?" + query;
}

/// Whether the first page of a file that SQLite cannot open has the marks of SQLite and of Tactoscope.
bool looksLikeSession(const std::filesystem::path& path) {
    std::array<char, 72> head{};
    const auto file = DatabaseFile::open(path);
    if (!file || !file->read(0, std::as_writable_bytes(std::span(head)))) return false;
    std::uint32_t id = 0;
    for (std::size_t i = 68; i < 72; ++i) id = id << 8 | static_cast<unsigned char>(head[i]);
    return std::string_view(head.data(), 15) == "SQLite format 3" && id == kApplicationId;
}

/// What changes when another program's writer moves rows from the journal to the file: the file's time and size, and
/// the first bytes of a journal that starts again.
struct Written {
    std::filesystem::file_time_type at{};
    std::uintmax_t size = 0;
    std::array<char, 32> journal{};
    bool operator==(const Written&) const = default;
};

Written writtenNow(const std::filesystem::path& path) {
    std::error_code ignored;
    Written now;
    now.at = std::filesystem::last_write_time(path, ignored);
    now.size = std::filesystem::file_size(path, ignored);
    std::ifstream journal(beside(path, "-wal"), std::ios::binary);  // journals are never locked
    journal.read(now.journal.data(), now.journal.size());
    return now;
}

/// Copies the file and its journal as they were at one moment.
Result<void> copyBoth(const std::filesystem::path& path, const std::filesystem::path& copy) {
    constexpr int kTries = 5;
    for (int i = 0; i < kTries; ++i) {
        const auto before = writtenNow(path);
        if (auto copied = copyDatabaseFile(path, copy); !copied) return copied;
        std::error_code error;
        std::filesystem::remove(beside(copy, "-wal"), error);
        if (std::filesystem::exists(beside(path, "-wal"), error))
            std::filesystem::copy_file(beside(path, "-wal"), beside(copy, "-wal"), error);
        if (error) return fail(ErrorCode::Io, "{}", error.message());
        if (writtenNow(path) == before) return {};
    }
    return fail(ErrorCode::Io, "another program is writing it");
}

tl::unexpected<Error> refuse(const std::filesystem::path& path, std::string_view reason) {
    return fail(ErrorCode::Unsupported, "{} is not a Tactoscope session: {}", path.string(), reason);
}

}  // namespace

SessionSource::PrivateFolder::PrivateFolder(std::filesystem::path made) : path(std::move(made)) {}
SessionSource::PrivateFolder::~PrivateFolder() {
    std::error_code ignored;
    std::filesystem::remove_all(path, ignored);
}

Result<SessionSource> SessionSource::openInPlace(const std::filesystem::path& path, const char* mode) {
    auto database = Database::open(uriOf(path, mode), SQLITE_OPEN_READONLY | SQLITE_OPEN_URI);
    if (!database) return failure(database);
    if (auto set = database->execute("PRAGMA busy_timeout=2000"); !set) return failure(set);
    // This first read fails if the file is damaged or its journal cannot be opened.
    if (auto rows = database->number("SELECT count(*) FROM sqlite_schema"); !rows) return failure(rows);
    return SessionSource(std::move(*database));
}

Result<SessionSource> SessionSource::openCopy(const std::filesystem::path& path) {
    std::error_code error;
    std::string pattern = (std::filesystem::temp_directory_path(error) / "tactoscope-read-XXXXXX").string();
    if (error || ::mkdtemp(pattern.data()) == nullptr) {
        return fail(ErrorCode::Io, "no temporary folder for reading {}", path.string());
    }
    const auto folder = std::make_shared<PrivateFolder>(pattern);
    const auto copy = folder->path / "session.tacto";
    if (auto copied = copyBoth(path, copy); !copied)
        return fail(ErrorCode::Io, "{} cannot be copied for reading: {}", path.string(), copied.error().message);
    auto database = Database::open(copy.string(), SQLITE_OPEN_READWRITE);
    if (!database) return failure(database);
    if (auto rows = database->number("SELECT count(*) FROM sqlite_schema"); !rows) return failure(rows);
    SessionSource source(std::move(*database));
    source.copy_ = folder;
    return source;
}

Result<SessionSource> SessionSource::open(const std::filesystem::path& path) {
    std::error_code error;
    if (std::filesystem::symlink_status(path, error).type() == std::filesystem::file_type::not_found)
        return fail(ErrorCode::NotFound, "there is no file {}", path.string());
    if (!std::filesystem::exists(path, error)) {
        return fail(ErrorCode::Io, "{} cannot be read: {}", path.string(),
                    error ? error.message() : "it is a link that leads nowhere");
    }
    if (!std::filesystem::is_regular_file(path, error)) return refuse(path, "it is not a file");
    if (std::filesystem::file_size(path, error) == 0) return refuse(path, "it is empty");

    const bool journal = std::filesystem::exists(beside(path, "-wal"), error);
    const bool index = std::filesystem::exists(beside(path, "-shm"), error);
    auto source = !journal ? openInPlace(path, "immutable=1") : index ? openInPlace(path, "mode=ro") : openCopy(path);
    if (!source && source.error().code == ErrorCode::Io && journal && index) source = openCopy(path);
    if (!source) {
        if (source.error().code != ErrorCode::ParseError) {
            return fail(ErrorCode::Io, "{} cannot be read: {}", path.string(), source.error().message);
        }
        if (!looksLikeSession(path)) return refuse(path, source.error().message);
        return fail(ErrorCode::ParseError, "{} is damaged: {}", path.string(), source.error().message);
    }

    const auto id = source->database().number("PRAGMA application_id");
    if (!id) return failure(id);
    if (static_cast<std::uint32_t>(*id) != kApplicationId) {
        return refuse(path, fmt::format("it is a database of another program (application id {})", *id));
    }
    const auto version = source->database().number("PRAGMA user_version");
    if (!version) return failure(version);
    if (*version < kSchemaVersion || *version > kNewestVersion) {
        return fail(ErrorCode::Unsupported, "{} cannot be read: it has session format {}, {}", path.string(), *version,
                    *version < kSchemaVersion
                        ? "which no version of Tactoscope has written"
                        : fmt::format("made by a newer Tactoscope; this program reads up to {}", kNewestVersion));
    }
    source->sealed_ = *version == kSealedVersion;
    source->hadJournal_ = journal && std::filesystem::file_size(beside(path, "-wal"), error) > 32;
    return source;
}

}  // namespace tacto
