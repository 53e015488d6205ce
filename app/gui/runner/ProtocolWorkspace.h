// ProtocolWorkspace.h - runs a protocol in steps: wiring, known reference, settings, run, result, report. The steps
// with their states are at the left, each has a page, and one button starts the run.
//
// With a name this is the workspace of that protocol; without one the operator chooses among all protocols.
#pragma once

#include <QBoxLayout>
#include <QFrame>
#include <QTimer>
#include <set>

#include "app/gui/runner/AskedRun.h"
#include "app/gui/runner/NextSteps.h"
#include "app/gui/runner/ProcedurePages.h"
#include "app/gui/runner/ScriptEditor.h"
#include "app/scripting/engine/ProtocolLibrary.h"

namespace tacto::gui {

class ProcedurePath;
class PromptPanel;
class ProtocolHead;
class RunPanel;
class ScriptEditor;
class StepList;

class ProtocolWorkspace final : public QWidget {
    Q_OBJECT
public:
    ProtocolWorkspace(BenchController& controller, const QString& protocol, QWidget* parent = nullptr);
    /// Shows the news of the run; called thirty times a second.
    void refresh();
    [[nodiscard]] bool running() const { return running_; }
    /// The written report of the run that ended last; empty if there is none.
    [[nodiscard]] QString report() const;
    /// True if a protocol has been read, none runs here, and nothing prevents a run.
    [[nodiscard]] bool ready() const { return declaration_.has_value() && !running_ && obstacle_.isEmpty(); }
    /// True while a script is being read: its form does not exist yet.
    [[nodiscard]] bool reads() const { return reading_.busy(); }
    /// Proposes a value of a parameter by its name in the script; does nothing if there is none of that name.
    void propose(const std::string& parameter, const QString& text);
    /// Returns the editor if it has unsaved changes; otherwise null.
    [[nodiscard]] ScriptEditor* unsavedScript() const;
    /// Hides the path, unless the path shows an obstacle to a run, or a question.
    void showPlotOnly(bool only);
    /// Returns the widget that chooses the plot of a calibration: RunViews::plotKind().
    [[nodiscard]] QWidget& plotKind();
    /// Does the same as the Run button.
    void runAsked();
    /// Does the same as a click on the step.
    void goTo(Step step);

signals:
    /// The result of ready() may have changed.
    void readyChanged();
    /// A protocol has been read, and the form shows its parameters with the script's values.
    void declaredAnew();
    /// A running protocol asks a question, so this workspace must be shown.
    void attentionWanted();
    /// The newest train of the running protocol.
    void captured(std::shared_ptr<const tacto::Capture> capture);
    /// The following signals ask another part of the window for an action.
    void profileChangeWanted();
    void sessionWanted(const QString& path);
    void safetyCheckWanted();
    void liveWanted();
    void plotOnlyWanted();

private:
    void arrange();
    void showPath();
    void connectPath();
    void connectPages();

    void fillChooser(const QString& select);
    void choose(const QString& nameOrPath);
    void declared(const ProtocolSource& source, const Result<ProtocolDeclaration>& declaration);
    void showStep(Step step);
    void showSetup();
    void judge();
    void withdraw();
    void preview();
    void setObstacle(const QString& why, bool byProfile);
    /// Why a typed value is refused: of the settings, else of the wiring. Empty: all can be read.
    [[nodiscard]] QString refusal() const;
    /// `resetFault`: as in RunOrder.
    void ask(bool resetFault);
    void runNow();
    [[nodiscard]] bool anotherRuns() const;
    void ended(const std::shared_ptr<const FinishedRun>& run);
    void showBench();
    void goOn(NextStep next);
    void useProfile();
    void showReport();
    void showButtons();
    void edit(const ProtocolSource& source, int line, const QString& why);
    void saved(const QString& path);
    [[nodiscard]] Result<RunOrder> order();

    BenchController& controller_;
    const QString fixed_;  ///< name of the one protocol, or empty to choose
    ProtocolSource source_;
    std::optional<ProtocolDeclaration> declaration_;
    QString obstacle_;        // why a run is not allowed: a limit would be exceeded, or an answer is missing
    bool byProfile_ = false;  // true if another profile would remove the obstacle
    AskedRun asked_;          // waits for the second step
    std::shared_ptr<const FinishedRun> last_;
    bool running_ = false;
    bool wantsReport_ = false;  ///< the report is to be shown once it is drawn
    bool refused_ = false;      // a typed value is refused
    std::set<Step> seen_;       // the steps seen since this protocol was chosen
    bool plotOnly_ = false;
    std::uint64_t run_ = 0;  ///< number of the run

    QBoxLayout* layout_;
    QFrame* edge_ = nullptr;  // the line between the path and the page
    ProcedurePath* path_ = nullptr;
    ProtocolHead* head_ = nullptr;  // head, steps and panel belong to path_
    StepList* steps_ = nullptr;
    RunPanel* panel_ = nullptr;
    PromptPanel* prompt_ = nullptr;
    ProcedurePages* pages_ = nullptr;
    ScriptEditor* editor_ = nullptr;
    QTimer previewLater_;
    ScriptReading reading_;  // declared last: its thread ends first
};

}  // namespace tacto::gui
