// LockHolder.h - which program holds a lock on a file, as the system lists it. Opens nothing: a handle that this
// process closed would drop its own locks on the file (fcntl(2)).
//
// Thread-safety: pure functions of the system's state.
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string_view>

namespace tacto {

enum class LockedBy {
    Any,
    Another  ///< than this process
};

/// The process. `kind`: "FLOCK" (flock(2)) or "POSIX" (fcntl(2)). Nothing where none holds one, and where that cannot
/// be seen.
[[nodiscard]] std::optional<std::int64_t> lockHolder(const std::filesystem::path& file, std::string_view kind,
                                                     LockedBy by = LockedBy::Any);

}  // namespace tacto
