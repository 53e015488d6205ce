#include "core/seal/OwnFile.h"

#include <cerrno>
#include <cstring>
#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

namespace tacto {

namespace {

constexpr ::mode_t kOthersAny = 077, kOthersWrite = 022, kPermissions = 07777;

Result<void> ownOf(const struct stat& about, const std::filesystem::path& path, std::string_view what,
                   ::mode_t forbidden, ::mode_t expected) {
    if (about.st_uid != ::geteuid() && about.st_uid != 0) {
        return fail(ErrorCode::NotFound, "{} {} belongs to user {}, and you are user {}; one of your own is expected",
                    what, path.string(), about.st_uid, ::geteuid());
    }
    if ((about.st_mode & forbidden) == 0) return {};
    return fail(ErrorCode::NotFound,
                "{} {} is open to other users (mode {:04o}); mode {:04o} is expected: chmod {:o} {}", what,
                path.string(), about.st_mode & kPermissions, expected, expected, path.string());
}

}  // namespace

Result<void> isOwnFile(int descriptor, const std::filesystem::path& file, std::string_view what) {
    struct stat about {};
    if (::fstat(descriptor, &about) != 0)
        return fail(ErrorCode::NotFound, "{} {} cannot be read: {}", what, file.string(), std::strerror(errno));
    if (S_ISCHR(about.st_mode)) return {};
    return ownOf(about, file, what, kOthersAny, 0600);
}

Result<void> isOwnFile(const std::filesystem::path& file, std::string_view what) {
    struct stat about {};
    if (::stat(file.c_str(), &about) != 0)
        return fail(ErrorCode::NotFound, "{} {} cannot be read: {}", what, file.string(), std::strerror(errno));
    return ownOf(about, file, what, kOthersAny, 0600);
}

Result<void> isOwnFolder(const std::filesystem::path& folder, std::string_view what) {
    struct stat about {};
    if (::stat(folder.c_str(), &about) != 0)
        return fail(ErrorCode::NotFound, "{} {} cannot be read: {}", what, folder.string(), std::strerror(errno));
    return ownOf(about, folder, what, kOthersWrite, 0700);
}

}  // namespace tacto
