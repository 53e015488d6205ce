// One day at the bench, in a real X server: open, arm in two steps, drive, stop from inside a dialog, run a protocol.
//
// Needs its own display (see in-xvfb); skipped elsewhere.
#include <QApplication>
#include <QLineEdit>
#include <QPushButton>
#include <QTabWidget>
#include <gtest/gtest.h>

#include "app/gui/theme/ConfirmButton.h"
#include "app/gui/theme/TabbedPage.h"
#include "app/gui/theme/Theme.h"
#include "app/gui/window/MainWindow.h"
#include "tests/e2e/Hand.h"
#include "tests/gui/Person.h"
#include "tests/support/InTime.h"

namespace tacto::test {
namespace {

TEST(EndToEnd, DISABLED_AWholeDay) {
    RecordProperty("hazard", "H2");
    ASSERT_EQ(QGuiApplication::platformName(), "xcb");
    gui::MainWindow window(simulatedRegistry);
    window.resize(QGuiApplication::primaryScreen()->size());
    window.move(0, 0);
    window.show();
    ASSERT_IN_TIME(QTest::qWaitForWindowExposed(&window));
    window.activateWindow();
    auto& controller = window.controller();
    const auto state = [&] { return controller.telemetry().state; };
    picture("1-empty");

    type("ctrl+b");
    ASSERT_IN_TIME(comesTrue([&] { return controller.activity() == gui::Activity::Live; }));
    controller.present("P120", 50, 1);
    letLive(3000);
    picture("2-live");

    click(*window.findChild<QPushButton*>("armButton"));
    auto* arm = window.findChild<QPushButton*>("armOutput");
    ASSERT_NE(arm, nullptr);
    ASSERT_IN_TIME(comesTrue([&] { return arm->isVisible(); }));
    picture("3-arming");
    EXPECT_EQ(state(), InterlockState::Disarmed) << "the first step arms nothing";
    letLive(gui::ConfirmButton::kDebounce_ms + 100);
    click(*arm);
    ASSERT_IN_TIME(comesTrue([&] { return state() == InterlockState::Armed; }));
    controller.drive(DriveSource::Sensor);
    ASSERT_IN_TIME(comesTrue([&] { return controller.telemetry().trainsDelivered >= 3; }));
    picture("4-delivering");

    auto* tabs = window.findChild<gui::TabbedPage*>("livePage");
    ASSERT_NE(tabs, nullptr);
    tabs->setCurrentIndex(1);
    letLive(4500);
    picture("4-oscilloscope");
    tabs->setCurrentIndex(0);

    auto* menuDialog = new QDialog(&window);
    menuDialog->setModal(true);
    auto* field = new QLineEdit(menuDialog);
    menuDialog->show();
    ASSERT_IN_TIME(QTest::qWaitForWindowExposed(menuDialog));
    menuDialog->activateWindow();
    field->setFocus();
    type("Escape");
    EXPECT_IN_TIME(comesTrue([&] { return state() == InterlockState::Disarmed; })) << "Esc stops from inside a dialog";

    for (int page = 0; page < 7; ++page) {
        window.showWorkspace(page);
        picture(QString("5-workspace-%1").arg(page + 1));
    }
    gui::applyTheme(gui::Theme::Dark);
    for (const int page : {0, 3, 5}) {
        window.showWorkspace(page);
        picture(QString("6-dark-%1").arg(page + 1));
    }
    gui::applyTheme(gui::Theme::Light);
    window.close();
}

}  // namespace
}  // namespace tacto::test
