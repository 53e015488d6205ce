#include "app/gui/pilot/PilotWorkspace.h"

#include <QApplication>
#include <QDesktopServices>
#include <QHBoxLayout>
#include <QScreen>
#include <QScrollArea>
#include <QTime>
#include <QUrl>
#include <QVBoxLayout>

#include "app/gui/pilot/FactsCard.h"
#include "app/gui/pilot/OperatorPage.h"
#include "app/gui/pilot/OperatorStrip.h"
#include "app/gui/pilot/ParticipantWindow.h"
#include "app/gui/pilot/PilotResult.h"
#include "app/gui/pilot/ScreenChoice.h"
#include "app/gui/pilot/TheirScreen.h"
#include "app/gui/runner/StepList.h"
#include "app/gui/theme/RecordTable.h"
#include "app/gui/theme/Text.h"
#include "app/gui/theme/Theme.h"
#include "app/scripting/engine/ProtocolLibrary.h"

namespace tacto::gui {

namespace {

constexpr int kPilotPath = 240, kPilotSide = 224, kPilotPad = 16;
constexpr int kMostStops = 3;  // of the participant: the third ends the session
constexpr int kOnePress_ms = 100;
constexpr const char* kProtocol = "pilot-identification";

enum PilotStep { kChecklist, kStopTest, kSkin, kThresholds, kTraining, kTest, kRatings, kAfter, kSteps };

using State = StepList::State;

/// Where a phase, or what the operator is asked in none, stands on the path; `now`: the step so far.
std::optional<int> stepOf(const std::string& name, int now) {
    if (name == "checklist") return kChecklist;
    if (name == "stop-test") return kStopTest;
    if (name == "erythema" || name == "oedema") return now >= kRatings ? kAfter : now >= kThresholds ? now : int(kSkin);
    if (name == "electrode-lot" || name == "electrodes-untouched") return kSkin;
    if (name == "ascending" || name == "detection" || name == "range") return kThresholds;
    if (name == "familiarisation" || name == "training") return kTraining;
    if (name == "test" || name == "drift" || name == "break") return kTest;
    if (name == "ratings") return kRatings;
    if (name == "ended") return kAfter;
    return {};
}

// The design's minutes at which each step begins; the end of the session is the last.
constexpr double kBegins_min[kSteps + 1] = {0, 4, 6, 12, 23, 30, 58, 62, 66};

}  // namespace

PilotWorkspace::PilotWorkspace(BenchController& controller, QWidget* parent)
    : QWidget(parent), controller_(controller) {
    setObjectName("pilotWorkspace");
    auto* row = new QHBoxLayout(this);
    row->setContentsMargins(0, 0, 0, 0);
    row->setSpacing(0);
    row->addWidget(buildPath());
    const auto edge = [this, row] {
        auto* line = new QFrame(this);
        line->setFrameShape(QFrame::VLine);
        line->setForegroundRole(QPalette::Mid);
        row->addWidget(line);
    };
    edge();
    pages_ = new QStackedWidget(this);
    new_ = new RehearsalPage(pages_);
    page_ = new OperatorPage(pages_);
    result_ = new PilotResult(pages_);
    for (auto* page : {static_cast<QWidget*>(new_), static_cast<QWidget*>(page_), static_cast<QWidget*>(result_)})
        pages_->addWidget(page);
    row->addWidget(pages_, 1);
    edge();
    side_ = buildSide();
    row->addWidget(side_);
    side_->hide();
    connectPage();
    connect(&desk_, &ParticipantDesk::screenChanged, this, &PilotWorkspace::show);
    connect(&desk_, &ParticipantDesk::asked, this, &PilotWorkspace::asked);
    connect(&desk_, &ParticipantDesk::closed, this, [this](quint64 id) {
        page_->closeQuestion(id);
        if (strip_ != nullptr) strip_->question().close();
        showTheirs();
    });
    connect(&desk_, &ParticipantDesk::obstacleChanged, this,
            [this](const QString& why) { page_->setObstacle(running_ && asked_.person ? why : QString()); });
    connect(&controller_, &BenchController::finished, this, &PilotWorkspace::ended);
    connect(&new_->screens(), &ScreenChoice::lost, this, &PilotWorkspace::screenLost);
    connect(&new_->screens(), &ScreenChoice::back, this, [this] {
        if (!running_ || !window_) return;
        desk_.setScreenThere(true);
        if (auto* screen = new_->screens().chosen()) window_->showOn(*screen);
    });
    reach(-1);
}

PilotWorkspace::~PilotWorkspace() { desk_.end(); }

QWidget* PilotWorkspace::buildPath() {
    auto* path = new QWidget(this);
    path->setObjectName("path");
    path->setFixedWidth(scaledPx(kPilotPath));
    auto* column = new QVBoxLayout(path);
    column->setContentsMargins(0, kPilotPad / 2, 0, kPilotPad);
    auto* top = new QVBoxLayout;
    top->setContentsMargins(kPilotPad, 0, kPilotPad, kPilotPad / 2);
    top->setSpacing(2);
    title_ = new QLabel(tr("Pilot sessions"), path);
    setTextSize(*title_, TextSize::Body, true);
    subtitle_ = new QLabel(tr("Can a person tell the four conditions apart?"), path);
    subtitle_->setWordWrap(true);
    setTextSize(*subtitle_, TextSize::Small);
    setTone(*subtitle_, Tone::Quiet);
    top->addWidget(title_);
    top->addWidget(subtitle_);
    column->addLayout(top);
    steps_ = new StepList({tr("Checklist"), tr("Stop test"), tr("Skin and electrodes"), tr("Thresholds and range"),
                           tr("Training"), tr("Test"), tr("Ratings"), tr("Electrodes off, skin")},
                          path);
    column->addWidget(steps_);
    column->addStretch();
    auto* foot = new QVBoxLayout;
    foot->setContentsMargins(kPilotPad, 0, kPilotPad, 0);
    foot->setSpacing(2);
    leftWord_ = new QLabel(tr("Time left"), path);
    setTextSize(*leftWord_, TextSize::Small);
    setTone(*leftWord_, Tone::Quiet);
    left_ = new QLabel(path);
    left_->setObjectName("timeLeft");
    setTextSize(*left_, TextSize::Large);
    foot->addWidget(leftWord_);
    foot->addWidget(left_);
    column->addLayout(foot);
    return path;
}

QWidget* PilotWorkspace::buildSide() {
    auto* area = new QScrollArea(this);
    area->setObjectName("pilotSide");
    area->setWidgetResizable(true);
    area->setFrameShape(QFrame::NoFrame);
    area->setHorizontalScrollBarPolicy(Qt::ScrollBarAlwaysOff);
    area->setFocusPolicy(Qt::NoFocus);
    area->setFixedWidth(scaledPx(kPilotSide));
    auto* inside = new QWidget(area);
    auto* column = new QVBoxLayout(inside);
    column->setContentsMargins(0, 0, 0, 0);
    column->setSpacing(0);
    who_ = new FactsCard(tr("Participant"), "pilot", inside);
    screenCard_ = new FactsCard(tr("Their screen"), "plot-only", inside);
    theirs_ = new TheirScreen(screenCard_);
    screenCard_->setPicture(theirs_);
    stops_ = new FactsCard(tr("Stops"), "hand", inside);
    for (auto* card : {who_, screenCard_, stops_}) {
        column->addWidget(card);
        auto* line = new QFrame(inside);
        line->setFrameShape(QFrame::HLine);
        line->setForegroundRole(QPalette::Mid);
        column->addWidget(line);
    }
    column->addStretch();
    area->setWidget(inside);
    for (auto* ground : {inside, area->viewport()}) ground->setAutoFillBackground(false);
    return area;
}

void PilotWorkspace::connectPage() {
    connect(new_, &RehearsalPage::beginWanted, this, [this] { begin(new_->rehearsal(), false); });
    connect(result_, &PilotResult::anotherWanted, this, [this] {
        pages_->setCurrentIndex(kNew);
        reach(-1);
    });
    connect(result_, &PilotResult::goOnWanted, this, [this] { begin(asked_, true); });
    connect(result_, &PilotResult::folderWanted, this,
            [this] { QDesktopServices::openUrl(QUrl::fromLocalFile(asked_.folder)); });
    connect(page_, &OperatorPage::breakAfterTrialWanted, this, &PilotWorkspace::wantBreak);
    connect(page_, &OperatorPage::breakNowWanted, this, &PilotWorkspace::breakNow);
    connect(page_, &OperatorPage::abortWanted, this, [this] { controller_.stop("operator (abort)"); });
    connect(page_, &OperatorPage::keysWanted, this, &PilotWorkspace::giveKeys);
    connect(&page_->question(), &OperatorAsk::answered, this, [this](quint64 id, const PilotAnswer& answer) {
        desk_.answerAsOperator(id, answer);
        giveKeys();
    });
    connect(&page_->notes(), &SessionNotes::noted, this, &PilotWorkspace::keep);
    connect(&page_->notes(), &SessionNotes::typingEnded, this, &PilotWorkspace::giveKeys);
}

void PilotWorkspace::connectStrip() {
    connect(strip_, &OperatorStrip::breakWanted, this, &PilotWorkspace::wantBreak);
    connect(strip_, &OperatorStrip::abortWanted, this, [this] { controller_.stop("operator (abort)"); });
    connect(strip_, &OperatorStrip::stopWanted, this, [this] { controller_.stop("operator (STOP)"); });
    connect(strip_, &OperatorStrip::closeWanted, this, [this] { window_->openStrip(false); });
    connect(&strip_->question(), &OperatorAsk::answered, this, [this](quint64 id, const PilotAnswer& answer) {
        desk_.answerAsOperator(id, answer);
        window_->openStrip(false);
    });
    connect(&strip_->notes(), &SessionNotes::noted, this, &PilotWorkspace::keep);
}

void PilotWorkspace::resizeEvent(QResizeEvent* event) {
    QWidget::resizeEvent(event);
    steps_->fit();
}

Result<RunOrder> PilotWorkspace::order(const Rehearsal& asked, bool goOn) const {
    auto source = ProtocolLibrary().find(kProtocol);
    if (!source) return failure(source);
    auto declaration = readDeclaration(*source);
    if (!declaration) return failure(declaration);
    std::map<std::string, std::string> given{{"participant", fmt::format("virtual:{}", asked.seed)}};
    if (goOn)
        given["unfinished"] = "resume";
    else
        given["blocks"] = std::to_string(asked.blocks);
    auto settings = applySettings(*declaration, given);
    if (!settings) return failure(settings);
    RunOrder order;
    order.script = std::move(*source);
    order.declaration = std::move(*declaration);
    order.settings = std::move(*settings);
    auto uri = DeviceUri::parse("sim:");
    if (!uri) return failure(uri);
    order.uris.push_back(std::move(*uri));
    order.needed = order.declaration.needs;
    order.seed = asked.seed;
    order.realtime = asked.person;
    order.notes = controller_.day().notes();
    order.profile = controller_.profile();
    order.limits = controller_.limits();
    return order;
}

void PilotWorkspace::begin(const Rehearsal& asked, bool goOn) {
    if (running_) return;
    if (controller_.activity() != Activity::Closed && controller_.activity() != Activity::Live)
        return new_->say(tr("Another protocol is running. Wait for its end or stop it (Esc)."));
    const auto mark = controller_.mark();
    auto made = order(asked, goOn);
    if (!made) {
        pages_->setCurrentIndex(kNew);
        return new_->say(sentence(made.error()));
    }
    new_->say({});
    asked_ = asked;
    running_ = true;
    seenFault_ = false;
    participantStops_ = operatorStops_ = faults_ = 0;
    screen_ = {};
    stoppedAt_.invalidate();
    page_->begin(asked.blind, true);
    reach(0);
    side_->show();
    pages_->setCurrentIndex(kSession);
    subtitle_->setText(asked.person ? tr("Rehearsal: you answer yourself") : tr("Rehearsal, virtual participant"));
    if (asked.person) openWindow();
    showFacts();
    showTheirs();
    PilotSeats seats;
    seats.study = asked.folder.toStdString();
    if (asked.person) {
        seats.people = &desk_;
        seats.begun = [this](std::shared_ptr<const Clock> clock) { desk_.begin(std::move(clock)); };
        seats.takesStop = [this](const char* by) { return desk_.testsOperatorsStop() && desk_.stopBy(by); };
    }
    run_ = controller_.runPilot(*made, seats, mark);
    emit runningChanged();
}

void PilotWorkspace::openWindow() {
    desk_.setScreenThere(true);
    window_ = std::make_unique<ParticipantWindow>(desk_, [this](const char* by) { stopAsParticipant(by); });
    window_->setKeys(asked_.keys);
    window_->setNote(tr("rehearsal · simulated"));
    connect(window_.get(), &ParticipantWindow::changed, this, &PilotWorkspace::showTheirs);
    strip_ = new OperatorStrip;
    connectStrip();
    window_->setStrip(strip_);
    if (auto* screen = new_->screens().chosen()) window_->showOn(*screen);
}

bool PilotWorkspace::stopAsParticipant(const char* by) {
    if (!running_ || !asked_.person) {
        controller_.stop(by);
        return false;
    }
    // StopKeys hears one press several times. Nothing can be on again so soon: that takes their "go on".
    if (stoppedAt_.isValid() && stoppedAt_.elapsed() < kOnePress_ms) return true;
    stoppedAt_.start();
    const bool heard = desk_.stopBy(by);
    if (!heard) controller_.stop(by);  // the session has not begun, or is over
    if (window_) window_->noteStop();
    ++participantStops_;
    showFacts();
    return heard;
}

void PilotWorkspace::show(const PilotScreen& screen) {
    screen_ = screen;
    page_->show(screen);
    if (const auto step = stepOf(screen.phase, step_); step && *step > step_) reach(*step);
    if (step_ == kTest && screen.phase == "test" && screen.trial > 0) {
        const int each = screen.blocks > 0 ? screen.trials / screen.blocks : screen.trials;
        steps_->setNote(
            kTest,
            tr("block %1 · trial %2 of %3").arg(screen.block).arg(screen.trial - (screen.block - 1) * each).arg(each));
    }
    if (strip_ != nullptr) strip_->setWhere(whereText(screen));
    left_->setText(timeLeft());
    showTheirs();
}

void PilotWorkspace::asked(const PilotPrompt& prompt, quint64 id) {
    page_->ask(prompt, id);
    if (prompt.name == "stop-test" && step_ < kStopTest) reach(kStopTest);
    if (prompt.to != PromptTo::Participant) {
        if (const auto step = stepOf(prompt.name, step_); step && *step > step_) reach(*step);
        // On the only screen the question comes up where the operator can reach it.
        if (window_ && ScreenChoice::isOnly() && strip_ != nullptr) {
            strip_->question().ask(prompt, id);
            window_->openStrip(true);
        } else {
            emit attentionWanted();
        }
    }
    showTheirs();
}

/// Everything before is done; -1: nothing has begun.
void PilotWorkspace::reach(int step) {
    step_ = std::max(0, step);
    for (int i = 0; i < kSteps; ++i) {
        const auto before = steps_->state(i);
        const auto now = i < step ? State::Done : i == step ? State::UnderWay : State::ToDo;
        steps_->setState(i, now);
        steps_->setOutOfReach(i, tr("The session goes through its steps by itself."));
        if (now == State::ToDo) steps_->setNote(i, {});
        if (now == State::UnderWay && before != now) steps_->setNote(i, QTime::currentTime().toString("HH:mm"));
    }
    steps_->setShown(std::min(step_, kSteps - 1));  // all are done once the session has ended
    const bool counts = step >= 0 && running_ && asked_.person;
    leftWord_->setVisible(counts);
    left_->setVisible(counts);
    left_->setText(timeLeft());
}

QString PilotWorkspace::timeLeft() const {
    double done_min = kBegins_min[step_];
    const double whole = kBegins_min[kSteps];
    double test_min = (kBegins_min[kRatings] - kBegins_min[kTest]) * asked_.blocks / 5;
    double rest = whole - kBegins_min[kRatings] + test_min;
    if (step_ < kTest) {
        rest += kBegins_min[kTest] - done_min;
    } else if (step_ == kTest) {
        if (screen_.trials > 0) rest -= test_min * std::max(0, screen_.trial - 1) / screen_.trials;
    } else {
        rest = whole - done_min;
    }
    return tr("about %1 min").arg(std::max(1, int(std::lround(rest))));
}

void PilotWorkspace::refresh(const Telemetry& telemetry) {
    if (!running_) return;
    const auto feed = controller_.takeRunFeed();  // its trials name conditions: they are dropped
    if (feed.progress && !asked_.person) {
        page_->setProgress(qtext(feed.progress->label), int(feed.progress->done), int(feed.progress->total));
        reach(kTest);
    }
    page_->refresh(telemetry);
    const bool faulted = telemetry.state == InterlockState::Faulted;
    if (faulted && !std::exchange(seenFault_, true)) {
        ++faults_;
        showFacts();
    }
    seenFault_ = faulted;
}

void PilotWorkspace::showFacts() {
    const auto none = tr("–");
    who_->setFacts({{tr("Participant"), asked_.person ? tr("you") : tr("virtual")},
                    {tr("Seed"), QString::number(asked_.seed)},
                    {tr("Consent"), tr("rehearsal")},
                    {tr("Study"), asked_.folder.section('/', -1)}});
    stops_->setFacts({{tr("Participant"), tr("%1 of %2").arg(participantStops_).arg(kMostStops), true},
                      {tr("Operator"), QString::number(operatorStops_), true},
                      {tr("Faults"), QString::number(faults_), true}});
}

QString PilotWorkspace::stopWords() const {
    return participantStops_ == 0 ? tr("Participant’s STOP: not pressed")
                                  : tr("Participant’s STOP: pressed %1 of %2").arg(participantStops_).arg(kMostStops);
}

void PilotWorkspace::showTheirs() {
    using Shows = TheirScreen::Shows;
    if (!window_) {
        theirs_->setShows(Shows::Nothing);
        return screenCard_->setWords(tr("A virtual participant has no screen."));
    }
    const bool feels = screen_.state == ScreenState::Dot || screen_.state == ScreenState::Feel;
    theirs_->setShows(window_->asking() ? Shows::Targets : feels ? Shows::Dot : Shows::Nothing);
    screenCard_->setWords(tr("%1, on “%2”. Their keys: %3.")
                              .arg(window_->says(), new_->screens().chosenName(),
                                   asked_.keys == KeySet::Figures    ? tr("the figures")
                                   : asked_.keys == KeySet::LeftHand ? tr("the left hand’s")
                                                                     : tr("the right hand’s")));
}

void PilotWorkspace::wantBreak(bool due) {
    if (!due && std::exchange(paused_, false)) controller_.resume();
    desk_.setBreak(due);
    page_->setBreakDue(due);
    if (strip_ != nullptr) strip_->setBreakDue(due);
    if (window_) window_->showBreak(due);
    if (!due) giveKeys();
}

/// The trial under way is void: it is repeated after the break.
void PilotWorkspace::breakNow() {
    paused_ = true;
    controller_.pause();
    wantBreak(true);
}

void PilotWorkspace::keep(const QString& note) {
    if (!controller_.markMoment(controller_.telemetry().at, note.isEmpty() ? tr("mark") : note)) return;
    page_->notes().add(note);
    if (strip_ != nullptr) strip_->notes().add(note);
}

void PilotWorkspace::giveKeys() {
    if (window_) window_->takeKeys();
}

void PilotWorkspace::screenLost(const QString& name) {
    if (!running_ || !asked_.person) return;
    controller_.stop("the participant's screen went");
    desk_.setScreenThere(false);
    page_->setObstacle(tr("the participant’s screen “%1” is gone").arg(name));
}

void PilotWorkspace::ended(const std::shared_ptr<const FinishedRun>& run) {
    if (!running_ || run->number != run_) return;  // another page's
    running_ = false;
    desk_.end();
    strip_ = nullptr;
    if (window_) {
        window_->hide();
        window_.release()->deleteLater();  // perhaps from its own press
    }
    const bool broke = run->result.outcome.error.has_value() || run->result.verdict() == "stopped";
    reach(broke ? step_ : int(kSteps));
    if (broke) steps_->setState(step_, State::Troubled);
    side_->hide();
    result_->show(*run, asked_.folder);
    pages_->setCurrentIndex(kResult);
    emit attentionWanted();
    emit runningChanged();
}

}  // namespace tacto::gui
