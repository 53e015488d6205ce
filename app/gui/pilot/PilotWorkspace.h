// PilotWorkspace.h - the workspace of those who run pilot sessions: a new rehearsal, the session with its two windows,
// its result.
//
// While a session runs the participant's window is a window of its own, full screen on the screen that was chosen;
// where there is one screen only, the operator's page is a strip in it, behind F2. A screen that goes switches the
// output off and holds the session back.
//
// Thread-safety: the GUI thread.
#pragma once

#include <QElapsedTimer>
#include <QLabel>
#include <QStackedWidget>
#include <QWidget>
#include <memory>

#include "app/gui/controller/BenchController.h"
#include "app/gui/pilot/ParticipantDesk.h"
#include "app/gui/pilot/RehearsalPage.h"

namespace tacto::gui {

class FactsCard;
class OperatorPage;
class OperatorStrip;
class ParticipantWindow;
class PilotResult;
class StepList;
class TheirScreen;

class PilotWorkspace final : public QWidget {
    Q_OBJECT
public:
    explicit PilotWorkspace(BenchController& controller, QWidget* parent = nullptr);
    ~PilotWorkspace() override;
    void refresh(const Telemetry& telemetry);
    [[nodiscard]] bool running() const { return running_; }
    /// Whether conditions, levels and trains are hidden from the operator now, in the whole window.
    [[nodiscard]] bool blind() const { return running_ && asked_.blind; }
    /// For the safety bar of a blind session: "Participant’s STOP: not pressed", and what else there is to say of it.
    [[nodiscard]] QString stopWords() const;
    /// Pause and Resume of the safety bar: a break at once, and its end.
    void pauseSession(bool pause) { pause ? breakNow() : wantBreak(false); }
    /// A stop by the participant's keys; false where no session of a person runs.
    bool stopAsParticipant(const char* by);
    /// Null while no session runs.
    [[nodiscard]] ParticipantWindow* participantWindow() const { return window_.get(); }

signals:
    void attentionWanted();
    void runningChanged();

protected:
    void resizeEvent(QResizeEvent* event) override;

private:
    enum Page { kNew, kSession, kResult };
    [[nodiscard]] QWidget* buildPath();
    [[nodiscard]] QWidget* buildSide();
    void connectPage();
    void connectStrip();
    void begin(const Rehearsal& asked, bool goOn);
    [[nodiscard]] Result<RunOrder> order(const Rehearsal& asked, bool goOn) const;
    void openWindow();
    void ended(const std::shared_ptr<const FinishedRun>& run);
    void show(const PilotScreen& screen);
    void asked(const PilotPrompt& prompt, quint64 id);
    void reach(int step);
    void showFacts();
    void showTheirs();
    void wantBreak(bool due);
    void breakNow();
    void keep(const QString& note);
    void giveKeys();
    void screenLost(const QString& name);
    [[nodiscard]] QString timeLeft() const;

    BenchController& controller_;
    ParticipantDesk desk_;
    std::unique_ptr<ParticipantWindow> window_;
    Rehearsal asked_;
    bool running_ = false;
    std::uint64_t run_ = 0;
    bool seenFault_ = false;
    bool paused_ = false;  ///< by a break
    int step_ = 0;
    QElapsedTimer stoppedAt_;  // by the participant
    int participantStops_ = 0, operatorStops_ = 0, faults_ = 0;
    PilotScreen screen_;

    QLabel* title_ = nullptr;
    QLabel* subtitle_ = nullptr;
    StepList* steps_ = nullptr;
    QLabel* left_ = nullptr;
    QLabel* leftWord_ = nullptr;
    QStackedWidget* pages_ = nullptr;
    RehearsalPage* new_ = nullptr;
    OperatorPage* page_ = nullptr;
    OperatorStrip* strip_ = nullptr;  ///< the window's, while it is there
    PilotResult* result_ = nullptr;
    QWidget* side_ = nullptr;
    FactsCard* who_ = nullptr;
    FactsCard* screenCard_ = nullptr;
    TheirScreen* theirs_ = nullptr;
    FactsCard* stops_ = nullptr;
};

}  // namespace tacto::gui
