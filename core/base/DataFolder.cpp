#include "core/base/DataFolder.h"

#include <cstdlib>

namespace tacto {

std::filesystem::path dataFolder() {
    const char* data = std::getenv("XDG_DATA_HOME");
    if (const std::filesystem::path set(data != nullptr ? data : ""); set.is_absolute()) return set / "tactoscope";
    const char* home = std::getenv("HOME");
    return std::filesystem::path(home != nullptr && *home != '\0' ? home : ".") / ".local" / "share" / "tactoscope";
}

}  // namespace tacto
