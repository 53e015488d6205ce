// LiveWorkspace.h - what the finger feels and what the skin would get, now.
//
// Thread-safety: the GUI thread.
#pragma once

#include <QLabel>
#include <QStackedWidget>
#include <QWidget>

#include "app/gui/desk/BenchDesk.h"
#include "app/gui/live/LiveHistory.h"

namespace tacto::gui {

class DrivePanel;
class StripPlots;
class TactilePlane;
class TaxelMap;

class LiveWorkspace final : public QWidget {
    Q_OBJECT
public:
    explicit LiveWorkspace(BenchDesk& desk, QWidget* parent = nullptr);
    /// Thirty times a second. Takes what came either way; draws when `visible`.
    void refresh(const Telemetry& telemetry, bool visible);
    /// A folder with recording.json, or such a file, replayed into the simulated stimulator. False, and the desk's
    /// window was told why, when it is no recording.
    bool openRecording(const QString& path);
    [[nodiscard]] const LiveHistory& history() const { return history_; }

signals:
    void refusedRecording(const QString& why);

private:
    [[nodiscard]] QWidget* buildBench();
    [[nodiscard]] QWidget* buildSide();
    [[nodiscard]] QWidget* buildFoot();
    void begin();
    void showHealth(const Telemetry& telemetry);
    void showCommand(const Telemetry& telemetry);
    void openSimulated();
    void chooseRecording();
    void editProfile();

    BenchDesk& desk_;
    LiveHistory history_;
    std::shared_ptr<BenchTap> tap_;
    QStackedWidget* stack_;
    StripPlots* strips_ = nullptr;
    TaxelMap* taxels_ = nullptr;
    TactilePlane* plane_ = nullptr;
    DrivePanel* drive_ = nullptr;
    QLabel* command_ = nullptr;
    QLabel* health_ = nullptr;
    int frame_ = 0;
};

}  // namespace tacto::gui
