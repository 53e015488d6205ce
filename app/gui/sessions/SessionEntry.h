// SessionEntry.h - a session file as a line of a list: what is known about it at a glance, or why it cannot be read.
//
// Thread-safety: values; sessionFiles() is pure but for the folders.
#pragma once

#include <QDateTime>
#include <QString>
#include <filesystem>
#include <vector>

#include "core/session/SessionIndex.h"

namespace tacto::gui {

struct SessionEntry {
    explicit SessionEntry(ListedSession listed);
    /// Whether both say the same of the same session.
    [[nodiscard]] bool sameAs(const SessionEntry& other) const {
        return path == other.path && bytes == other.bytes && summary == other.summary && problem == other.problem &&
               elsewhere == other.elsewhere;
    }

    std::filesystem::path path;
    SessionSummary summary;
    QDateTime began;
    qint64 began_ms = 0;  ///< the same since 1970, to sort by
    qint64 bytes = 0;
    bool elsewhere;    ///< another program is recording it
    QString problem;   ///< why it cannot be read; empty when it can
    QString searched;  ///< everything a search looks at, in lower case
};

/// *.tacto of a folder, newest first by name of the file; folders inside are looked into once.
[[nodiscard]] std::vector<std::filesystem::path> sessionFiles(const std::filesystem::path& folder);

/// What was read from sessions before, for all windows of this user: in the folder of caches.
[[nodiscard]] SessionIndex userSessionIndex();

}  // namespace tacto::gui
