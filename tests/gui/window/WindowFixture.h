// WindowFixture.h - the whole window on the simulated bench, and what a person does first with it.
#pragma once

#include <QLabel>
#include <QPushButton>
#include <QTest>
#include <gtest/gtest.h>

#include "app/gui/window/MainWindow.h"
#include "tests/gui/Person.h"

namespace tacto::test {

class Window : public testing::Test {
protected:
    Window() {
        window.resize(1440, 900);
        window.show();
        EXPECT_TRUE(QTest::qWaitForWindowExposed(&window));
        window.activateWindow();
    }
    ~Window() override { window.close(); }
    void key(Qt::Key key, Qt::KeyboardModifiers modifiers = Qt::NoModifier) {
        auto* focus = QApplication::activeWindow() != nullptr ? QApplication::activeWindow() : &window;
        QTest::keyClick(focus->windowHandle(), key, modifiers);
        QCoreApplication::processEvents();
    }
    [[nodiscard]] InterlockState state() { return window.desk().telemetry().state; }
    [[nodiscard]] QString banner() {
        const auto* label = window.findChild<QLabel*>("bannerText");
        return label->isVisible() ? label->text() : QString();
    }
    void open() {
        key(Qt::Key_B, Qt::ControlModifier);
        ASSERT_TRUE(comesTrue([this] { return window.desk().activity() == gui::Activity::Live; }));
        QTest::qWait(80);  // the next frame enables the buttons
    }
    /// Both steps, as a person takes them.
    void arm() {
        auto* first = window.findChild<QPushButton*>("armButton");
        ASSERT_TRUE(comesTrue([&] { return first->isEnabled() && first->text().contains("…"); }));
        click(*first);
        auto* second = window.findChild<QPushButton*>("armOutput");
        ASSERT_NE(second, nullptr);
        ASSERT_TRUE(comesTrue([&] { return second->isVisible(); }));
        click(*second);
        ASSERT_TRUE(comesTrue([this] { return state() == InterlockState::Armed; }));
    }
    void deliver() {
        window.desk().drive(DriveSource::Manual, 0.5, 1);
        ASSERT_TRUE(comesTrue([this] { return state() == InterlockState::Delivering; }));
    }
    gui::MainWindow window{simulatedRegistry};
};

}  // namespace tacto::test
