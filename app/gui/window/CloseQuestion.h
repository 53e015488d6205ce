// CloseQuestion.h - what is asked before the window closes: a run that closing stopped, scripts that are not saved.
//
// The output is off before anything is asked (hazard H2): MainWindow::closeEvent() stops it and then comes here. A
// signal never asks (SignalClose.h).
#pragma once

#include <QMainWindow>
#include <functional>
#include <vector>

#include "app/gui/controller/BenchController.h"

namespace tacto::gui {

class ProtocolWorkspace;
class ScriptEditor;

class CloseQuestion final : public QObject {
    Q_OBJECT
public:
    using Runners = std::function<std::vector<ProtocolWorkspace*>()>;
    /// The window owns this. `runners`: those that exist now. `otherRuns`: whether a run goes on that is not theirs.
    CloseQuestion(BenchController& controller, QMainWindow& window, Runners runners, std::function<bool()> otherRuns);
    /// Whether a run is going on or about to begin.
    [[nodiscard]] bool runs() const;
    /// Whether the window may close at once. Otherwise a question is open, and its answer closes the window. `stopped`:
    /// a run that the closing stopped.
    [[nodiscard]] bool mayClose(bool stopped);
    /// Closes without a question; unsaved text is lost.
    void closeUnasked();

private:
    void askAboutRun();
    void askAboutScripts();
    void saveNext();
    void discard();
    [[nodiscard]] std::vector<ScriptEditor*> unsaved() const;

    BenchController& controller_;
    QMainWindow& window_;
    const Runners runners_;
    const std::function<bool()> otherRuns_;
    bool runAnswered_ = false;
    bool unasked_ = false;
};

}  // namespace tacto::gui
