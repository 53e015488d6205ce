#include "app/gui/pilot/ParticipantWindow.h"

#include <QCloseEvent>
#include <QScreen>
#include <QWindow>
#include <algorithm>
#include <cmath>

#include "app/gui/pilot/ParticipantField.h"
#include "app/gui/pilot/ParticipantStop.h"
#include "app/gui/pilot/ShareBars.h"
#include "app/gui/theme/Text.h"
#include "app/gui/theme/Theme.h"

namespace tacto::gui {

namespace {

// The picture's lengths, at 1440 x 900.
constexpr double kWide = 1440, kHigh = 900;
constexpr double kMargin = 64, kTop = 48, kStopLeft = 968, kStopTop = 120, kStopBottom = 112, kColumn = 776;
constexpr double kHead_px = 20, kTitle_px = 37, kWords_px = 28, kStop_px = 92, kSmall_px = 14, kGap = 24;
constexpr double kLargeText = 1.4;  // times the usual
constexpr int kTick_ms = 100;
constexpr int kHoldKey = Qt::Key_H, kHoldKeyLeft = Qt::Key_G;
constexpr std::chrono::milliseconds kRepeats{150};  // X does not mark every press of a held key as repeated
constexpr const char* kDone = "done";               // the target that ends Several
constexpr const char* kStopsAs = "stopsAs";         // StopKeys looks for it

QFont withPixels(int px, QFont::Weight weight = QFont::Normal) {
    auto font = textFont(TextSize::Body, weight);
    font.setPixelSize(std::max(8, px));
    return font;
}

QString phaseTitle(const std::string& phase) {
    if (phase == "ascending" || phase == "detection" || phase == "range") return QObject::tr("Finding your range");
    if (phase == "familiarisation") return QObject::tr("Getting to know them");
    if (phase == "training") return QObject::tr("Training");
    if (phase == "drift") return QObject::tr("A short check");
    if (phase == "ratings") return QObject::tr("A few questions");
    return {};
}

}  // namespace

ParticipantWindow::ParticipantWindow(ParticipantDesk& desk, std::function<void(const char*)> stop, QWidget* parent)
    : QWidget(parent, Qt::Window),
      desk_(desk),
      stop_(std::move(stop)),
      block_(new QLabel(this)),
      blocks_(new ShareBars(this)),
      note_(new QLabel(this)),
      title_(new QLabel(this)),
      below_(new QLabel(this)),
      field_(new ParticipantField(this)),
      stopTarget_(new ParticipantStop(
          [this] {
              stop_("participant");
              noteStop();
          },
          this)),
      timeWord_(new QLabel(tr("time to answer"), this)),
      time_(new ShareBars(this)),
      hold_(new AnswerTarget(this)),
      line_(new QLineEdit(this)),
      leastWord_(new QLabel(this)),
      mostWord_(new QLabel(this)) {
    setObjectName("participantWindow");
    setWindowTitle(tr("Participant"));
    setAccessibleName(tr("Participant’s screen"));
    setAutoFillBackground(true);
    setBackgroundRole(QPalette::Window);
    setFocusPolicy(Qt::StrongFocus);
    setProperty(kStopsAs, "participant");
    for (auto* label : {block_, note_, title_, below_, timeWord_, leastWord_, mostWord_}) {
        label->setTextFormat(Qt::PlainText);
        label->setAttribute(Qt::WA_TransparentForMouseEvents);
    }
    title_->setObjectName("participantTitle");
    title_->setWordWrap(true);
    title_->setAlignment(Qt::AlignLeft | Qt::AlignTop);
    below_->setWordWrap(true);
    for (auto* quiet : {note_, below_, timeWord_, leastWord_, mostWord_}) setTone(*quiet, Tone::Quiet);
    hold_->hide();
    line_->hide();
    connect(field_, &ParticipantField::chosenAt, this, &ParticipantWindow::choose);
    connect(field_, &ParticipantField::missed, this, [this] {
        if (feels()) noteEarly({});
    });
    auto* hold = static_cast<AnswerTarget*>(hold_);
    hold->setObjectName("hold");
    connect(hold, &AnswerTarget::wentDown, this, &ParticipantWindow::pressHold);
    connect(hold, &AnswerTarget::cameUp, this, &ParticipantWindow::letGo);
    connect(line_, &QLineEdit::returnPressed, this, [this] {
        PilotAnswer answer;
        answer.keys.push_back(line_->text().trimmed().toStdString());
        give(std::move(answer), std::chrono::steady_clock::now());
    });
    connect(&desk_, &ParticipantDesk::screenChanged, this, &ParticipantWindow::showScreen);
    connect(&desk_, &ParticipantDesk::asked, this, &ParticipantWindow::ask);
    connect(&desk_, &ParticipantDesk::closed, this, &ParticipantWindow::closeQuestion);
    ticking_.setInterval(kTick_ms);
    connect(&ticking_, &QTimer::timeout, this, &ParticipantWindow::tick);
    showState();
    judge();
}

void ParticipantWindow::setNote(const QString& note) {
    note_->setText(note);
    arrange();
}

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
    if (!line_->isVisible()) setFocus(Qt::OtherFocusReason);
}

void ParticipantWindow::setStrip(QWidget* strip) {
    strip_ = strip;
    strip_->setParent(this);
    strip_->hide();
}

bool ParticipantWindow::stripOpen() const { return strip_ != nullptr && !strip_->isHidden(); }

void ParticipantWindow::openStrip(bool open) {
    if (strip_ == nullptr) return;
    if (open == stripOpen()) return arrange();  // it may ask something that needs more room
    strip_->setVisible(open);
    if (open) strip_->raise();
    if (!open) setFocus(Qt::OtherFocusReason);
    arrange();
    judge();
}

void ParticipantWindow::noteStop() {
    stopped_ = true;
    asking_ = false;
    heldKey_ = 0;
    ticking_.stop();
    showState();
    repaint();
}

void ParticipantWindow::showBreak(bool on) {
    break_ = on;
    if (!asking_ && !stopped_) showState();
}

QString ParticipantWindow::says() const {
    if (stopped_) return tr("Stopped");
    if (asking_) return tr("Answer phase");
    switch (screen_.state) {
        case ScreenState::Rest:
            return tr("Rest");
        case ScreenState::Dot:
        case ScreenState::Feel:
        case ScreenState::Interval:
            return tr("Presentation");
        case ScreenState::Named:
            return tr("A name");
        case ScreenState::Break:
            return tr("Break");
        case ScreenState::Ended:
            break;
    }
    return tr("Ended");
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
    if (screen.state == ScreenState::Rest) hold_->hide();
    showState();
    repaint();  // when it changes is the session's: not with the next frame
    emit changed();
}

void ParticipantWindow::ask(const PilotPrompt& prompt, quint64 id) {
    if (prompt.to == PromptTo::Operator) {
        asking_ = false;
        say(tr("One moment, please."), tr("The operator has something to do."));
        field_->clear();
        emit changed();
        return;
    }
    prompt_ = asItStands(prompt);
    if (prompt.kind == PromptKind::Several) prompt_.targets.push_back({kDone, tr("Done").toStdString()});
    keys_ = AnswerKeys(set_, prompt_);
    id_ = id;
    asking_ = true;
    stopped_ = false;
    showState();
    painted_ = false;
    repaint();
    since_.start();
    if (painted_) desk_.targetsShown(id_, std::chrono::steady_clock::now());
    if (prompt.within) ticking_.start();
    if (prompt.kind == PromptKind::Hold && desk_.holding()) return pressHold();  // from the series before
    emit changed();
}

void ParticipantWindow::closeQuestion(quint64 id) {
    if (!asking_ || id != id_) return;
    asking_ = false;
    ticking_.stop();
    showState();
    emit changed();
}

void ParticipantWindow::say(const QString& title, const QString& below) {
    title_->setText(title);
    below_->setText(below);
    arrange();
}

/// The words and the field of what goes on.
void ParticipantWindow::showState() {
    const auto shown = asking_ && prompt_.within;
    timeWord_->setVisible(shown);
    time_->setVisible(shown);
    time_->setShares({1});
    const bool scale = asking_ && prompt_.kind == PromptKind::Scale;
    leastWord_->setText(scale ? qtext(prompt_.leastText) : QString());
    mostWord_->setText(scale ? qtext(prompt_.mostText) : QString());
    line_->setVisible(asking_ && prompt_.kind == PromptKind::Text);
    block_->setText(screen_.blocks > 0 && screen_.block > 0
                        ? tr("Block %1 of %2").arg(screen_.block).arg(screen_.blocks)
                        : phaseTitle(screen_.phase));
    blocks_->setShares(screen_.blocks > 0 && screen_.block > 0
                           ? blockShares(screen_.block, screen_.blocks, screen_.trial, screen_.trials)
                           : std::vector<double>());
    if (stopped_) {
        field_->clear();
        return say(tr("Stopped. The output is off."), tr("It goes on only when you say so."));
    }
    if (asking_) {
        if (prompt_.kind == PromptKind::Hold) {
            const auto key = QKeySequence(set_ == KeySet::LeftHand ? kHoldKeyLeft : kHoldKey).toString();
            static_cast<AnswerTarget*>(hold_)->setContent(tr("hold this"), {"hand"}, key, AnswerTarget::Shape::Row);
            hold_->show();
            field_->clear();
        } else if (isStopTest()) {
            field_->clear();
        } else if (prompt_.kind == PromptKind::Text) {
            line_->clear();
            line_->setFocus();
            field_->clear();
        } else {
            field_->showTargets(prompt_, keys_);
        }
        const auto below = prompt_.kind == PromptKind::Hold   ? tr("Letting go stops the output.")
                           : isStopTest()                     ? tr("Press STOP, or Esc.")
                           : prompt_.kind == PromptKind::Text ? tr("Return gives the answer.")
                           : prompt_.kind == PromptKind::Several
                               ? tr("Touch each that fits, then press Return or “done”.")
                           : targetCount(prompt_) == 1 ? tr("Touch it, or press its key.")
                           : prompt_.within            ? tr("Touch one, or press its key. There is time.")
                                                       : tr("Touch one, or press its key.");
        return say(qtext(prompt_.text), below);
    }
    if (break_ && !feels()) {
        field_->clear();
        return say(tr("Break"), tr("It goes on when both of you are ready."));
    }
    switch (screen_.state) {
        case ScreenState::Rest:
            field_->clear();
            return say(qtext(screen_.text), {});
        case ScreenState::Dot:
        case ScreenState::Feel:
            field_->showDot();
            return say(tr("Feel what comes"), qtext(screen_.text));
        case ScreenState::Interval:
            if (screen_.interval == 0)
                field_->showDot();
            else
                field_->showWord(screen_.interval == 2 ? tr("second") : tr("first"), {});
            return say(tr("Feel what comes"), qtext(screen_.text));
        case ScreenState::Named: {
            const auto verdict = !screen_.right   ? tr("This is")
                                 : *screen_.right ? tr("Right. This was")
                                                  : tr("This was");
            field_->showWord(conditionWords(screen_.named), iconsOf(screen_.named));
            return say(verdict, qtext(screen_.text));
        }
        case ScreenState::Break:
            field_->clear();
            return say(tr("Break"), screen_.text.empty() ? tr("Take your time.") : qtext(screen_.text));
        case ScreenState::Ended:
            field_->clear();
            return say(tr("That was all. Thank you."), qtext(screen_.text));
    }
}

void ParticipantWindow::arrange() {
    const double s = std::min(width() / kWide, height() / kHigh);
    const double text = s * scaledPx(1000) / 1000.0;
    const auto px = [&](double designed) { return int(std::lround(designed * s)); };
    const int margin = px(kMargin), right = width() - margin;
    const int stopLeft = int(std::lround(kStopLeft / kWide * width()));
    const int column = std::min(int(std::lround(kColumn / kWide * width())), stopLeft - margin - px(kGap));
    const int foot = stripOpen() ? strip_->sizeHint().height() : 0;
    if (stripOpen()) strip_->setGeometry(0, height() - foot, width(), foot);  // as high as what it asks needs
    const int bottom = height() - foot;

    const auto head = withPixels(int(kHead_px * text));
    const int headHigh = QFontMetrics(head).height();
    for (auto* label : {block_, note_, below_}) label->setFont(head);
    const int top = px(kTop);
    block_->setGeometry(margin, top, QFontMetrics(head).horizontalAdvance(block_->text()) + 2, headHigh);
    const int barsLeft = block_->geometry().right() + px(kGap);
    blocks_->setGeometry(barsLeft, top + headHigh / 2 - px(4), std::max(0, std::min(px(392), stopLeft - barsLeft)),
                         std::max(4, px(8)));
    const int noteWide = QFontMetrics(head).horizontalAdvance(note_->text()) + 2;
    note_->setGeometry(right - noteWide, top, noteWide, headHigh);

    const int stopTop = std::max(px(kStopTop), top + headHigh + px(12));
    stopTarget_->setGeometry(stopLeft, stopTop, right - stopLeft, bottom - px(kStopBottom) - stopTop);
    stopTarget_->setType(int(kStop_px * s), int(kHead_px * text));

    // From the foot: the time bar, what is held; from the head: the question. The targets have the rest.
    const auto small = withPixels(std::max(11, int(kSmall_px * text)));
    const int smallHigh = QFontMetrics(small).height();
    const int timeTop = bottom - px(kMargin);
    timeWord_->setFont(small);
    const int wordWide = QFontMetrics(small).horizontalAdvance(timeWord_->text()) + 2;
    timeWord_->setGeometry(margin, timeTop - smallHigh / 2, wordWide, smallHigh);
    time_->setGeometry(margin + wordWide + px(14), timeTop - px(4), column - wordWide - px(14), std::max(4, px(8)));
    const int least = pixelsOf(kTarget_mm, *this);
    int fieldBottom = bottom - px(kStopBottom) - px(12);
    if (!hold_->isHidden()) {
        hold_->setGeometry(margin, fieldBottom - least, column, least);
        static_cast<AnswerTarget*>(hold_)->setType(int(kWords_px * text), int(kHead_px * text));
        fieldBottom -= least + px(kGap);
    }

    const int gap = px(kGap);
    const bool asks = asking_ && prompt_.kind != PromptKind::Hold && prompt_.kind != PromptKind::Text && !isStopTest();
    const int count = asks ? targetCount(prompt_) : 0;
    const int rows = count == 0                          ? 0
                     : prompt_.kind == PromptKind::Scale ? (count + 5) / 6
                     : count <= 3                        ? 1
                                                         : (count + fieldColumns(count) - 1) / fieldColumns(count);
    const int wanted = rows * least + std::max(0, rows - 1) * gap;
    int title_px = int(kTitle_px * text);
    int fieldTop = 0;
    bool hasBelow = text < kLargeText * s;  // with large text the targets take the room first
    for (;;) {
        const auto font = withPixels(title_px, QFont::Bold);
        title_->setFont(font);
        const int titleHigh = title_->heightForWidth(column);
        title_->setGeometry(margin, stopTop, column, titleHigh);
        const int belowHigh = hasBelow && !below_->text().isEmpty() ? below_->heightForWidth(column) : 0;
        below_->setVisible(belowHigh > 0);
        below_->setGeometry(margin, stopTop + titleHigh + px(8), column, belowHigh);
        fieldTop = stopTop + titleHigh + (belowHigh > 0 ? belowHigh + px(8) : 0) + px(36);
        if (fieldBottom - fieldTop >= wanted) break;
        // The targets come first: the second line goes, then the question gets smaller.
        if (hasBelow)
            hasBelow = false;
        else if (title_px > int(kHead_px * s))
            title_px -= 2;
        else
            break;
    }
    field_->setGeometry(margin, fieldTop, column, std::max(1, fieldBottom - fieldTop));
    field_->setType(int(kWords_px * text), int(kHead_px * text), gap);
    line_->setFont(withPixels(int(kWords_px * text)));
    line_->setGeometry(margin, fieldTop, column, least);
    for (auto* end : {leastWord_, mostWord_}) end->setFont(head);
    const bool ends = !leastWord_->text().isEmpty() || !mostWord_->text().isEmpty();
    leastWord_->setVisible(ends);
    mostWord_->setVisible(ends);
    if (!ends) return;
    // Below the row of a scale's targets.
    const int endsTop = std::min(fieldTop + rows * pixelsOf(60, *this) + rows * gap, fieldBottom);
    leastWord_->setGeometry(margin, endsTop, column / 2, headHigh);
    mostWord_->setGeometry(margin + column / 2, endsTop, column - column / 2, headHigh);
    mostWord_->setAlignment(Qt::AlignRight | Qt::AlignVCenter);
}

/// Answered by STOP, and by nothing else.
bool ParticipantWindow::isStopTest() const { return prompt_.name == "stop-test"; }

void ParticipantWindow::choose(int target, SteadyTime at) {
    if (!asking_ || isStopTest()) return;
    const auto index = std::size_t(target);
    PilotAnswer answer;
    if (prompt_.kind == PromptKind::Several && prompt_.targets.at(index).key != kDone) {
        field_->setChosen(target, !field_->chosen(target));
        return;
    }
    if (prompt_.kind == PromptKind::Scale) {
        answer.value = prompt_.least + target;
    } else if (prompt_.kind == PromptKind::Several) {
        for (std::size_t i = 0; i < prompt_.targets.size(); ++i) {
            if (i != index && field_->chosen(int(i))) answer.keys.push_back(prompt_.targets[i].key);
        }
    } else {
        answer.keys.push_back(prompt_.targets.at(index).key);
    }
    give(std::move(answer), at);
}

void ParticipantWindow::give(PilotAnswer answer, SteadyTime at) {
    if (!asking_) return;
    asking_ = false;
    ticking_.stop();
    desk_.answerAsParticipant(id_, std::move(answer), at);
    say({}, {});
    field_->clear();
    timeWord_->hide();
    time_->hide();
    line_->hide();
    setFocus(Qt::OtherFocusReason);
    emit changed();
}

void ParticipantWindow::pressHold() {
    if (!asking_ || prompt_.kind != PromptKind::Hold) return;
    desk_.setHolding(true);
    PilotAnswer answer;
    answer.keys.emplace_back("held");
    give(std::move(answer), std::chrono::steady_clock::now());
}

void ParticipantWindow::letGo() {
    heldKey_ = 0;
    if (!desk_.holding()) return;
    desk_.setHolding(false);
    stop_("participant let go");
    hold_->hide();
    noteStop();
}

void ParticipantWindow::noteEarly(std::optional<int> target) {
    const bool known = target && std::size_t(*target) < prompt_.targets.size();
    desk_.noteEarly(known ? prompt_.targets[std::size_t(*target)].key : std::string());
}

void ParticipantWindow::keyPressEvent(QKeyEvent* event) {
    const int key = event->key();
    const auto at = timeOf(*event);
    const int hold = set_ == KeySet::LeftHand ? kHoldKeyLeft : kHoldKey;
    if (key == hold && !hold_->isHidden()) {
        if (event->isAutoRepeat()) return;
        heldKey_ = key;
        return pressHold();
    }
    if (key == Qt::Key_F2 && strip_ != nullptr && !event->isAutoRepeat()) return openStrip(!stripOpen());
    const auto before = pressed_.find(key);
    const bool held = event->isAutoRepeat() || (before != pressed_.end() && at - before->second < kRepeats);
    if (before != pressed_.end() && held) before->second = at;
    if (!asking_) {
        const auto would = AnswerKeys(set_, prompt_).targetOf(key);
        if (!held && feels()) noteEarly(would);
        pressed_[key] = at;
        return;
    }
    if (held) return;
    pressed_.erase(key);
    if (prompt_.kind == PromptKind::Several && (key == Qt::Key_Return || key == Qt::Key_Enter)) {
        PilotAnswer answer;
        for (std::size_t i = 0; i < prompt_.targets.size(); ++i) {
            if (field_->chosen(int(i)) && prompt_.targets[i].key != kDone)
                answer.keys.push_back(prompt_.targets[i].key);
        }
        return give(std::move(answer), at);
    }
    if (const auto target = keys_.targetOf(key)) choose(*target, at);
}

void ParticipantWindow::keyReleaseEvent(QKeyEvent* event) {
    if (event->isAutoRepeat()) return;
    if (heldKey_ != 0 && event->key() == heldKey_) letGo();
}

void ParticipantWindow::mousePressEvent(QMouseEvent* /*event*/) {
    if (feels()) noteEarly({});
}

void ParticipantWindow::paintEvent(QPaintEvent* event) {
    QWidget::paintEvent(event);
    painted_ = true;
    if (!asking_) return;
    // The first time that the window system lets this window be seen: the targets are on the screen once it returns.
    QMetaObject::invokeMethod(
        this,
        [this, id = id_] {
            if (asking_ && id == id_) desk_.targetsShown(id, std::chrono::steady_clock::now());
        },
        Qt::QueuedConnection);
}

/// What is in the way of a presentation.
void ParticipantWindow::judge() {
    QString why;
    const int least = pixelsOf(kTarget_mm, *this);
    if (!isVisible())
        why = tr("the participant's window is not shown");
    else if (stripOpen())
        why = tr("the operator's strip is open on the participant's screen: F2 closes it");
    else if (!isActiveWindow())
        why = tr("the participant's window does not have the keys");
    else if (const int need = 6 * least; height() < need || width() < 5 * least)
        why = tr("the participant's screen has no room for targets of 20 mm");
    desk_.setObstacle(why);
    emit changed();
}

void ParticipantWindow::tick() {
    if (!asking_ || !prompt_.within) return;
    const double gone = double(since_.nsecsElapsed()) * 1e-9 / prompt_.within->count();
    time_->setShares({std::clamp(1 - gone, 0.0, 1.0)});
}

void ParticipantWindow::closeEvent(QCloseEvent* event) {
    event->ignore();  // it closes with the session
    stop_("participant");
    noteStop();
    emit closeWanted();
}

void ParticipantWindow::changeEvent(QEvent* event) {
    QWidget::changeEvent(event);
    if (event->type() == QEvent::FontChange) arrange();
    if (event->type() != QEvent::ActivationChange) return;
    if (!isActiveWindow() && heldKey_ != 0) letGo();  // its release would go to another window
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

void ParticipantWindow::resizeEvent(QResizeEvent* event) {
    QWidget::resizeEvent(event);
    arrange();
    judge();
}

}  // namespace tacto::gui
