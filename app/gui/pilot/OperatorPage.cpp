#include "app/gui/pilot/OperatorPage.h"

#include <QFrame>
#include <cmath>

#include "app/gui/pilot/ImpedanceTrend.h"
#include "app/gui/pilot/SessionPath.h"
#include "app/gui/theme/Building.h"
#include "app/gui/theme/ConfirmButton.h"
#include "app/gui/theme/Icons.h"
#include "app/gui/theme/Labels.h"
#include "app/gui/theme/Text.h"

namespace tacto::gui {

namespace {

constexpr int kOperatorPad = 16, kLow = 420;  // height in pixels; below it the plot is hidden
constexpr double kTrial_s = 9;                // time of one test trial in seconds, as the study design assumes

QString phaseName(const std::string& phase) {
    if (phase == "ascending") return QObject::tr("Rising levels");
    if (phase == "detection") return QObject::tr("Detection threshold");
    if (phase == "range") return QObject::tr("Range");
    if (phase == "comparison") return QObject::tr("Comparison of strengths");
    if (phase == "drift") return QObject::tr("Drift check");
    return titled(qtext(phase));
}

/// Returns, for example, "Test, block 2 of 5, trial 27 of 90".
QString whereText(const PilotScreen& screen) {
    QStringList words{phaseName(screen.phase)};
    if (screen.phase.empty()) words = QStringList(QObject::tr("Preparing"));
    if (screen.block > 0 && screen.blocks > 0)
        words << (screen.phase == "ascending" ? QObject::tr("series %1 of %2") : QObject::tr("block %1 of %2"))
                     .arg(screen.block)
                     .arg(screen.blocks);
    else if (screen.block > 0)
        words << QObject::tr("block %1").arg(screen.block);
    if (screen.trial > 0 && screen.trials > 0)
        words << QObject::tr("trial %1 of %2").arg(screen.trial).arg(screen.trials);
    else if (screen.trial > 0)
        words << QObject::tr("trial %1").arg(screen.trial);
    return words.join(", ");
}

}  // namespace

OperatorPage::OperatorPage(QWidget* parent)
    : QWidget(parent),
      where_(makeLabel({}, {.name = "whereInSession", .size = TextSize::Large}, this)),
      counts_(new ElidedLabel(this)),
      hidden_(new ElidedLabel(this)),
      phase_(new PhaseBar(this)),
      trend_(new ImpedanceTrend(this)),
      notes_(new SessionNotes(this)),
      ask_(new OperatorAsk(this)),
      obstacle_(new QWidget(this)) {
    setObjectName("operatorPage");
    auto* all = columnIn(*this, 0);
    auto* column = new QVBoxLayout;
    column->setContentsMargins(kOperatorPad, kOperatorPad, kOperatorPad, kOperatorPad / 2);
    column->setSpacing(kOperatorPad / 4);
    column->addWidget(where_);
    for (auto* quiet : {counts_, hidden_}) {
        setTone(*quiet, Tone::Quiet);
        column->addWidget(quiet);
    }
    column->addSpacing(kOperatorPad / 2);
    column->addWidget(phase_);
    auto* row = rowIn(*obstacle_);
    obstacleText_ = makeLabel({}, {.name = "presentationObstacle", .tone = Tone::Warning, .wraps = true}, obstacle_);
    row->addWidget(obstacleText_, 1);
    auto* keys =
        pageButton(tr("&Hand over the keys"), {}, tr("Brings the participant’s window to the front."), obstacle_);
    connect(keys, &QPushButton::clicked, this, &OperatorPage::keysWanted);
    row->addWidget(keys);
    // The line appears and disappears with the keys; its space is kept so that the buttons below do not move.
    auto kept = obstacle_->sizePolicy();
    kept.setRetainSizeWhenHidden(true);
    obstacle_->setSizePolicy(kept);
    onFontChange(*this, [this] { keepRoomForObstacle(); });
    obstacle_->hide();
    addAll(*column, {obstacle_, ask_});
    column->addSpacing(kOperatorPad / 2);
    column->addWidget(trend_, 100);
    column->addStretch(1);  // fills the space when the trend is hidden
    column->addSpacing(kOperatorPad / 2);
    column->addWidget(notes_);
    all->addLayout(column, 1);
    all->addWidget(buildBar());
    onEvent(*this, QEvent::Resize, [this] {
        keepRoomForObstacle();
        showTrend();
    });
}

QWidget* OperatorPage::buildBar() {
    auto* bar = new QFrame(this);
    bar->setObjectName("sessionBar");
    bar->setAutoFillBackground(true);
    bar->setBackgroundRole(QPalette::Window);
    auto* both = columnIn(*bar, 0);
    both->addWidget(lineAcross(bar));
    auto* row = new QHBoxLayout;
    row->setContentsMargins(kOperatorPad, kOperatorPad / 2 + 4, kOperatorPad, kOperatorPad / 2 + 4);
    row->setSpacing(8);
    after_ = pageButton(tr("Break after this trial"), "breakAfterTrial",
                        tr("The trial under way is answered first; the next one waits for you."), bar);
    after_->setIcon(icon("break", Ink::Primary));
    makePrimary(*after_);
    connect(after_, &QPushButton::clicked, this, [this] { emit breakAfterTrialWanted(!breakDue_); });
    now_ = pageButton(
        tr("Break now"), "breakNow",
        tr("No further train follows, and the present trial is repeated after the break. STOP ends a train that is "
           "under way."),
        bar);
    connect(now_, &QPushButton::clicked, this, &OperatorPage::breakNowWanted);
    onDisk_ = makeLabel<ElidedLabel>({}, {.name = "answersKept", .tone = Tone::Quiet, .size = TextSize::Small}, bar);
    onDisk_->setAlignment(Qt::AlignRight | Qt::AlignVCenter);
    abort_ = pageButton(tr("Abort session…"), "abortSession",
                        tr("First of two steps. Ends the session; what was answered is kept."), bar);
    connect(abort_, &QPushButton::clicked, this, [this] {
        abort_->hide();
        sure_->show();
    });
    sure_ = new QWidget(bar);
    auto* sureRow = rowIn(*sure_);
    reallyAbort_ = new ConfirmButton(tr("End it now"), sure_);
    reallyAbort_->setObjectName("reallyAbort");
    connect(reallyAbort_, &QPushButton::clicked, this, &OperatorPage::abortWanted);
    auto* back = new QPushButton(tr("Go on"), sure_);
    back->setAutoDefault(false);
    connect(back, &QPushButton::clicked, this, [this] {
        sure_->hide();
        abort_->show();
    });
    addAll(*sureRow, {reallyAbort_, back});
    sure_->hide();
    addAll(*row, {after_, now_});
    row->addWidget(onDisk_, 1);
    addAll(*row, {abort_, sure_});
    both->addLayout(row);
    return bar;
}

void OperatorPage::begin(const PilotStart& start) {
    blind_ = start.blind;
    screen_ = {};
    asked_.clear();
    virtual_ = !start.person;
    kept_ = {};
    at_ = Instant(0);
    theirs_.reset();
    vibrates_ = start.massager;
    trend_->clear();
    trend_->setSimulated(start.simulated());
    showTrend();
    notes_->clear();
    ask_->close();
    sure_->hide();
    abort_->show();
    setBreakDue(false);
    setObstacle({});
    phaseSince_.start();
    show(screen_);
}

void OperatorPage::show(const PilotScreen& screen) {
    const bool test = screen.phase == "test";
    if (test && screen.trial > 0) {
        if (screen.trials > 0) trend_->setPlan(screen.trials, std::max(1, screen.blocks));
        if (blind_) trend_->note(screen.trial, screen.impedance_ohm);
    }
    if (screen.state != screen_.state || screen.trial != screen_.trial) phaseSince_.start();
    if (screen.phase != screen_.phase) asked_.clear();
    screen_ = screen;
    showWhere();
    showTold();
    showCounts();
    refresh({});
}

void OperatorPage::count(const PilotCounts& counts) {
    kept_ = counts;
    showCounts();
}

std::optional<double> OperatorPage::waits_s() const {
    if (!screen_.until || at_ == Instant(0)) return {};
    return std::max(0.0, std::ceil(toSeconds(*screen_.until - at_)));
}

QString OperatorPage::whereAndWaits() const {
    const auto left = waits_s();
    return left && *left > 0 ? tr("%1: %2 s left").arg(where()).arg(*left) : where();
}

/// Says what is waited for, and what the operator may know.
void OperatorPage::showTold() {
    const bool mayKnow = !blind_ || screen_.operatorMayKnow;
    auto told = mayKnow ? qtext(screen_.operatorText) : QString();
    if (screen_.state == ScreenState::Break && screen_.until) told = tr("Break: both go on when they want to");
    if (const auto left = waits_s(); left && !told.isEmpty())
        told = *left > 0 ? tr("%1: %2 s left").arg(told).arg(*left) : tr("%1: the time is over").arg(told);
    hidden_->setText(!told.isEmpty() ? told
                     : blind_        ? tr("Hidden until the session ends: condition, level, interval, answers")
                                     : QString());
}

void OperatorPage::showWhere() { where_->setText(asked_.isEmpty() ? whereText(screen_) : asked_); }

void OperatorPage::showCounts() {
    QStringList words;
    if (virtual_) words << tr("Nothing is asked of you");
    words << (kept_.voided == 1 ? tr("1 trial voided") : tr("%1 trials voided").arg(kept_.voided));
    if (screen_.phase == "test" && screen_.blocks > 1 && screen_.block > 0 && screen_.block < screen_.blocks &&
        screen_.trials > 0) {
        const int last = int(std::lround(double(screen_.trials) / screen_.blocks * screen_.block));
        const double minutes = std::max(0, last - screen_.trial + 1) * kTrial_s / 60;
        words << tr("next break after trial %1, in about %2 min").arg(last).arg(std::max(1, int(std::lround(minutes))));
    }
    counts_->setText(words.join(" · "));
    counts_->setToolTip(counts_->text());
    onDisk_->setText(kept_.answers == 1 ? tr("1 answer on disk") : tr("%1 answers on disk").arg(kept_.answers));
}

void OperatorPage::ask(const PilotPrompt& prompt, quint64 id) {
    if (const auto step = stepAsked(prompt.name, screen_.phase, vibrates_); !step.isEmpty()) asked_ = step;
    showWhere();
    if (prompt.to != PromptTo::Participant) ask_->ask(prompt, id);
    if (prompt.to == PromptTo::Operator) return;
    theirs_ = prompt;
    theirsId_ = id;
    phaseSince_.start();
    refresh({});
}

void OperatorPage::closeQuestion(quint64 id) {
    ask_->close();
    if (!theirs_ || theirsId_ != id) return;
    theirs_.reset();
    phaseSince_.start();
    refresh({});
}

void OperatorPage::refresh(const Telemetry& telemetry) {
    // A reading shows that a train was given, and no reading shows that none was, so a blind operator sees no point.
    if (!blind_ && screen_.phase == "test" && theirs_) trend_->note(screen_.trial, telemetry.impedance_ohm);
    if (telemetry.at != Instant(0)) at_ = telemetry.at;
    if (screen_.until) showTold();
    const double gone = double(phaseSince_.nsecsElapsed()) * 1e-9;
    if (theirs_) {
        if (!theirs_->within) return phase_->setPhase(PhaseBar::kAnswer);
        const double left = std::max(0.0, theirs_->within->count() - gone);
        return phase_->setPhase(PhaseBar::kAnswer, std::round(left * 10) / 10,
                                std::min(1.0, gone / theirs_->within->count()));
    }
    switch (screen_.state) {
        case ScreenState::Dot:
            return phase_->setPhase(PhaseBar::kGetReady);
        case ScreenState::Feel:
        case ScreenState::Interval:
        case ScreenState::Named:
            return phase_->setPhase(PhaseBar::kTrains);
        case ScreenState::Rest:
        case ScreenState::Break:
            return phase_->setPhase(PhaseBar::kRest);
        case ScreenState::Ended:
            return phase_->setPhase(PhaseBar::kNone);
    }
}

void OperatorPage::setObstacle(const QString& why) {
    obstacleText_->setText(why.isEmpty() ? QString() : tr("⚠ No presentation starts: %1.").arg(why));
    obstacle_->setVisible(!why.isEmpty());
}

void OperatorPage::keepRoomForObstacle() {
    auto* keys = obstacle_->findChild<QPushButton*>();
    for (auto* each : {static_cast<QWidget*>(keys), static_cast<QWidget*>(obstacleText_)}) each->ensurePolished();
    obstacle_->setFixedHeight(std::max(keys->sizeHint().height(), 2 * obstacleText_->fontMetrics().lineSpacing() + 4));
}

void OperatorPage::setBreakDue(bool due) {
    breakDue_ = due;
    after_->setText(due ? tr("End the break") : tr("Break after this trial"));
}

/// Hides the trend for a massager, which has no impedance.
void OperatorPage::showTrend() { trend_->setVisible(!vibrates_ && height() > scaledPx(kLow)); }

}  // namespace tacto::gui

#include "moc_OperatorPage.cpp"
