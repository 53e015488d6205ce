// ParticipantDesk.h - where a pilot session's thread and the windows of its two people meet: the session asks and
// waits, a window answers, a stop ends the wait.
//
// A response time runs from the moment at which a window says that the targets are on the screen to the moment of the
// press (ConfirmButton.h).
//
// Thread-safety: the calls of PilotParticipant as it says; the others on the GUI thread, which also gets the signals.
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

/// A contact that comes back sooner has bounced: switches bounce for up to 6 ms, a pad reports every 1 to 10 ms, and a
/// finger that lets go and presses again takes over 40 ms (resources/design/pilot.md, section 5).
inline constexpr std::chrono::milliseconds kBounces{20};

inline constexpr const char* kOperatorsBreak = "the operator wants a break now";

class ParticipantDesk final : public QObject, public PilotParticipant {
    Q_OBJECT
public:
    explicit ParticipantDesk(QObject* parent = nullptr);

    /// Called before a session with its clock, which says when targets appear; on a virtual clock, or without any, they
    /// appear at once. Any thread, while no session has the desk.
    void begin(std::shared_ptr<const Clock> clock);

    void show(const PilotScreen& screen) override;
    [[nodiscard]] Result<PilotAnswer> ask(const PilotPrompt& prompt) override;
    void delivered(const FeltPresentation& /*felt*/) override {}
    [[nodiscard]] std::vector<EarlyPress> takeEarly() override;
    void cancel() noexcept override;
    void leave() noexcept override;
    [[nodiscard]] bool holding() const noexcept override { return holding_; }
    [[nodiscard]] bool letGoWasBounce() override;
    [[nodiscard]] std::optional<Hindrance> hindrance() const override;
    [[nodiscard]] bool hasScreen() const noexcept override;
    [[nodiscard]] bool answersInRealTime() const noexcept override { return true; }

    /// Sets what stands in the way of a presentation, half a sentence; empty: nothing.
    void setObstacle(const QString& why);
    /// The operator wants a break: no presentation starts until they end it, and the output is off. `why` stands in the
    /// record.
    void setBreak(bool wanted, const std::string& why = kOperatorsBreak);
    [[nodiscard]] bool breakWanted() const;
    /// The screen is gone: a question that waits for it ends with Device, and so does the next.
    void setScreenThere(bool there);
    /// The targets of question `id` are on the participant's screen since `at`.
    void targetsShown(quint64 id, SteadyTime at);
    /// Nothing happens where `id` is not open any longer, or where that person has answered already.
    void answerAsParticipant(quint64 id, PilotAnswer answer, SteadyTime pressed);
    void answerAsOperator(quint64 id, PilotAnswer answer);
    /// A press before the targets; `key` is what it would have been, or empty.
    void noteEarly(const std::string& key);
    /// `button`: the code of the held one; none for a key, the mouse or a finger. False where that button has come up
    /// meanwhile, which its device tells sooner than the window hears of it: then nothing is held.
    bool setHolding(bool holding, std::optional<int> button = std::nullopt);
    /// The button of that code came up. True where it was what is held, which ends that. Any thread.
    [[nodiscard]] bool letGoOf(int button) noexcept;
    /// A button that holds went down or came up, also one that is not what is held; before letGoOf(). Any thread.
    void noteHoldButton(int button, bool down, SteadyTime at);
    /// Someone pressed a STOP too: a release just before was not a bounce. Any thread.
    void notePressed();
    /// Output off, and the question that waits ends with Stopped; where none waits, the next one, unless the session
    /// shows something before. False where no session listens. Any thread.
    bool stopBy(const char* by);
    /// Whether the open question waits for that person's STOP: a test of it, which ends no session.
    [[nodiscard]] bool testsStopOf(PromptTo whose) const;

signals:
    void screenChanged(const tacto::PilotScreen& screen);
    void asked(const tacto::PilotPrompt& prompt, quint64 id);
    void closed(quint64 id);  ///< answered, out of time, stopped or cancelled
    void obstacleChanged(const QString& why);
    void bounced();  ///< the press that was taken for a stop is none

private:
    [[nodiscard]] bool answered() const;
    [[nodiscard]] Result<PilotAnswer> outcome(const PilotPrompt& prompt);

    mutable std::mutex mutex_;
    std::condition_variable changed_;
    // Guarded:
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
    bool stopped_ = false;  ///< a person stopped it; that ends one question
    bool there_ = true;
    std::set<int> down_;         ///< buttons that hold, as their devices say
    std::optional<int> cameUp_;  ///< the button that holds that came up last
    SteadyTime cameUpAt_{};
    bool downAgain_ = false;  ///< the button went down again within kBounces

    std::mutex stopMutex_;  // held for moments: while `stop` is called, and to end
    bool listens_ = false;  // guarded by stopMutex_
    static constexpr int kNoButton = -1;
    std::atomic<bool> holding_{false};
    std::atomic<int> heldButton_{kNoButton};  ///< the button that is held, until it comes up or a stop comes
    std::atomic<int> letGo_{kNoButton};       ///< the button that was held last and has come up
};

}  // namespace tacto::gui

Q_DECLARE_METATYPE(tacto::PilotScreen)
Q_DECLARE_METATYPE(tacto::PilotPrompt)
