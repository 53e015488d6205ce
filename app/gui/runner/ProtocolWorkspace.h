// ProtocolWorkspace.h - runs a protocol, as a path: wiring, known reference, settings, run, result, report. The steps
// stand at the left with their state, each has a page, and one button starts.
//
// With a name it is that protocol's workspace; without one the operator chooses among all of them.
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
    /// Thirty times a second: what its run says.
    void refresh();
    [[nodiscard]] bool running() const { return running_; }
    /// Whether a protocol was read, none runs here, and nothing is in the way of its run.
    [[nodiscard]] bool ready() const { return declaration_.has_value() && !running_ && obstacle_.isEmpty(); }
    /// Whether a script is being read: its form is not there yet.
    [[nodiscard]] bool reads() const { return reading_.busy(); }
    /// Sets a parameter of the form, by the name that the script has for it; one that it has not is left alone.
    void set(const std::string& parameter, const QString& text);
    /// The editor, where it holds changes that are not saved; null otherwise.
    [[nodiscard]] ScriptEditor* unsavedScript() const;
    /// Hides the path, unless something in it stands in the way of a run, or is asked.
    void showPlotOnly(bool only);
    /// The widget that chooses the plot of a calibration: RunViews::plotKind().
    [[nodiscard]] QWidget& plotKind();
    /// Does what the Run button does.
    void runAsked();
    /// Does what a click on the step does.
    void goTo(Step step);

signals:
    /// The answer of ready() may be another one.
    void readyChanged();
    /// A protocol was read, and the form shows its parameters as the script has them.
    void declaredAnew();
    /// A running protocol asks a question that must be seen here.
    void attentionWanted();
    /// The newest train of the running protocol.
    void captured(std::shared_ptr<const tacto::Capture> capture);
    /// Asks another part of the window to do it.
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
    void runNow();
    [[nodiscard]] bool anotherRuns() const;
    void ended(const std::shared_ptr<const FinishedRun>& run);
    void showBench();
    void goOn(NextStep next);
    void useProfile();
    void showButtons();
    void edit(const ProtocolSource& source, int line, const QString& why);
    void saved(const QString& path);
    [[nodiscard]] Result<RunOrder> order();

    BenchController& controller_;
    const QString fixed_;  ///< the one protocol, or empty
    ProtocolSource source_;
    std::optional<ProtocolDeclaration> declaration_;
    QString obstacle_;        // why it may not run: a limit that it would break, or a question without an answer
    bool byProfile_ = false;  // whether another profile would remove the obstacle
    AskedRun asked_;          // waits for the second step
    std::shared_ptr<const FinishedRun> last_;
    bool running_ = false;
    std::set<Step> seen_;  // the steps seen since this protocol was chosen
    bool plotOnly_ = false;
    std::uint64_t run_ = 0;  ///< its number

    QBoxLayout* layout_;
    QFrame* edge_ = nullptr;  // the line between the path and the page
    ProcedurePath* path_ = nullptr;
    ProtocolHead* head_ = nullptr;  // head, steps and panel are the path's
    StepList* steps_ = nullptr;
    RunPanel* panel_ = nullptr;
    PromptPanel* prompt_ = nullptr;
    ProcedurePages* pages_ = nullptr;
    ScriptEditor* editor_ = nullptr;
    QTimer previewLater_;
    ScriptReading reading_;  // Last: its thread ends first
};

}  // namespace tacto::gui
