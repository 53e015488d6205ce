// ProgramStart.h - what every program of ours needs of its surroundings before it does anything.
//
// Thread-safety: once, in main(), before other threads are started.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>

namespace tacto {

/// HOME becomes the folder that the system's list of accounts names, as a shell has it, where the environment has no
/// absolute one: nothing of the user's is written into the folder that the program was started in.
/// Returns the sentence to end with (exit code 3) where no folder is known for the user's data, and where an argument
/// is not UTF-8, with the bytes that are not spelled out: Qt would look for a file of another name.
[[nodiscard]] std::optional<std::string> refusedStart(int argc, const char* const* argv);

// Stdin, stdout and stderr are open in every program of ours: where one is closed, the next file
// that is opened takes its number, and what is printed for the user would be written into a device (hazard H4).
//
// A limit on the size of files is an error of what writes, as a full disk is, and does not end the program.

/// Opens /dev/null for each of the three streams that is closed, and ignores SIGXFSZ. Ends the program when /dev/null
/// cannot be opened.
void holdStandardStreams() noexcept;

/// Whether a line can be written to `stream` at once: writing into a full pipe would hold the thread, and with it a
/// stop.
[[nodiscard]] bool takesMore(int stream) noexcept;

// The programs that belong to this one lie in the same folder.

/// The folder of the program that runs; empty where the system does not tell.
[[nodiscard]] inline std::filesystem::path programFolder() {
    std::error_code error;
    return std::filesystem::read_symlink("/proc/self/exe", error).parent_path();
}

/// "tactoscope-watchdog" beside it.
[[nodiscard]] inline std::filesystem::path programBeside(std::string_view name) { return programFolder() / name; }

// Where the program keeps its user's data: calibrations, keys, sessions, protocols.

/// $XDG_DATA_HOME/tactoscope, or ~/.local/share/tactoscope where that is not set or not absolute, which the XDG base
/// directory specification tells programs to ignore: it would be another folder for each folder that the program is
/// started in. Need not exist. Relative only where HOME is not set either.
[[nodiscard]] std::filesystem::path dataFolder();

}  // namespace tacto
