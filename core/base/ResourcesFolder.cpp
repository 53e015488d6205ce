#include "core/base/ResourcesFolder.h"

#include <cstdlib>
#include <fmt/ranges.h>
#include <string>
#include <vector>

#include "core/base/ProgramStart.h"

#ifndef TACTOSCOPE_INSTALLED_RESOURCES
#define TACTOSCOPE_INSTALLED_RESOURCES "/usr/share/tactoscope"
#endif

namespace tacto {

namespace fs = std::filesystem;

Result<fs::path> resourcesFolder() {
    std::vector<std::string> tried;
    const auto usable = [&tried](const fs::path& folder) {
        std::error_code failed;
        if (!folder.empty()) tried.push_back(folder.string());
        return !folder.empty() && fs::is_directory(folder / "protocols", failed);
    };
    if (const char* const set = std::getenv("TACTOSCOPE_RESOURCES"); set != nullptr && *set != '\0') {
        // A folder that the user chose explicitly is not silently replaced.
        if (usable(set)) return fs::path(set);
        return fail(ErrorCode::NotFound, "TACTOSCOPE_RESOURCES is {}, a folder with protocols/ is expected", set);
    }
    const fs::path start = programFolder();
    if (usable(start / ".." / "share" / "tactoscope"))
        return (start / ".." / "share" / "tactoscope").lexically_normal();
    fs::path folder = start;
    for (int up = 0; up < 5 && !folder.empty() && folder != folder.root_path(); ++up, folder = folder.parent_path()) {
        if (usable(folder / "resources")) return folder / "resources";
    }
    if (usable(TACTOSCOPE_INSTALLED_RESOURCES)) return fs::path(TACTOSCOPE_INSTALLED_RESOURCES);
    return fail(ErrorCode::NotFound,
                "the program's resources were not found in {}; install it anew, or set TACTOSCOPE_RESOURCES to "
                "their folder",
                fmt::join(tried, ", "));
}

}  // namespace tacto
