// SessionEntry.h - a session file as a line of a list: what is known of it at a glance, or why it cannot be read.
//
// Thread-safety: values; reading is pure but for the file.
#pragma once

#include <QDateTime>
#include <QString>
#include <filesystem>

namespace tacto::gui {

struct SessionEntry {
    std::filesystem::path path;
    QDateTime began;
    QString protocol;
    QString devices;
    QString verdict;  ///< "pass", ...; empty for none
    double duration_s = 0;
    qint64 bytes = 0;
    bool simulated = false;
    bool closed = true;
    QString problem;  ///< why it cannot be read; empty when it can
    /// Everything a search looks at, in one line.
    [[nodiscard]] QString searched() const;
};

/// Never fails: what cannot be read is an entry with a problem.
[[nodiscard]] SessionEntry readEntry(const std::filesystem::path& path);

/// *.tacto of a folder, newest first by name of the file; folders inside are looked into once.
[[nodiscard]] std::vector<std::filesystem::path> sessionFiles(const std::filesystem::path& folder);

}  // namespace tacto::gui
