#include "core/session/Durable.h"

#include <cerrno>
#include <cstring>
#include <fcntl.h>
#include <unistd.h>

namespace tacto {

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
