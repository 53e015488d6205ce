// ScopeWorkspace.h - the oscilloscope page: the screen, with controls at its side, and spectrum and measurements below.
//
// Shows the captures of the open bench while it runs, captures from files, and captures from other parts of the
// program. "Hold" freezes the picture and does not affect the output: only STOP does.
//
// The user's choices (mode, trigger, record, scales, panels) are kept for the next start.
#pragma once

#include <QWidget>

#include "app/gui/scope/measurements/Reading.h"
#include "app/gui/scope/model/CapturePipe.h"
#include "app/gui/scope/model/RecordSearch.h"
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

    /// Called at 30 Hz while this page is visible, and also while it is hidden if setWatched(true) was called.
    void refresh(const Telemetry& telemetry);
    /// Restores the panels and columns of the first start.
    void resetLayout();
    /// True if another view shows what captureShown() reports: captures are then taken even while this page is hidden.
    void setWatched(bool watched);
    /// Reads a capture file in the background and shows it; puts the bench's captures on hold. Errors are shown on this
    /// page. Returns false if the file does not exist.
    bool openCaptureFile(const QString& path);
    /// Shows a capture that does not come from the bench, and puts the bench's captures on hold.
    void show(std::shared_ptr<const Capture> capture, const QString& source);
    void show(std::shared_ptr<const Capture> capture) { show(std::move(capture), tr("capture")); }
    using QWidget::show;

    /// The row of tools above the screen. A page of tabs can move this row into its own row.
    [[nodiscard]] QWidget* tools();

    /// Saves a picture (.png, .svg, .pdf) or, in the background, the visible data (.csv).
    void saveAs(const QString& path);
    [[nodiscard]] bool hasPicture() const { return model_.shown() != nullptr; }
    void askSavePicture();
    /// Returns errors as a sentence.
    [[nodiscard]] std::optional<QString> savePicture(const QString& path) const;
    void askSaveData();

    [[nodiscard]] ScopeMode mode() const noexcept { return acquisition_->mode(); }
    [[nodiscard]] bool running() const noexcept { return acquisition_->running(); }
    [[nodiscard]] ScopeModel& model() noexcept { return model_; }
    [[nodiscard]] ScopeScreen& screen() noexcept { return *screen_; }
    [[nodiscard]] MeasurementTable& table() noexcept { return *table_; }
    /// The readings that are shown on this page and in every MeasurementSummary.
    [[nodiscard]] ChosenReadings& readings() noexcept { return readings_; }
    [[nodiscard]] QSize minimumSizeHint() const override;
    /// The settings of the next capture.
    [[nodiscard]] ScopeSettings settings() const;

public slots:
    void setMode(tacto::gui::ScopeMode mode);
    void run();
    void hold();

signals:
    /// Reports every measured capture that comes to the screen; a MeasurementSummary shows it too.
    void captureShown(tacto::gui::ShownPtr shown);
    void fileAsked(const QString& path);  ///< this file is being read
    /// The user asked for a bench on the empty page: the window opens the simulated bench.
    void openBenchWanted();
    /// The user pressed the key for the drive: the window shows the drive's dock.
    void driveWanted();
    void markWanted();
    /// Asks the window to show the screen alone, or everything again.
    void plotOnlyWanted();

protected:
    void showEvent(QShowEvent* event) override;
    void hideEvent(QHideEvent* event) override;
    void dragEnterEvent(QDragEnterEvent* event) override;
    void dropEvent(QDropEvent* event) override;

private:
    void layOut();
    void connectTools();
    /// Adds the keys, which work wherever the focus is in the window while this page is visible: R run or hold, A auto,
    /// N normal, S single, T and L cursors, B box, D drive, F3 and Shift+F3 matches of the trigger, Ctrl+S saves the
    /// picture, Ctrl+Z undoes a zoom. For the keys of the screen see ScopeGestures.h.
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
    void goToMatch(int step);
    void showSpectrum();
    void showState();

    BenchController& controller_;
    CapturePipe pipe_;
    ScopeModel model_;
    RecordSearch search_{pipe_, model_};
    ChosenReadings readings_;
    std::unique_ptr<ScopeFiles> files_;
    int averages_ = 1;
    bool watched_ = false;

    // Constructed in the order in which the tab key visits them.
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
    TroubleLine* notOpened_ = nullptr;  ///< says why the last file was not opened, if nothing is shown
    ScopeColumns* columns_ = nullptr;
};

}  // namespace tacto::gui
