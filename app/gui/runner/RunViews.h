// RunViews.h - what a run shows: its main plot while it runs; at its end the verdict above the plot, the tables and the
// log behind it, and the next steps below.
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

class RunViews final : public QWidget {
    Q_OBJECT
public:
    using Plot = ProtocolView;
    enum View { kPlot, kTables, kWaveform, kLog };

    explicit RunViews(QWidget* parent = nullptr);
    void showPlot(Plot plot);
    /// Shows or hides the result's head and what comes next.
    void showResult(bool result);
    void showView(View view);

    /// Empty, for a run of the protocol of that title with these parameters.
    void begin(Plot plot, const QString& title, const nlohmann::json& parameters);
    /// The devices of the run, for its pictures and watermarks.
    void setDevices(const std::vector<SessionDevice>& devices, bool simulated);
    void take(const RunFeed& feed);
    /// Results may have any shape: the sentence says where they lack the shape that a view shows; else it is empty.
    [[nodiscard]] QString end(const FinishedRun& run);
    /// "PASS"; empty before the end.
    [[nodiscard]] QString word() const;
    /// Whether limits were judged on loads.
    [[nodiscard]] bool showsLimits() const;
    /// The widget that chooses the plot of a calibration: CalibrationView::plotKind().
    [[nodiscard]] QWidget& plotKind();

signals:
    void scriptErrorChosen(int line, const QString& why);
    void nextChosen(tacto::gui::NextStep step);
    void plotOnlyWanted();

private:
    [[nodiscard]] QWidget* buildPlots();
    [[nodiscard]] QWidget* buildBar();
    void addPictureTools(QBoxLayout& row);
    [[nodiscard]] PictureCaption caption() const;
    /// The view that is a picture; none of tables and words.
    [[nodiscard]] QWidget* pictured() const;
    [[nodiscard]] Still picture() const;
    void showPictureTools();
    void arrange();
    /// Where the tracing of a safety check stands.
    enum class Tracing { Beside, Below, OwnView };
    void placeTracing(bool judged);
    /// The strongest train on the load of a cell, in the tracing.
    void trace(const QString& limit, const QString& load, const QString& unit);

    Plot plot_ = Plot::Trials;
    QString title_;                  // the protocol's title
    QString devices_;                // their names
    bool simulated_ = false;         // whether the devices are simulated
    QDateTime ended_;                // invalid while it runs
    std::filesystem::path session_;  // the session of the run that ended
    bool showsResult_ = false;
    QVBoxLayout* body_ = nullptr;  // head and views, above the bar
    ResultHead* head_ = nullptr;
    QStackedWidget* views_ = nullptr;
    QBoxLayout* plots_ = nullptr;
    TrialPlane* plane_ = nullptr;
    LoadRows* loads_ = nullptr;            // takes the plane's place where a protocol measures loads
    QSplitter* judged_ = nullptr;          // the limits and their results
    LimitMatrixView* matrix_ = nullptr;    // limits by loads,
    DisclosedPanel* disclosed_ = nullptr;  // outputs to disclose, beside or below the limits where there is room
    Tracing tracing_ = Tracing::Below;
    CalibrationView* calibration_ = nullptr;  // takes the place of all this where a protocol calibrates
    QLabel* none_ = nullptr;
    CaptureStrip* wave_ = nullptr;
    ResultTables* tables_ = nullptr;
    QPlainTextEdit* log_ = nullptr;
    QBoxLayout* bar_ = nullptr;  // the next steps, and the choice of a view
    NextStepBar* next_ = nullptr;
    QWidget* viewRow_ = nullptr;
    QWidget* toolRow_ = nullptr;
    PictureTools* pictures_ = nullptr;
    QButtonGroup* choices_ = nullptr;
    SideWork reading_;
};

}  // namespace tacto::gui
