// SessionList.h - table of the recorded sessions: read on another thread, searched, sorted and chosen.
//
// The list comes from an index of sessions read before (core/session/SessionIndex.h). The sessions that are visible or
// chosen are then read from their own files, which override the index. A session that cannot be read is listed with the
// reason.
#pragma once

#include <QComboBox>
#include <QLabel>
#include <QLineEdit>
#include <QTableView>
#include <QTimer>
#include <set>

#include "app/gui/sessions/Background.h"
#include "app/gui/sessions/SessionModel.h"

namespace tacto::gui {

class SessionList final : public QWidget {
    Q_OBJECT
public:
    explicit SessionList(QWidget* parent);
    /// Lists the sessions folder again. `recording` is the session being written.
    void rescan(const std::filesystem::path& recording);
    /// Lists a session from another folder too, and chooses it once read.
    void add(const std::filesystem::path& file);
    /// Reads this session again from its file.
    void confirm(const std::filesystem::path& file);
    /// Returns the selected sessions, in the table's order.
    [[nodiscard]] std::vector<const SessionEntry*> selected() const;
    /// Returns the chosen session; null if none or several are chosen.
    [[nodiscard]] const SessionEntry* current() const;
    [[nodiscard]] const Background& scan() const noexcept { return scan_; }

signals:
    void selectionChanged();

private:
    [[nodiscard]] QWidget* buildSearch();
    void buildTable();
    void take(std::vector<SessionEntry> entries);
    void fitColumns();
    void filter();
    void choose(const std::vector<std::filesystem::path>& paths);
    void say();
    void confirmSeen();
    [[nodiscard]] std::vector<std::filesystem::path> chosenPaths() const;
    [[nodiscard]] std::vector<std::pair<std::filesystem::path, SessionSummary>> chosenNow() const;

    const SessionIndex index_;
    SessionModel* model_;
    std::set<std::filesystem::path> others_;
    std::set<std::filesystem::path> confirmed_;  ///< read from their files since they were listed
    std::filesystem::path wanted_;               ///< the session to choose once it is listed
    std::filesystem::path recording_;            ///< the session being written
    std::filesystem::path shownRecording_;       ///< the recording session shown in the rows
    bool arranging_ = false;                     ///< the selection is changed by the program, not by the user
    Background scan_, confirm_;
    QTimer seen_;
    QLineEdit* search_ = nullptr;
    QComboBox* ending_ = nullptr;
    QComboBox* age_ = nullptr;
    QLabel* count_ = nullptr;
    QTableView* table_ = nullptr;
    QLabel* empty_;
};

}  // namespace tacto::gui
