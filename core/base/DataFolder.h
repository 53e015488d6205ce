// DataFolder.h - where the program keeps what belongs to its user: calibrations, keys, sessions, protocols.
//
// Thread-safety: any thread, while none changes the environment.
#pragma once

#include <filesystem>

namespace tacto {

/// $XDG_DATA_HOME/tactoscope, or ~/.local/share/tactoscope where that is not set or not absolute, which the XDG base
/// directory specification tells programs to ignore: it would be another folder for each folder that the program is
/// started in. Need not exist. Relative only where HOME is not set either.
[[nodiscard]] std::filesystem::path dataFolder();

}  // namespace tacto
