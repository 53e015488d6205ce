// Tests that a window in which nothing changes does nothing: it handles hardly a timer and paints nothing. By counts
// of events, not by the clock, so that a busy machine changes nothing.
#include <QApplication>
#include <QElapsedTimer>
#include <QTimer>
#include <map>

#include "app/gui/live/StripPlots.h"
#include "tests/gui/window/WindowFixture.h"

namespace tacto::test {
namespace {

/// Counts timer events and paints of the whole program, by what receives them.
class Doings final : public QObject {
public:
    Doings() { qApp->installEventFilter(this); }
    ~Doings() override { qApp->removeEventFilter(this); }
    void forget() { timers_.clear(), paints_.clear(); }
    [[nodiscard]] int timers() const { return sum(timers_); }
    [[nodiscard]] int paints() const { return sum(paints_); }
    [[nodiscard]] std::string told() const {
        std::string all;
        for (const auto* counts : {&timers_, &paints_})
            for (const auto& [name, count] : *counts)
                all += fmt::format("{} {} {}\n", counts == &timers_ ? "timer" : "paint", name, count);
        return all;
    }

protected:
    bool eventFilter(QObject* watched, QEvent* event) override {
        const bool timer = event->type() == QEvent::Timer;
        if (!timer && (event->type() != QEvent::Paint || !watched->isWidgetType())) return false;
        const auto* parent = watched->parent();
        const auto name =
            fmt::format("{} '{}' in {}", watched->metaObject()->className(), watched->objectName().toStdString(),
                        parent == nullptr ? "" : parent->metaObject()->className());
        ++(timer ? timers_ : paints_)[name];
        return false;
    }

private:
    using Counts = std::map<std::string, int>;
    static int sum(const Counts& counts) {
        int all = 0;
        for (const auto& [name, count] : counts) all += count;
        return all;
    }
    Counts timers_, paints_;
};

class IdleWindow : public Window {
protected:
    /// Lets the window come to rest, then counts for half a second. Returns the seconds that this took.
    double rest() {
        letLive(900);
        doings.forget();
        QElapsedTimer lasts;
        lasts.start();
        letLive(500);
        return double(lasts.elapsed()) / 1000;
    }
    /// How often the window looks at telemetry and at whether STOP is in sight, in milliseconds.
    [[nodiscard]] int everyMs() const { return window.findChild<QTimer*>("frame")->interval(); }
    [[nodiscard]] bool looksEveryFrame() {
        return comesTrue([this] { return everyMs() <= 34; });
    }
    Doings doings;
};

constexpr int kPages = 7;

TEST_F(IdleWindow, WithoutABenchHardlyATimerComesAndNothingIsPainted) {
    for (int page = 0; page < kPages; ++page) {
        visit(page);
        const double seconds = rest();
        EXPECT_LE(doings.timers(), 13 * seconds + 2) << "page " << page << '\n' << doings.told();
        EXPECT_LE(doings.paints(), 4) << "page " << page << '\n' << doings.told();
    }
    window.showWorkspace(0);
    window.beginTour();
    rest();
    EXPECT_LE(doings.paints(), 4) << "beside the tour\n" << doings.told();
    window.showMinimized();
    rest();
    EXPECT_LE(doings.paints(), 4) << doings.told();
}

TEST_F(IdleWindow, BesideAnOpenBenchAnotherPageIsPaintedOnlyWhereNumbersChange) {
    open();
    for (int page = 1; page < kPages; ++page) {
        visit(page);
        const double seconds = rest();
        EXPECT_LE(doings.timers(), 45 * seconds + 5) << "page " << page << '\n' << doings.told();
        EXPECT_LE(doings.paints(), 25 * seconds) << "page " << page << '\n' << doings.told();
    }
}

TEST_F(IdleWindow, MinimisedTheLivePlotsAreNotDrawn) {
    visit(0);
    open();
    std::size_t drawn = 0;
    auto* plots = window.findChild<gui::StripPlots*>();
    QObject::connect(plots, &QCustomPlot::afterReplot, &doings, [&] { ++drawn; });
    ASSERT_IN_TIME(comesTrue([&] { return drawn > 3; }));
    window.showMinimized();
    letLive(300);
    drawn = 0;
    letLive(500);
    EXPECT_LE(drawn, 1U);
    window.showNormal();
    EXPECT_IN_TIME(comesTrue([&] { return drawn > 3; }));
}

/// The checks of whether STOP is in reach come with every frame whenever output can flow, whatever is shown.
TEST_F(IdleWindow, WhileOutputCanFlowEveryFrameIsWatched) {
    RecordProperty("hazard", "H2");
    open();
    for (const int page : {1, 3, 5}) {
        visit(page);
        EXPECT_IN_TIME(comesTrue([this] { return everyMs() > 34; })) << "page " << page;
        arm();
        EXPECT_IN_TIME(looksEveryFrame()) << "armed, page " << page;
        letLive(1000);  // longer than the frames after a click
        EXPECT_LE(everyMs(), 34) << "armed, page " << page;
        window.controller().disarm();
        ASSERT_IN_TIME(comesTrue([this] { return state() == InterlockState::Disarmed; }));
    }
    arm();
    deliver();
    letLive(1000);
    EXPECT_LE(everyMs(), 34) << "delivering";
    window.controller().pause();
    ASSERT_IN_TIME(comesTrue([this] { return state() == InterlockState::Paused; }));
    letLive(1000);
    EXPECT_LE(everyMs(), 34) << "paused: Resume would deliver";
    window.controller().resume();
    unplug();
    letLive(1000);
    EXPECT_LE(everyMs(), 34) << "faulted: the device may still deliver";
    window.controller().close();
    EXPECT_IN_TIME(comesTrue([this] { return everyMs() >= 1000; })) << "closed";
}

}  // namespace
}  // namespace tacto::test
