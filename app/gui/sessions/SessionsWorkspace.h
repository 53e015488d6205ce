// SessionsWorkspace.h - workspace for recorded sessions: find, view, label, replay, compare, report, export, verify.
//
// Reading and writing run on another thread.
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

/// Buttons for actions on a session: each says why it cannot act, and if space is short the buttons show only icons, so
/// that both panes fit side by side.
class ActionButtons {
public:
    /// Adds a button to `row`; the row's widget owns the button.
    QPushButton* add(QBoxLayout& row, const char* iconName, const QString& text, const QString& tip,
                     std::function<void()> act);
    /// Enables the button if `refusal` is empty; otherwise disables it, with `refusal` as its tool tip.
    void offer(QPushButton* button, const QString& refusal);
    void offerAll(const QString& refusal);
    /// Shows words or icons, by the width of the panes in pixels: call again after a change of width or text size.
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
    /// Lists a session from another folder too, and chooses it. Returns false if there is no such file.
    bool openSession(const QString& path);
    void rescan();
    /// The file of the session that is shown; empty if none is.
    [[nodiscard]] QString file() const;
    /// The report beside that session, as PDF; empty if none is written.
    [[nodiscard]] QString writtenReport() const;
    /// Writes the chosen session's CSV files into a new folder.
    void exportTo(const QString& folder);

signals:
    void captureChosen(std::shared_ptr<const tacto::Capture> capture);
    void recordingReady(const QString& folder);
    void sessionShown(const QString& path);

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
    void showReport(const QString& pdf);
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
    QString saidOfStream_;  ///< goes when the next stream is drawn
    QProgressBar* progress_;
    QPushButton* cancel_;
    ActionButtons actions_;
    QPushButton* compare_ = nullptr;
    QPushButton* replay_ = nullptr;
    QPushButton* capture_ = nullptr;
};

}  // namespace tacto::gui
