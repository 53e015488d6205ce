// FileHolders.h - finds which other programs have a device's file open, so that an error can name the program to close,
// and no device is taken from a program that uses it.
//
// Thread-safety: any thread; reads /proc.
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

/// Returns the other processes that have `file` open, by process number. Only root sees other users' processes. A
/// `file` that is missing or no character device has no holders.
[[nodiscard]] std::vector<FileHolder> holdersOf(const std::filesystem::path& file);

/// Returns "tactoscope-cli (pid 123) and cat (pid 124)"; without holders "this program itself or one that this user may
/// not see".
[[nodiscard]] std::string textOf(const std::vector<FileHolder>& holders);

}  // namespace tacto
