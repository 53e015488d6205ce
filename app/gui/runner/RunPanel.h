// RunPanel.h - the button that runs a protocol, the progress and time left of the run, and what prevents a run. Pause
// and STOP are only in the safety bar.
#pragma once

#include <QBoxLayout>
#include <QElapsedTimer>
#include <QLabel>
#include <QProgressBar>
#include <QPushButton>
#include <QWidget>

#include "app/gui/theme/Labels.h"
#include "app/scripting/engine/ScriptRun.h"
#include "core/base/Units.h"

namespace tacto::gui {

/// Estimates the time left from the steps done so far, without pauses and the time before the first step.
class TimeLeft {
public:
    void begin() { *this = {}; }
    /// `now_s`: seconds since the run began. Starts again when another list of steps begins.
    void note(const ScriptProgress& progress, bool paused, double now_s);
    /// Returns nothing before the first step is done, or if no step is left.
    [[nodiscard]] std::optional<double> seconds() const;

private:
    std::string label_;
    std::size_t firstDone_ = 0, done_ = 0, total_ = 0;
    double seenAt_s_ = -1;
    double worked_s_ = 0;        // work in seconds since this list's first report, without pauses
    double workedAtStep_s_ = 0;  // worked_s_ at the end of the newest step
};

class RunPanel final : public QWidget {
    Q_OBJECT
public:
    explicit RunPanel(QWidget* parent = nullptr);
    /// Sets whether there is a protocol to run. `obstacle`: a sentence that says why it may not run; empty if it may.
    /// `byProfile`: the profile is the obstacle, and a button to change it is shown.
    void setReady(bool ready, const QString& obstacle = {}, bool byProfile = false);
    /// Sets whether Run is the highlighted button; when a result is shown, another button is highlighted.
    void setLeading(bool leading);
    /// Shows a sentence about what prevents the run; empty for none. `line`: its line in the script; 0 for none.
    void say(const QString& what, int line = 0);
    /// Asks for the second step, which confirms a run on hardware; confirmed() follows if the operator agrees.
    void askToArm(const QString& what);
    void withdrawQuestion();
    void begin();
    /// Called at each refresh during a run. `progress`: null if nothing is new. `waiting`: the run awaits an answer.
    void show(const ScriptProgress* progress, bool paused, bool waiting);
    /// `benchTime`: the time that passed on a simulated bench, which has its own clock.
    void end(bool early, std::optional<Seconds> benchTime = {});
    enum class Open { None, Bench, WithFaults };
    /// Sets whether a bench is open, which a run would close, maybe with simulated faults that the run would not have;
    /// and whether a run closed it, so it can be opened again.
    void setBench(Open open, bool closedByRun);
    /// Puts the controls in one line, for a path shown as a row; the owner then places words().
    void setAcross(bool across);
    /// Returns the widget with the obstacle, the question and their buttons.
    [[nodiscard]] QWidget& words() noexcept { return *words_; }
    /// True if words() shows anything.
    [[nodiscard]] bool speaks() const;

signals:
    void runWanted();
    void confirmed();
    void lineWanted(int line, const QString& why);
    void profileChangeWanted();
    void openAgainWanted();

private:
    void buildWords();
    [[nodiscard]] QWidget* buildQuestion();
    void showButtons();
    void sayHowFar(const QString& format, const QString& left);
    void sayLeft();
    QBoxLayout* layout_;
    QWidget* words_;
    TroubleLine* obstacle_;
    TroubleLine* trouble_;
    QPushButton* toLine_;
    QPushButton* changeProfile_;
    QLabel* closed_;
    QPushButton* openAgain_;
    QWidget* question_;
    QLabel* questionText_ = nullptr;
    QPushButton* arm_ = nullptr;
    QPushButton* back_ = nullptr;  // cancels the question, and has the focus
    QPushButton* run_;
    QProgressBar* bar_;
    QLabel* left_;
    QElapsedTimer since_;
    TimeLeft timeLeft_;
    ScriptProgress progress_;
    QString said_;
    QString howLong_;  // time left or time taken, as text
    Open benchOpen_ = Open::None;
    int line_ = 0;
    bool ready_ = false;
    bool running_ = false;
    bool across_ = false;
};

}  // namespace tacto::gui
