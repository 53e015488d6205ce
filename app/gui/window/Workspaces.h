// Workspaces.h - the window's seven workspaces, one shown at a time. Live exists from the start; the others are made
// when first needed, because making all takes as long as the rest of the window.
#pragma once

#include <QStackedWidget>
#include <QStringList>
#include <memory>
#include <optional>
#include <vector>

#include "app/gui/calibrate/CalibrationBook.h"
#include "app/gui/controller/BenchController.h"

class QCustomPlot;

namespace tacto::gui {

class CalibrateWorkspace;
class LiveWorkspace;
class PictureTools;
class PilotWorkspace;
class ProtocolWorkspace;
class ScopeWorkspace;
class SessionsWorkspace;
class TabbedPage;

class Workspaces final : public QStackedWidget {
    Q_OBJECT
public:
    /// The pages, in the order of their buttons at the left.
    enum Page { kLive, kCalibrate, kSafetyCheck, kSeparability, kPilot, kSessions, kProtocols };
    enum LiveTab { kTouch, kScope };
    /// Both arguments outlive this.
    Workspaces(BenchController& controller, CalibrationBook& calibrations, QWidget* parent);
    /// Does nothing if there is no such page, or if a session in Pilot is blind and the page is another one.
    void showPage(int page);
    void showLive(LiveTab tab);
    /// True if the oscilloscope is shown.
    [[nodiscard]] bool showsScope() const;
    /// Focuses the workspace, so that it gets the next keys. Avoids its text fields, in which Space would not stop.
    void takeFocus();
    /// Hides tabs, tools and paths.
    void showPlotOnly(bool only);
    /// `measured`: the oscilloscope's readings are shown next to the present workspace. `inSight`: the window may be.
    void refresh(const Telemetry& telemetry, bool measured, bool inSight);
    /// Opens a recording (a folder or its JSON), a session or a capture; emits complained() if it is none of these.
    void openFile(const QString& path);

    /// The file that the present page shows: a recording, a capture or a session; empty if it comes from none.
    [[nodiscard]] QString file() const;
    /// True if the present page shows a picture that can be saved.
    [[nodiscard]] bool hasPicture() const;
    void askSavePicture();
    /// Saves the picture as savePicture() in PlotPicture.h does. Returns errors as a sentence.
    [[nodiscard]] std::optional<QString> savePicture(const QString& path) const;
    /// The report of the result or session on the present page, as PDF; empty if none is written.
    [[nodiscard]] QString report() const;
    [[nodiscard]] bool canExport() const;
    /// Asks where to export the present page's data: a session, the visible capture, a study, or a table.
    void askExport();
    /// True if a study is shown or a bench or recording is open, without a run.
    [[nodiscard]] bool canClose() const;
    void closeFile();

    [[nodiscard]] LiveWorkspace& live() const { return *live_; }
    [[nodiscard]] ScopeWorkspace& scope() const { return *scope_; }
    /// Null until the workspace is made.
    [[nodiscard]] PilotWorkspace* pilot() const { return pilot_; }
    /// The existing workspaces that run protocols.
    [[nodiscard]] std::vector<ProtocolWorkspace*> runners() const;

signals:
    /// Another workspace or another page of Live is now shown.
    void shown();
    void pilotMade();
    void complained(const QString& why);  ///< why a file or recording was not opened
    void markWanted();
    void plotOnlyWanted();
    void simulatedBenchWanted();
    void captured(std::shared_ptr<const tacto::Capture> capture);  ///< a run took this capture

private:
    void make(int page);
    template <typename Workspace, typename... Arguments>
    [[nodiscard]] Workspace* makeOn(int page, Arguments&&... arguments);
    void addRunner(ProtocolWorkspace& runner, int page);
    void connectSessions();
    void connectFiles();
    void noteAsked(const QString& path);
    /// Puts the file that was asked for at the head of the recent ones, once it is open.
    void noteOpened(const QString& path);
    /// The page's picture tools that can save now; null if there are none.
    [[nodiscard]] PictureTools* pictures() const;
    [[nodiscard]] QCustomPlot* plot() const;
    [[nodiscard]] ProtocolWorkspace* shownRunner() const;

    BenchController& controller_;
    CalibrationBook& calibrations_;
    TabbedPage* livePage_;
    LiveWorkspace* live_ = nullptr;
    ScopeWorkspace* scope_ = nullptr;
    CalibrateWorkspace* calibrate_ = nullptr;
    ProtocolWorkspace* safetyCheck_ = nullptr;
    ProtocolWorkspace* separability_ = nullptr;
    PilotWorkspace* pilot_ = nullptr;
    SessionsWorkspace* sessions_ = nullptr;
    ProtocolWorkspace* protocols_ = nullptr;
    bool plotOnly_ = false;
    QString asked_;                // the file that was asked for last; empty once it is open
    QString recording_, capture_;  // the files of the open bench and of the oscilloscope's capture
};

/// The files opened last that are still there, newest first; kept in the settings.
[[nodiscard]] QStringList recentFiles();

}  // namespace tacto::gui
