// ScopeWorkspace.h - the oscilloscope: screen, controls beside it, measurements below.
//
// Takes the captures of the open bench while it runs, opens captures from files, and shows what others hand it. "Hold"
// keeps the picture and touches no output: only STOP does that.
//
// What the user chose (mode, trigger, record, scales, panels) is remembered from one start to the next.
//
// Keys: A auto, N normal, S single; the screen's own are in ScopeView.h.
//
// Thread-safety: the GUI thread.
#pragma once

#include <QElapsedTimer>
#include <QWidget>

#include "app/gui/desk/BenchDesk.h"
#include "app/gui/scope/CapturePipe.h"

class QLabel;
class QMenu;
class QPushButton;
class QSplitter;
class QStackedWidget;
class QToolButton;
class QButtonGroup;
class QBoxLayout;

namespace tacto::gui {

class AcquisitionPanel;
class LanePanel;
class MeasurementTable;
class ScopeView;
class SpectrumPanel;
class ViewPanel;

enum class ScopeMode {
    Auto,    ///< the level follows the commanded amplitude; untriggered when no trigger comes
    Normal,  ///< the level is the user's
    Single,  ///< one capture, then hold
    Roll,    ///< captures one after the other on the session's time
};

class ScopeWorkspace final : public QWidget {
    Q_OBJECT
public:
    /// `desk` outlives this.
    explicit ScopeWorkspace(BenchDesk& desk, QWidget* parent = nullptr);
    ~ScopeWorkspace() override;

    /// At 30 Hz while this is visible; also while it is not, where setWatched().
    void refresh(const Telemetry& telemetry);
    /// Another view shows what captureShown() tells: captures are taken though this is not visible.
    void setWatched(bool watched);
    /// Reads a capture file in the background and shows it; what goes wrong is said here. False when there is no such
    /// file. The bench's captures are on hold from then on.
    bool openCaptureFile(const QString& path);
    /// "*.csv *.sr …": the files that can be opened, for a dialog's filter.
    [[nodiscard]] static QString captureGlobs();
    /// Shows a capture that is not the bench's; holds the bench's.
    void show(std::shared_ptr<const Capture> capture, const QString& source);
    void show(std::shared_ptr<const Capture> capture) { show(std::move(capture), tr("capture")); }
    using QWidget::show;

    /// Picture by its ending (.png, .svg, .pdf), or the visible data (.csv, in the background).
    void saveAs(const QString& path);

    [[nodiscard]] ScopeMode mode() const noexcept { return mode_; }
    [[nodiscard]] bool running() const noexcept { return running_; }
    [[nodiscard]] ScopeView& view() noexcept { return *view_; }
    [[nodiscard]] MeasurementTable& table() noexcept { return *table_; }
    [[nodiscard]] QSize minimumSizeHint() const override;
    /// What the next capture is asked with.
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

protected:
    void showEvent(QShowEvent* event) override;
    void hideEvent(QHideEvent* event) override;
    void resizeEvent(QResizeEvent* event) override;
    void changeEvent(QEvent* event) override;
    void dragEnterEvent(QDragEnterEvent* event) override;
    void dropEvent(QDropEvent* event) override;

private:
    QWidget* buildTools();
    QWidget* buildControls();
    QWidget* buildEmpty();
    void buildMenu();
    QToolButton* tool(const QString& text, const QString& tip, bool checkable);
    void connectView();
    void benchChanged();
    void take(const ShownPtr& shown);
    void request();
    void followAmplitude();
    void applyMode(ScopeMode mode);
    void stopped(const QString& why);
    [[nodiscard]] std::optional<Seconds> untriggeredAfter() const;
    [[nodiscard]] QString waitingText(const QString& level) const;
    void fitControls();
    void save() const;
    void restore();
    void say();
    void sayCursors();
    void showSpectrum();
    void showState();
    [[nodiscard]] QString statusText() const;
    [[nodiscard]] QString outputText() const;
    [[nodiscard]] QString triggerLane() const;
    [[nodiscard]] bool benchCanCapture() const;
    void askOpen();
    void askSave(const QString& filter, const QString& ending);
    void copyPicture();
    void copyData();

    BenchDesk& desk_;
    CapturePipe pipe_;
    ScopeMode mode_ = ScopeMode::Auto;
    bool wanted_ = true;  ///< runs as soon as there is a bench
    bool running_ = false;
    bool watched_ = false;
    bool failed_ = false;  ///< the oscilloscope stopped by itself; until the user lets it run again
    Telemetry telemetry_;
    ScopeSettings requested_;
    std::optional<Seconds> requestedWait_;
    QElapsedTimer sinceRequest_;
    QElapsedTimer sinceCapture_;
    QString problem_;
    QString done_;  ///< what was saved
    int taken_ = 0;

    QStackedWidget* stack_ = nullptr;
    QSplitter* plots_ = nullptr;
    QWidget* controls_ = nullptr;
    bool controlsWanted_ = true;
    bool controlsForced_ = false;  ///< asked for where there is no room for them
    ScopeView* view_ = nullptr;
    SpectrumPanel* spectrum_ = nullptr;
    MeasurementTable* table_ = nullptr;
    AcquisitionPanel* acquisition_ = nullptr;
    ViewPanel* viewPanel_ = nullptr;
    QPushButton* run_ = nullptr;
    QButtonGroup* modes_ = nullptr;
    QToolButton* undo_ = nullptr;
    QToolButton* box_ = nullptr;
    QToolButton* timeCursors_ = nullptr;
    QToolButton* levelCursors_ = nullptr;
    QToolButton* cancelOpen_ = nullptr;
    QToolButton* controlsShown_ = nullptr;
    QLabel* status_ = nullptr;
    QLabel* readout_ = nullptr;
    QMenu* menu_ = nullptr;
};

}  // namespace tacto::gui
