// WindowFixture.h - the whole window on the simulated bench, and the first actions of a person there.
//
// Thread-safety: the GUI thread.
#pragma once

#include <QLabel>
#include <QLineEdit>
#include <QPushButton>
#include <QRegularExpression>
#include <QTest>
#include <algorithm>
#include <fmt/format.h>
#include <gtest/gtest.h>

#include "app/gui/runner/ProtocolWorkspace.h"
#include "app/gui/theme/Theme.h"
#include "app/gui/window/DockColumn.h"
#include "app/gui/window/MainWindow.h"
#include "tests/gui/Looks.h"
#include "tests/gui/Person.h"
#include "tests/gui/RoomLooks.h"
#include "tests/gui/window/Unpluggable.h"
#include "tests/support/InTime.h"

namespace tacto::test {

class Window : public testing::Test {
protected:
    Window() : Window(nullptr) {}
    /// nullptr: the simulated bench with the stimulator that unplug() unplugs.
    explicit Window(std::function<Registry()> makeRegistry)
        : window(makeRegistry ? std::move(makeRegistry) : [plug = plug_] { return unpluggableRegistry(plug); }) {
        window.resize(1440, 900);
        window.show();
        EXPECT_IN_TIME(QTest::qWaitForWindowExposed(&window));
        window.activateWindow();
    }
    ~Window() override { window.close(); }
    void key(Qt::Key key, Qt::KeyboardModifiers modifiers = Qt::NoModifier) {
        auto* focus = QApplication::activeWindow() != nullptr ? QApplication::activeWindow() : &window;
        QTest::keyClick(focus->windowHandle(), key, modifiers);
        QCoreApplication::processEvents();
    }
    [[nodiscard]] InterlockState state() { return window.controller().telemetry().state; }
    [[nodiscard]] QString banner() {
        // Faults are shown in the safety bar, everything else above the workspaces.
        QString all;
        const auto* fault = window.findChild<QLabel*>("faultText");
        if (fault->isVisible()) all = "Fault: " + fault->parentWidget()->toolTip();
        const auto* label = window.findChild<QLabel*>("bannerText");
        return label->isVisible() ? all + label->text() : all;
    }
    /// Shows a workspace, and waits until the scripts of its procedures are read and their forms made.
    void visit(int page) {
        window.showWorkspace(page);
        ASSERT_IN_TIME(comesTrue([this] {
            return std::ranges::none_of(window.findChildren<gui::ProtocolWorkspace*>(), &gui::ProtocolWorkspace::reads);
        }));
    }
    void open() {
        key(Qt::Key_B, Qt::ControlModifier);
        ASSERT_IN_TIME(comesTrue([this] { return window.controller().activity() == gui::Activity::Live; }));
        letLive(80);  // the next frame enables the buttons
    }
    /// Unplugs the stimulator during delivery, and waits until the bench has faulted and gives the reason.
    void unplugWhile(double roughness, double pressure) {
        arm();
        window.controller().drive(DriveSource::Manual, roughness, pressure);
        const auto* word = window.findChild<QLabel*>("interlockState");
        ASSERT_IN_TIME(comesTrue([&] { return word->text() == "DELIVERING"; })) << "the window has seen it";
        unplug();
    }
    /// Unplugs the stimulator; waits for the fault, then for its reason and advice (from the loop's next steps).
    void unplug() {
        *plug_ = false;
        ASSERT_IN_TIME(comesTrue([this] { return state() == InterlockState::Faulted; }));
        ASSERT_IN_TIME(comesTrue([this] {
            const auto says = banner();
            return says.startsWith("Fault: ") && !says.contains("The bench has faulted.") &&
                   !says.contains("Fix the cause");
        })) << banner().toStdString();
    }
    /// Arms in both steps, as a person does.
    void arm() {
        auto* first = window.findChild<QPushButton*>("armButton");
        ASSERT_IN_TIME(comesTrue([&] { return first->isEnabled() && first->text().contains("…"); }));
        click(*first);
        auto* second = window.findChild<QPushButton*>("armOutput");
        ASSERT_NE(second, nullptr);
        ASSERT_IN_TIME(comesTrue([&] { return second->isVisible(); }));
        auto* load = second->window()->findChild<QLineEdit*>();
        if (load->text().isEmpty()) QTest::keyClicks(load, "1 kohm");
        click(*second);
        ASSERT_IN_TIME(comesTrue([this] { return state() == InterlockState::Armed; })) << banner().toStdString();
    }
    void deliver() {
        window.controller().drive(DriveSource::Manual, 0.5, 1);
        ASSERT_IN_TIME(comesTrue([this] { return state() == InterlockState::Delivering; }));
    }
    /// Runs the procedure of the present workspace, from its Run button to its verdict.
    void runsToItsEnd() {
        QPushButton* run = nullptr;
        ASSERT_IN_TIME(comesTrue([&] {
            run = find<QPushButton>(window, "runButton");
            return run != nullptr && run->isEnabled();
        }));
        const auto over = std::make_shared<bool>(false);
        QObject::connect(
            &window.controller(), &gui::BenchController::finished, run, [over] { *over = true; },
            Qt::SingleShotConnection);
        click(*run);
        ASSERT_IN_TIME(comesTrue([&] { return *over; }, 120'000));
        ASSERT_IN_TIME(comesTrue([&] { return find<QLabel>(window, "verdict") != nullptr; }));
    }
    /// Returns the visible widgets that need much of a small window's width, one per line.
    [[nodiscard]] std::string wide() const {
        std::string all;
        for (const auto* each : window.findChildren<QWidget*>())
            if (each->isVisible() && each->minimumSizeHint().width() > 300)
                all += fmt::format("{} {} {}\n", widgetName(*each), each->minimumSizeHint().width(), each->width());
        return all;
    }
    /// During its lifetime text is at 200 % (and stays so), the window is 1280 x 720, and the docks are opened by hand.
    class LargeBesideDocks {
    public:
        explicit LargeBesideDocks(Window& of)
            : of_(of),
              size_(of.window.size()),
              docks_(of.window.findChild<gui::DockColumn*>()),
              collapsed_(docks_->collapsed()) {
            gui::applyTextSize(200);
            of_.window.resize(1280, 720);
            docks_->setCollapsed(false);
        }
        ~LargeBesideDocks() {
            docks_->setCollapsed(collapsed_);
            of_.window.resize(size_);
        }
        LargeBesideDocks(const LargeBesideDocks&) = delete;
        LargeBesideDocks& operator=(const LargeBesideDocks&) = delete;

        /// Expects that nothing is cut off at the side. `scrolls`: the one table that has its own scroll bar.
        void fits(const QString& name, const char* scrolls = nullptr) const {
            auto& shown = of_.window;
            const auto faults = [&] {
                auto all = cutSideways(shown);
                if (scrolls != nullptr) all = all.filter(QRegularExpression(QString("^(?!.*%1)").arg(scrolls)));
                return all;
            };
            EXPECT_IN_TIME(comesTrue([&] { return faults().isEmpty(); })) << name.toStdString() << '\n'
                                                                          << faults().join('\n').toStdString() << '\n'
                                                                          << of_.wide();
            EXPECT_EQ(shown.size(), QSize(1280, 720)) << name.toStdString();
            shot(shown, "beside-docks-" + name);
        }

    private:
        Window& of_;
        QSize size_;
        gui::DockColumn* docks_;
        bool collapsed_;
    };

private:
    Plug plug_ = std::make_shared<std::atomic<bool>>(true);

protected:
    gui::MainWindow window;
};

}  // namespace tacto::test
