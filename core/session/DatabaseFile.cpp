#include "core/session/DatabaseFile.h"

#include <algorithm>
#include <sqlite3.h>
#include <vector>

#include "core/base/WholeFile.h"

namespace tacto {

namespace {
constexpr std::size_t kBlock = 1 << 20;
}

struct DatabaseFile::State {
    explicit State(const std::filesystem::path& path)
        : name(sqlite3_create_filename(std::filesystem::absolute(path).c_str(), "", "", 0, nullptr)) {}
    ~State() {
        if (file() != nullptr && file()->pMethods != nullptr) static_cast<void>(file()->pMethods->xClose(file()));
        sqlite3_free_filename(name);  // SQLite's layer keeps it until then
    }
    State(const State&) = delete;
    State& operator=(const State&) = delete;
    [[nodiscard]] sqlite3_file* file() noexcept { return reinterpret_cast<sqlite3_file*>(room.data()); }

    sqlite3_filename name;
    std::vector<std::max_align_t> room;  // for a file of the layer, whose size it says
};

Result<DatabaseFile> DatabaseFile::open(const std::filesystem::path& path) {
    sqlite3_initialize();
    auto* layer = sqlite3_vfs_find(nullptr);
    auto state = std::make_shared<State>(path);
    if (layer == nullptr || state->name == nullptr) return fail(ErrorCode::Io, "{} cannot be opened", path.string());
    state->room.resize((static_cast<std::size_t>(layer->szOsFile) + sizeof(std::max_align_t) - 1) /
                       sizeof(std::max_align_t));
    const int code =
        layer->xOpen(layer, state->name, state->file(), SQLITE_OPEN_READONLY | SQLITE_OPEN_MAIN_DB, nullptr);
    if (code != SQLITE_OK) return fail(ErrorCode::Io, "{} cannot be opened: {}", path.string(), sqlite3_errstr(code));
    return DatabaseFile(std::move(state));
}

Result<std::int64_t> DatabaseFile::size() const {
    sqlite3_int64 bytes = 0;
    const int code = state_->file()->pMethods->xFileSize(state_->file(), &bytes);
    if (code != SQLITE_OK) return fail(ErrorCode::Io, "{}: {}", state_->name, sqlite3_errstr(code));
    return bytes;
}

Result<void> DatabaseFile::read(std::int64_t at, std::span<std::byte> bytes) const {
    const int code = state_->file()->pMethods->xRead(state_->file(), bytes.data(), static_cast<int>(bytes.size()), at);
    if (code != SQLITE_OK) return fail(ErrorCode::Io, "{}: {}", state_->name, sqlite3_errstr(code));
    return {};
}

Result<void> copyDatabaseFile(const std::filesystem::path& from, const std::filesystem::path& to) {
    const auto file = DatabaseFile::open(from);
    if (!file) return failure(file);
    const auto size = file->size();
    if (!size) return failure(size);
    auto out = FileOut::create(to);
    if (!out) return failure(out);
    std::vector<std::byte> block(kBlock);
    for (std::int64_t at = 0; at < *size;) {
        const auto next = std::span(block).first(std::min(kBlock, static_cast<std::size_t>(*size - at)));
        if (auto done = file->read(at, next); !done) return done;
        if (auto done = out->write({reinterpret_cast<const char*>(next.data()), next.size()}); !done) return done;
        at += static_cast<std::int64_t>(next.size());
    }
    return {};
}

}  // namespace tacto
