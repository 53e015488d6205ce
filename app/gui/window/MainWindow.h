// MainWindow.h - the window: safety bar on top, workspaces at the left, the workspace, docks, the recording line.
//
// Thirty times a second it pulls telemetry and lets what is visible redraw. Nothing here blocks.
//
// Thread-safety: the GUI thread.
#pragma once

#include <QActionGroup>
#include <QLabel>
#include <QMainWindow>
#include <QMenu>
#include <QStackedWidget>
#include <QTimer>
#include <array>
#include <filesystem>
#include <functional>
#include <vector>

#include "app/gui/calibrate/CalibrationBook.h"
#include "app/gui/desk/BenchDesk.h"
#include "app/gui/look/Look.h"
#include "app/gui/window/ArmDialog.h"

class QTabWidget;

namespace tacto::gui {

class CalibrateWorkspace;
class DeviceDock;
class ExposureDock;
class LiveWorkspace;
class MeasurementSummary;
class ProtocolWorkspace;
class RecordingLine;
class SafetyBar;
class ScopeWorkspace;
class SessionsWorkspace;
class Tour;

class MainWindow final : public QMainWindow {
    Q_OBJECT
public:
    explicit MainWindow(BenchDesk::MakeRegistry makeRegistry);
    ~MainWindow() override;

    [[nodiscard]] BenchDesk& desk() noexcept { return desk_; }
    /// 0 to 6, in the order at the left.
    void showWorkspace(int index);
    [[nodiscard]] int workspace() const { return pages_->currentIndex(); }
    /// A recording (a folder or its JSON), a session or a capture. Says so when it is none of them.
    void openFile(const QString& path);
    /// The first of the two steps of arming.
    void askToArm();
    /// Not on the first run of a test.
    void beginTour();

protected:
    void showEvent(QShowEvent* event) override;
    void closeEvent(QCloseEvent* event) override;
    void changeEvent(QEvent* event) override;
    void dragEnterEvent(QDragEnterEvent* event) override;
    void dropEvent(QDropEvent* event) override;

private:
    void buildPages();
    void buildDocks();
    void buildNavigation();
    void buildMenus();  // Menus.cpp
    void buildBenchMenu();
    void buildViewMenu();
    void buildHelpMenu();
    void buildTour();
    void restore();
    void stayOnScreen();
    void tick();
    /// All that run protocols.
    [[nodiscard]] std::array<ProtocolWorkspace*, 5> runners() const;
    void noteChange();
    void sayState(const Telemetry& telemetry);
    void sayFault(const Telemetry& telemetry);
    void complain(const QString& what);
    void remember(const QString& path);
    void fillRecent();
    void chooseFile();
    void chooseRecording();
    void checkImpedance();
    void askToConfirm(ArmDialog::Purpose purpose);
    void openSimulatedBench();
    void askForSimulatedBench();
    void setTheme(Theme theme);
    void showScope();
    [[nodiscard]] QString declaredLoad() const;

    BenchDesk desk_;
    CalibrationBook calibrations_{desk_};
    SafetyBar* safety_ = nullptr;
    QFrame* banner_ = nullptr;
    QLabel* bannerText_ = nullptr;
    QStackedWidget* pages_ = nullptr;
    QTabWidget* livePage_ = nullptr;
    LiveWorkspace* live_ = nullptr;
    ScopeWorkspace* scope_ = nullptr;
    CalibrateWorkspace* calibrate_ = nullptr;
    ProtocolWorkspace* safetyCheck_ = nullptr;
    ProtocolWorkspace* separability_ = nullptr;
    ProtocolWorkspace* protocols_ = nullptr;
    SessionsWorkspace* sessions_ = nullptr;
    DeviceDock* devices_ = nullptr;
    ExposureDock* exposure_ = nullptr;
    QDockWidget* measurements_ = nullptr;
    MeasurementSummary* summary_ = nullptr;
    RecordingLine* line_ = nullptr;
    Tour* tour_ = nullptr;
    QActionGroup* navigation_ = nullptr;
    QMenu* recent_ = nullptr;
    QTimer frame_;
    QString load_;                  // declared last
    std::filesystem::path loadOf_;  // the session of its bench
    bool saidArmed_ = false;        // and nothing since that it is over
    int faultedFrames_ = 0;         // since the bench faulted
    QString faultText_;             // as the banner says it
};

}  // namespace tacto::gui
