// LiveWorkspace.h - workspace that shows what the finger feels and what the skin would get, live.
#pragma once

#include <QComboBox>
#include <QElapsedTimer>
#include <QLabel>
#include <QPushButton>
#include <QScrollArea>
#include <QSplitter>
#include <QStackedWidget>
#include <QWidget>

#include "app/gui/controller/BenchController.h"
#include "app/gui/live/LiveHistory.h"
#include "app/gui/theme/PlotPicture.h"

namespace tacto::gui {

class CommandPanel;
class ElidedLabel;
class PictureTools;
class RigPanel;
class StripPlots;
class TactilePlane;
class TaxelMap;
class ToolRow;

class LiveWorkspace final : public QWidget {
    Q_OBJECT
public:
    explicit LiveWorkspace(BenchController& controller, QWidget* parent = nullptr);
    /// Called 30 to 60 times a second. Takes new data in any case, but draws only if `visible`.
    void refresh(const Telemetry& telemetry, bool visible);
    /// Replays a recording (its folder or its recording.json) into the simulated stimulator. Returns false if it is not
    /// a recording; refusedRecording() then says why.
    bool openRecording(const QString& path);
    /// Opens the encoding profile's editor, which deletes itself when closed, at the field `key` of a profile file.
    void editProfile(const QString& key = {});
    /// Returns the row of tools above the plots; a page with tabs may move it into its own row.
    [[nodiscard]] QWidget* tools() { return tools_; }
    /// Shows the strips alone; a line above them warns if the sensor's samples are old.
    void showPlotOnly(bool only);
    [[nodiscard]] const LiveHistory& history() const { return history_; }
    [[nodiscard]] const StripPlots& plots() const { return *strips_; }

signals:
    void refusedRecording(const QString& why);
    /// Asks to mark this moment in the recording.
    void markWanted();
    /// Asks to hide or show everything around the plots.
    void plotOnlyWanted();

private:
    enum Page { kEmpty, kOpening, kBench };
    [[nodiscard]] QWidget* buildEmpty();
    [[nodiscard]] QWidget* buildBench();
    void fillSide();
    void buildTools();
    void addViewTools(ToolRow& row);
    [[nodiscard]] PictureCaption caption() const;
    void fit();
    void begin();
    [[nodiscard]] Telemetry asDriven(Telemetry telemetry) const;
    void showPlane(const Telemetry& telemetry);
    void showSide(const Telemetry& telemetry);
    void showTaxels(bool stale);
    void readCapture(const Capture& capture);
    void openOrder(LiveOrder order);
    void openSimulated();
    void chooseRecording();
    void replayExample();
    void replayAgain();

    BenchController& controller_;
    LiveHistory history_;
    std::shared_ptr<BenchTap> tap_;
    std::optional<double> pendingSpeed_;  // the speed ordered for a bench that is not open yet
    QStackedWidget* stack_;
    StripPlots* strips_ = nullptr;
    TaxelMap* taxels_ = nullptr;
    TactilePlane* plane_ = nullptr;
    QLabel* where_ = nullptr;
    CommandPanel* command_ = nullptr;
    RigPanel* rig_ = nullptr;
    QPushButton* freeze_ = nullptr;
    QWidget* tools_ = nullptr;
    ElidedLabel* health_ = nullptr;
    ElidedLabel* staleLine_ = nullptr;  // shown if the tools, with health_, are hidden
    QSplitter* split_ = nullptr;
    QScrollArea* side_ = nullptr;
    bool plotOnly_ = false;
    QElapsedTimer sinceReading_, sincePlane_, sinceSide_;
    std::vector<float> newest_;  // buffer, reused
};

}  // namespace tacto::gui
