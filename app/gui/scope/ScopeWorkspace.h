// ScopeWorkspace.h - the oscilloscope: screen, controls beside it, spectrum and measurements below.
//
// Takes the captures of the open bench while it runs, opens captures from files, and shows what others hand it. "Hold"
// keeps the picture and touches no output: only STOP does that.
//
// The user's choices (mode, trigger, record, scales, panels) are remembered from one start to the next.
#pragma once

#include <QWidget>

#include "app/gui/scope/measurements/Reading.h"
#include "app/gui/scope/model/CapturePipe.h"
#include "app/gui/scope/model/ScopeModel.h"
#include "app/gui/scope/panels/ScopeAcquisition.h"

class QStackedWidget;

namespace tacto::gui {

class MeasurementTable;
class ScopeColumns;
class ScopeControls;
class ScopeFiles;
class ScopeGestures;
class ScopeScreen;
class ScopeStatus;
class ScopeTools;
class SpectrumPanel;
class TroubleLine;
struct PictureCaption;

class ScopeWorkspace final : public QWidget {
    Q_OBJECT
public:
    /// `controller` outlives this.
    explicit ScopeWorkspace(BenchController& controller, QWidget* parent = nullptr);
    ~ScopeWorkspace() override;

    /// Called at 30 Hz while this is visible, and also while it is not, after setWatched().
    void refresh(const Telemetry& telemetry);
    /// Panels and columns as at the first start.
    void resetLayout();
    /// Another view shows what captureShown() reports, so that captures are taken although this view is hidden.
    void setWatched(bool watched);
    /// Reads a capture file in the background and shows it; what goes wrong is said here. False when there is no such
    /// file. The bench's captures are on hold from then on.
    bool openCaptureFile(const QString& path);
    /// Shows a capture that is not the bench's; holds the bench's.
    void show(std::shared_ptr<const Capture> capture, const QString& source);
    void show(std::shared_ptr<const Capture> capture) { show(std::move(capture), tr("capture")); }
    using QWidget::show;

    /// The row of tools above the screen; a page of tabs may take it into its own row.
    [[nodiscard]] QWidget* tools();

    /// Picture by its ending (.png, .svg, .pdf), or the visible data (.csv, in the background).
    void saveAs(const QString& path);

    [[nodiscard]] ScopeMode mode() const noexcept { return acquisition_->mode(); }
    [[nodiscard]] bool running() const noexcept { return acquisition_->running(); }
    [[nodiscard]] ScopeModel& model() noexcept { return model_; }
    [[nodiscard]] ScopeScreen& screen() noexcept { return *screen_; }
    [[nodiscard]] MeasurementTable& table() noexcept { return *table_; }
    /// Which readings are shown, here and wherever else: a MeasurementSummary follows them.
    [[nodiscard]] ChosenReadings& readings() noexcept { return readings_; }
    [[nodiscard]] QSize minimumSizeHint() const override;
    /// The settings of the next capture.
    [[nodiscard]] ScopeSettings settings() const;

public slots:
    void setMode(tacto::gui::ScopeMode mode);
    void run();
    void hold();

signals:
    /// Every capture that comes to the screen, measured: a MeasurementSummary takes it.
    void captureShown(tacto::gui::ShownPtr shown);
    /// The empty workspace's next step: the window opens the simulated bench.
    void openBenchWanted();
    /// The key for the drive was pressed: the window shows its dock.
    void driveWanted();
    void markWanted();
    /// The screen without what is around it, or back.
    void plotOnlyWanted();

protected:
    void showEvent(QShowEvent* event) override;
    void hideEvent(QHideEvent* event) override;
    void dragEnterEvent(QDragEnterEvent* event) override;
    void dropEvent(QDropEvent* event) override;

private:
    void layOut();
    void connectTools();
    /// Wherever the focus is in the window while this is visible: R run or hold, A auto, N normal, S single, T and L
    /// cursors, B box, D drive, Ctrl+S saves the picture, Ctrl+Z goes a zoom back. The screen's own are in
    /// ScopeGestures.h.
    void addKeys();
    void connectModel();
    void connectPanels();
    void connectBench();
    void benchChanged();
    void take(const ShownPtr& shown);
    void applyMode(ScopeMode mode);
    void average();
    [[nodiscard]] PictureCaption caption() const;
    void tell(const QString& done, const QString& problem);
    void save() const;
    void restore();
    void say();
    void sayCursors();
    void showSpectrum();
    void showState();

    BenchController& controller_;
    CapturePipe pipe_;
    ScopeModel model_;
    ChosenReadings readings_;
    std::unique_ptr<ScopeFiles> files_;
    int averages_ = 1;
    bool watched_ = false;

    // Constructed in the order of the tab key.
    ScopeTools* tools_;
    ScopeStatus* status_;
    ScopeScreen* screen_;
    std::unique_ptr<ScopeGestures> gestures_;
    std::unique_ptr<ScopeAcquisition> acquisition_;
    std::unique_ptr<ScopeFeed> feed_;
    ScopeControls* controls_;
    SpectrumPanel* spectrum_;
    MeasurementTable* table_;
    QStackedWidget* stack_;
    TroubleLine* notOpened_ = nullptr;  ///< why the last file was not opened, where nothing is shown
    ScopeColumns* columns_ = nullptr;
};

}  // namespace tacto::gui
