// SessionConduct.h - a pilot session while it runs in the window: the question for the code, the participant's window
// and the operator's strip in it, stops, breaks, notes, and its end.
//
// The participant's window is a window of its own, full screen on the screen that was chosen; where there is one screen
// only, the operator's page is a strip in it, behind F2. A screen that goes, or a
// participant's window that is closed, switches the output off and pauses the session until the window is seated again.
// A game pad or foot switch that is unplugged switches the output off and begins a break of the operator's.
// An abort switches the output off and then asks the operator for the reason.
//
// Thread-safety: the GUI thread. What a pad's or a foot switch's STOP switches off goes from its own thread.
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

/// A press of STOP in a person's session: a stop, the test of one, or a press that is heard again. StopKeys hears one
/// press several times, and a contact bounces.
struct HeardStop {
    bool heard = false;   ///< a session has heard it
    bool tested = false;  ///< a press that tested one of the two STOPs, and does not stop the session
};

class SessionStops {
public:
    /// `desk` and `controller` outlive it.
    SessionStops(ParticipantDesk& desk, BenchController& controller) : desk_(desk), controller_(controller) {}

    void begin();
    /// Switches off and says what it was; nothing where one press is heard again.
    [[nodiscard]] std::optional<HeardStop> participantPressed(const char* by);
    /// Whether this is another press, not the last one heard again: output needs their "go on" to be on again.
    [[nodiscard]] bool isAnotherPress(const char* by);
    /// By then a press is over; the repainting after it may have taken longer.
    void shown() { stoppedAt_ = std::chrono::steady_clock::now(); }
    /// Whether a stop from elsewhere, the operator's, is a test of their STOP: it switches the output off, no more.
    [[nodiscard]] bool isTested(const char* by);
    /// The operator answered: a key that is still held by now stops what comes next.
    void answered() { heldTested_ = false; }

private:
    ParticipantDesk& desk_;
    BenchController& controller_;
    std::atomic<SteadyTime> stoppedAt_{};  ///< when the participant stopped
    std::atomic<SteadyTime> testedAt_{};   ///< the operator's STOP
    std::atomic<bool> heldTested_{false};  ///< the tested STOP is one of their keys that may be held still
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
    /// All that is given here outlives it.
    SessionConduct(BenchController& controller, OperatorPage& page, QObject* parent = nullptr);
    ~SessionConduct() override;

    /// Returns one sentence that says why it cannot begin; empty where it begins. begun() comes from within; ended() or
    /// refused() follows. `screens` says where the participant's window is, as long as it runs.
    [[nodiscard]] QString begin(const PilotStart& start, ScreenChoice& screens);
    [[nodiscard]] bool running() const { return running_; }
    [[nodiscard]] const PilotStart& start() const { return start_; }
    [[nodiscard]] const PilotScreen& screen() const { return screen_; }
    /// Counts the stops in all parts of the session.
    [[nodiscard]] int participantStops() const { return participantStops_; }
    [[nodiscard]] int faults() const { return faults_; }
    /// Null while no person sits at one.
    [[nodiscard]] ParticipantWindow* window() const { return window_.get(); }
    /// The screen that shows the participant's window.
    [[nodiscard]] QString screenName() const;

    void refresh(const Telemetry& telemetry);
    /// A stop by the participant's keys; false where no session of a person runs.
    bool stopAsParticipant(const char* by);
    /// Asks for a break from the next trial on, until it is not wanted any longer.
    void wantBreak(bool due);
    [[nodiscard]] bool breakWanted() const { return desk_.breakWanted(); }
    /// The trial under way is void: it is repeated after the break.
    void breakNow();

signals:
    void begun();
    void screenChanged(const tacto::PilotScreen& screen);
    void asked(const tacto::PilotPrompt& prompt);
    void changed();                                             ///< stops, faults, what the participant's window shows
    void attentionWanted();                                     ///< the operator is asked something
    void progressed(const QString& what, int done, int total);  ///< how far a virtual participant has come
    void refused(const QString& why);                           ///< nothing was begun
    void ended(std::shared_ptr<const tacto::gui::FinishedRun> run);
    void runningChanged();

private:
    /// A stop by the participant of a person's session: the output first, and that alone. Any thread.
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
    ParticipantDesk desk_;
    SessionInputs inputs_;
    std::unique_ptr<ParticipantWindow> window_;
    OperatorStrip* strip_ = nullptr;  ///< the window's, while it is there
    ScreenChoice* screens_ = nullptr;
    PilotStart start_;
    RunOrder order_;
    StopMark mark_{};
    SideWork asker_;                       ///< waits for the answer to the code
    std::atomic<bool> confirming_{false};  ///< the code is asked for
    bool codeConfirmed_ = false;
    bool running_ = false;
    std::uint64_t run_ = 0;
    bool seenFault_ = false;
    SessionStops stops_;
    quint64 screenPrompt_ = 0;  ///< the question that the participant's window is seated again for
    int participantStops_ = 0, faults_ = 0;
    PilotScreen screen_;
};

}  // namespace tacto::gui
