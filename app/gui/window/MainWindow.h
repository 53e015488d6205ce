// MainWindow.h - the window: safety bar on top, workspaces at the left, the workspace, docks, the recording line.
//
// Thirty times a second it pulls telemetry and lets what is visible redraw. Nothing here blocks.
#pragma once

#include <QMainWindow>
#include <QTimer>
#include <functional>
#include <memory>

#include "app/gui/calibrate/CalibrationBook.h"
#include "app/gui/controller/BenchController.h"
#include "app/gui/theme/Theme.h"

namespace tacto::gui {

class ArmQuestion;
class Attendance;
class CloseQuestion;
class DeviceDock;
class DockColumn;
class DriveDock;
class ExposureDock;
class FoldingDock;
class MarkLine;
class MeasurementSummary;
class NoticeBanner;
class RecordingLine;
class SafetyBar;
class SmallStop;
class WelcomeTour;
class WorkspaceRail;
class Workspaces;

class MainWindow final : public QMainWindow {
    Q_OBJECT
public:
    /// `today` as of DayNotes.
    explicit MainWindow(BenchController::MakeRegistry makeRegistry, std::function<QDate()> today = {});
    ~MainWindow() override;

    [[nodiscard]] SafetyBar& safetyBar() { return *safety_; }
    [[nodiscard]] BenchController& controller() noexcept { return controller_; }
    /// 0 to 6, in the order at the left.
    void showWorkspace(int index);
    [[nodiscard]] int workspace() const;
    /// Opens a recording (a folder or its JSON), a session or a capture. Says so when it is none of them.
    void openFile(const QString& path);

    /// Closes at once, without a question about unsaved scripts or a run: for signals.
    void closeUnasked();

    // The orders of menus, docks and the tour:
    void chooseFile();
    void chooseRecording();
    void openSimulatedBench();
    void askForSimulatedBench();
    /// The first of the two steps of arming.
    void askToArm();
    void checkImpedance();
    void beginTour();
    /// Marks this moment of the session that is being recorded, and asks for a word.
    void markMoment();
    /// Operator and sample of today. `once`: unless the question was answered or put off today.
    void askForDay(bool once);
    /// Opens the docks with this one ("deviceDock") unfolded.
    void showDock(const QString& name);
    void setTheme(Theme theme);
    /// Safety bar and plot alone, without menus, tools and paths; STOP and the menus' keys stay.
    void showPlotOnly(bool only);
    /// STOP by itself, above the windows of other programs.
    void showSmallStop(bool shown);
    void resetLayout();

protected:
    void showEvent(QShowEvent* event) override;
    void closeEvent(QCloseEvent* event) override;
    void dragEnterEvent(QDragEnterEvent* event) override;
    void dropEvent(QDropEvent* event) override;

private:
    void connectWorkspaces();
    void buildDocks();
    void restore();
    void tick();
    /// Output pauses while the operator cannot see STOP and reach it.
    void attend(const Telemetry& telemetry);
    void standIn();
    void showTitle();
    /// While a pilot session hides what is delivered, shows this workspace alone, without docks and bars.
    void noteBlind();
    void enterDocks();

    BenchController controller_;
    CalibrationBook calibrations_{controller_};
    Attendance* attendance_ = nullptr;
    SafetyBar* safety_ = nullptr;
    const QWidget* stop_ = nullptr;  ///< the STOP of the safety bar
    std::unique_ptr<SmallStop> smallStop_;
    bool covered_ = false;   ///< STOP, by another program's window
    bool standsIn_ = false;  ///< the small STOP came by itself, and goes by itself
    NoticeBanner* banner_ = nullptr;
    Workspaces* workspaces_ = nullptr;
    DeviceDock* devices_ = nullptr;
    ExposureDock* exposure_ = nullptr;
    DriveDock* drive_ = nullptr;
    FoldingDock* measurements_ = nullptr;
    DockColumn* docks_ = nullptr;
    MeasurementSummary* summary_ = nullptr;
    RecordingLine* line_ = nullptr;
    MarkLine* mark_ = nullptr;
    WelcomeTour* tour_ = nullptr;
    CloseQuestion* closing_ = nullptr;
    ArmQuestion* arming_ = nullptr;
    WorkspaceRail* rail_ = nullptr;
    bool hasRoomForDocks_ = true, hasRoomForAllDocks_ = true;
    bool awaitsFrame_ = false;  ///< a frame from the window system
    QTimer frame_;
};

}  // namespace tacto::gui
