// Redraw.cpp - the cost of live plots at 60 frames a second, 1280x720: CPU time of the window's thread and of the whole
// process (including simulated bench and recording) over some seconds, compared with an empty plot that is redrawn as
// often.
//
// Goal: two channels cost at most three times the empty plot, with as many pictures. The limit is 25 % of one core. A
// window without a bench costs at most a tenth of the empty plot; there the limit is 0.5 %.
#include <QTabWidget>
#include <fmt/format.h>
#include <qcustomplot.h>

#include "app/gui/live/LiveWorkspace.h"
#include "app/gui/live/StripPlots.h"
#include "app/gui/scope/ScopeWorkspace.h"
#include "app/gui/scope/screen/ScopeScreen.h"
#include "app/gui/theme/TabbedPage.h"
#include "app/gui/window/MainWindow.h"
#include "tests/gui/Person.h"
#include "tests/perf/Verdict.h"
#include "tests/perf/window/WindowPerf.h"

namespace tacto::perf {

namespace {

using SteadyTime = std::chrono::steady_clock::time_point;

constexpr double kFrames_hz = 60;
constexpr int kSettle_ms = 1000;
constexpr int kMeasured_ms = 5000;
constexpr double kMaxTimes = 3;
constexpr double kMaxOfCore_percent = 25;
constexpr double kMaxIdleTimes = 0.1, kMaxIdle_percent = 0.5;
const QSize kScreen(1280, 720);

struct Cost {
    double window_percent = 0;   ///< share of one core for the window's thread
    double process_percent = 0;  ///< share of one core for all threads
    double frames_hz = 0;        ///< pictures actually drawn
};

/// Calls `frame` sixty times a second, if it is set. `drawn` counts pictures.
Cost costOf(const std::function<void()>& frame, const std::size_t& drawn) {
    QTimer timer;
    timer.setTimerType(Qt::PreciseTimer);
    timer.setSingleShot(true);
    const auto now = [] { return std::chrono::steady_clock::now(); };
    const std::chrono::duration<double> step(1 / kFrames_hz);
    std::chrono::duration<double> due(0);
    const auto began = now();
    // Due times are multiples of 1/60 s, however long a frame takes; missed frames are not made up for.
    const auto next = [&] {
        const std::chrono::duration<double> passed = now() - began;
        due = std::max(due + step, passed);
        timer.start(
            std::chrono::duration_cast<std::chrono::milliseconds>(due - passed + std::chrono::microseconds(500)));
    };
    QObject::connect(&timer, &QTimer::timeout, [&] {
        frame();
        next();
    });
    if (frame) next();
    pass(kSettle_ms);
    const double window = secondsOf(CLOCK_THREAD_CPUTIME_ID), process = secondsOf(CLOCK_PROCESS_CPUTIME_ID);
    const auto drawnBefore = drawn;
    const auto from = now();
    pass(kMeasured_ms);
    const double wall = std::chrono::duration<double>(now() - from).count();
    return {100 * (secondsOf(CLOCK_THREAD_CPUTIME_ID) - window) / wall,
            100 * (secondsOf(CLOCK_PROCESS_CPUTIME_ID) - process) / wall,
            static_cast<double>(drawn - drawnBefore) / wall};
}

void count(QCustomPlot& plot, std::size_t& drawn) {
    QObject::connect(&plot, &QCustomPlot::afterReplot, [&drawn] { ++drawn; });
}

void tell(const std::string& what, const Cost& cost, const Cost& baseline, bool hasGoal,
          const std::string& remarks = {}) {
    const auto figures =
        fmt::format("{:7.1f} % {:7.1f} % {:9.1f}", cost.window_percent, cost.process_percent, cost.frames_hz);
    const double times = cost.window_percent / baseline.window_percent;
    auto remark = fmt::format("{:.1f} times the empty plot", times);
    if (hasGoal) {
        remark = verdict(times, "the empty plot", kMaxTimes) + "; " +
                 verdict(baseline.frames_hz / cost.frames_hz, "as long for a picture", 1.05) +
                 ofLimit(cost.window_percent, kMaxOfCore_percent, "% of one core");
    }
    line(what, figures, remark + remarks);
}

Cost emptyPlot() {
    QCustomPlot plot;
    plot.setNotAntialiasedElements(QCP::aeAll);
    plot.resize(kScreen);
    plot.show();
    std::size_t drawn = 0;
    count(plot, drawn);
    double t = 0;
    return costOf(
        [&] {
            t += 1 / kFrames_hz;
            plot.xAxis->setRange(t, t + 10);
            plot.replot(QCustomPlot::rpQueuedReplot);
        },
        drawn);
}

/// Two channels with a new capture in each frame, more often than any real trigger.
void twoChannels(const Cost& baseline) {
    const char* what = "oscilloscope: two channels, new each frame";
    gui::BenchController controller(test::simulatedRegistry);
    if (!openBench(controller) || !deliver(controller))
        return notMeasured(what, "the simulated bench does not deliver");
    std::vector<gui::ShownPtr> captures;
    QObject::connect(&controller, &gui::BenchController::captured, [&](std::shared_ptr<const Capture> capture) {
        captures.push_back(gui::prepareCapture(std::move(capture)));
    });
    ScopeSettings settings;
    {
        gui::ScopeWorkspace controls(controller);
        settings = controls.settings();
    }
    controller.runScope(settings, false);
    if (!comes([&] { return captures.size() >= 4; })) return notMeasured(what, "the oscilloscope does not trigger");
    controller.stopScope();
    pass(100);
    gui::ScopeModel model;
    gui::ScopeScreen screen(model);
    screen.resize(kScreen);
    screen.QWidget::show();
    std::size_t drawn = 0, k = 0;
    count(screen, drawn);
    const auto cost = costOf([&] { model.show(captures[k++ % captures.size()]); }, drawn);
    tell(what, cost, baseline, true);
}

/// All strips, taxels and the tactile plane, while a finger slides and trains are delivered. The real window redraws
/// them half as often: wholeWindow().
void touch(const Cost& baseline) {
    const char* what = "touch: every strip; plane 30/s, numbers 10/s";
    gui::BenchController controller(test::simulatedRegistry);
    gui::LiveWorkspace live(controller);
    live.resize(kScreen);
    live.show();
    if (!openBench(controller) || !deliver(controller))
        return notMeasured(what, "the simulated bench does not deliver");
    controller.present("P120", 50, 1);
    controller.drive(DriveSource::Sensor);
    std::size_t drawn = 0;
    count(const_cast<gui::StripPlots&>(live.plots()), drawn);
    // Ten seconds are visible, and only a full picture has its full cost.
    QTimer fill;
    QObject::connect(&fill, &QTimer::timeout, [&] { live.refresh(controller.telemetry(), true); });
    fill.start(50);
    controller.setSpeed(10);
    const bool filled = comes([&] { return live.history().now_s() > 14; });
    controller.setSpeed(1);
    fill.stop();
    if (!filled) return notMeasured(what, "the simulated bench stands still");
    tell(what, costOf([&] { live.refresh(controller.telemetry(), true); }, drawn), baseline, false,
         fmt::format("; 14 traces and a spectrum, where {:.0f} % are asked of two channels", kMaxOfCore_percent));
}

/// The real program, redrawn as often as it does itself.
void wholeWindow(const Cost& baseline, int tab, const std::string& what) {
    gui::MainWindow window(test::simulatedRegistry);
    window.resize(1440, 900);
    window.show();
    auto& controller = window.controller();
    if (!openBench(controller) || !deliver(controller))
        return notMeasured(what, "the simulated bench does not deliver");
    controller.present("P120", 50, 1);
    controller.drive(DriveSource::Sensor);
    auto* tabs = window.findChild<gui::TabbedPage*>("livePage");
    window.showWorkspace(0);
    tabs->setCurrentIndex(tab);
    auto* plot = tab == 0 ? static_cast<QCustomPlot*>(window.findChild<gui::StripPlots*>())
                          : static_cast<QCustomPlot*>(window.findChild<gui::ScopeScreen*>());
    std::size_t drawn = 0;
    count(*plot, drawn);
    pass(2000);
    tell(what, costOf({}, drawn), baseline, false);
    window.close();
}

/// The window without a bench, in which nothing changes.
void idleWindow(const Cost& baseline) {
    gui::MainWindow window(test::simulatedRegistry);
    window.resize(1440, 900);
    window.show();
    pass(1000);
    const auto cost = costOf({}, 0);
    line("the whole window, no bench is open",
         fmt::format("{:7.2f} % {:7.2f} %", cost.window_percent, cost.process_percent),
         verdict(cost.window_percent / baseline.window_percent, "the empty plot", kMaxIdleTimes) +
             ofLimit(cost.process_percent, kMaxIdle_percent, "% of one core"));
    window.close();
}

}  // namespace

void measureRedraw() {
    heading("live redraw, CPU time of one core", "   window   process  frames/s");
    const auto baseline = emptyPlot();
    tell("baseline: empty plot", baseline, baseline, false);
    twoChannels(baseline);
    touch(baseline);
    idleWindow(baseline);
    wholeWindow(baseline, 0, "the whole window at its own pace: touch");
    wholeWindow(baseline, 1, "the whole window at its own pace: oscilloscope");
}

}  // namespace tacto::perf
