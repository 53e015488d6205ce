#include "tests/support/Support.h"

#include <atomic>
#include <fstream>
#include <unistd.h>

namespace tacto::test {

std::filesystem::path sourceDir() { return TACTO_SOURCE_DIR; }

std::optional<std::filesystem::path> sharedData(std::string_view relative) {
    const auto path = sourceDir() / ".." / "shared" / "data" / relative;
    if (!std::filesystem::exists(path)) return std::nullopt;
    return path;
}

ScratchDir::ScratchDir() {
    static std::atomic<int> count{0};
    path_ = std::filesystem::temp_directory_path() /
            ("tactoscope-test-" + std::to_string(getpid()) + "-" + std::to_string(++count));
    std::filesystem::create_directories(path_);
}

ScratchDir::~ScratchDir() {
    std::error_code ignored;
    std::filesystem::remove_all(path_, ignored);
}

std::filesystem::path ScratchDir::write(std::string_view name, std::string_view content) const {
    const auto path = path_ / name;
    std::filesystem::create_directories(path.parent_path());
    std::ofstream(path, std::ios::binary) << content;
    return path;
}

void settle(const std::filesystem::path& folder) {
    std::filesystem::create_directories(folder);
    std::filesystem::last_write_time(folder, std::filesystem::file_time_type::clock::now() - std::chrono::hours(1));
}

}  // namespace tacto::test
