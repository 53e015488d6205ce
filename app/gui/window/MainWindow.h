// MainWindow.h - the main window: safety bar at the top, workspaces chosen at the left, docks, recording line.
//
// Reads telemetry 30 times a second and lets the visible parts redraw; more seldom where less can change, see
// MainWindow::frameTime_ms(). Nothing here blocks.
#pragma once

#include <QElapsedTimer>
#include <QMainWindow>
#include <QPointer>
#include <QSplitter>
#include <QTimer>
#include <functional>
#include <memory>
#include <optional>
#include <vector>

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
class StopKeys;
class WelcomeTour;
class WorkspaceRail;
class Workspaces;

class MainWindow final : public QMainWindow {
    Q_OBJECT
public:
    /// For `today` see DayNotes.
    explicit MainWindow(BenchController::MakeRegistry makeRegistry, std::function<QDate()> today = {});
    ~MainWindow() override;

    [[nodiscard]] SafetyBar& safetyBar() { return *safety_; }
    [[nodiscard]] BenchController& controller() noexcept { return controller_; }
    /// Shows a workspace: 0 to 6, in the order of the buttons at the left.
    void showWorkspace(int index);
    [[nodiscard]] int workspace() const;
    /// Opens a recording (a folder or its JSON), a session or a capture. Reports a file that is none of these.
    void openFile(const QString& path);

    /// Closes at once, without questions about unsaved scripts or a run; used for signals.
    void closeUnasked();

    // Commands of the menus, the docks and the tour:
    void chooseFile();
    void chooseRecording();
    void openSimulatedBench();
    void askForSimulatedBench();
    /// Starts the first of the two steps of arming.
    void askToArm();
    void checkImpedance();
    void beginTour();
    /// Marks this moment of the session being recorded, and asks for a word.
    void markMoment();
    /// Asks for today's operator and sample. `once`: not if the question was answered or put off today.
    void askForDay(bool once);
    /// Opens the docks with the named dock ("deviceDock") unfolded.
    void showDock(const QString& name);
    void setTheme(Theme theme);
    static constexpr int kUsualText = 100;
    /// Sets and keeps the text size. Back at kUsualText, docks, columns and window have the sizes that they had there.
    void setTextPercent(int percent);
    /// Shows only safety bar and plot, without menus, tools and paths; STOP and the keys of the menus still work.
    void showPlotOnly(bool only);
    /// Shows STOP in a small window above the windows of other programs.
    void showSmallStop(bool shown);
    void resetLayout();

protected:
    void showEvent(QShowEvent* event) override;
    void closeEvent(QCloseEvent* event) override;
    void dragEnterEvent(QDragEnterEvent* event) override;
    void dropEvent(QDropEvent* event) override;
    bool eventFilter(QObject* watched, QEvent* event) override;

private:
    void connectWorkspaces();
    void buildDocks();
    void restore();
    void tick();
    /// Returns the time to the next tick(): a frame while output can flow, a run has the bench, live plots are in
    /// sight, or something has happened just now; ten a second with another page beside an open bench; one without a
    /// bench.
    [[nodiscard]] int frameTime_ms(InterlockState state) const;
    /// Something has happened that tick() may have to show: ticks with every frame for a while.
    void stir();
    /// True if a part of the window may be on the screen.
    [[nodiscard]] bool inSight() const;
    /// Pauses output while the operator cannot see and reach STOP.
    void attend(const Telemetry& telemetry);
    void standIn();
    void showTitle();
    /// An opened bench leads to Live, unless it is the one that a run had closed: then the result stays in sight.
    void followBench();
    /// Opens the bench again that a run has closed and then come to its end.
    void reopen(const FinishedRun& run);
    /// Shows only this workspace, without docks and bars, while a pilot session hides what is delivered.
    void noteBlind();
    void enterDocks();

    BenchController controller_;
    CalibrationBook calibrations_{controller_};
    StopKeys* keys_ = nullptr;
    Attendance* attendance_ = nullptr;
    SafetyBar* safety_ = nullptr;
    const QWidget* stop_ = nullptr;  ///< the STOP of the safety bar
    std::unique_ptr<SmallStop> smallStop_;
    bool covered_ = false;   ///< another program's window covers STOP
    bool standsIn_ = false;  ///< the small STOP appeared by itself and will go by itself
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
    Activity activity_ = Activity::Closed;
    /// The layout at the usual text size, kept while the text is larger.
    struct UsualLayout {
        QSize size, larger;  ///< of the window, and as the larger text left it
        QByteArray docks;
        std::vector<std::pair<QPointer<QSplitter>, QList<int>>> columns;
    };
    void layOutAsUsual(const UsualLayout& usual);
    std::optional<UsualLayout> usual_;
    bool reopens_ = false;      ///< the bench that a run closed is being opened again
    bool awaitsFrame_ = false;  ///< the window system has not yet added its frame
    QTimer frame_{this};
    QElapsedTimer stirred_;  ///< time since something happened
};

}  // namespace tacto::gui
