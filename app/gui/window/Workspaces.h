// Workspaces.h - the window's seven workspaces, one of them shown. Live is there from the start; each other is made
// when it is first needed: together they take as long as the rest of the window.
#pragma once

#include <QStackedWidget>
#include <QStringList>
#include <memory>
#include <vector>

#include "app/gui/calibrate/CalibrationBook.h"
#include "app/gui/controller/BenchController.h"

namespace tacto::gui {

class CalibrateWorkspace;
class LiveWorkspace;
class PilotWorkspace;
class ProtocolWorkspace;
class ScopeWorkspace;
class SessionsWorkspace;
class TabbedPage;

class Workspaces final : public QStackedWidget {
    Q_OBJECT
public:
    /// The pages in their order at the left.
    enum Page { kLive, kCalibrate, kSafetyCheck, kSeparability, kPilot, kSessions, kProtocols };
    enum LiveTab { kTouch, kScope };
    /// Both arguments outlive it.
    Workspaces(BenchController& controller, CalibrationBook& calibrations, QWidget* parent);
    /// Does nothing for a number without a page, and for any page but Pilot's while a session there is blind.
    void showPage(int page);
    void showLive(LiveTab tab);
    /// Whether the oscilloscope is shown.
    [[nodiscard]] bool showsScope() const;
    /// The keys that follow are meant for the workspace. Not for a field of text in it: there Space would not stop.
    void takeFocus();
    /// Hides tabs, tools and paths.
    void showPlotOnly(bool only);
    /// `measured`: the oscilloscope's readings are shown beside the workspace, whichever it is.
    void refresh(const Telemetry& telemetry, bool measured);
    /// Opens a recording (a folder or its JSON), a session or a capture; complained() says so when it is none of them.
    void openFile(const QString& path);

    [[nodiscard]] LiveWorkspace& live() const { return *live_; }
    [[nodiscard]] ScopeWorkspace& scope() const { return *scope_; }
    /// Null until it is made.
    [[nodiscard]] PilotWorkspace* pilot() const { return pilot_; }
    /// The workspaces that run protocols, as far as they are made.
    [[nodiscard]] std::vector<ProtocolWorkspace*> runners() const;

signals:
    /// Another workspace is shown, or another page of Live.
    void shown();
    void pilotMade();
    void complained(const QString& why);  ///< about a file or a recording that was not opened
    void markWanted();
    void plotOnlyWanted();
    void simulatedBenchWanted();
    void captured(std::shared_ptr<const tacto::Capture> capture);  ///< a run has captured this

private:
    void make(int page);
    template <typename Workspace, typename... Arguments>
    [[nodiscard]] Workspace* makeOn(int page, Arguments&&... arguments);
    void addRunner(ProtocolWorkspace& runner, int page);
    void connectSessions();

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
};

/// The files that were opened last, newest first, from one start to the next.
[[nodiscard]] QStringList recentFiles();

}  // namespace tacto::gui
