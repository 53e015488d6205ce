#include "core/safety/UnitFolders.h"

#include <cstdlib>

namespace tacto {

UnitFolders unitFolders() {
    constexpr const char* kClaims = "/run/lock";
    const char* data = std::getenv("XDG_DATA_HOME");
    if (data != nullptr && *data != '\0') return {std::filesystem::path(data) / "tactoscope" / "units", kClaims};
    const char* home = std::getenv("HOME");
    return {std::filesystem::path(home != nullptr ? home : ".") / ".local" / "share" / "tactoscope" / "units", kClaims};
}

}  // namespace tacto
