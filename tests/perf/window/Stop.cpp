// Stop.cpp - from the STOP click or the Esc key to the device's forceOff() having returned, while delivering.
//
// The event is put into the window's queue by another thread at a moment that the window does not choose, so that
// waiting for a picture that is being drawn counts. Esc goes through a modal dialog's text field in every other round.
//
// To be met: 10 ms.
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
#include "drivers/simulated/SimulatedDriver.h"
#include "tests/perf/window/WindowPerf.h"

namespace tacto::perf {

namespace {

using SteadyClockTime = std::chrono::steady_clock::time_point;

constexpr int kRounds = 100;
constexpr double kGoal_ms = 10;

/// When forceOff() came through last, since it was cleared.
std::atomic<std::int64_t> offAt_ns{0};

std::int64_t now_ns() { return std::chrono::steady_clock::now().time_since_epoch().count(); }

/// The simulated stimulator, with a clock at its forceOff().
class TimedStimulator final : public Stimulator {
public:
    explicit TimedStimulator(std::unique_ptr<Stimulator> inner) : inner_(std::move(inner)) {}
    const DeviceIdentity& identity() const noexcept override { return inner_->identity(); }
    const SourceTraits& traits() const noexcept override { return inner_->traits(); }
    Result<void> deliver(ApprovedTrain&& train) override { return inner_->deliver(std::move(train)); }
    Result<StimulatorStatus> status() override { return inner_->status(); }
    Result<void> keepAlive() override { return inner_->keepAlive(); }
    void forceOff() noexcept override {
        inner_->forceOff();
        std::int64_t none = 0;  // the first one counts
        offAt_ns.compare_exchange_strong(none, now_ns());
    }

private:
    std::unique_ptr<Stimulator> inner_;
};

class TimedDriver final : public Driver {
public:
    std::string_view scheme() const noexcept override { return inner_->scheme(); }
    std::vector<DeviceIdentity> list() const override { return inner_->list(); }
    bool runsOnVirtualClock() const noexcept override { return inner_->runsOnVirtualClock(); }
    Result<void> open(const DeviceUri& uri, const std::set<Role>& wanted, const OpenContext& context,
                      DeviceSet& into) override {
        const bool had = into.stimulator != nullptr;
        auto opened = inner_->open(uri, wanted, context, into);
        if (!had && into.stimulator) into.stimulator = std::make_unique<TimedStimulator>(std::move(into.stimulator));
        return opened;
    }

private:
    std::unique_ptr<Driver> inner_ = makeSimulatedDriver();
};

Registry timedRegistry() {
    std::vector<std::unique_ptr<Driver>> drivers;
    drivers.push_back(std::make_unique<TimedDriver>());
    return Registry(std::move(drivers));
}

/// Puts the events that `make` makes into the window's queue after `wait_ms`, from outside; the time of the first.
/// The event loop runs meanwhile. NaN when forceOff() did not come within 5 s.
double stopTime_ms(double wait_ms, const std::function<void()>& post) {
    offAt_ns = 0;
    std::atomic<std::int64_t> postedAt_ns{0};
    std::thread hand([&] {
        std::this_thread::sleep_for(std::chrono::duration<double, std::milli>(wait_ms));
        postedAt_ns = now_ns();
        post();
    });
    const bool came = comes([] { return offAt_ns != 0; }, 5000);
    hand.join();
    return came ? 1e-6 * static_cast<double>(offAt_ns - postedAt_ns) : std::nan("");
}

void postKey(QWindow& to) {
    for (const auto type : {QEvent::KeyPress, QEvent::KeyRelease})
        QCoreApplication::postEvent(&to, new QKeyEvent(type, Qt::Key_Escape, Qt::NoModifier));
}

void postClick(QWindow& to, QPointF at, QPointF onScreen) {
    QCoreApplication::postEvent(&to, new QMouseEvent(QEvent::MouseButtonPress, at, at, onScreen, Qt::LeftButton,
                                                     Qt::LeftButton, Qt::NoModifier));
    QCoreApplication::postEvent(&to, new QMouseEvent(QEvent::MouseButtonRelease, at, at, onScreen, Qt::LeftButton,
                                                     Qt::NoButton, Qt::NoModifier));
}

/// `act` stops once it is told how long to wait first, and tells how long that took.
void rounds(gui::BenchDesk& desk, const std::string& what, double baseline_ms,
            const std::function<double(int round, double wait_ms)>& act) {
    std::vector<double> taken;
    Random random(7, what.c_str());
    for (int round = 0; round < kRounds; ++round) {
        desk.setSpeed(10);  // arming takes bench time
        const bool on = deliver(desk);
        desk.setSpeed(1);
        if (!on) return notMeasured(what, "the simulated bench does not deliver");
        const double ms = act(round, 40 + 40 * random.uniform());
        if (!std::isfinite(ms)) return notMeasured(what, "the output was not switched off within 5 s");
        taken.push_back(ms);
        if (!comes([&] { return desk.telemetry().state == InterlockState::Disarmed; }))
            return notMeasured(what, "the bench is not disarmed after a stop");
    }
    std::ranges::sort(taken);
    const double median = taken[taken.size() / 2], worst = taken.back();
    line(what, fmt::format("{:7.2f} ms {:7.2f} ms", median, worst),
         baseline_ms > 0 ? fmt::format("{:.1f} times the call alone; wanted: within {:.0f} ms: {}",
                                       median / baseline_ms, kGoal_ms, verdict(worst <= kGoal_ms))
                         : std::string());
}

/// What BenchDesk::stop() takes when nobody has to wait for the window's queue.
double callAlone_ms(gui::BenchDesk& desk) {
    std::vector<double> taken;
    for (int round = 0; round < kRounds; ++round) {
        desk.setSpeed(10);
        if (!deliver(desk)) return 0;
        desk.setSpeed(1);
        offAt_ns = 0;
        const auto from = now_ns();
        desk.stop("benchmark");
        taken.push_back(1e-6 * static_cast<double>(offAt_ns - from));
    }
    std::ranges::sort(taken);
    line("baseline: the call alone", fmt::format("{:7.2f} ms {:7.2f} ms", taken[taken.size() / 2], taken.back()));
    return taken[taken.size() / 2];
}

}  // namespace

void measureStop() {
    heading("stop while delivering, until forceOff() returned, of 100", "   median      worst");
    gui::MainWindow window(timedRegistry);
    window.resize(1440, 900);
    window.show();
    window.activateWindow();
    auto& desk = window.desk();
    if (!openBench(desk)) return notMeasured("stop", "the simulated bench does not open");
    desk.present("P120", 50, 1);
    const double baseline_ms = callAlone_ms(desk);
    if (!(baseline_ms > 0)) return notMeasured("baseline: the call alone", "the simulated bench does not deliver");
    const auto* button = window.findChild<QPushButton*>("stopButton");
    rounds(desk, "STOP clicked", baseline_ms, [&](int, double wait_ms) {
        const QPointF at = button->mapTo(&window, button->rect().center());
        return stopTime_ms(wait_ms,
                           [&, at, screen = window.mapToGlobal(at)] { postClick(*window.windowHandle(), at, screen); });
    });
    rounds(desk, "Esc", baseline_ms,
           [&](int, double wait_ms) { return stopTime_ms(wait_ms, [&] { postKey(*window.windowHandle()); }); });
    rounds(desk, "Esc in a modal dialog's text field", baseline_ms, [&](int, double wait_ms) {
        QDialog dialog(&window);
        dialog.setModal(true);
        QLineEdit field(&dialog);
        dialog.show();
        field.setFocus();
        return stopTime_ms(wait_ms, [&] { postKey(*dialog.windowHandle()); });
    });
}

}  // namespace tacto::perf
