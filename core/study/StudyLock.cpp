#include "core/study/StudyLock.h"

#include <cerrno>
#include <cstring>
#include <fcntl.h>
#include <sys/file.h>

#include "core/base/WholeFile.h"

namespace tacto {

namespace fs = std::filesystem;

Result<StudyLock> StudyLock::take(const StudyFiles& files, const fs::path& besideKeys) {
    constexpr std::size_t kLockBytes = 1;
    const auto isOpen = [&](const fs::path& held) {
        const auto holder = lockHolder(held, "FLOCK");
        return fail(ErrorCode::Io, "{} in {} is open in {}; end that first. Nothing was changed",
                    held == besideKeys ? "a copy of the study" : "the study", files.folder.string(),
                    holder ? programOf(*holder) : "another program");
    };
    const int folder = ::open(files.folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
    const auto closed = [folder](tl::unexpected<Error> error) {
        if (folder >= 0) ::close(folder);
        return error;
    };
    if (folder >= 0 && ::flock(folder, LOCK_EX | LOCK_NB) != 0 && errno == EWOULDBLOCK)
        return closed(isOpen(files.folder));
    const auto refused = [&](const fs::path& file, const LockedFile::Refused& why) {
        if (why.why == LockedFile::Refusal::Held) return closed(isOpen(file));
        const bool failed = why.why == LockedFile::Refusal::Failed;
        return closed(fail(ErrorCode::Io,
                           "the study in {} cannot be opened for changes: its lock {} cannot be taken: {}",
                           files.folder.string(), file.string(),
                           failed ? std::strerror(why.error) : "it is a link, a pipe or has a second name"));
    };
    auto locked = LockedFile::open(files.lock(), kLockBytes, 0600);
    if (!locked) return refused(files.lock(), locked.error());
    std::error_code error;
    if (besideKeys.empty() || !fs::is_directory(besideKeys.parent_path(), error))
        return StudyLock(folder, std::move(*locked), std::nullopt);
    auto keys = LockedFile::open(besideKeys, kLockBytes, 0600);
    if (!keys) return refused(besideKeys, keys.error());
    return StudyLock(folder, std::move(*locked), std::move(*keys));
}

}  // namespace tacto
