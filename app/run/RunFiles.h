// RunFiles.h - where a run puts its session, reports and captures. Nothing that exists is ever written over.
//
// Thread-safety: any thread; what is made is in files that no other run has.
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
    std::filesystem::path captures;  ///< folder for CSV files; empty: none are written
    [[nodiscard]] std::filesystem::path report(const char* ending) const;
};

/// `out` as given by --out, or empty: the user's sessions folder, and no capture files. A folder that already holds a
/// session or captures gets a folder of its own for this run. Errors: Io when a folder cannot be made.
[[nodiscard]] Result<RunFiles> prepareRunFiles(const std::string& out, const std::string& protocol);

struct RunSession {
    RunFiles files;
    std::unique_ptr<SessionWriter> writer;
    std::shared_ptr<const RowSeal> seal = nullptr;  ///< null: its rows are not sealed
};
/// The files of a run and its session, begun: another program that begins one in the same second gets another name.
/// Errors: as prepareRunFiles() and SessionWriter::create().
[[nodiscard]] Result<RunSession> makeRunSession(const std::string& out, const std::string& protocol,
                                                const SessionAbout& about, const Clock& clock);

/// $XDG_DATA_HOME/tactoscope/sessions, or ~/.local/share/tactoscope/sessions.
[[nodiscard]] std::filesystem::path userSessionsFolder();

}  // namespace tacto
