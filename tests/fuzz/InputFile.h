// InputFile.h - writes an input to a file, for readers that take a path.
//
// Thread-safety: none; a target has one thread.
#pragma once

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <span>
#include <string>
#include <unistd.h>

namespace tacto::fuzz {

/// Returns a folder of this process, created at the first call and left for the system to delete.
inline const std::filesystem::path& scratchFolder() {
    static const auto folder = [] {
        auto made = std::filesystem::temp_directory_path() / ("tactoscope-fuzz-" + std::to_string(getpid()));
        std::filesystem::create_directories(made);
        return made;
    }();
    return folder;
}

/// Writes `bytes` to the file `name` in the scratch folder, accessible to its owner only; replaces an older file.
inline std::filesystem::path inputFile(const char* name, std::span<const std::uint8_t> bytes) {
    const auto path = scratchFolder() / name;
    std::ofstream file(path, std::ios::binary | std::ios::trunc);
    file.write(reinterpret_cast<const char*>(bytes.data()), static_cast<std::streamsize>(bytes.size()));
    if (!file.flush()) std::abort();
    std::filesystem::permissions(path, std::filesystem::perms::owner_read | std::filesystem::perms::owner_write);
    return path;
}

}  // namespace tacto::fuzz
