// ProtocolLibrary.h - finds protocol scripts: those shipped with the program and those of the laboratory.
//
// The name of a shipped script is reserved: a laboratory's file with this name is refused, and listed as refused. A
// script is called shipped only if its bytes are those that the program was built with. Other scripts, even in the
// program's own folder, are reported with their path.
//
// Thread-safety: constant after construction.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "app/scripting/engine/ProtocolDeclaration.h"
#include "core/base/ResourcesFolder.h"

namespace tacto {

/// Returns the file of a shipped drawing ("wiring"). Errors: InvalidArgument naming the existing drawings.
[[nodiscard]] Result<std::filesystem::path> drawingFile(std::string_view name);

/// Returns $XDG_DATA_HOME/tactoscope/protocols, or ~/.local/share/tactoscope/protocols, even if it does not exist.
[[nodiscard]] std::filesystem::path userProtocolsFolder();

/// A script file that cannot be run, and the reason.
struct RefusedScript {
    std::filesystem::path path;
    std::string why;
};

class ProtocolLibrary {
public:
    /// Uses the two standard folders. A missing folder holds no protocols.
    ProtocolLibrary();
    ProtocolLibrary(std::filesystem::path shipped, std::filesystem::path user);

    /// Returns every protocol, sorted by name.
    [[nodiscard]] std::vector<ProtocolSource> list() const;
    /// Returns every script that list() leaves out.
    [[nodiscard]] std::vector<RefusedScript> refused() const;

    /// Finds a protocol by its name or by the path of a .js file. Errors: NotFound naming it and the known names; Io;
    /// InvalidArgument for more than 1 MB, a text that is not UTF-8, or a laboratory's file with the name of a shipped
    /// protocol.
    [[nodiscard]] Result<ProtocolSource> find(std::string_view nameOrPath) const;

private:
    struct Listing;
    [[nodiscard]] Listing listing() const;

    std::filesystem::path shipped_;
    std::string missing_;  ///< why no shipped protocols were found
    std::filesystem::path user_;
};

}  // namespace tacto
