// SessionList.h - the sessions that were recorded, as a table: read beside the window, searched, sorted and chosen.
//
// Listed from an index of what was read before (core/session/SessionIndex.h). What is seen of the list, and what is
// chosen, is then read from the sessions themselves, which have the last word. A session that cannot be read is listed
// with the reason.
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
    /// Lists the sessions folder again. `recording` is the session that is being written.
    void rescan(const std::filesystem::path& recording);
    /// A session of another place is listed too, and chosen, once it is read.
    void add(const std::filesystem::path& file);
    /// Reads this one again, from the session.
    void confirm(const std::filesystem::path& file);
    /// The selected sessions, in the table's order.
    [[nodiscard]] std::vector<const SessionEntry*> selected() const;
    /// The chosen session; null for none or several.
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
    std::set<std::filesystem::path> confirmed_;  ///< read from the session since they were listed
    std::filesystem::path wanted_;               ///< to choose once it is listed
    std::filesystem::path recording_;            ///< being written
    std::filesystem::path shownRecording_;       ///< as the rows show it
    bool arranging_ = false;                     ///< the selection changes with the rows, not by the user
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
