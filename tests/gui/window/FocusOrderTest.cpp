// Tests the keyboard on pages with results: Tab goes from STOP through each page once, in reading order.
#include <QComboBox>
#include <QDockWidget>
#include <QLineEdit>
#include <QSettings>
#include <QStackedWidget>
#include <QStatusBar>
#include <QTabBar>
#include <QToolBar>
#include <QToolButton>

#include "app/gui/pilot/PilotWorkspace.h"
#include "app/gui/scope/ScopeWorkspace.h"
#include "app/gui/scope/model/ScopeModel.h"
#include "app/gui/theme/TabbedPage.h"
#include "tests/gui/Looks.h"
#include "tests/gui/OwnDataHome.h"
#include "tests/gui/window/TabRound.h"
#include "tests/gui/window/WindowFixture.h"
#include "tests/support/InTime.h"
#include "tests/support/Support.h"

namespace tacto::test {
namespace {

class FocusOrder : private OwnDataHome, public Window {
protected:
    ~FocusOrder() override { QSettings().clear(); }
    [[nodiscard]] QWidget& page() {
        return *window.findChild<QWidget*>("centre")->findChild<QStackedWidget*>()->currentWidget();
    }
    /// Presses Tab from STOP until it comes back: expects every enabled control once, in reading order in each part.
    void expectReadInOrder(const std::string& name) {
        SCOPED_TRACE(name);
        window.activateWindow();
        ASSERT_IN_TIME(comesTrue([this] { return QApplication::activeWindow() == &window; }));
        letLive(100);  // time for the layout
        std::vector<const QWidget*> order;
        const auto reached = tabFrom(*window.findChild<QPushButton*>("stopButton"),
                                     [&order](const QWidget& at) { order.push_back(&at); });
        expectAllReached(window, reached);
        // Starts the order at the start of the window: STOP is the last control in its bar.
        const auto first = std::ranges::find(order, window.findChild<QPushButton*>("armButton"));
        if (first != order.end()) std::ranges::rotate(order, first);
        std::vector<const QWidget*> parts{window.findChild<QWidget*>("safetyBar"), &page(), window.statusBar()};
        for (const auto* bar : window.findChildren<QToolBar*>()) parts.push_back(bar);
        for (const auto* dock : window.findChildren<QDockWidget*>()) parts.push_back(dock);
        const QWidget* before = nullptr;
        std::set<const QWidget*> left;
        for (const auto* part : parts) {
            std::vector<const QWidget*> within;
            std::ranges::copy_if(order, std::back_inserter(within), [&](auto* at) { return part->isAncestorOf(at); });
            EXPECT_EQ(stepsBack(within), "") << "in " << widgetName(*part);
        }
        for (const auto* at : order) {
            const auto part = std::ranges::find_if(parts, [&](auto* each) { return each->isAncestorOf(at); });
            const auto* in = part == parts.end() ? nullptr : *part;
            if (in == before) continue;
            if (before != nullptr) left.insert(before);
            EXPECT_FALSE(left.contains(in)) << "it comes back to " << widgetName(*at);
            before = in;
        }
        EXPECT_TRUE(std::ranges::any_of(order, [this](auto* at) { return page().isAncestorOf(at); }));
    }
    /// Tests each view of a result.
    void expectResultReadInOrder(const std::string& name) {
        expectReadInOrder(name);
        for (const auto* view : {"Tables", "Log"}) {
            auto* choice = find<QPushButton>(window, view);
            ASSERT_NE(choice, nullptr) << view;
            click(*choice);
            expectReadInOrder(name + ", " + view);
        }
    }
};

TEST_F(FocusOrder, OfACalibrationIsThatOfReading) {
    ASSERT_NO_FATAL_FAILURE(visit(1));
    window.findChild<QLineEdit*>("warm_up_s")->setText("0");
    ASSERT_NO_FATAL_FAILURE(runsToItsEnd());
    expectResultReadInOrder("calibration");
}

TEST_F(FocusOrder, OfASensorCalibrationIsThatOfReading) {
    visit(1);
    window.findChild<gui::TabbedPage*>("calibratePages")->setCurrentIndex(1);
    ASSERT_NO_FATAL_FAILURE(runsToItsEnd());
    expectResultReadInOrder("sensor calibration");
}

TEST_F(FocusOrder, OfASafetyCheckIsThatOfReading) {
    visit(2);
    QLineEdit* area = nullptr;
    ASSERT_IN_TIME(comesTrue([&] { return (area = find<QLineEdit>(window, "area")) != nullptr; }));
    area->setText("4");
    ASSERT_NO_FATAL_FAILURE(runsToItsEnd());
    expectResultReadInOrder("safety check");
    click(*find<QPushButton>(window, "Limits"));
    window.resize(1280, 720);  // too low for limits and tracing in one view
    ASSERT_IN_TIME(comesTrue([this] { return find<QPushButton>(window, "Tracing") != nullptr; }));
    click(*find<QPushButton>(window, "Tracing"));
    expectReadInOrder("safety check, Tracing");
}

TEST_F(FocusOrder, OfASeparabilityRunIsThatOfReading) {
    visit(3);
    ASSERT_NO_FATAL_FAILURE(runsToItsEnd());
    expectResultReadInOrder("separability");
    click(*find<QPushButton>(window, "Sign report…"));
    expectReadInOrder("separability, sign");
}

TEST_F(FocusOrder, OfAPilotsResultIsThatOfReading) {
    const ScratchDir folder;
    visit(4);
    auto& pilot = *window.findChild<gui::PilotWorkspace*>();
    pilot.findChild<QLineEdit*>("studyFolder")->setText(QString::fromStdString((folder.path() / "study").string()));
    pilot.findChild<QLineEdit*>("rehearsalBlocks")->setText("1");
    click(*pilot.findChild<QPushButton*>("beginRehearsal"));
    ASSERT_IN_TIME(comesTrue([&] { return pilot.running(); }));
    ASSERT_IN_TIME(comesTrue([&] { return !pilot.running(); }, 100'000));
    ASSERT_IN_TIME(comesTrue([this] { return find<QPushButton>(window, "backFromResult") != nullptr; }));
    expectReadInOrder("pilot");
}

TEST_F(FocusOrder, OfTheOscilloscopeIsThatOfReading) {
    open();
    ASSERT_NO_FATAL_FAILURE(arm());
    ASSERT_NO_FATAL_FAILURE(deliver());
    visit(0);
    window.findChild<gui::TabbedPage*>("livePage")->setCurrentIndex(1);
    auto& scope = *window.findChild<gui::ScopeWorkspace*>();
    ASSERT_IN_TIME(comesTrue([&] { return scope.model().shown() != nullptr; }));
    window.controller().disarm();
    ASSERT_IN_TIME(comesTrue([this] { return state() == InterlockState::Disarmed; }));
    for (const auto* panel : {"All measurements", "Spectrum tool", "Controls"})
        if (auto* tool = find<QToolButton>(window, panel); tool->isChecked()) click(*tool);
    expectReadInOrder("oscilloscope");
    for (const auto* panel : {"All measurements", "Spectrum tool", "Controls"}) {
        auto* tool = find<QToolButton>(window, panel);
        click(*tool);
        expectReadInOrder(std::string("oscilloscope with ") + panel);
        click(*tool);
    }
}

}  // namespace
}  // namespace tacto::test
