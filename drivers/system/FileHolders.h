// FileHolders.h - which other programs have a device's file open, so that a busy device is reported with the program
// that must be closed, and no device is taken from a program that uses it.
//
// Thread-safety: pure but for reading /proc.
#pragma once

#include <filesystem>
#include <string>
#include <sys/types.h>
#include <vector>

namespace tacto {

struct FileHolder {
    pid_t process = 0;
    std::string name;  ///< the program's name, as ps shows it; 15 characters at most
};

/// Other processes that have `file` open, by process number. Processes of other users are seen by root only, and what
/// is not a character device, or not there, has no holders.
[[nodiscard]] std::vector<FileHolder> holdersOf(const std::filesystem::path& file);

/// "tactoscope-cli (pid 123) and cat (pid 124)"; for none "this program itself or one that this
/// user may not see".
[[nodiscard]] std::string textOf(const std::vector<FileHolder>& holders);

}  // namespace tacto
