// Tests the tour: each step is done with the window's own controls, and the tour notices it.
#include <QComboBox>
#include <QSettings>
#include <QTabBar>
#include <gmock/gmock.h>

#include "app/gui/theme/TabbedPage.h"
#include "app/gui/theme/Theme.h"
#include "tests/gui/Looks.h"
#include "tests/gui/window/WindowFixture.h"
#include "tests/support/InTime.h"

namespace tacto::test {
namespace {

using gui::Activity;
using testing::HasSubstr;

class TourOfTheWindow : public Window {
protected:
    TourOfTheWindow() { QSettings().remove("tourStep"); }
    ~TourOfTheWindow() override {
        QSettings().remove("tourStep");
        gui::applyTextSize(100);
        gui::applyTheme(gui::Theme::Light);
    }
    [[nodiscard]] QFrame& tour() { return *window.findChild<QFrame*>("tour"); }
    [[nodiscard]] QString title() { return tour().findChild<QLabel*>("tourTitle")->text(); }
    [[nodiscard]] bool comesTo(const QString& step, int limit_ms = 20'000) {
        return comesTrue([&] { return title() == step; }, limit_ms);
    }
    /// The tour's frame, in whichever window it is.
    [[nodiscard]] static QWidget* frame() {
        for (auto* widget : QApplication::allWidgets()) {
            if (widget->objectName() == "tourFrame" && widget->isVisible()) return widget;
        }
        return nullptr;
    }
    /// Waits until the frame is around this widget.
    [[nodiscard]] bool frames(const QWidget& widget) {
        return comesTrue([&] {
            const auto* now = frame();
            if (now == nullptr || now->window() != widget.window()) return false;
            const QRect around(widget.mapTo(widget.window(), QPoint()), widget.size());
            return now->geometry().contains(around & widget.window()->rect()) && now->width() < around.width() + 30 &&
                   now->height() < around.height() + 30;
        });
    }
    template <class T>
    [[nodiscard]] T& named(const char* name) {
        auto* found = window.findChild<T*>(name);
        if (found == nullptr) throw std::runtime_error(std::string("there is no ") + name);
        return *found;
    }
    [[nodiscard]] QWidget& stopButton() { return *named<QWidget>("safetyBar").findChild<QWidget*>("stopButton"); }
    void press(const char* button) { click(*find<QPushButton>(tour(), button)); }
    void picture(const char* name) { shot(window, QString("tour-%1").arg(name)); }
};

TEST_F(TourOfTheWindow, IsWalkedByDoingEachThing) {
    window.beginTour();
    ASSERT_TRUE(tour().isVisible());
    EXPECT_EQ(title(), "First, how to stop");
    ASSERT_IN_TIME(frames(stopButton()));
    picture("1-stop");
    key(Qt::Key_Escape);

    ASSERT_IN_TIME(comesTo("Open the simulated bench"));
    auto& opens = named<QPushButton>("openBench");
    ASSERT_IN_TIME(frames(opens));
    picture("2-open");
    click(opens);
    ASSERT_IN_TIME(comesTo("Put a surface under the finger"));
    auto& surface = named<QComboBox>("surface");
    ASSERT_IN_TIME(frames(surface));
    picture("3-surface");
    surface.setCurrentIndex(surface.findText("P120"));

    ASSERT_IN_TIME(comesTo("Arm, in two steps"));
    auto& first = named<QPushButton>("armButton");
    ASSERT_IN_TIME(frames(first));
    picture("4-arm");
    click(first);
    auto& second = named<QPushButton>("armOutput");
    ASSERT_IN_TIME(frames(second)) << "the second step stands in a dialog";
    EXPECT_EQ(state(), InterlockState::Disarmed) << "the tour arms nothing by itself";
    shot(*second.window(), "tour-4b-second-step");
    letLive(600);  // the second step ignores presses at first
    click(second);

    ASSERT_IN_TIME(comesTo("Let the fingertip drive"));
    auto& finger = named<QPushButton>("driveFingertip");
    ASSERT_IN_TIME(frames(finger));
    EXPECT_EQ(window.controller().telemetry().trainsDelivered, 0U) << "the tour drives nothing by itself";
    picture("5-drive");
    click(finger);

    ASSERT_IN_TIME(comesTo("See a measured pulse"));
    auto& live = named<gui::TabbedPage>("livePage");
    letLive(200);
    ASSERT_NE(frame(), nullptr);
    picture("6-scope");
    auto* tabs = live.findChild<QTabBar*>();
    QTest::mouseClick(tabs, Qt::LeftButton, {}, tabs->tabRect(1).center());
    ASSERT_IN_TIME(frames(named<QWidget>("measurementDock")));
    ASSERT_IN_TIME(comesTrue([this] { return tour().findChild<QLabel*>("tourPlace")->text().contains("done"); }));
    picture("6b-measured");

    ASSERT_IN_TIME(comesTo("Disarm"));
    EXPECT_NE(state(), InterlockState::Disarmed) << "the operator disarms, not the tour";
    ASSERT_IN_TIME(frames(first));
    click(first);
    ASSERT_IN_TIME(comesTo("Run a protocol"));
    auto* rail = window.findChildren<QWidget*>("workspaceButton").value(3);
    ASSERT_IN_TIME(frames(*rail));
    click(*rail);
    EXPECT_EQ(window.workspace(), 3);
    QWidget* run = nullptr;
    ASSERT_IN_TIME(comesTrue([&] {
        for (auto* one : window.findChildren<QPushButton*>("runButton")) {
            if (one->isVisible() && one->isEnabled()) run = one;
        }
        return run != nullptr;
    }));
    ASSERT_IN_TIME(frames(*run));
    picture("7-run");
    click(*run);
    ASSERT_IN_TIME(
        comesTrue([this] { return tour().findChild<QLabel*>("tourPlace")->text().contains("done"); }, 120'000));
    picture("7b-verdict");
    ASSERT_NE(find<QWidget>(window, "verdictReasons"), nullptr);
    ASSERT_IN_TIME(comesTo("Everything is kept"));
    auto* sessions = window.findChildren<QWidget*>("workspaceButton").value(5);
    ASSERT_IN_TIME(frames(*sessions));
    click(*sessions);
    ASSERT_IN_TIME(comesTrue([this] {
        auto* report = find<QPushButton>(window, "Report");
        return report != nullptr && report->isEnabled();
    })) << "the newest session is chosen";
    picture("8-sessions");
    ASSERT_IN_TIME(comesTrue([this] { return !tour().isVisible(); }, 20'000));
    EXPECT_EQ(frame(), nullptr);
    EXPECT_TRUE(QSettings().value("tourDone").toBool()) << "it does not come again by itself";
    EXPECT_NE(find<QLabel>(window, "Who is working today, and on what?"), nullptr) << "every other start asks at once";
    EXPECT_FALSE(QSettings().contains("tourStep"));
}

TEST_F(TourOfTheWindow, GoesBackAndStaysThere) {
    window.beginTour();
    key(Qt::Key_Escape);
    ASSERT_IN_TIME(comesTo("Open the simulated bench"));
    open();
    ASSERT_IN_TIME(comesTo("Put a surface under the finger"));
    press("Back");
    EXPECT_EQ(title(), "Open the simulated bench");
    letLive(2000);
    EXPECT_EQ(title(), "Open the simulated bench") << "what is done already does not push forward again";
    EXPECT_EQ(tour().findChild<QLabel*>("tourPlace")->text().toStdString(), "2 of 9 ✔ done") << "and says so";
    press("Next");
    EXPECT_EQ(title(), "Put a surface under the finger");
    press("Back");
    press("Back");
    EXPECT_FALSE(find<QPushButton>(tour(), "Back")->isEnabled());
}

/// A user who stops on the way, or goes back to a step that needs the output, is told how to get the output back.
TEST_F(TourOfTheWindow, SaysThatTheOutputIsOffWhereAStepNeedsIt) {
    RecordProperty("hazard", "H12");
    ASSERT_NO_FATAL_FAILURE(open());
    const auto says = [this] { return tour().findChild<QLabel*>("tourText")->text(); };
    for (const int step : {4, 5}) {
        QSettings().setValue("tourStep", step);
        window.beginTour();
        EXPECT_IN_TIME(comesTrue([&] { return says().startsWith("The output is off: arm it again"); }))
            << says().toStdString();
        ASSERT_NO_FATAL_FAILURE(arm());
        EXPECT_IN_TIME(comesTrue([&] { return !says().contains("output is off"); })) << says().toStdString();
        key(Qt::Key_Escape);
        EXPECT_IN_TIME(comesTrue([&] { return says().startsWith("The output is off: arm it again"); }));
        press("Leave");
    }
}

TEST_F(TourOfTheWindow, IsLeftAndResumed) {
    RecordProperty("hazard", "H12");
    open();
    window.beginTour();
    press("Next");
    press("Next");
    EXPECT_EQ(title(), "Put a surface under the finger");
    press("Leave");
    EXPECT_FALSE(tour().isVisible());
    EXPECT_EQ(frame(), nullptr);
    window.beginTour();
    EXPECT_EQ(title(), "Put a surface under the finger");
    QSettings().setValue("tourStep", 99);  // as left by a version with more steps
    window.beginTour();
    EXPECT_EQ(title(), "First, how to stop");
    QSettings().setValue("tourStep", 3);  // the step that arms
    window.controller().close();
    ASSERT_IN_TIME(comesTrue([this] { return window.controller().activity() == gui::Activity::Closed; }));
    window.beginTour();
    EXPECT_EQ(title(), "Open the simulated bench") << "it arms nothing but simulated devices";
}

TEST_F(TourOfTheWindow, TakesNeitherClicksNorKeys) {
    RecordProperty("hazard", "H2");
    window.beginTour();
    ASSERT_IN_TIME(frames(stopButton()));
    open();
    arm();
    deliver();
    EXPECT_EQ(window.childAt(stopButton().mapTo(&window, stopButton().rect().center())), &stopButton());
    QTest::mouseClick(window.windowHandle(), Qt::LeftButton, {},
                      stopButton().mapTo(&window, stopButton().rect().center()));
    EXPECT_IN_TIME(comesTrue([this] { return state() == InterlockState::Disarmed; }));
    for (const auto stops : {Qt::Key_Escape, Qt::Key_Pause, Qt::Key_Space}) {
        arm();
        deliver();
        find<QPushButton>(tour(), "Next")->setFocus();
        key(stops);
        EXPECT_IN_TIME(comesTrue([this] { return state() == InterlockState::Disarmed; })) << stops;
    }
}

TEST_F(TourOfTheWindow, LooksRightInEverySizeAndTheme) {
    open();
    for (const int percent : {100, 200}) {
        gui::applyTextSize(percent);
        for (const auto size : {QSize(1280, 720), QSize(1920, 1080)}) {
            window.resize(size);
            for (const auto theme : themesAt(percent)) {
                gui::applyTheme(theme);
                QSettings().remove("tourStep");
                window.beginTour();
                for (int step = 0; tour().isVisible(); ++step) {
                    const auto now = title();
                    SCOPED_TRACE(now.toStdString());
                    letLive(80);
                    const auto& bar = named<QWidget>("safetyBar");
                    const auto covers = [&](const QRect& what) { return tour().geometry().intersects(what); };
                    // Waits until the step's page is laid out and the panel has found its place. A completed step leads
                    // on only after a longer time.
                    const auto stands = [&] { return frame() != nullptr && !covers(frame()->geometry()); };
                    static_cast<void>(comesTrue(stands, 1000));
                    EXPECT_TRUE(stands()) << "no control is framed, or the panel hides it at " << percent << " %";
                    EXPECT_TRUE(window.rect().contains(tour().geometry()));
                    EXPECT_FALSE(covers({bar.mapTo(&window, QPoint()), bar.size()})) << "STOP is covered";
                    EXPECT_EQ(faultsOf(tour()), "");
                    picture(QString("%1-%2-%3-%4")
                                .arg(percent)
                                .arg(size.width())
                                .arg(theme == gui::Theme::Dark ? "dark" : "light")
                                .arg(step + 1)
                                .toUtf8()
                                .constData());
                    // On a busy machine a completed step may have led on already.
                    if (title() == now) press(find<QPushButton>(tour(), "Next") != nullptr ? "Next" : "Done");
                }
            }
        }
    }
}

}  // namespace
}  // namespace tacto::test
