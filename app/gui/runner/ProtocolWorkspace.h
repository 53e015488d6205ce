// ProtocolWorkspace.h - runs a protocol: settings and worst case before, points and log while, verdict and report
// after.
//
// With a name it is that protocol's workspace; without one the operator chooses among all of them.
//
// Thread-safety: the GUI thread.
#pragma once

#include <QBoxLayout>
#include <QComboBox>
#include <QElapsedTimer>
#include <QLabel>
#include <QPdfDocument>
#include <QPdfView>
#include <QPlainTextEdit>
#include <QScrollArea>
#include <QTabWidget>
#include <QTimer>

#include "app/gui/desk/BenchDesk.h"
#include "app/gui/runner/ScriptReading.h"
#include "app/gui/runner/TrialPlane.h"
#include "app/scripting/ProtocolLibrary.h"

namespace tacto::gui {

class CalibrationView;
class CaptureStrip;
class ExposureTable;
class LoadRows;
class ParameterForm;
class PromptPanel;
class ResultPanel;
class RunPanel;
class ScriptEditor;
class StepList;
class WiringPage;
class NotesPanel;
class WiringPanel;

class ProtocolWorkspace final : public QWidget {
    Q_OBJECT
public:
    ProtocolWorkspace(BenchDesk& desk, const QString& protocol, QWidget* parent = nullptr);
    void refresh(const Telemetry& telemetry);
    [[nodiscard]] bool running() const { return running_; }
    /// Whether a protocol was read, none runs here, and no limit is in the way of its strongest command.
    [[nodiscard]] bool ready() const { return declaration_.has_value() && !running_ && obstacle_.isEmpty(); }
    /// Sets a parameter of the form, by the name that the script has for it; one that it has not is left alone.
    void set(const std::string& parameter, const QString& text);
    /// As the Run button.
    void runAsked();

signals:
    /// The answer of ready() may be another one.
    void readyChanged();
    /// A protocol was read, and the form shows its parameters as the script has them.
    void declaredAnew();
    /// A running protocol asks a question that must be seen here.
    void attentionWanted();
    /// The newest train of the running protocol.
    void captured(std::shared_ptr<const tacto::Capture> capture);

protected:
    void resizeEvent(QResizeEvent* event) override;

private:
    [[nodiscard]] QWidget* buildPath();
    [[nodiscard]] QWidget* buildHead(QWidget* parent);
    [[nodiscard]] QWidget* buildPlots();
    [[nodiscard]] QWidget* buildTabs();
    void buildKeys();
    void placeWave();
    void giveRoom();
    enum class Plot { Trials, Loads, Calibration, Slides, None };
    [[nodiscard]] static TrialPlane::Features featuresOf(Plot plot);
    void showPlot(Plot plot);
    [[nodiscard]] Plot plotOf() const;

    void fillChooser(const QString& select);
    void choose(const QString& nameOrPath);
    void declared(const ProtocolSource& source, const Result<ProtocolDeclaration>& declaration);
    void goTo(int step);
    void judge();
    void preview();
    void setObstacle(const QString& why);
    void runNow();
    [[nodiscard]] bool anotherRuns() const;
    void ended(const FinishedRun& run);
    void showButtons();
    void edit(const ProtocolSource& source, int line, const QString& why);
    void saved(const QString& path);
    void openReport(const QString& pdf);
    [[nodiscard]] Result<RunOrder> order();

    BenchDesk& desk_;
    const QString fixed_;  ///< the one protocol, or empty
    ProtocolSource source_;
    std::optional<ProtocolDeclaration> declaration_;
    QString obstacle_;               // why it may not run: a limit that its strongest command would break
    std::optional<RunOrder> asked_;  // waits for the second step
    StopMark askedAt_;               // when the first was taken
    QElapsedTimer askedSince_;
    Plot plot_ = Plot::Trials;
    bool running_ = false;
    bool paused_ = false;  // asked for here, or seen
    bool seenPaused_ = false;

    StepList* steps_ = nullptr;
    QComboBox* chooser_ = nullptr;
    QLabel* purpose_ = nullptr;
    QScrollArea* before_ = nullptr;  // wiring and settings
    WiringPanel* wiring_ = nullptr;
    NotesPanel* notes_ = nullptr;
    ParameterForm* form_ = nullptr;
    RunPanel* panel_ = nullptr;
    PromptPanel* prompt_ = nullptr;
    QBoxLayout* plots_ = nullptr;
    TrialPlane* plane_ = nullptr;
    LoadRows* loads_ = nullptr;               // in the plane's place where a protocol measures loads
    CalibrationView* calibration_ = nullptr;  // and in its place where one calibrates
    CaptureStrip* wave_ = nullptr;
    QTabWidget* tabs_ = nullptr;
    WiringPage* drawing_ = nullptr;
    QWidget* worstPage_ = nullptr;
    ExposureTable* worst_ = nullptr;
    QLabel* worstSays_ = nullptr;
    QPlainTextEdit* log_ = nullptr;
    ResultPanel* result_ = nullptr;
    QPdfDocument* document_ = nullptr;
    QPdfView* pdf_ = nullptr;
    ScriptEditor* editor_ = nullptr;
    QTimer previewLater_;
    ScriptReading reading_;  // Last: its thread ends first
};

}  // namespace tacto::gui
