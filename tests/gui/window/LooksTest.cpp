// Tests the design's rules in the whole window: text is legible, simulated data are marked, messages are kept, and only
// STOP and faults are red.
#include <QDialog>
#include <QDockWidget>
#include <QPlainTextEdit>
#include <QSettings>
#include <QToolButton>
#include <gmock/gmock.h>

#include "app/gui/scope/ScopeWorkspace.h"
#include "app/gui/scope/measurements/MeasurementTable.h"
#include "app/gui/scope/measurements/SpectrumPanel.h"
#include "app/gui/scope/model/ScopeModel.h"
#include "app/gui/sessions/SessionsWorkspace.h"
#include "app/gui/theme/TabbedPage.h"
#include "app/gui/theme/Theme.h"
#include "app/gui/window/FoldingDock.h"
#include "app/gui/window/LimitBar.h"
#include "tests/gui/Looks.h"
#include "tests/gui/OwnDataHome.h"
#include "tests/gui/window/WindowFixture.h"
#include "tests/support/InTime.h"
#include "tests/support/Support.h"

namespace tacto::test {
namespace {

using testing::HasSubstr;

TEST_F(Window, LooksRightInBothThemesAndSizes) {
    open();
    window.controller().present("P120", 50, 1);
    ASSERT_IN_TIME(comesTrue([this] {
        const auto touch = window.controller().telemetry();
        return std::isfinite(touch.roughness) && std::isfinite(touch.pressure);
    })) << "the fingertip's R and P are on the screen";
    for (const auto theme : bothThemes()) {
        gui::applyTheme(theme);
        for (const auto size : sizesIn(theme, {QSize(1920, 1080), QSize(1280, 720), QSize(1024, 640)})) {
            window.resize(size);
            for (int page = 0; page < 7; ++page) {
                visit(page);
                letLive(120);
                const auto name = QString("window-%1-%2-%3")
                                      .arg(theme == gui::Theme::Dark ? "dark" : "light")
                                      .arg(size.width())
                                      .arg(page);
                shot(window, name);
                EXPECT_EQ(faultsOf(window), "") << name.toStdString();
            }
            EXPECT_LE(window.width(), size.width()) << "everything fits a small screen";
        }
    }
}

TEST_F(Window, LooksRightWithTextAtTwiceTheSize) {
    open();
    gui::applyTextSize(200);
    for (const auto theme : bothThemes()) {
        gui::applyTheme(theme);
        for (const auto size : sizesIn(theme, {QSize(1280, 720), QSize(1440, 900), QSize(1920, 1080)})) {
            window.resize(size);
            for (int page = 0; page < 8; ++page) {  // page 7 is the oscilloscope
                visit(page % 7);
                window.findChild<gui::TabbedPage*>("livePage")->setCurrentIndex(page / 7);
                const auto name = QString("window-200-%1-%2-%3")
                                      .arg(theme == gui::Theme::Dark ? "dark" : "light")
                                      .arg(size.width())
                                      .arg(page);
                EXPECT_IN_TIME(comesTrue([this] { return faultsOf(window).empty(); }))
                    << faultsOf(window) << ", " << name.toStdString();
                shot(window, name);
            }
            EXPECT_LE(window.width(), size.width());
            EXPECT_LE(window.height(), size.height());
        }
    }
    window.findChild<gui::TabbedPage*>("livePage")->setCurrentIndex(0);
}

class DocksOfTheWindow : public Window {
protected:
    ~DocksOfTheWindow() override { QSettings().remove("docks"); }
    [[nodiscard]] std::vector<gui::FoldingDock*> openDocks() {
        std::vector<gui::FoldingDock*> open;
        for (auto* dock : window.findChildren<gui::FoldingDock*>())
            if (dock->isVisible() && !dock->folded()) open.push_back(dock);
        return open;
    }
    /// Delivers with the oscilloscope visible, until it has taken `captures` captures.
    void deliverToTheScope(int captures) {
        open();
        arm();
        window.controller().drive(DriveSource::Manual, 0.5, 0.8);
        visit(0);
        window.findChild<gui::TabbedPage*>("livePage")->setCurrentIndex(1);
        auto& scope = *window.findChild<gui::ScopeWorkspace*>();
        ASSERT_IN_TIME(comesTrue([&] { return int(scope.table().statistics().captures()) >= captures; }));
    }
};

TEST_F(DocksOfTheWindow, KeepTheirHeadersInALowWindow) {
    open();
    window.resize(1280, 720);
    visit(0);
    for (auto* dock : window.findChildren<gui::FoldingDock*>()) dock->fold(false);
    for (const int page : {3, 0}) {
        visit(page);
        letLive(100);
    }
    shot(window, "four-docks");
    EXPECT_EQ(openDocks().size(), 4U);
    EXPECT_EQ(faultsOf(window), "");
    for (const auto* dock : openDocks()) {
        const auto* header = dock->titleBarWidget();
        EXPECT_EQ(header->visibleRegion(), QRegion(header->rect())) << dock->windowTitle().toStdString();
    }
}

TEST_F(DocksOfTheWindow, TheOscilloscopeLooksRightWithWhatItReads) {
    ASSERT_NO_FATAL_FAILURE(deliverToTheScope(5));
    auto& scope = *window.findChild<gui::ScopeWorkspace*>();
    auto& model = scope.model();
    const double width = model.viewport().width_s();
    EXPECT_NEAR(500e-6 / width, 1.0 / 3, 0.05) << "the first train is what one sees";
    window.activateWindow();  // the arming dialog had the focus
    ASSERT_IN_TIME(QTest::qWaitForWindowActive(&window));
    key(Qt::Key_T);
    ASSERT_TRUE(model.cursors().time_s());
    model.dragTimeCursor(0, 0, width / 50);
    model.dragTimeCursor(1, 200e-6, width / 50);
    for (const auto theme : bothThemes()) {
        gui::applyTheme(theme);
        for (const auto size : sizesIn(theme, {QSize(1280, 720), QSize(1920, 1080)})) {
            window.resize(size);
            letLive(200);
            // The docks share their column anew after each change of content, over several turns of the event loop.
            EXPECT_IN_TIME(comesTrue([&] { return faultsOf(window).empty(); })) << faultsOf(window);
            shot(window, QString("scope-%1-%2").arg(theme == gui::Theme::Dark ? "dark" : "light").arg(size.width()));
        }
    }
    gui::applyTheme(gui::Theme::Light);
    const auto before = window.controller().telemetry().driving;
    key(Qt::Key_D);
    const auto* drive = window.findChild<QDockWidget*>("driveDock");
    EXPECT_TRUE(drive->isAncestorOf(QApplication::focusWidget())) << "the key leads to the drive";
    EXPECT_EQ(window.controller().telemetry().driving, before) << "and changes nothing there";
    EXPECT_IN_TIME(state() == InterlockState::Delivering);
}

TEST_F(DocksOfTheWindow, TheOscilloscopesPanelsLookRight) {
    ASSERT_NO_FATAL_FAILURE(deliverToTheScope(3));
    window.controller().disarm();  // the last trains stay on the screen
    const auto set = [&](const char* panel, bool on) {
        auto* tool = find<QToolButton>(window, panel);
        ASSERT_NE(tool, nullptr) << panel;
        if (tool->isChecked() != on) click(*tool);
    };
    for (const auto* panel : {"All measurements", "Spectrum tool", "Controls"}) set(panel, false);
    const std::vector<const char*> all[] = {
        {"All measurements"}, {"Spectrum tool"}, {"All measurements", "Spectrum tool"}, {"Controls"}};
    for (const auto theme : bothThemes()) {
        gui::applyTheme(theme);
        for (const auto size : sizesIn(theme, {QSize(1280, 720), QSize(1920, 1080)})) {
            window.resize(size);
            letLive(100);
            for (const auto& panels : all) {
                for (const auto* panel : panels) set(panel, true);
                const auto name = QString("scope-%1-%2-%3")
                                      .arg(theme == gui::Theme::Dark ? "dark" : "light", panels.front())
                                      .arg(size.width());
                EXPECT_IN_TIME(comesTrue([&] { return faultsOf(window).empty(); }))
                    << faultsOf(window) << ", " << name.toStdString();
                shot(window, panels.size() > 1 ? name + "-both" : name);
                for (const auto* panel : panels) set(panel, false);
            }
        }
    }
}

/// A window with an empty list of sessions: the word for a session that ended in a fault is rightly red.
class WindowWithoutSessions : private OwnDataHome, public Window {};

TEST_F(WindowWithoutSessions, NothingIsRedButStop) {
    open();
    arm();
    deliver();
    const auto red = gui::stateStyle(InterlockState::Faulted).ground;
    auto* stop = window.findChild<QPushButton*>("stopButton");
    for (int page = 0; page < 7; ++page) {
        visit(page);
        letLive(120);
        const auto all = pixelsOf(window.grab().toImage(), red);
        EXPECT_GT(all, 1000) << "STOP is there";
        EXPECT_EQ(all, pixelsOf(stop->grab().toImage(), red)) << "on page " << page;
    }
}

TEST(LimitBarColour, IsAmberFromEightyPercent) {
    for (const auto theme : {gui::Theme::Light, gui::Theme::Dark}) {
        gui::applyTheme(theme);
        const auto amberAt = [](double share) {
            gui::LimitBar bar("5 s RMS");
            bar.resize(bar.sizeHint());
            ExposureRow row;
            row.quantity = Quantity::RmsCurrent5s;
            row.value = 10 * share;
            row.limit = 10;
            row.unit = "mA";
            row.evaluated = row.within = true;
            bar.show(row);
            return pixelsOf(bar.grab().toImage(), gui::colours().amber);
        };
        EXPECT_EQ(amberAt(0.79), 0);
        EXPECT_GT(amberAt(0.80), 100);
        EXPECT_GT(amberAt(0.99), amberAt(0.80)) << "it fills towards the limit";
    }
}

TEST_F(Window, EveryPlotOfSimulatedDataSaysSo) {
    RecordProperty("hazard", "H9");
    open();
    window.controller().present("P120", 50, 1);
    arm();
    deliver();
    auto* tabs = window.findChild<gui::TabbedPage*>("livePage");
    ASSERT_IN_TIME(comesTrue([this] { return window.controller().telemetry().trainsDelivered >= 2; }));
    int plots = 0;
    for (int tab = 0; tab < 2; ++tab) {
        visit(0);
        tabs->setCurrentIndex(tab);
        if (tab == 1) {
            auto* scope = window.findChild<gui::ScopeWorkspace*>();
            ASSERT_IN_TIME(comesTrue([&] { return scope->model().shown() != nullptr; }));
            scope->findChild<gui::SpectrumPanel*>()->setVisible(true);
        }
        letLive(200);
        for (auto* plot : window.findChildren<QCustomPlot*>()) {
            if (!plot->isVisible()) continue;
            ++plots;
            int marked = 0;
            for (int i = 0; i < plot->itemCount(); ++i)
                marked += plot->item(i)->objectName() == "watermark" && plot->item(i)->visible();
            EXPECT_GE(marked, 1) << plot->metaObject()->className();
        }
    }
    EXPECT_GE(plots, 4) << "strips, plane, oscilloscope and spectrum";
}

TEST_F(Window, TheLastMessageOpensTheLogOfAllOfThem) {
    open();
    arm();
    window.controller().disarm();
    auto* last = find<QToolButton>(window, "lastMessage");
    ASSERT_IN_TIME(comesTrue([&] { return last->text().endsWith(" Disarmed: stopped with Disarm. Output is off."); }));
    click(*last);
    QDialog* log = nullptr;
    ASSERT_IN_TIME(comesTrue([&] {
        for (auto* dialog : window.findChildren<QDialog*>()) {
            if (dialog->isVisible() && dialog->windowTitle() == "Messages") log = dialog;
        }
        return log != nullptr;
    }));
    const auto text = log->findChild<QPlainTextEdit*>()->toPlainText().toStdString();
    for (const auto* said : {"Open. Recording to", "Armed.", "Disarmed: stopped with Disarm. Output is off."})
        EXPECT_THAT(text, HasSubstr(said));
    log->close();
}

TEST_F(Window, EscStopsWhileASessionIsExported) {
    RecordProperty("hazard", "H2");
    open();
    const auto session = window.controller().open()->session;
    window.controller().setSpeed(20);
    ASSERT_IN_TIME(
        comesTrue([this] { return window.controller().telemetry().at > Instant(std::chrono::seconds(20)); }));
    window.controller().close();
    ASSERT_IN_TIME(comesTrue([this] { return window.controller().activity() == gui::Activity::Closed; }));
    open();
    arm();
    deliver();
    visit(5);
    window.openFile(QString::fromStdString(session.string()));
    auto* sessions = window.findChild<gui::SessionsWorkspace*>();
    auto* verify = find<QPushButton>(*sessions, "Verify");
    ASSERT_NE(verify, nullptr);
    ASSERT_IN_TIME(comesTrue([&] { return verify->isEnabled(); }));
    const ScratchDir folder;
    const auto target = folder.path() / "csv";
    sessions->exportTo(QString::fromStdString(target.string()));
    EXPECT_FALSE(std::filesystem::exists(target)) << "it is at work";
    ASSERT_IN_TIME(state() == InterlockState::Delivering);
    key(Qt::Key_Escape);
    EXPECT_EQ(state(), InterlockState::Disarmed) << "before the key event returned";
    EXPECT_IN_TIME(comesTrue([&] { return std::filesystem::exists(target); })) << "the export goes on to its end";
}

}  // namespace
}  // namespace tacto::test
