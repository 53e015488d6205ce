// ProgramStart.h - what each of our programs does first: it checks its folders, arguments and standard streams.
//
// Thread-safety: call once, in main(), before any thread is started.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>

namespace tacto {

/// If the environment has no absolute HOME, sets it to the folder in the system's list of accounts, so that no user
/// data is written to the folder in which the program was started.
/// Returns the sentence to end with (exit code 3) if no folder for user data is known, or if an argument is not UTF-8
/// (its wrong bytes are escaped): Qt would look for a file with another name.
[[nodiscard]] std::optional<std::string> refusedStart(int argc, const char* const* argv);

// Stdin, stdout and stderr must be open in each of our programs: if one is closed, the next opened file gets its
// number, and text printed for the user could be written to a device (hazard H4).
//
// Exceeding a limit on file sizes is a write error, like a full disk, and does not end the program.

/// Opens /dev/null for each closed stream, and ignores SIGXFSZ. Ends the program if /dev/null cannot be opened.
void holdStandardStreams() noexcept;

/// Whether `stream` can take a line at once: writing to a full pipe would block the thread, and so delay a stop.
[[nodiscard]] bool takesMore(int stream) noexcept;

// The other programs of Tactoscope lie in the same folder as this program.

/// Returns the folder of the running program; empty if the system does not tell.
[[nodiscard]] inline std::filesystem::path programFolder() {
    std::error_code error;
    return std::filesystem::read_symlink("/proc/self/exe", error).parent_path();
}

/// Returns the path of a program in that folder, such as "tactoscope-watchdog".
[[nodiscard]] inline std::filesystem::path programBeside(std::string_view name) { return programFolder() / name; }

// The folder with the user's data: calibrations, keys, sessions, protocols.

/// Returns $XDG_DATA_HOME/tactoscope, or ~/.local/share/tactoscope if that is not set or not absolute. The XDG base
/// directory specification tells programs to ignore relative paths: they depend on where the program is started. The
/// folder need not exist. The path is relative only if HOME is not set either.
[[nodiscard]] std::filesystem::path dataFolder();

}  // namespace tacto
