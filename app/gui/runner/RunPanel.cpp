#include "app/gui/runner/RunPanel.h"

#include <QApplication>
#include <cmath>

#include "app/gui/theme/Building.h"
#include "app/gui/theme/ConfirmButton.h"
#include "app/gui/theme/Icons.h"
#include "app/gui/theme/Labels.h"
#include "app/gui/theme/Theme.h"
#include "app/report/NumberText.h"

namespace tacto::gui {

namespace {

constexpr double kMinute_s = 60;
constexpr double kMinutesFrom_s = 90;

QString timeText(double seconds) {
    if (seconds < kMinutesFrom_s) return QObject::tr("%1 s").arg(std::max(1, int(std::ceil(seconds))));
    return QObject::tr("%1 min").arg(int(std::ceil(seconds / kMinute_s)));
}

}  // namespace

void TimeLeft::note(const ScriptProgress& progress, bool paused, double now_s) {
    if (seenAt_s_ < 0 || progress.label != label_ || progress.done < done_) {
        label_ = progress.label;
        firstDone_ = done_ = progress.done;
        total_ = progress.total;
        worked_s_ = workedAtStep_s_ = 0;
        seenAt_s_ = now_s;
        return;
    }
    if (!paused) worked_s_ += now_s - seenAt_s_;
    seenAt_s_ = now_s;
    total_ = progress.total;
    if (progress.done > done_) workedAtStep_s_ = worked_s_;
    done_ = progress.done;
}

std::optional<double> TimeLeft::seconds() const {
    if (done_ <= firstDone_ || total_ <= done_) return std::nullopt;
    const double perStep = workedAtStep_s_ / double(done_ - firstDone_);
    // Part of the time for the present step has already passed.
    return std::max(0.0, perStep * double(total_ - done_) - (worked_s_ - workedAtStep_s_));
}

RunPanel::RunPanel(QWidget* parent)
    : QWidget(parent), layout_(new QBoxLayout(QBoxLayout::TopToBottom, this)), words_(new QWidget(this)) {
    layout_->setContentsMargins(0, 0, 0, 0);
    buildWords();
    layout_->addWidget(words_);
    run_ = new QPushButton(tr("R&un"), this);
    run_->setObjectName("runButton");
    run_->setAutoDefault(false);
    makePrimary(*run_);
    connect(run_, &QPushButton::clicked, this, &RunPanel::runWanted);
    setFocusProxy(run_);
    layout_->addWidget(run_);
    bar_ = new ProgressBar(this);
    bar_->setAccessibleName(tr("Progress"));
    bar_->setToolTip(
        tr("STOP, Esc and Shift+F5 switch the output off and end the run; what was recorded so far is kept. "
           "Pause in the safety bar holds it."));
    bar_->setFocusPolicy(Qt::StrongFocus);  // has the focus during a run, so that Space stops and is not typed anywhere
    bar_->setRange(0, 1);
    bar_->setValue(0);
    layout_->addWidget(bar_);
    bar_->hide();
    howLong_ = tr("F5 runs; Esc stops.");
    left_ = makeLabel(howLong_,
                      {.name = "timeLeft", .tone = Tone::Quiet, .size = TextSize::Small, .wraps = true, .plain = true},
                      this);
    // Above the button, so that Run stays where it is when there is more to say.
    layout_->insertWidget(layout_->indexOf(run_), left_);
    showButtons();
}

void RunPanel::buildWords() {
    auto* column = columnIn(*words_);
    const auto addTrouble = [&](const char* name) {
        auto* line = new TroubleLine(name, words_);
        column->addWidget(line);
        return line;
    };
    const auto addButton = [&](const QString& text, const char* name, const QString& tip) {
        auto* button = pageButton(text, name, tip, words_);
        button->hide();
        column->addWidget(button, 0, Qt::AlignLeft);
        return button;
    };
    obstacle_ = addTrouble("runObstacle");
    changeProfile_ =
        addButton(tr("Change profile…"), "changeProfile",
                  tr("Opens the encoding profile: a smaller amplitude or a longer interval stays within the limit."));
    connect(changeProfile_, &QPushButton::clicked, this, &RunPanel::profileChangeWanted);
    trouble_ = addTrouble("runTrouble");
    toLine_ = addButton(tr("Show the &line in the script"), "toLine", tr("Opens the script with that line marked."));
    connect(toLine_, &QPushButton::clicked, this, [this] { emit lineWanted(line_, said_); });
    closed_ = makeLabel(tr("The run closed the bench that was open."), {.name = "closedByRun", .wraps = true}, words_);
    closed_->hide();
    column->addWidget(closed_);
    setTone(*closed_, Tone::Quiet);
    openAgain_ =
        addButton(tr("Open the bench again"), "openAgain",
                  tr("Opens the same devices; the output stays off. A run that came to its end does it by itself."));
    connect(openAgain_, &QPushButton::clicked, this, &RunPanel::openAgainWanted);
    question_ = buildQuestion();
    column->addWidget(question_);
}

QWidget* RunPanel::buildQuestion() {
    auto* holder = new QWidget(words_);
    auto* column = columnIn(*holder);
    questionText_ = makeLabel({}, {.name = "armQuestion", .wraps = true, .plain = true}, holder);
    column->addWidget(questionText_);
    auto* row = new QHBoxLayout;
    arm_ = new ConfirmButton(tr("Arm and run"), holder);
    arm_->setToolTip(tr("The second of two steps: the protocol may now put out current."));
    connect(arm_, &QPushButton::clicked, this, [this] {
        question_->hide();
        emit confirmed();
    });
    back_ = pageButton(tr("Back"), {}, tr("Nothing is opened, and the output stays off."), holder);
    connect(back_, &QPushButton::clicked, this, [this] {
        question_->hide();
        run_->setFocus();
    });
    addAll(*row, {arm_, back_});
    row->addStretch();
    column->addLayout(row);
    holder->hide();
    return holder;
}

void RunPanel::setAcross(bool across) {
    across_ = across;
    layout_->setDirection(across ? QBoxLayout::RightToLeft : QBoxLayout::TopToBottom);
    if (!across) layout_->insertWidget(0, words_);
    showButtons();
}

/// In the one-row layout, the bar shows progress and time left together.
void RunPanel::sayHowFar(const QString& format, const QString& left) {
    howLong_ = left;
    sayLeft();
    bar_->setFormat(across_ && running_ ? tr("%1 · %2").arg(format, left) : format);
    const int needed = bar_->fontMetrics().horizontalAdvance(bar_->format() + "00");
    bar_->setMinimumWidth(across_ ? std::max(needed, bar_->minimumWidth()) : 0);  // the bar does not shrink
}

void RunPanel::sayLeft() {
    const auto more = running_                   ? tr("Esc ends the run; what was recorded is kept.")
                      : benchOpen_ == Open::None ? QString()
                      : benchOpen_ == Open::Bench
                          ? tr("Running closes the open bench and opens it again afterwards.")
                          : tr("Running closes the open bench and opens it again afterwards. Its "
                               "simulated faults are not in the run: choose them under Wiring.");
    left_->setText(more.isEmpty() ? howLong_ : howLong_ + '\n' + more);
}

void RunPanel::setBench(Open open, bool closedByRun) {
    benchOpen_ = open;
    sayLeft();
    for (QWidget* part : {static_cast<QWidget*>(closed_), static_cast<QWidget*>(openAgain_)})
        part->setVisible(closedByRun);
}

void RunPanel::setLeading(bool leading) {
    makePrimary(*run_, leading);
    run_->setText(leading ? tr("R&un") : tr("R&un again"));
    run_->setIcon(leading ? QIcon() : icon("run"));
}

void RunPanel::setReady(bool ready, const QString& obstacle, bool byProfile) {
    ready_ = ready && obstacle.isEmpty();
    changeProfile_->setVisible(byProfile && !obstacle.isEmpty());
    if (!ready_) question_->hide();
    obstacle_->say(obstacle);
    // A script's words must not be read as markup.
    run_->setToolTip(!obstacle.isEmpty()
                         ? (Qt::mightBeRichText(obstacle) ? obstacle.toHtmlEscaped() : obstacle)
                         : tr("Opens the devices, arms on the declared load and runs (F5). Esc stops. A bench that is "
                              "open under Live is closed first, and opened again after a run that came to its end; its "
                              "output stays off."));
    showButtons();
}

void RunPanel::say(const QString& what, int line) {
    said_ = what;
    line_ = line;
    toLine_->setVisible(line > 0);
    trouble_->say(what);
}

void RunPanel::askToArm(const QString& what) {
    questionText_->setText(what);
    question_->show();
    back_->setFocus();
}

void RunPanel::withdrawQuestion() {
    if (question_->isAncestorOf(QApplication::focusWidget())) run_->setFocus();
    question_->hide();
}

bool RunPanel::speaks() const { return !obstacle_->isHidden() || !trouble_->isHidden() || !question_->isHidden(); }

void RunPanel::begin() {
    say({});
    question_->hide();
    running_ = true;
    progress_ = {};
    since_.restart();
    timeLeft_.begin();
    bar_->show();
    bar_->setRange(0, 0);
    sayHowFar(tr("starting"), tr("opening the devices"));
    showButtons();
    bar_->setFocus();
}

void RunPanel::show(const ScriptProgress* progress, bool paused, bool waiting) {
    if (!running_) return;
    const double now_s = double(since_.elapsed()) / 1000;
    if (progress != nullptr) progress_ = *progress;
    if (progress_.total == 0) {
        sayHowFar(tr("running"), waiting  ? tr("waits for your answer")
                                 : paused ? tr("paused")
                                          : tr("running for %1").arg(timeText(now_s)));
        return;
    }
    timeLeft_.note(progress_, paused || waiting, now_s);
    bar_->setRange(0, int(progress_.total));
    bar_->setValue(int(progress_.done));
    const auto left = timeLeft_.seconds();
    sayHowFar(tr("%1: %2 of %3").arg(QString::fromStdString(progress_.label)).arg(progress_.done).arg(progress_.total),
              waiting  ? tr("waits for your answer")
              : paused ? tr("paused")
              : left   ? tr("about %1 left").arg(timeText(*left))
                       : tr("time left: not known yet"));
}

void RunPanel::end(bool early, std::optional<Seconds> benchTime) {
    running_ = false;
    const auto steps = progress_.total > 0 ? tr(" after %1 of %2").arg(progress_.done).arg(progress_.total) : QString();
    bar_->setRange(0, std::max(1, int(progress_.total)));
    bar_->setValue(early ? int(progress_.done) : bar_->maximum());
    bar_->setVisible(early);
    const auto took = timeText(double(since_.elapsed()) / 1000);
    sayHowFar(early ? tr("ended early%1").arg(steps) : tr("done"),
              benchTime ? tr("Took %1; %2 of the bench’s time").arg(took, durationText(benchTime->count()))
                        : tr("Took %1").arg(took));
    showButtons();
}

void RunPanel::showButtons() {
    run_->setEnabled(!running_ && ready_);
    run_->setVisible(!across_ || !running_);
    left_->setVisible(!across_);
}

}  // namespace tacto::gui

#include "moc_RunPanel.cpp"
