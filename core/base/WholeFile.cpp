#include "core/base/WholeFile.h"

#include <algorithm>
#include <atomic>
#include <cerrno>
#include <cstring>
#include <fcntl.h>
#include <fmt/format.h>
#include <fstream>
#include <string>
#include <sys/stat.h>
#include <system_error>
#include <unistd.h>
#include <utility>

#include "core/base/LocaleFreeText.h"

namespace tacto {

namespace {

namespace fs = std::filesystem;

tl::unexpected<Error> because(int reason) { return fail(ErrorCode::Io, "{}", std::generic_category().message(reason)); }

std::string draftsOf(int owner) { return fmt::format(".tactoscope-{}-", owner); }

fs::path folderOf(const fs::path& path) { return path.has_parent_path() ? path.parent_path() : fs::path("."); }

/// Follows links from `path` to the last file, existing or not. stat() has already followed them, so there is no loop.
fs::path behindLinks(fs::path path) {
    std::error_code error;
    while (fs::is_symlink(fs::symlink_status(path, error))) {
        const auto next = fs::read_symlink(path, error);
        path = next.is_absolute() ? next : folderOf(path) / next;
    }
    return path;
}

/// Removes the draft unless it has replaced the file.
struct Draft {
    fs::path path;
    bool kept = false;
    explicit Draft(fs::path draft) : path(std::move(draft)) {}
    ~Draft() {
        std::error_code ignored;
        if (!kept) fs::remove(path, ignored);
    }
    Draft(const Draft&) = delete;
    Draft& operator=(const Draft&) = delete;
};

/// Creates an empty file next to `path`, with the permissions of `path` if that exists.
Result<fs::path> draftFor(const fs::path& path, const struct stat* before) {
    constexpr int kTries = 100;  // a killed process with the same number may have left drafts
    for (int i = 0; i < kTries; ++i) {
        auto draft = draftBeside(path);
        const int file = ::open(draft.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0666);
        if (file < 0 && errno == EEXIST) continue;
        if (file < 0) return because(errno);
        if (before != nullptr) static_cast<void>(::fchmod(file, before->st_mode & 07777U));
        ::close(file);
        return draft;
    }
    return because(EEXIST);
}

Result<void> syncedFile(const fs::path& path) {
    const int file = ::open(path.c_str(), O_RDONLY | O_CLOEXEC);
    if (file < 0) return because(errno);
    const int reason = ::fsync(file) == 0 ? 0 : errno;
    ::close(file);
    if (reason != 0) return because(reason);
    return {};
}

}  // namespace

fs::path draftBeside(const fs::path& path) {
    static std::atomic<unsigned> count{0};
    return folderOf(path) / fmt::format("{}{}", draftsOf(::getpid()), ++count);
}

void removeDraftsOf(int owner, const fs::path& path) {
    std::error_code ignored;
    for (const auto& entry : fs::directory_iterator(folderOf(path), ignored)) {
        if (entry.path().filename().string().starts_with(draftsOf(owner))) fs::remove(entry.path(), ignored);
    }
}

Result<FileOut> FileOut::create(const fs::path& path) {
    const int file = ::open(path.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, 0666);
    if (file < 0) return because(errno);
    return FileOut(file);
}

FileOut::FileOut(FileOut&& other) noexcept : file_(std::exchange(other.file_, -1)) {}

FileOut::~FileOut() {
    if (file_ >= 0) ::close(file_);
}

Result<void> FileOut::write(std::string_view text) {
    while (!text.empty()) {
        // A full disk first takes part of the text; only the next write returns the reason.
        const auto written = ::write(file_, text.data(), text.size());
        if (written < 0 && errno == EINTR) continue;
        if (written < 0) return because(errno);
        text.remove_prefix(static_cast<std::size_t>(written));
    }
    return {};
}

Result<void> replaceWholeFile(const fs::path& path, const std::function<Result<void>(const fs::path& draft)>& write) {
    struct stat before {};
    const bool isThere = ::stat(path.c_str(), &before) == 0;
    if (!isThere && errno != ENOENT) return because(errno);
    if (isThere && S_ISDIR(before.st_mode)) return because(EISDIR);
    if (isThere && ::access(path.c_str(), W_OK) != 0) return because(errno);
    if (isThere && !S_ISREG(before.st_mode)) return write(path);
    const auto target = behindLinks(path);
    const auto made = draftFor(target, isThere ? &before : nullptr);
    if (!made) return failure(made);
    Draft draft(*made);
    if (auto written = write(draft.path); !written) return written;
    if (auto synced = syncedFile(draft.path); !synced) return synced;
    if (::rename(draft.path.c_str(), target.c_str()) != 0) return because(errno);
    draft.kept = true;
    return {};
}

Result<void> writeWholeFile(const fs::path& path, std::string_view content) {
    return replaceWholeFile(path, [&](const fs::path& draft) -> Result<void> {
        auto file = FileOut::create(draft);
        return file ? file->write(content) : failure(file);
    });
}

Result<void> namedAs(const fs::path& path, Result<void> written) {
    if (written || written.error().code != ErrorCode::Io) return written;
    return fail(ErrorCode::Io, "{} could not be written: {}", path.string(), written.error().message);
}

std::optional<std::int64_t> lockHolder(const std::filesystem::path& file, std::string_view kind, LockedBy by) {
    struct stat about {};
    if (::stat(file.c_str(), &about) != 0) return std::nullopt;
    std::ifstream locks("/proc/locks");
    const auto inode = fmt::format(":{}", about.st_ino);
    for (std::string number, held, mode, access, process, place, rest;
         locks >> number >> held >> mode >> access >> process >> place; std::getline(locks, rest)) {
        const bool isHere = held == kind && place.ends_with(inode);
        const auto id = isHere ? parseWhole<std::int64_t>(process) : std::nullopt;
        if (id && *id > 0 && (by == LockedBy::Any || *id != ::getpid())) return id;
    }
    return std::nullopt;
}

namespace {

bool synced(const std::filesystem::path& path, int kind) noexcept {
    const int handle = ::open(path.c_str(), kind | O_RDONLY | O_CLOEXEC);
    if (handle < 0) return false;
    const bool done = ::fsync(handle) == 0;
    ::close(handle);
    return done;
}

}  // namespace

Result<void> syncFile(const std::filesystem::path& file) {
    if (!synced(file, 0)) return fail(ErrorCode::Io, "{}", std::strerror(errno));
    return {};
}

void syncFolderOf(const std::filesystem::path& file) noexcept {
    static_cast<void>(synced(file.has_parent_path() ? file.parent_path() : std::filesystem::path("."), O_DIRECTORY));
}

void removeDraft(const std::filesystem::path& draft) {
    std::error_code ignored;
    for (const char* suffix : {"", "-wal", "-shm", "-journal"}) {
        auto part = draft;
        std::filesystem::remove(part += suffix, ignored);
    }
}

}  // namespace tacto
