// ProgramPath.h - where the programs that belong to this one are: in the same folder.
//
// Thread-safety: pure functions.
#pragma once

#include <filesystem>
#include <string_view>

namespace tacto {

/// The folder of the program that runs; empty where the system does not tell.
[[nodiscard]] inline std::filesystem::path programFolder() {
    std::error_code error;
    return std::filesystem::read_symlink("/proc/self/exe", error).parent_path();
}

/// "tactoscope-watchdog" beside it.
[[nodiscard]] inline std::filesystem::path programBeside(std::string_view name) { return programFolder() / name; }

}  // namespace tacto
