#include "drivers/system/FileHolders.h"

#include <algorithm>
#include <fmt/format.h>
#include <fstream>
#include <optional>
#include <sys/stat.h>
#include <unistd.h>

#include "core/base/LocaleFreeText.h"

namespace tacto {

namespace {

namespace fs = std::filesystem;

/// True if both are the same file, or nodes of the same device.
bool isSame(const struct stat& a, const struct stat& b) {
    if (!S_ISCHR(a.st_mode) || !S_ISCHR(b.st_mode)) return false;
    return (a.st_dev == b.st_dev && a.st_ino == b.st_ino) || a.st_rdev == b.st_rdev;
}

std::optional<pid_t> processOf(const fs::path& folder) { return parseWhole<pid_t>(folder.filename().string()); }

bool hasOpen(const fs::path& process, const struct stat& wanted) {
    std::error_code error;
    for (fs::directory_iterator at(process / "fd", error), end; !error && at != end; at.increment(error)) {
        struct stat found {};
        if (::stat(at->path().c_str(), &found) == 0 && isSame(found, wanted)) return true;
    }
    return false;
}

std::string nameOf(const fs::path& process) {
    std::ifstream file(process / "comm");
    std::string name;
    std::getline(file, name);
    std::ranges::replace_if(
        name, [](char c) { return c < ' ' || c > '~'; }, '?');
    return name.empty() ? "a program" : name;
}

}  // namespace

std::vector<FileHolder> holdersOf(const fs::path& file) {
    std::vector<FileHolder> found;
    struct stat wanted {};
    if (::stat(file.c_str(), &wanted) != 0) return found;
    std::error_code error;
    for (fs::directory_iterator at("/proc", error), end; !error && at != end; at.increment(error)) {
        const auto process = processOf(at->path());
        if (!process || *process == getpid() || !hasOpen(at->path(), wanted)) continue;
        found.push_back({*process, nameOf(at->path())});
    }
    std::ranges::sort(found, {}, &FileHolder::process);
    return found;
}

std::string textOf(const std::vector<FileHolder>& holders) {
    std::string text;
    for (const auto& holder : holders) {
        text += fmt::format("{}{} (pid {})", text.empty() ? "" : " and ", holder.name, holder.process);
    }
    return text.empty() ? "this program itself or one that this user may not see" : text;
}

}  // namespace tacto
