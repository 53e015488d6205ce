// ParticipantDesk.h - connects a pilot session's thread with the windows of participant and operator: the session asks
// and waits, a window answers, and a stop ends the wait.
//
// A response time runs from the moment a window reports the targets on the screen to the moment of the press
// (ConfirmButton.h).
//
// Thread-safety: PilotParticipant's calls as documented there; others, and the signals, on the GUI thread.
#pragma once

#include <QObject>
#include <QString>
#include <atomic>
#include <condition_variable>
#include <memory>
#include <mutex>
#include <set>

#include "app/gui/theme/ConfirmButton.h"
#include "core/base/Clock.h"
#include "core/pilot/PilotParticipant.h"

namespace tacto::gui {

/// A contact that closes again within this time has bounced. Switches bounce for up to 6 ms, a pad reports every 1 to
/// 10 ms, and a finger that lets go and presses again takes over 40 ms (pilot.md, section 5).
inline constexpr std::chrono::milliseconds kBounces{20};

inline constexpr const char* kOperatorsBreak = "the operator wants a break now";

class ParticipantDesk final : public QObject, public PilotParticipant {
    Q_OBJECT
public:
    explicit ParticipantDesk(QObject* parent = nullptr);

    /// Call this before a session, with the session's clock, which says when targets appear; on a virtual clock, or
    /// without a clock, they appear at once. Any thread, while no session uses the desk.
    void begin(std::shared_ptr<const Clock> clock);

    void show(const PilotScreen& screen) override;
    [[nodiscard]] Result<PilotAnswer> ask(const PilotPrompt& prompt) override;
    void counted(const PilotCounts& counts) override { emit countsChanged(counts); }
    void delivered(const FeltPresentation& felt) override { emit presented(felt); }
    [[nodiscard]] std::vector<EarlyPress> takeEarly() override;
    void cancel() noexcept override;
    void leave() noexcept override;
    [[nodiscard]] bool holding() const noexcept override { return holding_; }
    [[nodiscard]] bool letGoWasBounce() override;
    [[nodiscard]] std::optional<Hindrance> hindrance() const override;
    [[nodiscard]] bool hasScreen() const noexcept override;
    [[nodiscard]] bool answersInRealTime() const noexcept override { return true; }

    /// Sets what prevents a presentation, as half a sentence; empty if nothing does.
    void setObstacle(const QString& why);
    /// Sets whether the operator wants a break. Until the operator ends it, no presentation starts and the output is
    /// off. The record contains `why`.
    void setBreak(bool wanted, const std::string& why = kOperatorsBreak);
    [[nodiscard]] bool breakWanted() const;
    /// Sets whether the participant's screen exists. Without it, the waiting question and the next one end with Device.
    void setScreenThere(bool there);
    /// Reports that the targets of question `id` have been on the participant's screen since `at`.
    void targetsShown(quint64 id, SteadyTime at);
    /// Does nothing if question `id` is no longer open, or if that person has already answered.
    void answerAsParticipant(quint64 id, PilotAnswer answer, SteadyTime pressed);
    void answerAsOperator(quint64 id, PilotAnswer answer);
    /// Reports a press before the targets appear; `key` is the answer that it would have given, or empty.
    void noteEarly(const std::string& key);
    /// `button`: the code of the held button; none for a key, the mouse or a finger. Returns false, and holds nothing,
    /// if the button has already come up, since the device reports a release before the window hears of the press.
    bool setHolding(bool holding, std::optional<int> button = std::nullopt);
    /// True while a question other than to hold waits for the participant: nothing is delivered, and letting go is no
    /// stop. Any thread.
    [[nodiscard]] bool mayLetGo() const;
    /// Reports that button `button` came up. Returns true if it was the held button, and ends the hold. Any thread.
    [[nodiscard]] bool letGoOf(int button) noexcept;
    /// Reports that any hold button went down or came up, even if not the held one; call before letGoOf(). Any thread.
    void noteHoldButton(int button, bool down, SteadyTime at);
    /// Reports that someone pressed STOP too: a release just before was not a bounce. Any thread.
    void notePressed();
    /// Turns the output off and ends the waiting question with Stopped. If none waits, the next question ends so,
    /// unless the session shows a screen before it. Returns false if no session listens. Any thread.
    bool stopBy(const char* by);
    /// True if the open question asks that person to test STOP; this test does not end the session.
    [[nodiscard]] bool testsStopOf(PromptTo whose) const;

signals:
    void screenChanged(const tacto::PilotScreen& screen);
    void countsChanged(const tacto::PilotCounts& counts);
    /// Called before the question about it. A participant feels nothing from simulated devices.
    void presented(const tacto::FeltPresentation& felt);
    void asked(const tacto::PilotPrompt& prompt, quint64 id);
    void closed(quint64 id);  ///< answered, out of time, stopped or cancelled
    void obstacleChanged(const QString& why);
    void bounced();  ///< the release that was taken for a stop was only a bounce

private:
    [[nodiscard]] bool answered() const;
    [[nodiscard]] Result<PilotAnswer> outcome(const PilotPrompt& prompt);

    mutable std::mutex mutex_;
    std::condition_variable changed_;
    // Guarded by mutex_:
    std::shared_ptr<const Clock> clock_;
    std::optional<PilotPrompt> open_;
    quint64 id_ = 0;
    std::optional<SteadyTime> shownAt_;
    std::optional<PilotAnswer> participants_, operators_;
    std::vector<EarlyPress> early_;
    QString obstacle_;
    bool break_ = false;
    std::string breakWhy_;
    bool cancelled_ = false;
    bool stopped_ = false;  ///< a person pressed stop; this ends one question
    bool there_ = true;
    std::set<int> down_;         ///< hold buttons that are down, as reported by their devices
    std::optional<int> cameUp_;  ///< the hold button that was released last
    SteadyTime cameUpAt_{};
    bool downAgain_ = false;  ///< the button went down again within kBounces

    std::mutex stopMutex_;  // held briefly: while `stop` is called, and when a session ends
    bool listens_ = false;  // guarded by stopMutex_
    static constexpr int kNoButton = -1;
    std::atomic<bool> holding_{false};
    std::atomic<int> heldButton_{kNoButton};  ///< the held button, until it is released or a stop comes
    std::atomic<int> letGo_{kNoButton};       ///< the held button that was released last
};

}  // namespace tacto::gui

Q_DECLARE_METATYPE(tacto::PilotScreen)
Q_DECLARE_METATYPE(tacto::PilotPrompt)
Q_DECLARE_METATYPE(tacto::PilotCounts)
