// SessionsWorkspace.h - everything that was recorded: find, look into, say what it is, replay, compare, report, export,
// verify.
//
// Reading and writing happen beside the window.
#pragma once

#include <QBoxLayout>
#include <QLabel>
#include <QProgressBar>
#include <QPushButton>
#include <QSplitter>
#include <QTemporaryDir>
#include <functional>
#include <vector>

#include "app/gui/controller/BenchController.h"
#include "app/gui/runner/ReportMaker.h"
#include "app/gui/sessions/Background.h"
#include "app/gui/sessions/SessionDetails.h"
#include "app/gui/sessions/SessionList.h"

namespace tacto::gui {

/// Buttons for what can be done with a session: each says why it cannot act, and where there is little room they are
/// icons, so that the panes beside each other fit.
class ActionButtons {
public:
    /// Adds a button to `row`, which owns it as a child of its widget.
    QPushButton* add(QBoxLayout& row, const char* iconName, const QString& text, const QString& tip,
                     std::function<void()> act);
    /// Enabled with an empty `refusal`, else disabled with it as the tool tip.
    void offer(QPushButton* button, const QString& refusal);
    void offerAll(const QString& refusal);
    /// Words or icons, by the room for the panes in pixels: call again when that or the size of text changes.
    void dress(int room);

private:
    struct Action {
        QPushButton* button;
        QString text;
        QString tip;
        QString refusal;
    };
    static void explain(const Action& action);
    std::vector<Action> all_;
};

class SessionsWorkspace final : public QWidget {
    Q_OBJECT
public:
    explicit SessionsWorkspace(BenchController& controller, QWidget* parent = nullptr);
    /// Lists a session of another place too, and chooses it. False when there is no such file.
    bool openSession(const QString& path);
    void rescan();
    /// Writes the chosen session's CSV files into a new folder.
    void exportTo(const QString& folder);

signals:
    void captureChosen(std::shared_ptr<const tacto::Capture> capture);
    void recordingReady(const QString& folder);

protected:
    void dragEnterEvent(QDragEnterEvent* event) override;
    void dropEvent(QDropEvent* event) override;

private:
    void fitPanes();
    static void layOut(QWidget& pane, QWidget& shown, QWidget& actions);
    [[nodiscard]] QWidget* buildListActions();
    [[nodiscard]] QWidget* buildSessionActions();
    [[nodiscard]] QWidget* buildNews();
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

    BenchController& controller_;
    std::shared_ptr<const ReadSession> read_;
    Background reading_, work_;
    ReportMaker reports_;
    std::unique_ptr<QTemporaryDir> replayed_;

    QSplitter* split_;
    SessionList* list_;
    SessionDetails* details_;
    QLabel* says_;
    QProgressBar* progress_;
    QPushButton* cancel_;
    ActionButtons actions_;
    QPushButton* compare_ = nullptr;
    QPushButton* replay_ = nullptr;
    QPushButton* capture_ = nullptr;
};

}  // namespace tacto::gui
