#include "tests/support/Support.h"

#include <cerrno>
#include <cstdlib>
#include <fmt/format.h>
#include <fstream>
#include <system_error>
#include <unistd.h>

namespace tacto::test {

std::filesystem::path sourceDir() { return TACTO_SOURCE_DIR; }

std::optional<std::filesystem::path> sharedData(std::string_view relative) {
    const auto path = sourceDir() / ".." / "shared" / "data" / relative;
    if (!std::filesystem::exists(path)) return std::nullopt;
    return path;
}

ScratchDir::ScratchDir() {
    // The name does not contain the process number: process numbers repeat during a run, and a killed process leaves
    // its folder behind.
    auto path = (std::filesystem::temp_directory_path() / "tactoscope-test-XXXXXX").string();
    if (::mkdtemp(path.data()) == nullptr) throw std::system_error(errno, std::generic_category(), path);
    path_ = path;
}

ScratchDir::~ScratchDir() {
    std::error_code ignored;
    std::filesystem::remove_all(path_, ignored);
}

std::filesystem::path ScratchDir::write(std::string_view name, std::string_view content) const {
    const auto path = path_ / name;
    std::filesystem::create_directories(path.parent_path());
    std::ofstream(path, std::ios::binary) << content;
    std::filesystem::permissions(path, std::filesystem::perms::owner_read | std::filesystem::perms::owner_write);
    return path;
}

OwnSerial::OwnSerial(std::string_view begins) {
    static int made = 0;
    text_ = fmt::format("{}{:0{}}", begins, ::getpid() % 100'000 * 100 + made++ % 100, 10 - begins.size());
}

OwnSerial::~OwnSerial() {
    std::error_code gone;
    for (const auto& claim : std::filesystem::directory_iterator("/run/lock", gone)) {
        if (claim.path().filename().string().find(text_) != std::string::npos) std::filesystem::remove(claim, gone);
    }
}

}  // namespace tacto::test
