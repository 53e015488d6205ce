// SessionsWorkspace.h - everything that was recorded: find, look into, replay, compare, report, export, verify.
//
// Reading and writing happen beside the window; a session that cannot be read is listed with the reason.
//
// Thread-safety: the GUI thread.
#pragma once

#include <QLabel>
#include <QLineEdit>
#include <QProgressBar>
#include <QPushButton>
#include <QTableWidget>
#include <QTemporaryDir>
#include <set>

#include "app/gui/desk/BenchDesk.h"
#include "app/gui/runner/ReportMaker.h"
#include "app/gui/sessions/Background.h"
#include "app/gui/sessions/SessionDetails.h"
#include "app/gui/sessions/SessionEntry.h"

namespace tacto::gui {

class SessionsWorkspace final : public QWidget {
    Q_OBJECT
public:
    explicit SessionsWorkspace(BenchDesk& desk, QWidget* parent = nullptr);
    /// Lists a session of another place too, and chooses it. False when there is no such file.
    bool openSession(const QString& path);
    void rescan();
    /// Writes the chosen session's CSV files into a new folder.
    void exportTo(const QString& folder);

signals:
    void captureChosen(std::shared_ptr<const tacto::Capture> capture);
    void recordingReady(const QString& folder);

protected:
    void showEvent(QShowEvent* event) override;
    void dragEnterEvent(QDragEnterEvent* event) override;
    void dropEvent(QDropEvent* event) override;

private:
    [[nodiscard]] QWidget* buildList();
    [[nodiscard]] QWidget* buildActions();
    void fillList();
    void filter();
    void chosen();
    void say(const QString& what);
    void openCapture(qint64 seq);
    void drawStream(int stream);
    void verify();
    void makeReport();
    void askExport();
    void exportSession(const std::filesystem::path& session, const QString& folder);
    void replay();
    void compare();
    void showInFolder();
    [[nodiscard]] std::vector<std::size_t> selected() const;  ///< indices into entries_
    [[nodiscard]] const SessionEntry* current() const;
    [[nodiscard]] bool isRecording(const SessionEntry& entry) const;

    BenchDesk& desk_;
    std::vector<SessionEntry> entries_;
    std::set<std::filesystem::path> others_;
    std::filesystem::path wanted_;  ///< to choose once it is listed
    std::shared_ptr<const ReadSession> read_;
    Background scan_, reading_, work_;
    ReportMaker reports_;
    std::unique_ptr<QTemporaryDir> replayed_;

    QLineEdit* search_;
    QTableWidget* table_;
    QLabel* empty_;
    SessionDetails* details_;
    QLabel* says_;
    QProgressBar* progress_;
    QPushButton* cancel_;
    std::vector<QPushButton*> actions_;
    QPushButton* compare_ = nullptr;
};

}  // namespace tacto::gui
