// ProtocolLibrary.h - where protocol scripts are: those shipped with the program, and the lab's own.
//
// The name of a shipped script belongs to it: a file of the lab's that carries it is refused, and listed as such. A
// script is called shipped only when its bytes are those that the program was built with; one that lies in the
// program's folder and differs says where it lies, as the lab's own do.
//
// Thread-safety: constant after construction.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "app/scripting/engine/ProtocolDeclaration.h"

namespace tacto {

/// The program's resources folder (protocols/, examples/, limit sets beside the built-in ones ...):
/// $TACTOSCOPE_RESOURCES; else `resources` beside or above the executable (a build inside the source tree); else the
/// installed share folder. Errors: NotFound naming what was tried.
[[nodiscard]] Result<std::filesystem::path> resourcesFolder();

/// The file of a shipped drawing ("wiring"). Errors: InvalidArgument naming those there are.
[[nodiscard]] Result<std::filesystem::path> drawingFile(std::string_view name);

/// $XDG_DATA_HOME/tactoscope/protocols, or ~/.local/share/tactoscope/protocols. Need not exist.
[[nodiscard]] std::filesystem::path userProtocolsFolder();

/// A file among the scripts that cannot be run, and why.
struct RefusedScript {
    std::filesystem::path path;
    std::string why;
};

class ProtocolLibrary {
public:
    /// The usual two folders. A folder that is not there holds no protocols.
    ProtocolLibrary();
    ProtocolLibrary(std::filesystem::path shipped, std::filesystem::path user);

    /// Every protocol, by name.
    [[nodiscard]] std::vector<ProtocolSource> list() const;
    /// Every script that list() leaves out.
    [[nodiscard]] std::vector<RefusedScript> refused() const;

    /// A protocol's name, or the path of a .js file.
    /// Errors: NotFound naming it and the known names; Io; InvalidArgument above 1 MB, for a text that is not UTF-8, or
    /// for a file of the lab's with the name of a shipped protocol.
    [[nodiscard]] Result<ProtocolSource> find(std::string_view nameOrPath) const;

private:
    struct Listing;
    [[nodiscard]] Listing listing() const;

    std::filesystem::path shipped_;
    std::string missing_;  ///< why there are no shipped ones
    std::filesystem::path user_;
};

}  // namespace tacto
