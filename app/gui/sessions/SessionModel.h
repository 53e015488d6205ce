// SessionModel.h - the sessions as rows of a table: those that a search and a choice of verdict and age let through, in
// the order of a column. Thousands of rows cost what is seen of them.
#pragma once

#include <QAbstractTableModel>
#include <QDateTime>
#include <QString>
#include <filesystem>
#include <optional>
#include <vector>

#include "core/session/SessionIndex.h"

namespace tacto::gui {

/// A session file as a line of a list: what is known about it at a glance, or why it cannot be read.
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
    qint64 began_ms = 0;  ///< the same moment, in ms since 1970, for sorting
    qint64 bytes = 0;
    bool elsewhere;    ///< another program is recording it
    QString problem;   ///< why it cannot be read; empty when it can
    QString searched;  ///< everything a search looks at, in lower case
};

/// *.tacto of a folder, newest first by name of the file; folders inside are looked into once.
[[nodiscard]] std::vector<std::filesystem::path> sessionFiles(const std::filesystem::path& folder);

/// The cache of sessions read earlier, for all windows of this user: in the folder of caches.
[[nodiscard]] SessionIndex userSessionIndex();

/// Chooses which sessions are shown.
struct SessionFilter {
    QString words;                    ///< words that must all be found
    QString ending;                   ///< the word of the column Verdict; empty: any
    std::optional<int> withinDays{};  ///< 0: today
    [[nodiscard]] bool empty() const { return words.trimmed().isEmpty() && ending.isEmpty() && !withinDays; }
};

class SessionModel final : public QAbstractTableModel {
    Q_OBJECT
public:
    enum Column { kVerdict, kBegan, kProcedure, kSample, kOperator, kLength, kNote, kColumns };
    explicit SessionModel(QObject* parent);

    void setEntries(std::vector<SessionEntry> entries, const std::filesystem::path& recording);
    /// Replaces the session of the same path in its row, without filtering or sorting again.
    void replace(SessionEntry entry);
    void setFilter(const SessionFilter& filter);
    /// Verdicts take their colours from the theme.
    void recolour();

    [[nodiscard]] const std::vector<SessionEntry>& entries() const { return entries_; }
    [[nodiscard]] const SessionEntry& entry(int row) const { return entries_[rows_[std::size_t(row)]]; }
    /// -1 where it is not shown.
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
    std::vector<std::size_t> rows_;  // into entries_
    std::filesystem::path recording_;
    SessionFilter filter_;
    int column_ = kBegan;
    Qt::SortOrder order_ = Qt::DescendingOrder;
};

}  // namespace tacto::gui
