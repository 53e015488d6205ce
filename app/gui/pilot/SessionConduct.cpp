#include "app/gui/pilot/SessionConduct.h"

#include <QScreen>
#include <algorithm>
#include <string_view>
#include <utility>

#include "app/gui/pilot/InputRows.h"
#include "app/gui/pilot/OperatorPage.h"
#include "app/gui/pilot/OperatorStrip.h"
#include "app/gui/pilot/ParticipantWindow.h"
#include "app/gui/pilot/SeatRows.h"
#include "app/gui/theme/ScriptPlace.h"
#include "app/gui/theme/Text.h"
#include "app/scripting/engine/ProtocolLibrary.h"
#include "core/pilot/StudyWords.h"

namespace tacto::gui {

namespace {

constexpr const char* kScreenWent = "the participant's screen went";
constexpr const char* kScreenClosed = "the participant's screen was closed";

/// Returns the run for a pilot session, with the present profile, limits and notes of the day.
Result<RunOrder> pilotOrder(const PilotStart& start, BenchController& controller) {
    auto source = ProtocolLibrary().find(start.protocol);
    if (!source) return failure(source);
    auto declaration = readDeclaration(*source);
    if (!declaration) return failure(declaration);
    std::map<std::string, std::string> given{
        {"participant", start.participant}, {"method", start.method}, {"modality", start.modality}};
    if (!start.language.isEmpty()) given["language"] = start.language.toStdString();
    if (!start.unfinished.empty()) given["unfinished"] = start.unfinished;
    if (start.blocks) given["blocks"] = std::to_string(*start.blocks);
    auto settings = applySettings(*declaration, given);
    if (!settings) return failure(settings);
    auto order = controller.orderOf(std::move(*source), std::move(*declaration), std::move(*settings));
    order.uris = start.devices;
    order.needed = order.declaration.needs;
    order.seed = start.seed;
    order.realtime = start.realTime || (start.person && start.pace == 0);
    return order;
}

/// What the participant's screen says of itself: "rehearsal · simulated".
QString noteOf(const PilotStart& start) {
    QStringList notes;
    if (start.rehearsal) notes << QObject::tr("rehearsal");
    if (start.simulated()) notes << QObject::tr("simulated");
    if (start.person && start.pace > 0) notes << QObject::tr("%1 times as fast").arg(start.pace);
    return notes.join(" · ");
}

/// True if the participant's screen says what they would feel: someone who rehearses on simulated devices feels
/// nothing, would find no range, and would never see training and test. Never in a study.
bool saysWhatIsFelt(const PilotStart& start) {
    return start.rehearsal && start.person && start.simulated() && !start.blind;
}

QString feltText(const FeltPresentation& felt, bool massager) {
    if (!(felt.level > 0)) return QObject::tr("felt: nothing");
    const auto level = [massager](double of) {
        const auto said = QString::number(of, 'g', 3);
        return massager ? QObject::tr("strength %1").arg(said) : QObject::tr("%1 mA").arg(said);
    };
    const auto where = felt.inInterval == 1 ? QObject::tr("first interval") : QObject::tr("second interval");
    const auto what =
        felt.weaker > 0
            ? QObject::tr("felt: %1 and %2, the stronger in the %3").arg(level(felt.level), level(felt.weaker), where)
        : felt.inInterval > 0
            ? QObject::tr("felt: %1 in the %2").arg(level(felt.level), where)
            : QObject::tr("felt: %1 every %2 s").arg(level(felt.level), QString::number(felt.interval.count(), 'g', 3));
    return felt.likely.empty() ? what : QObject::tr("%1, perhaps “%2”").arg(what, qtext(felt.likely));
}

}  // namespace

SessionConduct::SessionConduct(BenchController& controller, OperatorPage& page, QObject* parent)
    : QObject(parent), controller_(controller), page_(page), stops_(desk_, controller) {
    connectPage();
    connectInputs();
    connect(&desk_, &ParticipantDesk::screenChanged, this, &SessionConduct::show);
    connect(&desk_, &ParticipantDesk::asked, this, &SessionConduct::ask);
    connect(&desk_, &ParticipantDesk::closed, this, [this](quint64 id) {
        page_.closeQuestion(id);
        if (strip_ != nullptr) strip_->question().close();
        emit changed();
    });
    connect(&desk_, &ParticipantDesk::bounced, this, [this] {
        participantStops_ = std::max(0, participantStops_ - 1);
        emit changed();
    });
    connect(&desk_, &ParticipantDesk::obstacleChanged, this,
            [this](const QString& why) { page_.setObstacle(running_ && start_.person ? why : QString()); });
    connect(&desk_, &ParticipantDesk::presented, this, [this](const FeltPresentation& felt) {
        if (window_ && saysWhatIsFelt(start_))
            window_->setNote(noteOf(start_) + " · " + feltText(felt, start_.massager));
    });
    connect(&desk_, &ParticipantDesk::countsChanged, this, [this](const PilotCounts& counts) {
        page_.count(counts);
        emit counted(counts);
    });
    connect(&controller_, &BenchController::finished, this, &SessionConduct::finish);
    connect(this, &SessionConduct::changed, this, [this] {
        if (window_) window_->setStopsLeft(std::max(0, int(kMaxParticipantStops) - participantStops_));
    });
}

SessionConduct::~SessionConduct() {
    inputs_.end();
    desk_.leave();  // gives asker_ the answer that it waits for
}

void SessionConduct::connectPage() {
    connect(&page_, &OperatorPage::breakAfterTrialWanted, this, &SessionConduct::wantBreak);
    connect(&page_, &OperatorPage::breakNowWanted, this, &SessionConduct::breakNow);
    connect(&page_, &OperatorPage::abortWanted, this, &SessionConduct::abort);
    connect(&page_, &OperatorPage::keysWanted, this, &SessionConduct::giveKeys);
    connectDesk(page_.question(), page_.notes());
    connect(&page_.question(), &OperatorAsk::answered, this, &SessionConduct::giveKeys);
    connect(&page_.notes(), &SessionNotes::typingEnded, this, &SessionConduct::giveKeys);
}

void SessionConduct::connectDesk(OperatorAsk& question, SessionNotes& notes) {
    connect(&question, &OperatorAsk::answered, this, &SessionConduct::answerAsOperator);
    connect(&notes, &SessionNotes::noted, this, &SessionConduct::keep);
}

void SessionConduct::connectInputs() {
    connect(&inputs_, &SessionInputs::participantMoved, this,
            [this](int code, const ButtonUse& use, bool down, SteadyTime at) {
                if (window_) window_->moveButton(code, use, down, at);
            });
    connect(&inputs_, &SessionInputs::operatorPressed, this, [this](const ButtonUse& use) {
        if (use.does != ButtonUse::Does::Answer) return;  // atOnce() handles STOP
        const bool atStrip = strip_ != nullptr && strip_->question().open();
        (atStrip ? strip_->question() : page_.question()).press(use.answer);
    });
    connect(&inputs_, &SessionInputs::lost, this, [this] {
        if (window_) window_->setInputGone(inputs_.gone());
        if (confirming_ || !running_) return;  // nothing is delivered, and no presentation starts
        setBreak(true, inputs_.gone().toStdString());
        if (window_) window_->noteStop();
    });
    connect(&inputs_, &SessionInputs::back, this, [this] {
        if (window_) window_->setInputGone(inputs_.gone());
    });
}

/// Returns the callbacks for the devices' threads, which switch the output off without waiting for the window's thread.
InputsAtOnce SessionConduct::atOnce() {
    const auto participant = [this](const char* by) {
        const auto stop = switchOff(by);
        if (stop)
            QMetaObject::invokeMethod(
                this, [this, stop = *stop] { noteStop(stop); }, Qt::QueuedConnection);
    };
    InputsAtOnce all;
    all.stop = [this, participant](PromptTo whose) {
        if (whose == PromptTo::Participant)
            participant("participant (button)");
        else
            controller_.stop("operator (button)");
    };
    all.letGo = [this, participant](int code) {
        if (desk_.letGoOf(code) && !desk_.mayLetGo()) participant(kParticipantLetGo);
    };
    all.heldMoved = [this](int code, bool down, SteadyTime at) { desk_.noteHoldButton(code, down, at); };
    all.lost = [this](const std::string& which) {
        if (confirming_) return;
        desk_.setBreak(true, which);
        if (!desk_.stopBy(kOperatorPauses)) controller_.stop(kOperatorPauses);
        desk_.setHolding(false);  // a release now is not a stop by the participant
    };
    return all;
}

void SessionConduct::connectStrip() {
    connect(strip_, &OperatorStrip::breakWanted, this, &SessionConduct::wantBreak);
    connect(strip_, &OperatorStrip::abortWanted, this, &SessionConduct::abort);
    connect(strip_, &OperatorStrip::stopWanted, this, [this] { controller_.stop("operator (STOP)"); });
    connect(strip_, &OperatorStrip::closeWanted, this, [this] { window_->openStrip(false); });
    connectDesk(strip_->question(), strip_->notes());
    connect(&strip_->question(), &OperatorAsk::answered, this, [this] { window_->openStrip(false); });
}

QString SessionConduct::begin(const PilotStart& start, ScreenChoice& screens) {
    if (running_) return tr("A session is running. Wait for its end or stop it (Esc).");
    if (controller_.activity() != Activity::Closed && controller_.activity() != Activity::Live)
        return tr("Another protocol is running. Wait for its end or stop it (Esc).");
    if (controller_.day().asksFirst()) return DayNotes::wantedText();
    mark_ = controller_.mark();
    start_ = start;
    auto made = pilotOrder(start_, controller_);
    if (!made) return sentence(made.error());
    order_ = std::move(*made);
    auto words = languageOf(start.folder.toStdString(), start.language.isEmpty() ? "en" : start.language.toStdString());
    if (!words) return sentence(words.error());
    words_ = std::move(*words);
    if (start.person) {
        if (const auto trouble = inputs_.begin(start.buttons, start.inputs, atOnce()); !trouble.isEmpty())
            return trouble;
        if (!start.inputsOf.isEmpty()) rememberInputs(start.inputsOf, start.inputs);
    }
    if (screens_ != nullptr) screens_->disconnect(this);
    screens_ = &screens;
    connect(screens_, &ScreenChoice::lost, this, &SessionConduct::screenLost);
    connect(screens_, &ScreenChoice::back, this, &SessionConduct::screenBack);
    running_ = true;
    seenFault_ = codeConfirmed_ = false;
    screenPrompt_ = 0;
    participantStops_ = faults_ = 0;
    screen_ = {};
    stops_.begin();
    page_.begin(start);
    emit begun();
    if (start_.person) openWindow();
    emit changed();
    if (start_.confirmsCode)
        confirmCode();
    else
        run();
    emit runningChanged();
    return {};
}

QString SessionConduct::screenName() const { return screens_ == nullptr ? QString() : screens_->chosenName(); }

void SessionConduct::openWindow() {
    desk_.setScreenThere(true);
    window_ = std::make_unique<ParticipantWindow>(desk_, [this](const char* by) { stopAsParticipant(by); });
    window_->setWords(words_);
    window_->setKeys(start_.keys);
    window_->setButtonAnswers(inputs_.participantAnswers());
    window_->setButtonLabels(inputs_.labels());
    window_->setNote(noteOf(start_));
    connect(window_.get(), &ParticipantWindow::changed, this, &SessionConduct::changed);
    connect(window_.get(), &ParticipantWindow::closeWanted, this, [this] { pauseFor(kScreenClosed); });
    strip_ = new OperatorStrip;
    connectStrip();
    window_->setStrip(strip_);
    if (auto* screen = screens_->chosen()) window_->showOn(*screen);
}

/// Asks the participant to confirm the code before any study is opened and before anything is created.
void SessionConduct::confirmCode() {
    confirming_ = true;
    desk_.begin(nullptr);
    PilotScreen screen;
    screen.phase = "checklist";
    screen.operatorText = "The participant is asked whether the code is theirs.";
    screen.operatorMayKnow = true;
    desk_.show(screen);
    const auto prompt = yesNoPrompt("code", words_.text("code.question", {{"code", start_.participant}}),
                                    PromptTo::Participant, words_);
    asker_.start(
        this, [this, prompt] { return desk_.ask(prompt); },
        [this](const auto& said) { codeAnswered(said.has_value(), said && said->key() == "yes"); });
}

void SessionConduct::codeAnswered(bool answered, bool theirs) {
    confirming_ = false;
    if (theirs) {
        codeConfirmed_ = true;
        return run();
    }
    const auto code = qtext(start_.participant);
    refuse(answered ? tr("The participant says that %1 is not their code. Nothing was begun.").arg(code)
                    : tr("Stopped before %1 was confirmed. Nothing was begun.").arg(code));
}

void SessionConduct::run() {
    PilotSeats seats;
    seats.study = start_.folder.toStdString();
    seats.passphrase = start_.passphrase;
    seats.exclusions = start_.exclusions;
    seats.markers = start_.markers;
    order_.lsl = start_.lsl;
    seats.pace = start_.pace;
    if (!start_.person) seats.watch = &desk_;
    if (start_.person) {
        seats.people = &desk_;
        seats.codeConfirmed = codeConfirmed_;
        seats.begun = [this](std::shared_ptr<const Clock> clock, int stops) {
            desk_.begin(std::move(clock));
            QMetaObject::invokeMethod(this, [this, stops] {
                participantStops_ += stops;
                emit changed();
            });
        };
        seats.takesStop = [this](const char* by) { return stops_.isTested(by); };
    }
    run_ = controller_.runPilot(order_, seats, mark_);
}

/// Switches the output off first. A person's session then asks for the reason, which it records, and ends.
void SessionConduct::abort() {
    if (confirming_ || !start_.person || !desk_.stopBy(kOperatorAborts)) controller_.stop(kOperatorAborts);
    if (confirming_) desk_.cancel();
    if (window_) window_->noteStop();
}

void SessionConduct::answerAsOperator(quint64 id, const PilotAnswer& answer) {
    stops_.answered();
    if (id == screenPrompt_) seatTheirWindow();
    desk_.answerAsOperator(id, answer);
}

bool SessionConduct::stopAsParticipant(const char* by) {
    if (!running_ || !start_.person) {
        controller_.stop(by);
        return false;
    }
    const auto stop = switchOff(by);
    if (!stop) return true;
    noteStop(*stop);
    return stop->heard;
}

std::optional<HeardStop> SessionConduct::switchOff(const char* by) {
    if (!confirming_) return stops_.participantPressed(by);
    if (!stops_.isAnotherPress(by)) return {};
    controller_.stop(by);
    desk_.cancel();
    return HeardStop{true, true};
}

/// Shows the stop in the windows.
void SessionConduct::noteStop(const HeardStop& stop) {
    if (window_) window_->noteStop();
    if (!stop.tested) ++participantStops_;
    emit changed();
    stops_.shown();
}

void SessionConduct::show(const PilotScreen& screen) {
    screen_ = screen;
    if (window_ && saysWhatIsFelt(start_) && screen.state != ScreenState::Rest) window_->setNote(noteOf(start_));
    page_.show(screen);
    if (strip_ != nullptr) strip_->setWhere(page_.whereAndWaits());
    emit screenChanged(screen);
}

void SessionConduct::ask(const PilotPrompt& prompt, quint64 id) {
    if (prompt.name == kScreenPrompt) screenPrompt_ = id;
    page_.ask(prompt, id);
    if (strip_ != nullptr) strip_->setWhere(page_.whereAndWaits());
    emit asked(prompt);
    if (prompt.to == PromptTo::Participant) return;
    // On a single screen the question appears in the strip, where the operator can reach it.
    if (window_ && window_->isVisible() && ScreenChoice::isOnly() && strip_ != nullptr) {
        strip_->question().ask(prompt, id);
        window_->openStrip(true);
    } else {
        emit attentionWanted();
    }
}

void SessionConduct::refresh(const Telemetry& telemetry) {
    if (!running_) return;
    static_cast<void>(controller_.takeRunFeed());  // trials are discarded, as they name conditions
    page_.refresh(telemetry);
    if (strip_ != nullptr && strip_->isVisible()) strip_->setWhere(page_.whereAndWaits());
    const bool faulted = telemetry.state == InterlockState::Faulted;
    if (faulted && !std::exchange(seenFault_, true)) {
        ++faults_;
        emit changed();
    }
    seenFault_ = faulted;
}

void SessionConduct::wantBreak(bool due) { setBreak(due, kOperatorsBreak); }

void SessionConduct::setBreak(bool due, const std::string& why) {
    desk_.setBreak(due, why);
    page_.setBreakDue(due);
    if (strip_ != nullptr) strip_->setBreakDue(due);
    if (window_) window_->showBreak(due);
    if (!due) giveKeys();
}

/// The break is set before the output goes off, so that the session finds the reason for the stop.
void SessionConduct::breakNow() {
    wantBreak(true);
    desk_.stopBy(kOperatorPauses);
}

void SessionConduct::keep(const QString& note) {
    if (!controller_.markMoment(controller_.telemetry().at, note.isEmpty() ? tr("mark") : note)) return;
    page_.notes().add(note);
    if (strip_ != nullptr) strip_->notes().add(note);
}

void SessionConduct::giveKeys() {
    if (window_) window_->takeKeys();
}

/// A session that has begun pauses, and continues once the window is shown again; a session that has not begun ends.
void SessionConduct::pauseFor(const char* why) {
    if (!running_ || !start_.person) return;
    if (!desk_.stopBy(why)) controller_.stop(why);
    if (confirming_) desk_.cancel();  // the session has not begun
    desk_.setHolding(false);          // a release now is not a stop by the participant
    if (window_) window_->noteStop();
}

void SessionConduct::screenLost(const QString& name) {
    if (!running_ || !start_.person) return;
    pauseFor(kScreenWent);
    desk_.setScreenThere(false);
    if (window_) window_->hide();  // otherwise the participant's window would cover the operator's
    page_.setObstacle(tr("the participant’s screen “%1” is gone").arg(name));
}

void SessionConduct::screenBack() {
    if (running_) seatTheirWindow();
}

void SessionConduct::seatTheirWindow() {
    auto* screen = screens_->seat();
    if (!window_ || screen == nullptr) return;
    window_->showOn(*screen);
    desk_.setScreenThere(true);
}

void SessionConduct::leaveSeats() {
    running_ = false;
    desk_.leave();
    inputs_.end();
    strip_ = nullptr;
    if (!window_) return;
    window_->hide();
    window_.release()->deleteLater();  // perhaps called from a press in this window
}

void SessionConduct::refuse(const QString& why) {
    leaveSeats();
    emit refused(why);
    emit attentionWanted();
    emit runningChanged();
}

void SessionConduct::finish(const std::shared_ptr<const FinishedRun>& run) {
    if (!running_ || confirming_ || run->number != run_) return;  // a run of another page
    const auto& outcome = run->result.outcome;
    if (outcome.error && run->result.session.empty())
        return refuse(sentence(withoutScriptPlace(qtext(outcome.error->message))));
    leaveSeats();
    emit ended(run);
    emit attentionWanted();
    emit runningChanged();
}

namespace {

constexpr std::chrono::milliseconds kOnePress{100};

/// False if the operator aborts, or a window closes or a screen goes: these do not test a STOP.
bool isPressOfStop(std::string_view by) {
    return by.starts_with("operator (") && by != kOperatorAborts && by != "operator (signal)";
}

}  // namespace

void SessionStops::begin() {
    stoppedAt_ = testedAt_ = SteadyTime();
    heldTested_ = false;
}

bool SessionStops::isAnotherPress(const char* by) {
    auto last = stoppedAt_.load();
    const auto now = std::chrono::steady_clock::now();
    if (now - last >= kOnePress && stoppedAt_.compare_exchange_strong(last, now)) return true;
    if (std::string_view(by) != kParticipantLetGo) desk_.notePressed();
    return false;
}

std::optional<HeardStop> SessionStops::participantPressed(const char* by) {
    if (!isAnotherPress(by)) return {};
    HeardStop stop;
    stop.tested = desk_.testsStopOf(PromptTo::Participant) || desk_.testsStopOf(PromptTo::Operator);
    stop.heard = desk_.stopBy(by);
    if (!stop.heard) controller_.stop(by);  // the session has not begun or is over
    return stop;
}

bool SessionStops::isTested(const char* by) {
    if (std::string_view(by).ends_with(kStillHeld)) return heldTested_.load();
    if (!isPressOfStop(by)) return false;
    // A repeat of a press that tested STOP: the output is already off, and a question comes next.
    if (std::chrono::steady_clock::now() - testedAt_.load() < kOnePress) return true;
    // If a test asks for either STOP, this press of the operator's STOP answers the test and does not end the session.
    const bool tests = desk_.testsStopOf(PromptTo::Operator) || desk_.testsStopOf(PromptTo::Participant);
    heldTested_ = tests && desk_.stopBy(by);
    if (heldTested_) testedAt_ = std::chrono::steady_clock::now();
    return heldTested_.load();
}

}  // namespace tacto::gui

#include "moc_SessionConduct.cpp"
