// ProgramPath.h - where the programs that belong to this one are: in the same folder.
//
// Thread-safety: pure function.
#pragma once

#include <filesystem>
#include <string_view>

namespace tacto {

/// "tactoscope-watchdog" beside the program that runs.
[[nodiscard]] inline std::filesystem::path programBeside(std::string_view name) {
    std::error_code error;
    return std::filesystem::read_symlink("/proc/self/exe", error).parent_path() / name;
}

}  // namespace tacto
