#include "app/gui/pilot/ParticipantWindow.h"

#include <QCloseEvent>
#include <QGuiApplication>
#include <QScreen>
#include <QWindow>
#include <algorithm>
#include <utility>

#include "app/gui/pilot/ParticipantFace.h"
#include "app/gui/pilot/ParticipantField.h"
#include "app/gui/theme/KeyState.h"
#include "app/gui/theme/Text.h"
#include "app/gui/theme/Theme.h"

namespace tacto::gui {

namespace {

constexpr int kTick_ms = 100;
constexpr int kHoldKey = Qt::Key_H, kHoldKeyLeft = Qt::Key_G;
constexpr int kFirstButton = 0x4000'0000;    // above every Qt::Key value
constexpr const char* kDone = "done";        // the target that ends a Several question
constexpr const char* kStopsAs = "stopsAs";  // property that StopKeys reads

}  // namespace

ParticipantWindow::ParticipantWindow(ParticipantDesk& desk, std::function<void(const char*)> stop, QWidget* parent)
    : QWidget(parent, Qt::Window),
      desk_(desk),
      stop_(std::move(stop)),
      face_(new ParticipantFace(
          [this] {
              stop_("participant");
              noteStop();
          },
          this)) {
    setObjectName("participantWindow");
    setWindowTitle(tr("Participant"));
    setAccessibleName(tr("Participant’s screen"));
    setAutoFillBackground(true);
    setBackgroundRole(QPalette::Window);
    setFocusPolicy(Qt::StrongFocus);
    setProperty(kStopsAs, "participant");
    connect(&face_->field(), &ParticipantField::chosenAt, this, &ParticipantWindow::choose);
    connect(&face_->field(), &ParticipantField::missed, this, [this] {
        if (feels()) noteEarly({});
    });
    connect(&face_->hold(), &AnswerTarget::wentDown, this, &ParticipantWindow::pressHold);
    connect(&face_->hold(), &AnswerTarget::cameUp, this, &ParticipantWindow::letGo);
    connect(&face_->line(), &QLineEdit::returnPressed, this, [this] {
        PilotAnswer answer;
        answer.keys.push_back(face_->line().text().trimmed().toStdString());
        give(std::move(answer), std::chrono::steady_clock::now());
    });
    connect(&desk_, &ParticipantDesk::screenChanged, this, &ParticipantWindow::showScreen);
    connect(&desk_, &ParticipantDesk::asked, this, &ParticipantWindow::ask);
    connect(&desk_, &ParticipantDesk::closed, this, &ParticipantWindow::closeQuestion);
    qApp->installEventFilter(this);
    ticking_.setInterval(kTick_ms);
    connect(&ticking_, &QTimer::timeout, this, &ParticipantWindow::tick);
    showState();
    judge();
    onEvent(*this, QEvent::Resize, [this] {
        face_->setGeometry(rect());
        judge();
    });
}

void ParticipantWindow::setWords(const ParticipantWords& words) {
    words_ = words;
    face_->setWords(words);
    showState();
}

void ParticipantWindow::setNote(const QString& note) { face_->setNote(note); }

const ParticipantField& ParticipantWindow::field() const { return face_->field(); }

QString ParticipantWindow::title() const { return face_->title(); }

void ParticipantWindow::showOn(QScreen& screen) {
    setScreen(&screen);
    setGeometry(screen.geometry());
    showFullScreen();
    takeKeys();
}

void ParticipantWindow::takeKeys() {
    if (!isVisible()) return;
    raise();
    activateWindow();
    if (!face_->line().isVisible()) setFocus(Qt::OtherFocusReason);
}

void ParticipantWindow::setStrip(QWidget* strip) { face_->setStrip(strip); }

bool ParticipantWindow::stripOpen() const { return face_->stripOpen(); }

void ParticipantWindow::openStrip(bool open) {
    face_->openStrip(open);
    if (!open) setFocus(Qt::OtherFocusReason);
    judge();
}

void ParticipantWindow::noteStop() {
    stopped_ = true;
    asking_ = false;
    heldKey_ = 0;
    ticking_.stop();
    if (!desk_.holding()) face_->hold().hide();
    showState();
    repaint();
}

void ParticipantWindow::setStopsLeft(int left) { face_->setStopsLeft(left); }

void ParticipantWindow::showBreak(bool on) {
    break_ = on;
    if (!asking_ && !stopped_) showState();
}

QString ParticipantWindow::says() const {
    if (stopped_) return tr("Stopped");
    if (asking_) return tr("Answer phase");
    return screenWords(screen_.state);
}

bool ParticipantWindow::feels() const {
    return !asking_ && !stopped_ &&
           (screen_.state == ScreenState::Dot || screen_.state == ScreenState::Feel ||
            screen_.state == ScreenState::Interval);
}

void ParticipantWindow::showScreen(const PilotScreen& screen) {
    screen_ = screen;
    stopped_ = false;
    asking_ = false;
    if (std::exchange(operatorsTest_, false)) judge();
    if (screen.state == ScreenState::Rest) face_->hold().hide();
    showState();
    repaint();  // drawn now: the session decides the moment of a change, not the next frame
    emit changed();
}

void ParticipantWindow::ask(const PilotPrompt& prompt, quint64 id) {
    operatorsTest_ = prompt.to == PromptTo::Operator && isStopTestPrompt(prompt);
    if (prompt.to == PromptTo::Operator) {
        asking_ = false;
        judge();
        face_->say(qtext(words_.text("moment.title")), qtext(words_.text("moment.below")));
        emit changed();
        return;
    }
    prompt_ = prompt;
    if (prompt.kind == PromptKind::Several) prompt_.targets.push_back({kDone, words_.text("answer.done")});
    keys_ = AnswerKeys(set_, prompt_);
    id_ = id;
    asking_ = true;
    shown_ = stopped_ = false;
    showState();
    painted_ = false;
    repaint();
    since_.start();
    if (prompt.within) ticking_.start();
    if (painted_) noteShown();
    emit changed();
}

void ParticipantWindow::noteShown() {
    if (!asking_ || std::exchange(shown_, true)) return;
    desk_.targetsShown(id_, std::chrono::steady_clock::now());
    if (prompt_.kind == PromptKind::Hold && desk_.holding()) return pressHold();  // held since the series before
    emit changed();
}

void ParticipantWindow::closeQuestion(quint64 id) {
    if (!asking_ || id != id_) return;
    asking_ = false;
    ticking_.stop();
    showState();
    emit changed();
}

void ParticipantWindow::showState() {
    face_->hold().setDown(desk_.holding());
    face_->show({.screen = screen_,
                 .asked = asking_ ? std::optional(prompt_) : std::nullopt,
                 .keys = keys_,
                 .holdKey = QKeySequence(holdKey()).toString(),
                 .buttons = asking_ ? buttons_.textsFor(prompt_) : QStringList(),
                 .holdButton = buttons_.labels.hold,
                 .stopped = stopped_,
                 .pause = break_ && !feels()});
}

int ParticipantWindow::holdKey() const { return set_ == KeySet::LeftHand ? kHoldKeyLeft : kHoldKey; }

/// True if only STOP answers the question.
bool ParticipantWindow::isStopTest() const { return isStopTestPrompt(prompt_); }

void ParticipantWindow::choose(int target, SteadyTime at) {
    if (!asking_ || isStopTest()) return;
    if (!shown_) return noteEarly(target);
    const auto index = std::size_t(target);
    PilotAnswer answer;
    if (prompt_.kind == PromptKind::Several && prompt_.targets.at(index).key != kDone) {
        face_->field().setChosen(target, !face_->field().chosen(target));
        return;
    }
    if (prompt_.kind == PromptKind::Scale) {
        answer.value = prompt_.least + target;
    } else if (prompt_.kind == PromptKind::Several) {
        answer.keys = chosenKeys();
    } else {
        answer.keys.push_back(prompt_.targets.at(index).key);
    }
    give(std::move(answer), at);
}

std::vector<std::string> ParticipantWindow::chosenKeys() const {
    std::vector<std::string> keys;
    for (std::size_t i = 0; i < prompt_.targets.size(); ++i) {
        if (face_->field().chosen(int(i)) && prompt_.targets[i].key != kDone) keys.push_back(prompt_.targets[i].key);
    }
    return keys;
}

void ParticipantWindow::give(PilotAnswer answer, SteadyTime at) {
    if (!asking_ || !shown_) return;
    asking_ = false;
    ticking_.stop();
    desk_.answerAsParticipant(id_, std::move(answer), at);
    face_->say({}, {});
    setFocus(Qt::OtherFocusReason);
    emit changed();
}

void ParticipantWindow::pressHold() {
    if (!asking_ || !shown_ || prompt_.kind != PromptKind::Hold) return;
    const auto button = heldKey_ >= kFirstButton ? std::optional(heldKey_ - kFirstButton) : std::nullopt;
    if (!desk_.setHolding(true, button)) return;
    face_->hold().setDown(true);
    PilotAnswer answer;
    answer.keys.emplace_back("held");
    give(std::move(answer), std::chrono::steady_clock::now());
}

void ParticipantWindow::letGo() {
    heldKey_ = 0;
    if (!desk_.holding()) return;
    desk_.setHolding(false);  // first, so that a presentation that begins now sees it
    face_->hold().setDown(false);
    if (desk_.mayLetGo()) return;
    stop_(kParticipantLetGo);
    face_->hold().hide();
    noteStop();
}

void ParticipantWindow::noteEarly(std::optional<int> target) {
    const bool known = target && std::size_t(*target) < prompt_.targets.size();
    desk_.noteEarly(known ? prompt_.targets[std::size_t(*target)].key : std::string());
}

/// True if a press answers the question: the targets are shown, and the key was not held from before.
bool ParticipantWindow::takesPress(int code, SteadyTime at, bool repeated, std::optional<int> would) {
    const bool held = pressed_.isHeld(code, at, repeated);
    if (!asking_) {
        if (!held && feels()) noteEarly(would);
        pressed_.note(code, at);
        return false;
    }
    if (!held) pressed_.forget(code);
    return !held;
}

void ParticipantWindow::setButtonLabels(const ButtonLabels& labels) {
    buttons_.labels = labels;
    face_->setStopButtons(labels.stops);
}

void ParticipantWindow::moveButton(int code, const ButtonUse& use, bool down, SteadyTime at) {
    const int key = kFirstButton + code;
    if (!down) {
        if (heldKey_ == key) letGo();
        return;
    }
    switch (use.does) {
        case ButtonUse::Does::Nothing:
            return;
        case ButtonUse::Does::Stop:  // the device's thread has already stopped the output (SessionInputs.h)
            return noteStop();
        case ButtonUse::Does::Hold:
            if (face_->hold().isHidden()) return;
            heldKey_ = key;
            heldAt_ = at;
            // The hold begins after its contact has settled: bounces until then do not let go.
            QTimer::singleShot(kBounces, Qt::PreciseTimer, this, [this, key, at] {
                if (heldKey_ == key && heldAt_ == at) pressHold();
            });
            return;
        case ButtonUse::Does::Answer:
            break;
    }
    const auto target = buttons_.targetOf(use.answer, prompt_);
    if (takesPress(key, at, false, target) && target) choose(*target, at);
}

void ParticipantWindow::setInputGone(const QString& why) {
    inputGone_ = why;
    judge();
}

void ParticipantWindow::keyPressEvent(QKeyEvent* event) {
    const int key = event->key();
    const auto at = timeOf(*event);
    if (key == holdKey() && !face_->hold().isHidden()) {
        if (event->isAutoRepeat()) return;
        heldKey_ = key;
        return pressHold();
    }
    if (key == Qt::Key_F2 && face_->hasStrip() && !event->isAutoRepeat()) return openStrip(!stripOpen());
    if (!takesPress(key, at, event->isAutoRepeat(), AnswerKeys(set_, prompt_).targetOf(key))) return;
    if (prompt_.kind == PromptKind::Several && (key == Qt::Key_Return || key == Qt::Key_Enter)) {
        PilotAnswer answer;
        answer.keys = chosenKeys();
        return give(std::move(answer), at);
    }
    if (const auto target = keys_.targetOf(key)) choose(*target, at);
}

/// Letting go is heard whatever has the focus: a line of text in the operator's strip keeps the releases it gets. A key
/// pressed again before its release is handled counts as held.
bool ParticipantWindow::eventFilter(QObject* watched, QEvent* event) {
    if (event->type() != QEvent::KeyRelease || heldKey_ == 0) return QWidget::eventFilter(watched, event);
    const auto& key = *static_cast<QKeyEvent*>(event);
    if (!key.isAutoRepeat() && key.key() == heldKey_ && !isKeyDown(key.nativeScanCode()).value_or(false)) letGo();
    return false;
}

void ParticipantWindow::mousePressEvent(QMouseEvent* /*event*/) {
    if (feels()) noteEarly({});
}

void ParticipantWindow::paintEvent(QPaintEvent* event) {
    QWidget::paintEvent(event);
    painted_ = true;
    if (!asking_) return;
    // First exposure of this window: the targets are on the screen once this call returns.
    QMetaObject::invokeMethod(
        this,
        [this, id = id_] {
            if (id == id_) noteShown();
        },
        Qt::QueuedConnection);
}

/// Sets what prevents a presentation now.
void ParticipantWindow::judge() {
    QString why;
    const int least = pixelsOf(kTarget_mm, *this);
    if (!inputGone_.isEmpty())
        why = inputGone_;
    else if (!isVisible())
        why = tr("the participant's window is not shown");
    else if (stripOpen() && !operatorsTest_)  // the operator's STOP is in the strip, and its test needs the output on
        why = tr("the operator's strip is open on the participant's screen: F2 closes it");
    else if (!isActiveWindow())
        why = tr("keys do not reach the participant's window");
    else if (const int need = 6 * least; height() < need || width() < 5 * least)
        why = tr("the participant's screen has no room for targets of 20 mm");
    desk_.setObstacle(why);
    emit changed();
}

void ParticipantWindow::tick() {
    if (!asking_ || !prompt_.within) return;
    const double gone = double(since_.nsecsElapsed()) * 1e-9 / prompt_.within->count();
    face_->setTimeLeft(std::clamp(1 - gone, 0.0, 1.0));
}

void ParticipantWindow::closeEvent(QCloseEvent* event) {
    event->ignore();  // the window closes with the session
    emit closeWanted();
    noteStop();
}

void ParticipantWindow::changeEvent(QEvent* event) {
    QWidget::changeEvent(event);
    if (event->type() != QEvent::ActivationChange) return;
    if (!isActiveWindow() && heldKey_ != 0 && heldKey_ < kFirstButton)
        letGo();  // the release of a held key would go to another window
    if (!isActiveWindow()) pressed_.clear();
    judge();
}

void ParticipantWindow::showEvent(QShowEvent* event) {
    QWidget::showEvent(event);
    if (windowHandle() != nullptr) windowHandle()->setProperty(kStopsAs, "participant");
    judge();
}

void ParticipantWindow::hideEvent(QHideEvent* event) {
    QWidget::hideEvent(event);
    judge();
}

}  // namespace tacto::gui

#include "moc_ParticipantWindow.cpp"
