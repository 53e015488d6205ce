// SessionModel.h - the sessions as table rows: only those that match the search, verdict and age, sorted by a column.
// Only visible rows cost time, so that thousands are possible.
#pragma once

#include <QAbstractTableModel>
#include <QDateTime>
#include <QString>
#include <filesystem>
#include <optional>
#include <vector>

#include "core/session/SessionIndex.h"

namespace tacto::gui {

/// A session file as a list entry: the main facts about the session, or why it cannot be read.
struct SessionEntry {
    explicit SessionEntry(ListedSession listed);
    /// True if both entries say the same about the same session.
    [[nodiscard]] bool sameAs(const SessionEntry& other) const {
        return path == other.path && bytes == other.bytes && summary == other.summary && problem == other.problem &&
               elsewhere == other.elsewhere;
    }

    std::filesystem::path path;
    SessionSummary summary;
    QDateTime began;
    qint64 began_ms = 0;  ///< the same time in ms since 1970, for sorting
    qint64 bytes = 0;
    bool elsewhere;    ///< another program is recording this session
    QString problem;   ///< why it cannot be read; empty if it can
    QString searched;  ///< all text that a search looks at, in lower case
};

/// Lists the *.tacto files of a folder, newest first by file name; also looks one level into folders inside.
[[nodiscard]] std::vector<std::filesystem::path> sessionFiles(const std::filesystem::path& folder);

/// Returns the cache of sessions read earlier, shared by all windows of this user, in the cache folder.
[[nodiscard]] SessionIndex userSessionIndex();

/// Selects which sessions are shown.
struct SessionFilter {
    QString words;                    ///< words that must all occur
    QString ending;                   ///< text of the column Verdict; empty: any
    std::optional<int> withinDays{};  ///< 0: today
    [[nodiscard]] bool empty() const { return words.trimmed().isEmpty() && ending.isEmpty() && !withinDays; }
};

class SessionModel final : public QAbstractTableModel {
    Q_OBJECT
public:
    enum Column { kVerdict, kBegan, kProcedure, kSample, kOperator, kLength, kNote, kColumns };
    explicit SessionModel(QObject* parent);

    void setEntries(std::vector<SessionEntry> entries, const std::filesystem::path& recording);
    /// Replaces the session with the same path in its row, without filtering or sorting again.
    void replace(SessionEntry entry);
    void setFilter(const SessionFilter& filter);
    /// Updates the verdict colours from the theme.
    void recolour();

    [[nodiscard]] const std::vector<SessionEntry>& entries() const { return entries_; }
    [[nodiscard]] const SessionEntry& entry(int row) const { return entries_[rows_[std::size_t(row)]]; }
    /// Returns the row of a session; -1 if not shown.
    [[nodiscard]] int rowOf(const std::filesystem::path& path) const;

    [[nodiscard]] int rowCount(const QModelIndex& parent = {}) const override;
    [[nodiscard]] int columnCount(const QModelIndex& parent = {}) const override;
    [[nodiscard]] QVariant data(const QModelIndex& index, int role) const override;
    [[nodiscard]] QVariant headerData(int section, Qt::Orientation orientation, int role) const override;
    void sort(int column, Qt::SortOrder order) override;

private:
    void arrange();
    [[nodiscard]] bool passes(const SessionEntry& entry, const QStringList& words) const;
    [[nodiscard]] QString text(const SessionEntry& entry, int column) const;
    [[nodiscard]] QString about(const SessionEntry& entry) const;
    std::vector<SessionEntry> entries_;
    std::vector<std::size_t> rows_;  // indices into entries_
    std::filesystem::path recording_;
    SessionFilter filter_;
    int column_ = kBegan;
    Qt::SortOrder order_ = Qt::DescendingOrder;
};

}  // namespace tacto::gui
