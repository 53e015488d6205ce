#include "core/base/LockHolder.h"

#include <fmt/format.h>
#include <fstream>
#include <string>
#include <sys/stat.h>
#include <unistd.h>

#include "core/base/WholeNumber.h"

namespace tacto {

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

}  // namespace tacto
