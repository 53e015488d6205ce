#include "core/safety/LockedFile.h"

#include <cerrno>
#include <fcntl.h>
#include <fmt/format.h>
#include <fstream>
#include <sys/file.h>
#include <sys/mman.h>
#include <sys/stat.h>
#include <unistd.h>
#include <utility>

namespace tacto {

tl::expected<LockedFile, LockedFile::Refused> LockedFile::open(const std::filesystem::path& path, std::size_t size,
                                                               ::mode_t mode) {
    int file = ::open(path.c_str(), O_RDWR | O_CREAT | O_EXCL | O_CLOEXEC, mode);
    const bool made = file >= 0;
    // Open without O_CREAT: in a folder for everybody the kernel refuses O_CREAT for another account's file. O_NOFOLLOW
    // and O_NONBLOCK: a link would lead to a file with another purpose, and a pipe would block.
    if (!made && errno == EEXIST) file = ::open(path.c_str(), O_RDWR | O_CLOEXEC | O_NOFOLLOW | O_NONBLOCK);
    const auto refused = [&](Refusal why) {
        const int error = errno;
        if (made && why != Refusal::Held) ::unlink(path.c_str());
        if (file >= 0) ::close(file);
        return tl::unexpected(Refused{why, error});
    };
    if (file < 0) return refused(errno == ELOOP ? Refusal::NotItsOwn : Refusal::Failed);
    if (::flock(file, LOCK_EX | LOCK_NB) != 0) {
        return refused(errno == EWOULDBLOCK ? Refusal::Held : Refusal::Failed);
    }
    struct stat about {};
    if (::fstat(file, &about) != 0) return refused(Refusal::Failed);
    if (!S_ISREG(about.st_mode) || about.st_nlink != 1) return refused(Refusal::NotItsOwn);
    if (made && ::fchmod(file, mode) != 0) return refused(Refusal::Failed);  // sets the mode whatever the umask says
    // Allocate now, so that a full disk is found here and not in the middle of a run.
    if (const int error = ::posix_fallocate(file, 0, static_cast<::off_t>(size)); error != 0) {
        errno = error;
        return refused(Refusal::Failed);
    }
    void* at = ::mmap(nullptr, size, PROT_READ | PROT_WRITE, MAP_SHARED | MAP_POPULATE, file, 0);
    if (at == MAP_FAILED) return refused(Refusal::Failed);
    return LockedFile(file, at, size, made, made || about.st_size == static_cast<::off_t>(size));
}

LockedFile::LockedFile(LockedFile&& other) noexcept
    : file_(std::exchange(other.file_, -1)),
      content_(std::exchange(other.content_, nullptr)),
      size_(other.size_),
      made_(other.made_),
      whole_(other.whole_) {}

LockedFile::~LockedFile() {
    if (content_ != nullptr) ::munmap(content_, size_);
    if (file_ >= 0) ::close(file_);  // closing releases the lock, too
}

std::uint64_t checksumOf(const void* data, std::size_t size) noexcept {
    std::uint64_t sum = 0xcbf29ce484222325;
    for (const auto *at = static_cast<const unsigned char*>(data), *end = at + size; at != end; ++at)
        sum = (sum ^ *at) * 0x100000001b3;
    return sum;
}

std::string programOf(std::int64_t process) {
    // The system's short name is cut at 15 characters; the file name is complete, if it may be read.
    std::string program;
    std::ifstream in(fmt::format("/proc/{}/comm", process));
    std::getline(in, program);
    std::error_code error;
    const auto file = std::filesystem::read_symlink(fmt::format("/proc/{}/exe", process), error).filename().string();
    if (!program.empty() && file.starts_with(program)) program = file;
    return fmt::format("{} (process {})", program.empty() ? "a program" : program, process);
}

}  // namespace tacto
