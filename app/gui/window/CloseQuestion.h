// CloseQuestion.h - questions before the window closes: about a run that closing stopped, and about unsaved scripts.
//
// The output is off before any question (hazard H2): MainWindow::closeEvent() stops it first. A signal closes the
// window without questions (SignalClose.h).
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
    /// The window owns this. `runners` returns the present ones; `otherRuns`: true if any other run is going on.
    CloseQuestion(BenchController& controller, QMainWindow& window, Runners runners, std::function<bool()> otherRuns);
    /// True if a run is going on or about to begin.
    [[nodiscard]] bool runs() const;
    /// Returns true if the window may close at once. Otherwise opens a question; its answer closes the window.
    /// `stopped`: closing has stopped a run.
    [[nodiscard]] bool mayClose(bool stopped);
    [[nodiscard]] bool unasked() const { return unasked_; }  ///< true during closeUnasked()
    /// Closes the window without a question; unsaved text is lost.
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
