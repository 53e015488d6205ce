// RunViews.h - the views of a run: its main plot while it runs; afterwards the verdict above the plot, further views
// with tables and log, and the next steps below.
#pragma once

#include <QButtonGroup>
#include <QPlainTextEdit>
#include <QPushButton>
#include <QStackedWidget>
#include <QVBoxLayout>
#include <QWidget>
#include <filesystem>

#include "app/gui/controller/SideWork.h"
#include "app/gui/runner/NextSteps.h"
#include "app/gui/runner/TrialPlane.h"
#include "app/gui/theme/PlotPicture.h"
#include "app/scripting/engine/ProtocolDeclaration.h"

class QSplitter;

namespace tacto::gui {

class CalibrationView;
class CaptureStrip;
class DisclosedPanel;
class LimitMatrixView;
class LoadRows;
class PictureTools;
class ResultHead;
class ResultTables;
class SheetView;

class RunViews final : public QWidget {
    Q_OBJECT
public:
    using Plot = ProtocolView;
    enum View { kPlot, kTables, kWaveform, kLog };

    explicit RunViews(QWidget* parent = nullptr);
    void showPlot(Plot plot);
    /// Shows or hides the verdict and the next steps.
    void showResult(bool result);
    void showView(View view);

    /// Empties the views for a run of the protocol with this title and these parameters.
    void begin(Plot plot, const QString& title, const nlohmann::json& parameters);
    /// Sets the devices of the run, for the captions and watermarks of its pictures.
    void setDevices(const std::vector<SessionDevice>& devices, bool simulated);
    void take(const RunFeed& feed);
    /// Shows the results, which may have any shape. Returns a sentence if a view cannot show them; otherwise empty.
    [[nodiscard]] QString end(const FinishedRun& run);
    /// Returns the verdict, such as "PASS"; empty before the end.
    [[nodiscard]] QString word() const;
    /// True if limits were judged on loads.
    [[nodiscard]] bool showsLimits() const;
    /// Returns the widget that chooses the plot of a calibration: CalibrationView::plotKind().
    [[nodiscard]] QWidget& plotKind();

signals:
    void scriptErrorChosen(int line, const QString& why);
    void nextChosen(tacto::gui::NextStep step);
    void reportMenuWanted(QMenu& menu);  ///< NextStepBar::reportMenuWanted()
    void plotOnlyWanted();

private:
    [[nodiscard]] QWidget* buildPlots();
    [[nodiscard]] QWidget* buildBar();
    void addPictureTools(QBoxLayout& row);
    [[nodiscard]] PictureCaption caption() const;
    /// Returns the view shown if it is a picture; null for tables and text.
    [[nodiscard]] QWidget* pictured() const;
    [[nodiscard]] Still picture() const;
    void showPictureTools();
    void arrange();
    void arrangeSoon();
    void showFigure(const std::filesystem::path& session);
    /// Position of a safety check's tracing.
    enum class Tracing { Beside, Below, OwnView };
    void placeTracing(bool judged);
    /// Shows the strongest train on the load of a cell as the tracing.
    void trace(const QString& limit, const QString& load, const QString& unit);

    Plot plot_ = Plot::Trials;
    QString title_;                  // the protocol's title
    QString devices_;                // the names of the devices
    bool simulated_ = false;         // true if the devices are simulated
    QDateTime ended_;                // invalid while the run goes on
    std::filesystem::path session_;  // the session of the run that has ended
    bool showsResult_ = false;
    QVBoxLayout* body_ = nullptr;  // head and views, above the bar
    ResultHead* head_ = nullptr;
    QStackedWidget* views_ = nullptr;
    QBoxLayout* plots_ = nullptr;
    TrialPlane* plane_ = nullptr;
    QWidget* figured_ = nullptr;  // after the end replaces the plane by the figure that the result is read from
    QLabel* figureTitle_ = nullptr;
    SheetView* sheet_ = nullptr;
    bool hasFigure_ = false;
    LoadRows* loads_ = nullptr;            // replaces the plane if a protocol measures loads
    QSplitter* judged_ = nullptr;          // the limits and their results
    LimitMatrixView* matrix_ = nullptr;    // the limits for each load
    DisclosedPanel* disclosed_ = nullptr;  // outputs to disclose, next to the limits or below
    Tracing tracing_ = Tracing::Below;
    bool arrangesSoon_ = false;
    bool dragged_ = false;                    // the operator parted limits and tracing by hand
    CalibrationView* calibration_ = nullptr;  // replaces all of these for a calibration protocol
    QLabel* none_ = nullptr;
    CaptureStrip* wave_ = nullptr;
    ResultTables* tables_ = nullptr;
    QPlainTextEdit* log_ = nullptr;
    QBoxLayout* bar_ = nullptr;  // the next steps and the view chooser
    NextStepBar* next_ = nullptr;
    QWidget* viewRow_ = nullptr;
    QWidget* toolRow_ = nullptr;
    PictureTools* pictures_ = nullptr;
    QButtonGroup* choices_ = nullptr;
    SideWork reading_;
};

}  // namespace tacto::gui
