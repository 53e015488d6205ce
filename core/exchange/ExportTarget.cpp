#include "core/exchange/ExportTarget.h"

#include <algorithm>
#include <cerrno>
#include <cstdio>
#include <fcntl.h>
#include <random>
#include <sys/stat.h>
#include <system_error>
#include <unistd.h>

#include "core/base/WholeFile.h"

namespace tacto {

namespace {

namespace fs = std::filesystem;

constexpr std::size_t kLongestName = 255;  // bytes, on Linux's file systems
constexpr int kTries = 100;

tl::unexpected<Error> notWritten(const fs::path& path, int reason) {
    return fail(ErrorCode::Io, "{} could not be written: {}", path.string(), std::generic_category().message(reason));
}

/// Cuts `name` to `most` bytes, at a character's border.
std::string cutName(std::string name, std::size_t most) {
    if (name.size() <= most) return name;
    while (most > 0 && (static_cast<unsigned char>(name[most]) & 0xC0U) == 0x80U) --most;
    name.resize(most);
    return name;
}

fs::path privateName(const fs::path& path, std::random_device& random) {
    static constexpr std::string_view kLetters = "abcdefghijklmnopqrstuvwxyz0123456789";
    std::string suffix = ".";
    for (int i = 0; i < 6; ++i) suffix += kLetters[random() % kLetters.size()];
    const auto name = "." + cutName(path.filename().string(), kLongestName - suffix.size() - 1) + suffix;
    return path.parent_path() / name;
}

/// Returns 0, or the system's reason.
int madeExclusively(const fs::path& path, ExportTarget::Kind kind) {
    if (kind == ExportTarget::Kind::Folder) return ::mkdir(path.c_str(), 0777) == 0 ? 0 : errno;
    const int file = ::open(path.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0666);
    if (file < 0) return errno;
    ::close(file);
    return 0;
}

}  // namespace

ExportTarget::ExportTarget(ExportTarget&& other) noexcept
    : path_(std::move(other.path_)), draft_(std::move(other.draft_)), kind_(other.kind_) {
    other.draft_.clear();
}

ExportTarget::~ExportTarget() {
    std::error_code ignored;
    if (!draft_.empty()) fs::remove_all(draft_, ignored);
}

Error ExportTarget::isThere() const {
    return {ErrorCode::InvalidArgument, fmt::format("{} exists already; a new {} is expected", path_.string(),
                                                    kind_ == Kind::Folder ? "folder" : "file")};
}

Result<ExportTarget> ExportTarget::begin(const fs::path& path, Kind kind) {
    auto whole = path;
    if (!whole.has_filename() && whole.has_parent_path()) whole = whole.parent_path();  // "out/" is "out"
    std::error_code error;
    ExportTarget target(whole, {}, kind);
    if (const auto name = whole.filename(); name.empty() || name == "." || name == "..") {
        if (!path.empty()) return tl::unexpected(target.isThere());
        return fail(ErrorCode::InvalidArgument, "the export has no name; the path of a new file or folder is expected");
    }
    if (fs::symlink_status(whole, error).type() != fs::file_type::not_found) {
        if (!error) return tl::unexpected(target.isThere());
        return notWritten(whole, error.value());
    }
    std::random_device random;
    for (int tried = 0; tried < kTries; ++tried) {
        const auto draft = privateName(fs::absolute(whole), random);
        const int reason = madeExclusively(draft, kind);
        if (reason == EEXIST) continue;
        if (reason != 0) return notWritten(whole, reason);
        target.draft_ = draft;
        return target;
    }
    return notWritten(whole, EEXIST);
}

Result<void> ExportTarget::publish() {
    if (kind_ == Kind::Folder) {
        std::error_code error;
        for (fs::recursive_directory_iterator each(draft_, error), end; !error && each != end; each.increment(error)) {
            if (auto synced = namedAs(path_, syncFile(each->path())); !synced) return synced;
        }
        if (error) return notWritten(path_, error.value());
    }
    if (auto synced = namedAs(path_, syncFile(draft_)); !synced) return synced;
    const auto target = fs::absolute(path_);
    if (::renameat2(AT_FDCWD, draft_.c_str(), AT_FDCWD, target.c_str(), RENAME_NOREPLACE) != 0) {
        if (errno == EEXIST || errno == ENOTEMPTY) return tl::unexpected(isThere());
        // A file system without that flag (NFS, some of FUSE) still refuses a second link to an existing name.
        if (errno != EINVAL && errno != ENOSYS) return notWritten(path_, errno);
        if (kind_ == Kind::Folder || ::link(draft_.c_str(), target.c_str()) != 0) {
            if (errno == EEXIST) return tl::unexpected(isThere());
            return fail(ErrorCode::Io,
                        "{} could not be written: its file system cannot rename without replacing; a folder of another "
                        "disk is expected",
                        path_.string());
        }
        ::unlink(draft_.c_str());
    }
    draft_.clear();
    syncFolderOf(target);
    return {};
}

Error ExportTarget::named(Error error) const {
    for (const auto& drawn : {draft_.string(), draft_.filename().string()}) {
        if (const auto at = error.message.find(drawn); !drawn.empty() && at != std::string::npos)
            error.message.replace(at, drawn.size(),
                                  drawn == draft_.string() ? path_.string() : path_.filename().string());
    }
    return error;
}

}  // namespace tacto
