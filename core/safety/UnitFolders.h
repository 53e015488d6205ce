// UnitFolders.h - where the program keeps what outlives it about each unit (UnitRecord.h, UnitClaim.h).
//
// Thread-safety: values.
#pragma once

#include <filesystem>

namespace tacto {

struct UnitFolders {
    std::filesystem::path records;
    std::filesystem::path claims;  ///< the same for everybody on this computer, and emptied when it starts
};

/// The records in $XDG_DATA_HOME/tactoscope/units or ~/.local/share/tactoscope/units, the claims in /run/lock.
[[nodiscard]] UnitFolders unitFolders();

}  // namespace tacto
