// LiveWorkspace.h - what the finger feels and what the skin would get, now.
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
    /// Thirty to sixty times a second. Takes what came either way; draws when `visible`.
    void refresh(const Telemetry& telemetry, bool visible);
    /// A folder with recording.json, or such a file, replayed into the simulated stimulator. False, and
    /// When it is not a recording, refusedRecording() says why.
    bool openRecording(const QString& path);
    /// Opens the encoding profile's editor, which is its own owner, at the field `key` of a profile's file.
    void editProfile(const QString& key = {});
    /// The row of tools above the plots; a page of tabs may take it into its own row.
    [[nodiscard]] QWidget* tools() { return tools_; }
    /// The strips alone; a line above them says when the sensor's samples are old.
    void showPlotOnly(bool only);
    [[nodiscard]] const LiveHistory& history() const { return history_; }
    [[nodiscard]] const StripPlots& plots() const { return *strips_; }

signals:
    void refusedRecording(const QString& why);
    /// Asks to mark this moment in the recording.
    void markWanted();
    /// The plots without what is around them, or back.
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
    std::optional<double> pendingSpeed_;  // the speed that was ordered here for a bench that is not open yet
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
    ElidedLabel* staleLine_ = nullptr;  // where the tools with health_ are hidden
    QSplitter* split_ = nullptr;
    QScrollArea* side_ = nullptr;
    bool plotOnly_ = false;
    QElapsedTimer sinceReading_, sincePlane_, sinceSide_;
    std::vector<float> newest_;  // reused
};

}  // namespace tacto::gui
