// ProtocolLibrary.h - where protocol scripts are: those shipped with the program, and the lab's own.
//
// A script of the lab's folder with the name of a shipped one takes its place, and says so by its path.
//
// Thread-safety: constant after construction.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "app/scripting/ProtocolDeclaration.h"

namespace tacto {

/// The program's resources folder (protocols/, limits/, examples/ ...): $TACTOSCOPE_RESOURCES; else `resources` beside
/// or above the executable (a build inside the source tree); else the installed share folder.
/// Errors: NotFound naming what was tried.
[[nodiscard]] Result<std::filesystem::path> resourcesFolder();

/// The file of a shipped drawing ("wiring"). Errors: InvalidArgument naming those there are.
[[nodiscard]] Result<std::filesystem::path> drawingFile(std::string_view name);

/// $XDG_DATA_HOME/tactoscope/protocols, or ~/.local/share/tactoscope/protocols. Need not exist.
[[nodiscard]] std::filesystem::path userProtocolsFolder();

class ProtocolLibrary {
public:
    /// The usual two folders. A folder that is not there holds no protocols.
    ProtocolLibrary();
    ProtocolLibrary(std::filesystem::path shipped, std::filesystem::path user);

    /// Every protocol, by name.
    [[nodiscard]] std::vector<ProtocolSource> list() const;

    /// A protocol's name, or the path of a .js file.
    /// Errors: NotFound naming it and the known names; Io; InvalidArgument above 1 MB or for a text that is not UTF-8.
    [[nodiscard]] Result<ProtocolSource> find(std::string_view nameOrPath) const;

private:
    std::filesystem::path shipped_;
    std::filesystem::path user_;
};

}  // namespace tacto
