// SessionConduct.h - runs a pilot session in the window: confirms the code, shows the participant's window and the
// operator's strip, handles stops, breaks and notes, and ends the session.
//
// The participant's window is shown full screen on the chosen screen. If there is only one screen, the operator's page
// is a strip in that window, opened by F2. If the screen goes or the participant's window is closed, the output goes
// off and the session pauses until the window is shown again. Unplugging a game pad or foot switch switches the output
// off and begins an operator's break. An abort switches the output off and then asks the operator for the reason.
//
// Thread-safety: the GUI thread. The STOP of a pad or foot switch switches the output off on the device's own thread.
#pragma once

#include <QObject>
#include <atomic>
#include <memory>
#include <optional>
#include <string>

#include "app/gui/controller/BenchController.h"
#include "app/gui/controller/SideWork.h"
#include "app/gui/pilot/ParticipantDesk.h"
#include "app/gui/pilot/PilotStart.h"
#include "app/gui/pilot/SessionInputs.h"
#include "app/gui/theme/ConfirmButton.h"

namespace tacto::gui {

/// A press of STOP in a person's session: a stop, a test of STOP, or the same press heard again. StopKeys may hear a
/// press several times, and a contact bounces.
struct HeardStop {
    bool heard = false;   ///< a session received the stop
    bool tested = false;  ///< the press tested one of the two STOPs, and does not stop the session
};

class SessionStops {
public:
    /// `desk` and `controller` must outlive this.
    SessionStops(ParticipantDesk& desk, BenchController& controller) : desk_(desk), controller_(controller) {}

    void begin();
    /// Switches the output off and says what the press was; nothing if the same press is heard again.
    [[nodiscard]] std::optional<HeardStop> participantPressed(const char* by);
    /// True if this is a new press, not the last one heard again: output returns only after the participant's "go on".
    [[nodiscard]] bool isAnotherPress(const char* by);
    /// Notes that the stop has been shown: the repainting may have taken longer than the press.
    void shown() { stoppedAt_ = std::chrono::steady_clock::now(); }
    /// True if the operator's stop is a test of their STOP, which only switches the output off.
    [[nodiscard]] bool isTested(const char* by);
    /// Notes that the operator answered: if the STOP key is still held, it now stops what comes next.
    void answered() { heldTested_ = false; }

private:
    ParticipantDesk& desk_;
    BenchController& controller_;
    std::atomic<SteadyTime> stoppedAt_{};  ///< when the participant stopped
    std::atomic<SteadyTime> testedAt_{};   ///< when the operator's STOP was tested
    std::atomic<bool> heldTested_{false};  ///< the tested STOP is a key that the operator may still hold
};

class OperatorAsk;
class OperatorPage;
class OperatorStrip;
class ParticipantWindow;
class ScreenChoice;
class SessionNotes;

class SessionConduct final : public QObject {
    Q_OBJECT
public:
    /// All arguments must outlive this.
    SessionConduct(BenchController& controller, OperatorPage& page, QObject* parent = nullptr);
    ~SessionConduct() override;

    /// Returns a sentence that says why the session cannot begin; empty if it begins. begun() is emitted during this
    /// call; ended() or refused() follows. `screens` gives the participant's screen while the session runs.
    [[nodiscard]] QString begin(const PilotStart& start, ScreenChoice& screens);
    [[nodiscard]] bool running() const { return running_; }
    [[nodiscard]] const PilotStart& start() const { return start_; }
    [[nodiscard]] const PilotScreen& screen() const { return screen_; }
    /// Returns the number of stops in all parts of the session.
    [[nodiscard]] int participantStops() const { return participantStops_; }
    [[nodiscard]] int faults() const { return faults_; }
    /// Null while no person uses a participant's window.
    [[nodiscard]] ParticipantWindow* window() const { return window_.get(); }
    /// Returns the name of the screen that shows the participant's window.
    [[nodiscard]] QString screenName() const;

    void refresh(const Telemetry& telemetry);
    /// Stops by the participant's keys; returns false if no session with a person is running.
    bool stopAsParticipant(const char* by);
    /// Sets whether a break is wanted from the next trial on.
    void wantBreak(bool due);
    [[nodiscard]] bool breakWanted() const { return desk_.breakWanted(); }
    /// Begins a break at once and voids the present trial, which is repeated after the break.
    void breakNow();

signals:
    void begun();
    void screenChanged(const tacto::PilotScreen& screen);
    void asked(const tacto::PilotPrompt& prompt);
    void changed();          ///< stops, faults or participant's screen changed
    void attentionWanted();  ///< the operator is asked something
    void counted(const tacto::PilotCounts& counts);
    void refused(const QString& why);  ///< no session was begun
    void ended(std::shared_ptr<const tacto::gui::FinishedRun> run);
    void runningChanged();

private:
    /// Handles a stop by the participant in a person's session: only switches the output off. Any thread.
    std::optional<HeardStop> switchOff(const char* by);
    void connectPage();
    void connectDesk(OperatorAsk& question, SessionNotes& notes);
    void connectInputs();
    void openWindow();
    void connectStrip();
    void confirmCode();
    void codeAnswered(bool answered, bool theirs);
    void run();
    void abort();
    void refuse(const QString& why);
    void leaveSeats();
    void finish(const std::shared_ptr<const FinishedRun>& run);
    void show(const PilotScreen& screen);
    void ask(const PilotPrompt& prompt, quint64 id);
    void keep(const QString& note);
    void giveKeys();
    [[nodiscard]] InputsAtOnce atOnce();
    void noteStop(const HeardStop& stop);
    void setBreak(bool due, const std::string& why);
    void answerAsOperator(quint64 id, const PilotAnswer& answer);
    void pauseFor(const char* why);
    void seatTheirWindow();
    void screenLost(const QString& name);
    void screenBack();

    BenchController& controller_;
    OperatorPage& page_;
    ParticipantDesk desk_{this};
    SessionInputs inputs_;
    std::unique_ptr<ParticipantWindow> window_;
    OperatorStrip* strip_ = nullptr;  ///< the strip in the window, while there is one
    ScreenChoice* screens_ = nullptr;
    PilotStart start_;
    RunOrder order_;
    ParticipantWords words_ = ParticipantWords::english();
    StopMark mark_{};
    SideWork asker_;                       ///< waits for the answer to the code
    std::atomic<bool> confirming_{false};  ///< the code is being confirmed
    bool codeConfirmed_ = false;
    bool running_ = false;
    std::uint64_t run_ = 0;
    bool seenFault_ = false;
    SessionStops stops_;
    quint64 screenPrompt_ = 0;  ///< the question for which the participant's window is shown again
    int participantStops_ = 0, faults_ = 0;
    PilotScreen screen_;
};

}  // namespace tacto::gui
