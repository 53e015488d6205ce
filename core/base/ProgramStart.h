// ProgramStart.h - what every program of ours needs of its surroundings before it does anything.
//
// Thread-safety: once, in main(), before other threads are started.
#pragma once

#include <optional>
#include <string>

namespace tacto {

/// HOME becomes the folder that the system's list of accounts names, as a shell has it, where the environment has no
/// absolute one: nothing of the user's is written into the folder that the program was started in.
/// Returns the sentence to end with (exit code 3) where no folder is known for the user's data, and where an argument
/// is not UTF-8, with the bytes that are not spelled out: Qt would look for a file of another name.
[[nodiscard]] std::optional<std::string> refusedStart(int argc, const char* const* argv);

}  // namespace tacto
