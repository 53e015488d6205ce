// RunFiles.h - the files for a run's session, reports and captures. Existing files are never overwritten.
//
// Thread-safety: any thread; each run has its own files.
#pragma once

#include <filesystem>
#include <memory>
#include <string>

#include "core/base/Clock.h"
#include "core/base/Result.h"
#include "core/session/SessionWriter.h"

namespace tacto {

struct RunFiles {
    std::filesystem::path session;   ///< *.tacto
    std::filesystem::path captures;  ///< folder for CSV files; empty: no CSV files
    [[nodiscard]] std::filesystem::path report(const char* ending) const;
};

/// `out`: the value of --out; empty: the user's sessions folder, without capture files. If the folder already has a
/// session or captures, this run gets a new folder inside. Errors: Io if a folder cannot be made.
[[nodiscard]] Result<RunFiles> prepareRunFiles(const std::string& out, const std::string& protocol);

struct RunSession {
    RunFiles files;
    std::unique_ptr<SessionWriter> writer;
    std::shared_ptr<const RowSeal> seal = nullptr;  ///< null: rows are not sealed
};
/// Makes the files of a run and begins its session. Programs that do this in the same second get different names.
/// Errors: as prepareRunFiles() and SessionWriter::create().
[[nodiscard]] Result<RunSession> makeRunSession(const std::string& out, const std::string& protocol,
                                                const SessionAbout& about, const Clock& clock);

/// Returns $XDG_DATA_HOME/tactoscope/sessions, or ~/.local/share/tactoscope/sessions.
[[nodiscard]] std::filesystem::path userSessionsFolder();

}  // namespace tacto
