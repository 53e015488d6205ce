#include "app/gui/pilot/ParticipantDesk.h"

#include <utility>

namespace tacto::gui {

ParticipantDesk::ParticipantDesk(QObject* parent) : QObject(parent) {
    qRegisterMetaType<PilotScreen>();
    qRegisterMetaType<PilotPrompt>();
    qRegisterMetaType<FeltPresentation>();
}

void ParticipantDesk::begin(std::shared_ptr<const Clock> clock) {
    const std::scoped_lock lock(mutex_);
    clock_ = std::move(clock);
    early_.clear();
    down_.clear();
    cancelled_ = stopped_ = false;
    break_ = false;
    holding_ = false;
}

void ParticipantDesk::leave() noexcept {
    cancel();
    const std::scoped_lock lock(stopMutex_);
    listens_ = false;
    stop = nullptr;  // otherwise the next show() would listen again
    holding_ = false;
}

void ParticipantDesk::show(const PilotScreen& screen) {
    {
        const std::scoped_lock lock(stopMutex_);
        listens_ = stop != nullptr;
    }
    if (screen.state == ScreenState::Rest) holding_ = false;
    {
        const std::scoped_lock lock(mutex_);
        stopped_ = false;
    }
    emit screenChanged(screen);
}

bool ParticipantDesk::answered() const {
    const bool one = open_->to == PromptTo::Operator || participants_;
    const bool other = open_->to == PromptTo::Participant || operators_;
    return one && other;
}

Result<PilotAnswer> ParticipantDesk::ask(const PilotPrompt& prompt) {
    std::unique_lock lock(mutex_);
    const bool theirs = prompt.to != PromptTo::Operator;
    const auto broken = [&] { return cancelled_ || stopped_ || (theirs && !there_); };
    if (clock_ && !clock_->isVirtual() && !broken())
        changed_.wait_for(lock, std::max(Instant(0), prompt.targetsAt - clock_->now()), broken);
    open_ = prompt;
    ++id_;
    shownAt_.reset();
    participants_.reset();
    operators_.reset();
    if (!theirs) shownAt_ = std::chrono::steady_clock::now();  // the operator's window is already visible
    emit asked(prompt, id_);
    const auto look = std::chrono::duration_cast<SteadyTime::duration>(kWaitingLook);
    for (auto next = std::chrono::steady_clock::now() + look; !broken() && !answered();) {
        const auto until = prompt.within && shownAt_
                               ? *shownAt_ + std::chrono::duration_cast<SteadyTime::duration>(*prompt.within)
                               : SteadyTime::max();
        if (changed_.wait_until(lock, std::min(until, next)) != std::cv_status::timeout) continue;
        if (std::chrono::steady_clock::now() >= until) break;
        next += look;
        lock.unlock();
        if (waiting) waiting();
        lock.lock();
    }
    auto result = outcome(prompt);
    open_.reset();
    emit closed(id_);
    return result;
}

Result<PilotAnswer> ParticipantDesk::outcome(const PilotPrompt& prompt) {
    if (cancelled_ || std::exchange(stopped_, false))
        return fail(ErrorCode::Stopped, "\"{}\" was stopped before it was answered", prompt.name);
    if (prompt.to != PromptTo::Operator && !there_)
        return fail(ErrorCode::Device, "\"{}\" was not answered: the participant's screen is gone", prompt.name);
    if (answered()) return prompt.to == PromptTo::Operator ? *operators_ : *participants_;
    PilotAnswer none;
    none.given = false;
    none.after = *prompt.within;
    return none;
}

std::vector<EarlyPress> ParticipantDesk::takeEarly() {
    const std::scoped_lock lock(mutex_);
    return std::exchange(early_, {});
}

void ParticipantDesk::cancel() noexcept {
    {
        const std::scoped_lock lock(mutex_);
        cancelled_ = true;
    }
    changed_.notify_all();
}

std::optional<Hindrance> ParticipantDesk::hindrance() const {
    const std::scoped_lock lock(mutex_);
    if (cancelled_) return {};  // the next question reports the cancellation
    if (break_) return Hindrance{true, breakWhy_};
    if (!obstacle_.isEmpty()) return Hindrance{false, obstacle_.toStdString()};
    return {};
}

bool ParticipantDesk::hasScreen() const noexcept {
    const std::scoped_lock lock(mutex_);
    return there_;
}

void ParticipantDesk::setObstacle(const QString& why) {
    {
        const std::scoped_lock lock(mutex_);
        if (std::exchange(obstacle_, why) == why) return;
    }
    emit obstacleChanged(why);
}

void ParticipantDesk::setBreak(bool wanted, const std::string& why) {
    const std::scoped_lock lock(mutex_);
    break_ = wanted;
    breakWhy_ = why;
}

bool ParticipantDesk::breakWanted() const {
    const std::scoped_lock lock(mutex_);
    return break_;
}

void ParticipantDesk::setScreenThere(bool there) {
    {
        const std::scoped_lock lock(mutex_);
        there_ = there;
    }
    changed_.notify_all();
}

void ParticipantDesk::targetsShown(quint64 id, SteadyTime at) {
    {
        const std::scoped_lock lock(mutex_);
        if (!open_ || id != id_ || shownAt_) return;
        shownAt_ = at;
    }
    changed_.notify_all();
}

void ParticipantDesk::answerAsParticipant(quint64 id, PilotAnswer answer, SteadyTime pressed) {
    {
        const std::scoped_lock lock(mutex_);
        if (!open_ || id != id_ || participants_ || !shownAt_ || open_->to == PromptTo::Operator) return;
        answer.after = std::max(Seconds(0), Seconds(pressed - *shownAt_));
        participants_ = std::move(answer);
    }
    changed_.notify_all();
}

void ParticipantDesk::answerAsOperator(quint64 id, PilotAnswer answer) {
    {
        const std::scoped_lock lock(mutex_);
        if (!open_ || id != id_ || operators_ || open_->to == PromptTo::Participant) return;
        operators_ = std::move(answer);
    }
    changed_.notify_all();
}

void ParticipantDesk::noteEarly(const std::string& key) {
    const std::scoped_lock lock(mutex_);
    early_.push_back({key, clock_ ? clock_->now() : Instant(0)});
}

bool ParticipantDesk::setHolding(bool holding, std::optional<int> button) {
    const std::scoped_lock lock(mutex_);
    if (holding && button && !down_.contains(*button)) return false;
    holding_ = holding;
    const int before = heldButton_.exchange(holding ? button.value_or(kNoButton) : kNoButton);
    if (!holding) letGo_ = before;
    return true;
}

bool ParticipantDesk::letGoOf(int button) noexcept {
    int held = button;
    if (!heldButton_.compare_exchange_strong(held, kNoButton) || !holding_.exchange(false)) return false;
    letGo_ = button;
    return true;
}

void ParticipantDesk::noteHoldButton(int button, bool down, SteadyTime at) {
    {
        const std::scoped_lock lock(mutex_);
        if (down)
            down_.insert(button);
        else
            down_.erase(button);
        if (!down) {
            cameUp_ = button;
            cameUpAt_ = at;
            downAgain_ = false;
        } else if (cameUp_ == button && at - cameUpAt_ < kBounces) {
            downAgain_ = true;
        }
    }
    changed_.notify_all();
}

void ParticipantDesk::notePressed() {
    const std::scoped_lock lock(mutex_);
    cameUp_.reset();
    downAgain_ = false;
}

bool ParticipantDesk::letGoWasBounce() {
    const int button = letGo_.exchange(kNoButton);
    if (button == kNoButton) return false;  // a key, the mouse or a finger, none of which bounces
    std::unique_lock lock(mutex_);
    const bool bounce = changed_.wait_for(lock, kBounces, [&] { return downAgain_ && cameUp_ == button; });
    downAgain_ = false;
    lock.unlock();
    if (bounce) emit bounced();
    return bounce;
}

bool ParticipantDesk::mayLetGo() const {
    const std::scoped_lock lock(mutex_);
    return open_ && open_->to != PromptTo::Operator && open_->kind != PromptKind::Hold && shownAt_;
}

bool ParticipantDesk::testsStopOf(PromptTo whose) const {
    const std::scoped_lock lock(mutex_);
    return open_ && open_->name == "stop-test" && open_->to == whose;
}

bool ParticipantDesk::stopBy(const char* by) {
    {
        // Locked until the end of the press, so that only the screen after it clears `stopped_`.
        const std::scoped_lock whole(stopMutex_);
        if (!listens_) return false;
        stop(by);
        heldButton_ = kNoButton;  // the output is already off: letting go does not stop it again
        const std::scoped_lock lock(mutex_);
        stopped_ = true;
    }
    changed_.notify_all();
    return true;
}

}  // namespace tacto::gui

#include "moc_ParticipantDesk.cpp"
