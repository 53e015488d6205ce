// Stop.cpp - the time from the STOP click or the Esc key until the device's forceOff() has returned, during delivery.
//
// Another thread posts the event to the window's queue at a random moment, so that the time includes waiting for a
// picture being drawn. The baseline is the same click in a window that draws nothing.
//
// Goal: the 95 % value is at most fifteen times the baseline's. The limit is 10 ms.
#include <QCoreApplication>
#include <QDialog>
#include <QKeyEvent>
#include <QLineEdit>
#include <QMouseEvent>
#include <QPushButton>
#include <QWindow>
#include <atomic>
#include <fmt/format.h>
#include <thread>

#include "app/gui/window/MainWindow.h"
#include "core/base/Random.h"
#include "tests/perf/Verdict.h"
#include "tests/perf/window/WindowPerf.h"
#include "tests/support/WrappedTwin.h"

namespace tacto::perf {

namespace {

constexpr int kRounds = 100;
constexpr double kMaxTimes = 15;
constexpr double kMaxStop_ms = 10;

/// Time of the first forceOff() since this was cleared.
std::atomic<std::int64_t> offAt_ns{0};

std::int64_t now_ns() { return std::chrono::steady_clock::now().time_since_epoch().count(); }

/// The simulated stimulator, which stores the time of its forceOff().
class TimedStimulator final : public test::WrappedStimulator {
public:
    using WrappedStimulator::WrappedStimulator;
    void forceOff() noexcept override {
        WrappedStimulator::forceOff();
        std::int64_t none = 0;  // only the first call is stored
        offAt_ns.compare_exchange_strong(none, now_ns());
    }
};

Registry timedRegistry() {
    std::vector<std::unique_ptr<Driver>> drivers;
    drivers.push_back(std::make_unique<test::WrappedBench>([](std::unique_ptr<Stimulator> twin, const OpenContext&) {
        return std::make_unique<TimedStimulator>(std::move(twin));
    }));
    return Registry(std::move(drivers));
}

/// The events of a key press or click, ready for a window's queue.
using Events = std::vector<std::unique_ptr<QEvent>>;

Events escape() {
    Events events;
    for (const auto type : {QEvent::KeyPress, QEvent::KeyRelease})
        events.push_back(std::make_unique<QKeyEvent>(type, Qt::Key_Escape, Qt::NoModifier));
    return events;
}

Events clickOn(const QWidget& button) {
    const QPointF at = button.mapTo(button.window(), button.rect().center());
    const QPointF onScreen = button.window()->mapToGlobal(at);
    Events events;
    events.push_back(std::make_unique<QMouseEvent>(QEvent::MouseButtonPress, at, at, onScreen, Qt::LeftButton,
                                                   Qt::LeftButton, Qt::NoModifier));
    events.push_back(std::make_unique<QMouseEvent>(QEvent::MouseButtonRelease, at, at, onScreen, Qt::LeftButton,
                                                   Qt::NoButton, Qt::NoModifier));
    return events;
}

/// Posts the events after `wait_ms`, from another thread, while the event loop runs; returns the time until `done_ns`
/// is set, or NaN after 5 s.
double answerTime_ms(double wait_ms, QWindow& to, Events events, const std::atomic<std::int64_t>& done_ns) {
    std::atomic<std::int64_t> postedAt_ns{0};
    std::thread hand([&] {
        std::this_thread::sleep_for(std::chrono::duration<double, std::milli>(wait_ms));
        postedAt_ns = now_ns();
        for (auto& event : events) QCoreApplication::postEvent(&to, event.release());
    });
    const bool came = comes([&] { return done_ns != 0; }, 5000);
    hand.join();
    return came ? 1e-6 * static_cast<double>(done_ns - postedAt_ns) : std::nan("");
}

/// Returns a random waiting time, independent of the drawing of pictures.
double anyMoment_ms(Random& random) { return 40 + 40 * random.uniform(); }

struct Taken {
    double median_ms = 0, p95_ms = 0, worst_ms = 0;
};
Taken takenOf(std::vector<double> all) {
    std::ranges::sort(all);
    return {all[all.size() / 2], all[all.size() * 95 / 100], all.back()};
}
std::string figures(const Taken& taken) {
    return fmt::format("{:7.2f} ms {:7.2f} ms {:7.2f} ms", taken.median_ms, taken.p95_ms, taken.worst_ms);
}

/// Presses a button in a window that has nothing else to do.
Taken emptyWindow() {
    QWidget window;
    window.resize(1440, 900);
    QPushButton button("STOP", &window);
    std::atomic<std::int64_t> pressedAt_ns{0};
    QObject::connect(&button, &QPushButton::pressed, [&] { pressedAt_ns = now_ns(); });
    window.show();
    pass(200);
    Random random(7, "empty");
    std::vector<double> all;
    for (int round = 0; round < kRounds; ++round) {
        pressedAt_ns = 0;
        all.push_back(answerTime_ms(anyMoment_ms(random), *window.windowHandle(), clickOn(button), pressedAt_ns));
    }
    return takenOf(std::move(all));
}

/// A hundred times: delivers, then measures `stop`, which gets its waiting time.
void rounds(gui::BenchController& controller, const std::string& what, const Taken& baseline,
            const std::function<double(double wait_ms)>& stop) {
    std::vector<double> all;
    Random random(7, what.c_str());
    for (int round = 0; round < kRounds; ++round) {
        controller.setSpeed(10);  // arming takes bench time
        const bool on = deliver(controller);
        controller.setSpeed(1);
        if (!on) return notMeasured(what, "the simulated bench does not deliver");
        offAt_ns = 0;
        const double ms = stop(anyMoment_ms(random));
        if (!std::isfinite(ms)) return notMeasured(what, "the output was not switched off within 5 s");
        all.push_back(ms);
        if (!comes([&] { return controller.telemetry().state == InterlockState::Disarmed; }))
            return notMeasured(what, "the bench is not disarmed after a stop");
    }
    const auto taken = takenOf(std::move(all));
    line(what, figures(taken),
         verdict(taken.p95_ms / baseline.p95_ms, "the empty window's p95", kMaxTimes) +
             ofLimit(taken.worst_ms, kMaxStop_ms, "ms that a stop may take"));
}

}  // namespace

void measureStop() {
    heading("stop while delivering, to the end of forceOff()", "   median        p95      worst of 100");
    const auto baseline = emptyWindow();
    if (!(baseline.worst_ms > 0)) return notMeasured("baseline: empty window", "a click had no effect");
    line("baseline: a button of an empty window", figures(baseline));
    gui::MainWindow window(timedRegistry);
    window.resize(1440, 900);
    window.show();
    window.activateWindow();
    auto& controller = window.controller();
    if (!openBench(controller)) return notMeasured("stop", "the simulated bench does not open");
    controller.present("P120", 50, 1);
    const auto* button = window.findChild<QPushButton*>("stopButton");
    rounds(controller, "STOP clicked", baseline,
           [&](double wait_ms) { return answerTime_ms(wait_ms, *window.windowHandle(), clickOn(*button), offAt_ns); });
    rounds(controller, "Esc", baseline,
           [&](double wait_ms) { return answerTime_ms(wait_ms, *window.windowHandle(), escape(), offAt_ns); });
    rounds(controller, "Esc in a modal dialog's text field", baseline, [&](double wait_ms) {
        QDialog dialog(&window);
        dialog.setModal(true);
        QLineEdit field(&dialog);
        dialog.show();
        field.setFocus();
        return answerTime_ms(wait_ms, *dialog.windowHandle(), escape(), offAt_ns);
    });
    window.close();
}

}  // namespace tacto::perf
