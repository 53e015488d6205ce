// Tests the tour with newcomers of five speeds: however long they read before the fingertip drives, no fault occurs.
// From 5 s after arming a second check pulse comes before the first train.
#include <QComboBox>
#include <QSettings>
#include <QTabBar>
#include <gmock/gmock.h>

#include "app/gui/theme/TabbedPage.h"
#include "tests/gui/window/WindowFixture.h"
#include "tests/support/InTime.h"

namespace tacto::test {
namespace {

class Newcomer : public Window, public testing::WithParamInterface<int> {
protected:
    Newcomer() { QSettings().remove("tourStep"); }
    ~Newcomer() override { QSettings().remove("tourStep"); }
    [[nodiscard]] QString title() { return window.findChild<QLabel*>("tourTitle")->text(); }
    [[nodiscard]] bool comesTo(const QString& step, int limit_ms = 30'000) {
        return comesTrue([&] { return title() == step; }, limit_ms);
    }
    template <class T>
    [[nodiscard]] T& named(const char* name) {
        return *window.findChild<T*>(name);
    }
    void goTo(int workspace) { click(*window.findChildren<QWidget*>("workspaceButton").value(workspace)); }
};

TEST_P(Newcomer, WalksTheTourToItsEndWithoutAFault) {
    RecordProperty("hazard", "H12");
    window.beginTour();
    key(Qt::Key_Escape);
    ASSERT_IN_TIME(comesTo("Open the simulated bench"));
    open();
    ASSERT_IN_TIME(comesTo("Put a surface under the finger"));
    auto& surface = named<QComboBox>("surface");
    ASSERT_IN_TIME(comesTrue([&] { return surface.isEnabled(); }));
    surface.setCurrentIndex(surface.findText("P120"));
    ASSERT_IN_TIME(comesTo("Arm, in two steps"));
    arm();
    ASSERT_IN_TIME(comesTo("Let the fingertip drive"));
    letLive(GetParam());
    click(named<QPushButton>("driveFingertip"));
    ASSERT_IN_TIME(comesTo("See a measured pulse"));
    auto* tabs = named<gui::TabbedPage>("livePage").findChild<QTabBar*>();
    QTest::mouseClick(tabs, Qt::LeftButton, {}, tabs->tabRect(1).center());
    ASSERT_IN_TIME(comesTo("Disarm")) << banner().toStdString();
    EXPECT_EQ(state(), InterlockState::Delivering) << banner().toStdString();
    click(named<QPushButton>("armButton"));
    ASSERT_IN_TIME(comesTo("Run a protocol"));
    goTo(3);
    QWidget* run = nullptr;
    ASSERT_IN_TIME(comesTrue([&] {
        for (auto* one : window.findChildren<QPushButton*>("runButton")) {
            if (one->isVisible() && one->isEnabled()) run = one;
        }
        return run != nullptr;
    }));
    click(*run);
    ASSERT_IN_TIME(comesTo("Everything is kept", 120'000)) << banner().toStdString();
    goTo(5);
    ASSERT_IN_TIME(comesTrue([] { return QSettings().value("tourDone").toBool(); }));
    ASSERT_IN_TIME(comesTrue([] { return !QSettings().contains("tourStep"); }, 20'000)) << "it came to its end";
    EXPECT_NE(state(), InterlockState::Faulted) << banner().toStdString();
}

INSTANTIATE_TEST_SUITE_P(WhoDrivesAfterMilliseconds, Newcomer, testing::Values(0, 2500, 5200, 6500, 8500));

}  // namespace
}  // namespace tacto::test
