// RunPanel.h - the button that runs a protocol, the progress of the run with its time left, and what prevents a run.
// Pause and STOP stand in the safety bar alone.
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

/// Time left from what the steps so far took: pauses and what came before the first step do not count.
class TimeLeft {
public:
    void begin() { *this = {}; }
    /// `now_s`: seconds since the run began. Starts over when another list of steps begins.
    void note(const ScriptProgress& progress, bool paused, double now_s);
    /// Nothing before the first step is through, or when no step is to come.
    [[nodiscard]] std::optional<double> seconds() const;

private:
    std::string label_;
    std::size_t firstDone_ = 0, done_ = 0, total_ = 0;
    double seenAt_s_ = -1;
    double worked_s_ = 0;        // seconds of work since the first report of this list, without pauses
    double workedAtStep_s_ = 0;  // when the newest step was through
};

class RunPanel final : public QWidget {
    Q_OBJECT
public:
    explicit RunPanel(QWidget* parent = nullptr);
    /// Whether there is something to run. `obstacle`: the sentence that says why it may not run; empty: it may. Where
    /// the profile is in the way, it can be changed from here.
    void setReady(bool ready, const QString& obstacle = {}, bool byProfile = false);
    /// Run is the leading button; once a result is shown another one leads, and Run stays for running again.
    void setLeading(bool leading);
    /// A sentence in the way of the run; empty for none. `line` of the script that it is about; 0 for none.
    void say(const QString& what, int line = 0);
    /// The second deliberate step before a run on hardware: confirmed() follows, or nothing.
    void askToArm(const QString& what);
    void withdrawQuestion();
    void begin();
    /// Called at each refresh while a run is on. `progress` may be null: nothing new. `waiting`: for an answer.
    void show(const ScriptProgress* progress, bool paused, bool waiting);
    /// `benchTime`: the time of a simulated bench, which is its own.
    void end(bool early, std::optional<Seconds> benchTime = {});
    /// A run closes the bench that is open; afterwards it can be opened again.
    void setBench(bool open, bool closedByRun);
    /// Puts the controls into one line, for a path that is a row; the owner then places words().
    void setAcross(bool across);
    /// The obstacle, the question, and the buttons that belong to them.
    [[nodiscard]] QWidget& words() noexcept { return *words_; }
    /// Whether words() has something to say.
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
    QPushButton* back_ = nullptr;  // goes back from the question, and takes the focus
    QPushButton* run_;
    QProgressBar* bar_;
    QLabel* left_;
    QElapsedTimer since_;
    TimeLeft timeLeft_;
    ScriptProgress progress_;
    QString said_;
    QString howLong_;  // left, or taken
    bool benchOpen_ = false;
    int line_ = 0;
    bool ready_ = false;
    bool running_ = false;
    bool across_ = false;
};

}  // namespace tacto::gui
