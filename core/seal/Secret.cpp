#include "core/seal/Secret.h"

#include <cerrno>
#include <cstring>
#include <fcntl.h>
#include <new>
#include <sodium.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <unistd.h>
#include <utility>

namespace tacto {

namespace {

/// Switches core dumps off, since they would contain every key, and hides memory from this account's other processes.
void startWithoutCoreDumps() noexcept {
    static const bool started = [] {
        const ::rlimit none{0, 0};
        ::setrlimit(RLIMIT_CORE, &none);
        ::prctl(PR_SET_DUMPABLE, 0, 0, 0, 0);
        return sodium_init() >= 0;
    }();
    static_cast<void>(started);
}

}  // namespace

Secret::Secret(std::size_t size) : size_(size) {
    startWithoutCoreDumps();
    data_ = static_cast<std::byte*>(sodium_malloc(size));
    if (data_ == nullptr) throw std::bad_alloc();
    std::memset(data_, 0, size);
}

Secret::Secret(std::span<const std::byte> bytes) : Secret(bytes.size()) {
    if (!bytes.empty()) std::memcpy(data_, bytes.data(), bytes.size());
}

Secret::~Secret() {
    if (data_ != nullptr) sodium_free(data_);  // also wipes the memory
}

Secret::Secret(Secret&& other) noexcept
    : data_(std::exchange(other.data_, nullptr)), size_(std::exchange(other.size_, 0)) {}

Secret& Secret::operator=(Secret&& other) noexcept {
    std::swap(data_, other.data_);
    std::swap(size_, other.size_);
    return *this;
}

Secret Secret::random(std::size_t size) {
    Secret out(size);
    randombytes_buf(out.data_, size);
    return out;
}

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
