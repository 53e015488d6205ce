#include "app/gui/window/WelcomeTour.h"

#include <QSettings>
#include <QTabBar>
#include <algorithm>
#include <utility>

#include "app/gui/scope/screen/ScopeScreen.h"
#include "app/gui/sessions/SessionDetails.h"
#include "app/gui/theme/FieldForm.h"
#include "app/gui/theme/TabbedPage.h"
#include "app/gui/window/FoldingDock.h"
#include "app/gui/window/MainWindow.h"
#include "app/gui/window/StateWords.h"

namespace tacto::gui {

namespace {

// Page numbers as in the rail at the left.
constexpr int kLivePage = 0;
constexpr int kSeparabilityPage = 3;
constexpr int kSessionsPage = 5;
constexpr int kTouchTab = 0;
constexpr int kScopeTab = 1;
constexpr int kOpenStep = 1;  // the tour's step that opens the simulated bench
constexpr int kInside = 8;
constexpr int kSee_ms = 1200;
constexpr int kReadFor_ms = 6000;  // for steps whose result the user should read

std::function<QString()> say(const char* text) { return Tour::always(WelcomeTour::tr(text)); }

}  // namespace

WelcomeTour::WelcomeTour(MainWindow& window) : QObject(&window), window_(window), controller_(window.controller()) {
    auto steps = onTheBench();
    for (auto& step : toTheVerdict()) steps.push_back(std::move(step));
    for (std::size_t i = 0; i < steps.size(); ++i) {
        auto& step = steps[i];
        step.enter = [this, enter = std::move(step.enter)] {
            begun_ = controller_.mark();
            presented_ = captured_ = judged_ = 0;
            if (enter) enter();
        };
        if (int(i) <= kOpenStep) continue;
        // The tour includes arming and driving, so these steps work on simulated devices only.
        step.target = [this, target = std::move(step.target)] { return target && !isReal() ? target() : TourTarget{}; };
        step.done = [this, done = std::move(step.done)] { return done && !isReal() && done(); };
    }
    tour_ = new Tour(std::move(steps), &window);
    connect(&controller_, &BenchController::presented, this, [this](const QString& material) {
        if (!material.isEmpty()) ++presented_;
    });
    connect(&controller_, &BenchController::captured, this, [this](const std::shared_ptr<const Capture>& capture) {
        if (!capture->untriggered) ++captured_;
    });
    connect(&controller_, &BenchController::finished, this, [this](const std::shared_ptr<const FinishedRun>& run) {
        if (!run->result.outcome.error) ++judged_;
        newest_ = QString::fromStdString(run->result.session.string());
    });
    connect(tour_, &Tour::stepped, this, [](int step) { QSettings().setValue("tourStep", step); });
    connect(tour_, &Tour::ended, this, [this](bool finished) {
        QSettings settings;
        const bool first = !settings.value("tourDone").toBool();
        settings.setValue("tourDone", true);
        if (finished) settings.remove("tourStep");
        if (first) window_.askForDay(true);  // every other start asks at once
    });
}

/// Resumes a tour that was left after opening the bench only if the open bench is simulated.
void WelcomeTour::begin() {
    const int left = QSettings().value("tourStep", 0).toInt();
    const auto open = controller_.open();
    const bool simulated = open && open->source && open->simulated();
    tour_->begin(simulated ? left : std::min(left, kOpenStep));
}

bool WelcomeTour::isReal() const {
    const auto open = controller_.open();
    return open && !open->simulated();
}

std::vector<TourStep> WelcomeTour::onTheBench() {
    const auto toTouch = [this] {
        window_.showWorkspace(kLivePage);
        window_.findChild<TabbedPage*>("livePage")->setCurrentIndex(kTouchTab);
    };
    return {
        {tr("First, how to stop"),
         say("This bench turns what a fingertip feels into pulse trains: texture into amplitude, pressure into the "
             "interval. The tour runs on simulated devices alone: while a real one is open it points at nothing. Esc, "
             "Pause and this button switch "
             "the output off, at any time and in any window; outside a field of text Space does too. Press Esc."),
         {},
         [this] { return TourTarget{window_.findChild<QWidget*>("safetyBar")->findChild<QWidget*>("stopButton")}; },
         [this] { return controller_.stoppedSince(begun_); }},
        {tr("Open the simulated bench"),
         say("A fingertip, a stimulator on 1 kΩ and an oscilloscope. Press the framed button, or Ctrl+B. From then on "
             "everything is recorded."),
         [this, toTouch] {
             toTouch();
             window_.showDock("deviceDock");
         },
         [this] { return TourTarget{named("openBench")}; },
         [this] {
             const auto open = controller_.open();
             return controller_.activity() == Activity::Live && open && open->source && open->simulated();
         }},
        {tr("Put a surface under the finger"),
         say("Choose another surface: glass is smooth, P120 a coarse sandpaper. Acceleration, force and taxels become "
             "roughness R and pressure P: the point in the tactile plane."),
         toTouch, [this] { return TourTarget{named("surface")}; }, [this] { return presented_ > 0; }},
        {tr("Arm, in two steps"),
         say("The first opens a question, the second measures the load with one small pulse. The bars at the top show "
             "how far each limit is."),
         {},
         [this] { return armTarget(); },
         [this] { return state() == InterlockState::Armed || state() == InterlockState::Delivering; }},
        {tr("Let the fingertip drive"),
         whileOn(tr("Nothing is delivered until something drives. Choose Fingertip: amplitude and interval then follow "
                    "what is felt.")),
         [this] { window_.showDock("driveDock"); }, [this] { return TourTarget{named("driveFingertip")}; },
         [this] { return state() == InterlockState::Delivering && controller_.telemetry().trainsDelivered > 0; },
         kSee_ms},
    };
}

std::vector<TourStep> WelcomeTour::toTheVerdict() {
    return {
        {tr("See a measured pulse"),
         whileOn(tr("Open the oscilloscope. What really came out is captured, and each pulse is measured: amplitude, "
                    "phase width and gap stand under Measurements, charge further down.")),
         [this] { window_.showDock("measurementDock"); }, [this] { return scopeTarget(); },
         [this] { return showsScope() && captured_ > 0; }, kReadFor_ms},
        {tr("Disarm"),
         say("Done with the output: the same button switches it off."),
         {},
         [this] { return TourTarget{named("armButton")}; },
         [this] {
             return state() != InterlockState::Armed && state() != InterlockState::Delivering &&
                    state() != InterlockState::Paused;
         }},
        {tr("Run a protocol"),
         say("Separability asks whether an oscilloscope can tell four conditions apart. Open it and press Run: on "
             "simulated devices it takes less than a minute, and ends with a verdict and a report."),
         {},
         [this] { return runTarget(); },
         [this] { return judged_ > 0; },
         kReadFor_ms},
        {tr("Everything is kept"),
         say("Each bench and each run is a session. Open Sessions and look at the newest one: its verdict, trials and "
             "captures, and below them Report, Replay and Open capture. ? shows all keys, F1 opens the guide."),
         {},
         [this] { return sessionsTarget(); },
         [this] { return window_.workspace() == kSessionsPage; },
         kReadFor_ms},
    };
}

/// A step that needs the output on explains how to get it back, because a stop, a fault or Back may have ended it.
std::function<QString()> WelcomeTour::whileOn(const QString& text) const {
    return [this, text] {
        return isOn(state()) ? text
                             : tr("The output is off: arm it again first, with “Arm…”. Back leads to that step.");
    };
}

/// The newest session, or the button of the sessions page if another page is shown.
TourTarget WelcomeTour::sessionsTarget() {
    if (window_.workspace() != kSessionsPage) return workspaceButton(kSessionsPage);
    if (!newest_.isEmpty()) window_.openFile(std::exchange(newest_, {}));
    auto* details = window_.findChild<SessionDetails*>();
    return {details, details->rect().adjusted(kInside, kInside, -kInside, -kInside)};  // the frame must not cover STOP
}

QWidget* WelcomeTour::named(const char* name) const { return window_.findChild<QWidget*>(name); }

InterlockState WelcomeTour::state() const { return controller_.telemetry().state; }

TourTarget WelcomeTour::workspaceButton(int index) const {
    return {window_.findChildren<QWidget*>("workspaceButton").value(index)};
}

/// The second step of arming is in a window of its own.
TourTarget WelcomeTour::armTarget() const {
    auto* second = named("armOutput");
    return {second != nullptr && second->isVisible() ? second : named("armButton")};
}

bool WelcomeTour::showsScope() const {
    return window_.workspace() == kLivePage && window_.findChild<TabbedPage*>("livePage")->currentIndex() == kScopeTab;
}

TourTarget WelcomeTour::scopeTarget() const {
    if (window_.workspace() != kLivePage) return workspaceButton(kLivePage);
    if (showsScope()) return {named("measurementDock")};
    auto* bar = window_.findChild<TabbedPage*>("livePage")->findChild<QTabBar*>();
    return {bar, bar->tabRect(kScopeTab)};
}

TourTarget WelcomeTour::runTarget() const {
    if (window_.workspace() != kSeparabilityPage) return workspaceButton(kSeparabilityPage);
    for (auto* run : window_.findChildren<QWidget*>("runButton")) {
        if (run->isVisible()) return {run};
    }
    return {};
}

}  // namespace tacto::gui

#include "moc_WelcomeTour.cpp"
