// RunFiles.h - where a run puts its session, reports and captures. Nothing that exists is ever written over.
#pragma once

#include <filesystem>
#include <string>

#include "core/base/Result.h"

namespace tacto {

struct RunFiles {
    std::filesystem::path session;   ///< *.tacto
    std::filesystem::path captures;  ///< folder for CSV files; empty: none are written
    [[nodiscard]] std::filesystem::path report(const char* ending) const;
};

/// `out` as given by --out, or empty: the user's sessions folder, and no capture files. A folder that already holds a
/// session or captures gets a folder of its own for this run. Errors: Io when a folder cannot be made.
[[nodiscard]] Result<RunFiles> prepareRunFiles(const std::string& out, const std::string& protocol);

/// $XDG_DATA_HOME/tactoscope/sessions, or ~/.local/share/tactoscope/sessions.
[[nodiscard]] std::filesystem::path userSessionsFolder();

}  // namespace tacto
