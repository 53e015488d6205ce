#include "app/gui/pilot/SessionPath.h"

#include <QTime>
#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

#include "app/gui/runner/StepList.h"
#include "app/gui/theme/Building.h"

namespace tacto::gui {

namespace {

constexpr int kPilotPath = 240, kPathPad = 16;

enum PilotStep { kChecklist, kStopTest, kSkin, kThresholds, kTraining, kTest, kRatings, kAfter, kSteps };
constexpr std::array<int, 3> kTested = {kTraining, kTest, kRatings};  // steps that a thresholds-only session leaves out

using State = StepList::State;

/// Returns the step of a phase, or of an operator's question outside the phases; `now` is the step so far.
std::optional<int> stepOf(const std::string& name, int now) {
    if (name == "checklist" || name == "code") return kChecklist;
    if (name == "stop-test") return kStopTest;
    if (name == "erythema" || name == "oedema") return now >= kRatings ? kAfter : now >= kThresholds ? now : int(kSkin);
    if (name == "electrode-lot" || name == "electrodes-untouched" || name == "massager-untouched" ||
        name == "masking-noise")
        return kSkin;
    if (name == "ascending" || name == "detection" || name == "range" || name == "comparison") return kThresholds;
    if (name == "familiarisation" || name == "training") return kTraining;
    if (name == "test" || name == "drift" || name == "break") return kTest;
    if (name == "ratings") return kRatings;
    if (name == "ended") return kAfter;
    return {};
}

QString titleOf(int step, bool massager) {
    switch (step) {
        case kChecklist:
            return QObject::tr("Checklist");
        case kStopTest:
            return QObject::tr("Stop test");
        case kSkin:
            return massager ? QObject::tr("Skin and massager") : QObject::tr("Skin and electrodes");
        case kThresholds:
            return QObject::tr("Thresholds and range");
        case kTraining:
            return QObject::tr("Training");
        case kTest:
            return QObject::tr("Test");
        case kRatings:
            return QObject::tr("Ratings");
        default:
            return massager ? QObject::tr("Massager off, skin") : QObject::tr("Electrodes off, skin");
    }
}

// The minute at which each step begins in the design, with the usual blocks; the last number is the session's end.
constexpr double kBegins_min[kSteps + 1] = {0, 4, 6, 12, 23, 30, 58, 62, 66};
constexpr double kTestTrial_s = 9;    // of the test, until trials have been timed
constexpr int kTimedTrials = 5;       // so many tell how long a trial takes
constexpr double kBetween_min = 3.6;  // between two blocks: break, check pulse and drift

bool stepBelongs(int step, int blocks) { return blocks > 0 || std::ranges::count(kTested, step) == 0; }

double stepLasts_min(int step, int blocks) {
    const double usual_min = kBegins_min[step + 1] - kBegins_min[step];
    return step == kTest ? usual_min * blocks / kUsualBlocks : usual_min;
}

QString aboutMinutes(double minutes) { return QObject::tr("about %1 min").arg(std::max(1L, std::lround(minutes))); }

}  // namespace

QString sessionLasts(int blocks) {
    double all_min = 0;
    for (int step = 0; step < kSteps; ++step) all_min += stepBelongs(step, blocks) ? stepLasts_min(step, blocks) : 0;
    return aboutMinutes(all_min);
}

QString stepAsked(const std::string& prompt, const std::string& phase, bool massager) {
    const bool before = phase.empty() || phase == "checklist";
    if (!before && phase != "ratings") return {};
    const auto step = stepOf(prompt, before ? kChecklist : kRatings);
    return step ? titleOf(*step, massager) : QString();
}

SessionPath::SessionPath(QWidget* parent) : QWidget(parent) {
    setObjectName("path");
    fixWidth(*this, kPilotPath);
    auto* column = columnIn(*this, -1, {0, kPathPad / 2, 0, kPathPad});
    auto* top = new QVBoxLayout;
    top->setContentsMargins(kPathPad, 0, kPathPad, kPathPad / 2);
    top->setSpacing(4);
    title_ = makeLabel({}, {.size = TextSize::Body, .strong = true, .wraps = true}, this);
    below_ = makeLabel({}, {.tone = Tone::Quiet, .size = TextSize::Small, .wraps = true}, this);
    addAll(*top, {title_, below_});
    column->addLayout(top);
    QStringList titles;
    for (int step = 0; step < kSteps; ++step) titles << titleOf(step, false);
    steps_ = new StepList(titles, this);
    column->addWidget(steps_);
    column->addStretch();
    auto* foot = new QVBoxLayout;
    foot->setContentsMargins(kPathPad, 0, kPathPad, 0);
    foot->setSpacing(4);
    leftWord_ = makeLabel(tr("Time left"), {.tone = Tone::Quiet, .size = TextSize::Small}, this);
    left_ = makeLabel({}, {.name = "timeLeft", .size = TextSize::Large}, this);
    addAll(*foot, {leftWord_, left_});
    column->addLayout(foot);
    clear();
    onEvent(*this, QEvent::Resize, [this] { steps_->fit(); });
}

void SessionPath::setTitle(const QString& title, const QString& below) {
    title_->setText(title);
    below_->setText(below);
}

void SessionPath::begin(int blocks, bool counts, bool massager) {
    nameSeats(massager);
    screen_ = {};
    trials_s_ = trials_ = 0;
    trialAt_.invalidate();
    blocks_ = blocks;
    counts_ = counts;
    for (int step = 0; step < kSteps; ++step) steps_->setStepVisible(step, has(step));
    reach(kChecklist);
}

void SessionPath::nameSeats(bool massager) {
    for (const int step : {kSkin, kAfter}) steps_->setName(step, titleOf(step, massager));
}

void SessionPath::clear() {
    begin(kUsualBlocks, false, false);
    reach(-1);
}

void SessionPath::end(SessionEnd how) {
    counts_ = false;
    reach(how == SessionEnd::BrokenOff ? step_ : int(kSteps));
    if (how == SessionEnd::BrokenOff) steps_->setState(step_, State::Troubled);
    if (how != SessionEnd::NoRange) return;
    for (const int step : kTested) {
        steps_->setState(step, State::ToDo);
        steps_->setNote(step, tr("not run"));
    }
}

bool SessionPath::has(int step) const { return stepBelongs(step, blocks_); }

void SessionPath::count(const PilotCounts& counts) {
    if (blocks_ > 0 && counts.blocks > 0) blocks_ = counts.blocks;
    left_->setText(timeLeft());
}

void SessionPath::show(const PilotScreen& screen) {
    if (screen.phase == "test" && screen.trial != screen_.trial) {
        if (screen_.phase == "test" && screen.block == screen_.block && trialAt_.isValid()) {
            trials_s_ += double(trialAt_.elapsed()) / 1000;
            ++trials_;
        }
        trialAt_.start();
    }
    screen_ = screen;
    reachFor(screen.phase);
    if (step_ == kTest && screen.phase == "test" && screen.trial > 0) {
        const int each = screen.blocks > 0 ? screen.trials / screen.blocks : screen.trials;
        steps_->setNote(
            kTest,
            tr("block %1 · trial %2 of %3").arg(screen.block).arg(screen.trial - (screen.block - 1) * each).arg(each));
    }
    left_->setText(timeLeft());
}

void SessionPath::asked(const PilotPrompt& prompt) {
    if (prompt.name == "stop-test" && step_ < kStopTest) reach(kStopTest);
    if (prompt.to != PromptTo::Participant) reachFor(prompt.name);
}

void SessionPath::reachFor(const std::string& name) {
    if (const auto step = stepOf(name, step_); step && *step > step_) reach(*step);
}

/// Marks all steps before `step` as done; -1: nothing has begun.
void SessionPath::reach(int step) {
    if (step != step_) since_.start();
    step_ = std::max(0, step);
    for (int i = 0; i < kSteps; ++i) {
        const auto before = steps_->state(i);
        const auto now = i < step ? State::Done : i == step ? State::UnderWay : State::ToDo;
        steps_->setState(i, now);
        steps_->setOutOfReach(i, tr("The session goes through its steps by itself."));
        if (now == State::ToDo) steps_->setNote(i, {});
        if (now == State::UnderWay && before != now) steps_->setNote(i, QTime::currentTime().toString("HH:mm"));
    }
    steps_->setShown(std::min(step_, kSteps - 1));  // after the session's end all steps are done
    const bool shown = step >= 0 && counts_;
    leftWord_->setVisible(shown);
    left_->setVisible(shown);
    left_->setText(timeLeft());
}

QString SessionPath::timeLeft() const {
    double rest_min = 0;
    for (int step = step_; step < kSteps; ++step) {
        if (!has(step)) continue;
        double lasts_min = stepLasts_min(step, blocks_);
        if (step == kTest && step == step_ && screen_.trials > 0) {
            const double trial_s = trials_ >= kTimedTrials ? trials_s_ / trials_ : kTestTrial_s;
            lasts_min = (screen_.trials - std::max(0, screen_.trial - 1)) * trial_s / 60 +
                        std::max(0, blocks_ - screen_.block) * kBetween_min;
        } else if (step == step_ && since_.isValid()) {
            lasts_min = std::max(0.0, lasts_min - double(since_.elapsed()) / 60'000);
        }
        rest_min += lasts_min;
    }
    return aboutMinutes(rest_min);
}

}  // namespace tacto::gui

#include "moc_SessionPath.cpp"
