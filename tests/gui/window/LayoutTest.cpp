// Tests where things are in the window, and that data get the room: plots, docks, the rail, F11, keys and focus.
#include <QAbstractSpinBox>
#include <QDockWidget>
#include <QLineEdit>
#include <QMenu>
#include <QMenuBar>
#include <QRegularExpression>
#include <QSplitter>
#include <QStackedWidget>
#include <QStatusBar>
#include <QToolBar>
#include <QToolButton>
#include <QTreeWidget>
#include <algorithm>
#include <cmath>
#include <gmock/gmock.h>

#include "app/gui/controller/FirstOutput.h"
#include "app/gui/live/LiveWorkspace.h"
#include "app/gui/live/ProfileEditor.h"
#include "app/gui/scope/ScopeWorkspace.h"
#include "app/gui/scope/measurements/MeasurementSummary.h"
#include "app/gui/scope/measurements/MeasurementTable.h"
#include "app/gui/scope/panels/ScopeTools.h"
#include "app/gui/scope/screen/ScopeScreen.h"
#include "app/gui/theme/TabbedPage.h"
#include "app/gui/window/DockColumn.h"
#include "app/gui/window/FoldingDock.h"
#include "app/gui/window/LimitBar.h"
#include "tests/gui/Looks.h"
#include "tests/gui/PlotLooks.h"
#include "tests/gui/RoomLooks.h"
#include "tests/gui/window/WindowFixture.h"
#include "tests/support/InTime.h"

namespace tacto::test {
namespace {

using testing::HasSubstr;

class Layout : public Window {
protected:
    ~Layout() override { QSettings().clear(); }
    void checkMnemonics(const std::string& where) {
        std::map<QString, QStringList> keys;
        const auto note = [&keys](const QString& text) {
            const auto key = QKeySequence::mnemonic(text).toString();
            if (!key.isEmpty()) keys[key] << text;
        };
        for (const auto* action : window.menuBar()->actions()) note(action->text());
        for (const auto* button : window.findChildren<QAbstractButton*>())
            if (button->isVisible()) note(button->text());
        for (const auto* label : window.findChildren<QLabel*>())
            if (label->isVisible() && label->buddy() != nullptr) note(label->text());
        for (const auto* bar : window.findChildren<QTabBar*>())
            for (int tab = 0; bar->isVisible() && tab < bar->count(); ++tab) note(bar->tabText(tab));
        for (const auto& [key, texts] : keys)
            EXPECT_EQ(texts.size(), 1) << where << ", " << key.toStdString() << ": " << texts.join(" / ").toStdString();
    }
    gui::FoldingDock& dock(const char* name) { return *window.findChild<gui::FoldingDock*>(name); }
    /// The present workspace.
    [[nodiscard]] QWidget& page() {
        return *window.findChild<QWidget*>("centre")->findChild<QStackedWidget*>()->currentWidget();
    }
    QToolBar& bar(const char* name) { return *window.findChild<QToolBar*>(name); }
};

TEST_F(Layout, F11LeavesSafetyBarAndPlotAlone) {
    RecordProperty("hazard", "H2");
    open();
    visit(0);  // opens the page with its docks
    const auto* stop = window.findChild<QPushButton*>("stopButton");
    const auto before = window.centralWidget()->size();
    key(Qt::Key_F11);
    EXPECT_IN_TIME(comesTrue([&] { return window.centralWidget()->width() > before.width() + 200; }));
    EXPECT_FALSE(bar("workspaces").isVisible());
    EXPECT_FALSE(dock("driveDock").isVisible());
    EXPECT_FALSE(window.statusBar()->isVisible());
    EXPECT_FALSE(window.menuBar()->isVisible());
    EXPECT_FALSE(window.findChild<QWidget*>("tabRow")->isVisible());
    EXPECT_TRUE(stop->isVisible());
    EXPECT_TRUE(window.findChild<QLabel*>("interlockState")->isVisible());
    key(Qt::Key_3, Qt::ControlModifier);
    const auto* path = page().findChild<QWidget*>("path");
    EXPECT_IN_TIME(comesTrue([&] { return path->isVisible(); })) << "it says what is in the way of the run";
    EXPECT_TRUE(page().findChild<QWidget*>("runObstacle")->isVisible());
    key(Qt::Key_4, Qt::ControlModifier);
    const auto* run = page().findChild<QPushButton*>("runButton");
    const auto* free = page().findChild<QWidget*>("path");
    ASSERT_IN_TIME(comesTrue([&] { return run->isEnabled(); }));
    EXPECT_IN_TIME(comesTrue([&] { return !free->isVisible(); })) << "nothing is in the way";
    visit(5);
    EXPECT_FALSE(bar("dockStrip").isVisible()) << "also in another workspace";
    key(Qt::Key_F11);
    EXPECT_IN_TIME(comesTrue([this] { return bar("workspaces").isVisible(); }));
    EXPECT_TRUE(window.statusBar()->isVisible());
    EXPECT_TRUE(window.menuBar()->isVisible());
    visit(2);
    EXPECT_TRUE(path->isVisible());
    visit(3);
    EXPECT_TRUE(free->isVisible());
    visit(0);  // the next window starts where this one ends
}

TEST_F(Layout, TheOscilloscopesToolsHaveTheKeysForAMarkAndForThePlotAlone) {
    open();
    visit(0);
    window.findChild<gui::TabbedPage*>("livePage")->setCurrentIndex(1);
    auto& head = *window.findChild<QWidget*>("livePage")->findChild<QWidget*>("tabRow");
    for (const int width : {1280, 1920}) {
        window.resize(width, width * 9 / 16);
        letLive(50);
        EXPECT_LT(head.height(), 50) << "one row of tools at " << width;
        for (const auto* name : {"Save", "Copy picture", "Controls", "Plot only"})
            EXPECT_NE(find<QToolButton>(head, name), nullptr) << name << " is in sight at " << width;
    }
    auto* only = find<QToolButton>(head, "Plot only");
    ASSERT_NE(only, nullptr);
    click(*only);
    EXPECT_IN_TIME(comesTrue([this] { return !bar("workspaces").isVisible(); }));
    key(Qt::Key_F11);
    EXPECT_IN_TIME(comesTrue([this] { return bar("workspaces").isVisible(); })) << "the same as the key";
    auto* mark = find<QToolButton>(head, "Mark");
    ASSERT_NE(mark, nullptr);
    click(*mark);
    EXPECT_IN_TIME(comesTrue([this] { return window.findChild<QWidget*>("markLine")->isVisible(); }));
}

TEST_F(Layout, F11HidesTheTabsAndTheirKeysStay) {
    open();
    key(Qt::Key_F11);
    auto& live = *window.findChild<gui::TabbedPage*>("livePage");
    key(Qt::Key_O, Qt::AltModifier);
    EXPECT_EQ(live.currentIndex(), 1);
    EXPECT_TRUE(window.findChild<gui::ScopeScreen*>()->isVisible());
    key(Qt::Key_T, Qt::AltModifier);
    EXPECT_EQ(live.currentIndex(), 0);
    EXPECT_FALSE(window.findChild<QWidget*>("commandWords")->isVisible()) << "the strips alone";
    visit(1);
    auto& calibrate = *window.findChild<gui::TabbedPage*>("calibratePages");
    EXPECT_FALSE(calibrate.bar().isVisible());
    key(Qt::Key_N, Qt::AltModifier);
    EXPECT_EQ(calibrate.currentIndex(), 1);
    letLive(50);
    EXPECT_LE(calibrate.currentPage()->mapTo(&calibrate, QPoint(0, 0)).y(), 1)
        << "below the edge its page has the room";
    key(Qt::Key_G, Qt::AltModifier);
    EXPECT_EQ(calibrate.currentIndex(), 0);
    shot(window, "plot-only-calibrate");
    key(Qt::Key_F11);
    EXPECT_TRUE(calibrate.bar().isVisible());
    key(Qt::Key_T, Qt::AltModifier);
    EXPECT_EQ(calibrate.currentIndex(), 2) << "by the tab bar's own keys again";
    key(Qt::Key_G, Qt::AltModifier);
    visit(0);
    EXPECT_TRUE(window.findChild<QWidget*>("commandWords")->isVisible());
    key(Qt::Key_O, Qt::AltModifier);
    EXPECT_EQ(live.currentIndex(), 1);
    key(Qt::Key_T, Qt::AltModifier);
}

TEST_F(Layout, WithThePlotAloneOldSamplesAreStillSaid) {
    RecordProperty("hazard", "H7");
    gui::LiveOrder order;
    order.uris.push_back(*DeviceUri::parse("sim:finger?fault=unplug@2s"));
    order.uris.push_back(*DeviceUri::parse("sim:"));
    order.profile = window.controller().profile();
    window.controller().openLive(order);
    ASSERT_IN_TIME(comesTrue([this] { return window.controller().activity() == gui::Activity::Live; }));
    key(Qt::Key_F11);
    const auto* line = window.findChild<QLabel*>("staleLine");
    EXPECT_FALSE(line->isVisible()) << "fresh samples need no line";
    ASSERT_IN_TIME(comesTrue([&] { return line->isVisible(); }));
    EXPECT_THAT(line->text().toStdString(), HasSubstr("Old: the newest sample is"));
    EXPECT_EQ(line->visibleRegion().boundingRect().size(), line->size());
    shot(window, "plot-only-stale");
    key(Qt::Key_F11);
    EXPECT_FALSE(line->isVisible()) << "the tools say it";
    EXPECT_TRUE(window.findChild<QLabel*>("sensorHealth")->isVisible());
}

TEST_F(Layout, WithThePlotAloneASessionOfAPilotHasNoPath) {
    visit(4);
    auto* begin = window.findChild<QPushButton*>("beginRehearsal");
    ASSERT_IN_TIME(comesTrue([&] { return begin->isVisible() && begin->isEnabled(); }));
    click(*begin);
    const auto* path = page().findChild<QWidget*>("path");
    ASSERT_IN_TIME(comesTrue([&] { return path->isVisible(); }));
    // A run stopped while its bench opens has no result, so wait.
    ASSERT_IN_TIME(comesTrue([this] { return window.controller().activity() == gui::Activity::Running; }));
    letLive(300);
    key(Qt::Key_F11);
    EXPECT_FALSE(path->isVisible());
    shot(window, "plot-only-pilot");
    EXPECT_TRUE(window.findChild<QPushButton*>("stopButton")->isVisible());
    window.controller().stop("the test");
    ASSERT_IN_TIME(comesTrue([this] { return window.controller().activity() == gui::Activity::Closed; }, 60'000));
    letLive(100);
    EXPECT_FALSE(path->isVisible()) << "nor has its result";
    key(Qt::Key_F11);
    EXPECT_TRUE(path->isVisible());
    visit(0);
}

TEST_F(Layout, AClickInTheRailGivesTheKeysToTheWorkspace) {
    RecordProperty("hazard", "H2");
    for (const bool opened : {false, true}) {
        if (opened) open();
        for (auto* button : bar("workspaces").findChildren<QToolButton*>("workspaceButton")) {
            const auto name = button->accessibleName().toStdString();
            window.findChild<QPushButton*>("stopButton")->setFocus();
            click(*button);
            const auto* at = QApplication::focusWidget();
            ASSERT_NE(at, nullptr) << name;
            EXPECT_TRUE(page().isAncestorOf(at) || at == &page()) << name << ": " << widgetName(*at);
            EXPECT_FALSE(qobject_cast<const QLineEdit*>(at) || qobject_cast<const QAbstractSpinBox*>(at)) << name;
        }
    }
    visit(0);  // the next window starts where this one ends
}

TEST_F(Layout, WhatABlindSessionHidesNoKeyAndNoMenuBringsBack) {
    RecordProperty("hazard", "H9");
    using Hidden = gui::DockColumn::Hidden;
    open();
    auto& docks = *window.findChild<gui::DockColumn*>();
    dock("driveDock").setFloating(true);
    dock("driveDock").show();
    docks.setHidden(Hidden::Blind, true);
    const auto shows = [this] {
        return std::ranges::any_of(window.findChildren<QDockWidget*>(), &QDockWidget::isVisible) ||
               bar("dockStrip").isVisible();
    };
    EXPECT_FALSE(shows());
    key(Qt::Key_F11);
    EXPECT_FALSE(bar("workspaces").isVisible());
    key(Qt::Key_F11);
    EXPECT_TRUE(bar("workspaces").isVisible());
    EXPECT_FALSE(shows()) << "F11 twice";
    key(Qt::Key_D, Qt::ControlModifier);
    key(Qt::Key_D, Qt::ControlModifier);
    EXPECT_FALSE(shows()) << "Ctrl+D twice";
    for (auto* each : docks.docks()) docks.show(*each);
    EXPECT_FALSE(shows()) << "the View menu";
    window.resetLayout();
    EXPECT_FALSE(shows()) << "View > Reset layout";
    docks.setHidden(Hidden::Blind, false);
    EXPECT_TRUE(dock("exposureDock").isVisible());
    EXPECT_TRUE(dock("driveDock").isVisible()) << "in the window of its own";
}

TEST_F(Layout, AWindowThatWasClosedWithThePlotAloneBeginsWhole) {
    open();
    key(Qt::Key_F11);
    EXPECT_FALSE(bar("workspaces").isVisible());
    ASSERT_TRUE(window.close());
    gui::MainWindow next(simulatedRegistry);
    next.show();
    EXPECT_TRUE(next.findChild<QToolBar*>("workspaces")->isVisible());
    EXPECT_TRUE(next.statusBar()->isVisible());
}

TEST_F(Layout, DocksCollapseToAStripThatKeepsTheirKeyFigures) {
    open();
    ASSERT_TRUE(dock("driveDock").isVisible());
    key(Qt::Key_D, Qt::ControlModifier);
    ASSERT_IN_TIME(comesTrue([this] { return bar("dockStrip").isVisible(); }));
    for (const auto* name : {"driveDock", "measurementDock", "exposureDock", "deviceDock"})
        EXPECT_FALSE(dock(name).isVisible()) << name;
    auto* drive = find<QToolButton>(bar("dockStrip"), "Drive");
    ASSERT_NE(drive, nullptr);
    EXPECT_IN_TIME(comesTrue([&] { return drive->accessibleDescription() == "Off"; }));
    click(*drive);
    EXPECT_TRUE(dock("driveDock").isVisible());
    EXPECT_FALSE(bar("dockStrip").isVisible());
    visit(5);
    EXPECT_TRUE(bar("dockStrip").isVisible()) << "elsewhere the plot has the room";
    visit(0);
    EXPECT_FALSE(bar("dockStrip").isVisible()) << "each workspace keeps its own";
}

TEST_F(Layout, InLargeTextEveryDockIsInSightInTheStrip) {
    gui::applyTextSize(200);
    window.resize(1280, 720);
    visit(5);
    const auto hidden = [this] {
        QStringList names;
        auto& strip = bar("dockStrip");
        for (const auto* name : {"Drive", "Measurements", "Exposure", "Devices"}) {
            const auto* button = find<QToolButton>(strip, name);
            if (button == nullptr || !button->isVisible() || !strip.rect().contains(button->geometry())) names << name;
        }
        return names.join(' ').toStdString();
    };
    static_cast<void>(comesTrue([&] { return hidden().empty(); }, 3000));
    EXPECT_EQ(hidden(), "");
    shot(window, "strip-200");
    gui::applyTextSize(100);
    visit(0);
}

TEST_F(Layout, InLargeTextToolsWithoutRoomStandInAMenu) {
    open();
    visit(0);
    window.findChild<gui::TabbedPage*>("livePage")->setCurrentIndex(1);
    auto* more = window.findChild<gui::ScopeTools*>()->findChild<QToolButton*>("moreTools");
    window.resize(1920, 1080);
    EXPECT_IN_TIME(comesTrue([&] { return !more->isVisible(); })) << "there is room for all of them";
    auto* spectrum = find<QToolButton>(window, "Spectrum tool");
    ASSERT_NE(spectrum, nullptr);
    gui::applyTextSize(200);
    window.resize(1280, 720);
    EXPECT_IN_TIME(comesTrue([&] { return more->isVisible() && !spectrum->isVisible(); }));
    EXPECT_EQ(more->visibleRegion().boundingRect().size(), more->size());
    emit more->menu()->aboutToShow();
    QAction* action = nullptr;
    for (auto* each : more->menu()->actions())
        if (each->text() == "Spectrum tool") action = each;
    ASSERT_NE(action, nullptr);
    action->trigger();
    EXPECT_TRUE(spectrum->isChecked()) << "as a click on it";
    gui::applyTextSize(100);
    window.resize(1920, 1080);
    EXPECT_IN_TIME(comesTrue([&] { return spectrum->isVisible() && !more->isVisible(); }));
    window.findChild<gui::TabbedPage*>("livePage")->setCurrentIndex(0);
}

TEST_F(Layout, InLargeTextADockThatIsOpenedMakesTheWindowNoWiderThanASmallScreen) {
    RecordProperty("hazard", "H2");
    open();
    gui::applyTextSize(200);
    window.resize(1280, 720);
    for (int page = 0; page < 7; ++page) {
        visit(page);
        for (const bool opened : {false, true}) {
            window.findChild<gui::DockColumn*>()->setCollapsed(!opened);
            letLive(100);
            window.resize(1280, 720);
            letLive(50);
            EXPECT_LE(window.width(), 1280) << page << opened << "\n" << wide();
            EXPECT_LE(window.height(), 720) << page << opened;
        }
        EXPECT_IN_TIME(comesTrue([&] { return cutSideways(window).isEmpty(); }))
            << page << "\n"
            << cutSideways(window).join('\n').toStdString() << "\n"
            << wide();
        shot(window, QString("docks-open-200-%1").arg(page));
    }
    visit(0);
    letLive(100);
    for (const auto* name : {"measurementDock", "exposureDock", "deviceDock"}) {
        EXPECT_TRUE(dock(name).folded()) << name;
        EXPECT_GE(dock(name).height(), dock("driveDock").titleBarWidget()->height()) << name << ": a whole header";
    }
    for (const auto* part : {"driveFingertip", "Roughness R", "Pressure P"}) {
        const auto* control = find<QWidget>(dock("driveDock"), part);
        ASSERT_NE(control, nullptr) << part;
        EXPECT_IN_TIME(comesTrue([&] { return control->visibleRegion() == QRegion(control->rect()); }))
            << part << ": the drive has the room";
    }
    letLive(50);
    shot(window, "docks-open-200-live");
    EXPECT_IN_TIME(comesTrue([this] { return plotWordFaults(window).isEmpty(); }))
        << plotWordFaults(window).join('\n').toStdString();
}

TEST_F(Layout, InLargeTextTheNearestLimitStandsBesideTheState) {
    RecordProperty("hazard", "H9");
    // Lays out before anything is delivered: next to other work, the layout would take longer than the control loop is
    // allowed to be silent.
    gui::applyTextSize(200);
    window.resize(1280, 720);
    open();
    visit(5);  // here the docks are folded
    letLive(300);
    arm();
    deliver();
    const auto& bar = *window.findChild<QWidget*>("safetyBar");
    const auto seen = [&] {
        std::vector<const gui::LimitBar*> all;
        for (const auto* one : bar.findChildren<gui::LimitBar*>())
            if (one->isVisible()) all.push_back(one);
        return all;
    };
    ASSERT_IN_TIME(comesTrue([&] { return seen().size() == 1 && seen().front()->share() > 0; }));
    const auto& nearest = *seen().front();
    for (const auto* other : bar.findChildren<gui::LimitBar*>())
        EXPECT_FALSE(other->share() > nearest.share() + 0.2) << other->accessibleName().toStdString();
    EXPECT_EQ(nearest.visibleRegion().boundingRect().size(), nearest.size());
    const QFontMetrics metrics(gui::textFont(gui::TextSize::Small));
    EXPECT_LE(metrics.horizontalAdvance(nearest.shownText()), nearest.width());
    EXPECT_TRUE(nearest.shownText().contains(QRegularExpression("[0-9]"))) << nearest.shownText().toStdString();
    const auto* word = window.findChild<QLabel*>("interlockState");
    EXPECT_GE(word->font().pointSizeF(), 28) << "from two metres";
    const auto* stop = window.findChild<QPushButton*>("stopButton");
    EXPECT_EQ(stop->visibleRegion().boundingRect().size(), stop->size());
    EXPECT_LE(nearest.mapTo(&window, QPoint(nearest.width(), 0)).x(),
              window.findChild<QPushButton*>("armButton")->mapTo(&window, QPoint()).x());
    EXPECT_EQ(cutTexts(bar).join('\n').toStdString(), "");
    const auto place = [&] { return word->parentWidget()->geometry(); };
    const auto before = place();
    shot(window, "nearest-limit-200");
    window.controller().stop("operator (STOP)");
    ASSERT_IN_TIME(comesTrue([this] { return state() == InterlockState::Disarmed; }));
    letLive(100);
    EXPECT_EQ(place(), before) << "nothing moves";
    gui::applyTheme(gui::Theme::Dark);
    EXPECT_IN_TIME(comesTrue([&] { return cutTexts(bar).isEmpty(); })) << cutTexts(bar).join('\n').toStdString();
    shot(window, "nearest-limit-200-dark");
    gui::applyTheme(gui::Theme::Light);
    gui::applyTextSize(100);
    visit(0);
}

TEST_F(Layout, ADockFoldsToItsHeader) {
    auto& exposure = dock("exposureDock");
    auto* fold = find<QToolButton>(exposure, "Fold Exposure");
    ASSERT_NE(fold, nullptr);
    click(*fold);
    EXPECT_IN_TIME(comesTrue([&] { return exposure.height() <= 40; })) << exposure.height();
    EXPECT_FALSE(exposure.widget()->isVisible());
    click(*find<QToolButton>(exposure, "Unfold Exposure"));
    EXPECT_TRUE(exposure.widget()->isVisible());
}

TEST_F(Layout, BesideTheOscilloscopeMeasurementsHaveRoomInASmallWindowToo) {
    open();
    arm();
    deliver();
    window.resize(1280, 720);
    visit(0);
    EXPECT_TRUE(dock("measurementDock").folded()) << "beside Touch";
    EXPECT_FALSE(dock("deviceDock").folded());
    window.findChild<gui::TabbedPage*>("livePage")->setCurrentIndex(1);
    EXPECT_TRUE(dock("deviceDock").folded());
    const auto* says = window.findChild<QLabel*>("driveSays");
    EXPECT_IN_TIME(comesTrue([&] { return says->visibleRegion() == QRegion(says->rect()); })) << "all of the drive";
    click(*find<QToolButton>(dock("measurementDock"), "Fold Measurements"));
    window.findChild<gui::TabbedPage*>("livePage")->setCurrentIndex(0);
    window.findChild<gui::TabbedPage*>("livePage")->setCurrentIndex(1);
    EXPECT_TRUE(dock("measurementDock").folded()) << "a person's choice is kept";
}

TEST_F(Layout, TheDevicesShowWholeRowsInASmallWindow) {
    open();
    visit(0);
    auto& devices = dock("deviceDock");
    auto* tree = devices.findChild<QTreeWidget*>();
    ASSERT_FALSE(devices.folded());
    ASSERT_FALSE(dock("exposureDock").folded());
    constexpr int kGap = 4;  // of a row, above its text
    const auto rows = [&] {
        int whole = 0, cut = 0;
        for (int i = 0; i < tree->topLevelItemCount(); ++i) {
            const auto row = tree->visualItemRect(tree->topLevelItem(i));
            const auto seen = tree->viewport()->visibleRegion().boundingRect().intersected(row);
            whole += seen.height() == row.height() ? 1 : 0;
            cut += seen.height() > kGap && seen.height() < row.height() ? 1 : 0;
        }
        return std::pair(whole, cut);
    };
    const auto said = [&] { return fmt::format("{} whole and {} cut", rows().first, rows().second); };
    const auto allWhole = [&] { return rows().first >= 3 && rows().second == 0; };
    for (const int height : {720, 768, 900, 1080}) {
        window.resize(1280, height);
        EXPECT_IN_TIME(comesTrue(allWhole, 3000)) << "disarmed, " << height << ": " << said();
    }
    arm();
    deliver();
    for (const int height : {1080, 900, 768, 740, 720}) {
        window.resize(1280, height);
        EXPECT_IN_TIME(comesTrue(allWhole, 3000)) << "delivering, " << height << ": " << said();
        shot(window, QString("devices-rows-%1").arg(height));
    }
}

TEST_F(Layout, TheNearestLimitStandsFirstAndTheAreaCanBeEnteredThere) {
    RecordProperty("hazard", "H9");
    open();
    arm();
    window.controller().drive(DriveSource::Manual, 1, 1);
    ASSERT_IN_TIME(comesTrue([this] { return state() == InterlockState::Delivering; }));
    visit(0);
    auto& exposure = dock("exposureDock");
    const auto inOrder = [&] {
        std::vector<gui::LimitBar*> bars;
        for (auto* bar : exposure.findChildren<gui::LimitBar*>()) bars.push_back(bar);
        std::ranges::sort(bars, {}, [](const gui::LimitBar* bar) { return bar->y(); });
        return bars;
    };
    // The commanded voltage comes first, at its limit of 40 V.
    ASSERT_IN_TIME(comesTrue([&] { return !inOrder().empty() && inOrder().front()->share() > 0.9; }));
    EXPECT_TRUE(std::isnan(inOrder().back()->share())) << "what is not evaluated stands last";
    EXPECT_GE(inOrder().size(), 6U);
    auto* enter = exposure.findChild<QPushButton*>("enterArea");
    ASSERT_TRUE(enter->isVisibleTo(&exposure));
    enter->click();
    auto* editor = window.findChild<gui::ProfileEditor*>();
    ASSERT_NE(editor, nullptr);
    const auto* area = editor->findChild<QLineEdit*>("electrode_area_cm2");
    EXPECT_IN_TIME(comesTrue([&] { return area->isVisible(); })) << "its tab is in front";
    EXPECT_EQ(editor->focusWidget(), area);
    editor->close();
}

TEST_F(Layout, AKeyThatShowsAWorkspaceTakesTheFocusThereAndNotIntoAText) {
    RecordProperty("hazard", "H2");
    open();
    for (int page = 6; page >= 0; --page) {
        key(static_cast<Qt::Key>(Qt::Key_1 + page), Qt::ControlModifier);
        const auto* pages = window.centralWidget()->findChild<QStackedWidget*>();
        ASSERT_IN_TIME(comesTrue([&] { return pages->currentWidget()->isAncestorOf(QApplication::focusWidget()); }))
            << page;
        const auto* at = QApplication::focusWidget();
        EXPECT_FALSE(qobject_cast<const QLineEdit*>(at) || qobject_cast<const QAbstractSpinBox*>(at))
            << page << ": Space would not stop";
    }
}

TEST_F(Layout, NoTwoThatAreSeenHaveTheSameMnemonic) {
    open();
    const auto checkEachPage = [&](const std::string& when) {
        for (int page = 0; page < 8; ++page) {
            visit(page % 7);
            window.findChild<gui::TabbedPage*>("livePage")->setCurrentIndex(page / 7);
            window.findChild<gui::DockColumn*>()->setCollapsed(false);
            for (auto* dock : window.findChildren<gui::FoldingDock*>()) dock->fold(false);
            letLive(50);
            checkMnemonics(fmt::format("{}, page {}", when, page));
        }
    };
    checkEachPage("open");
    ASSERT_NO_FATAL_FAILURE(arm());
    ASSERT_NO_FATAL_FAILURE(deliver());
    checkEachPage("delivering");
    window.controller().pause();
    ASSERT_IN_TIME(comesTrue([this] { return state() == InterlockState::Paused; }));
    checkEachPage("paused");
    window.controller().resume();
    ASSERT_IN_TIME(comesTrue([this] { return state() == InterlockState::Delivering; }));
    ASSERT_NO_FATAL_FAILURE(unplug());
    checkEachPage("faulted");
}

TEST_F(Layout, NoTwoThatAreSeenHaveTheSameMnemonicWhileDevicesAreTicked) {
    auto* list = window.findChild<QTreeWidget*>();
    ASSERT_IN_TIME(comesTrue([&] { return list->topLevelItemCount() >= 3; }));
    list->topLevelItem(0)->setCheckState(0, Qt::Checked);
    checkMnemonics("ticked");
}

TEST_F(Layout, AFaultSaysCauseOutputAndNextStepAndMovesNothing) {
    RecordProperty("hazard", "H2");
    ASSERT_NO_FATAL_FAILURE(open());
    arm();
    deliver();
    letLive(200);  // by now everything that a delivery shows has its place
    const auto stopAt = window.findChild<QPushButton*>("stopButton")->geometry();
    const auto resetAt = window.findChild<QPushButton*>("armButton")->geometry();
    const auto pagesAt = window.centralWidget()->geometry();
    ASSERT_NO_FATAL_FAILURE(unplug());
    const auto says = banner().toStdString();
    EXPECT_THAT(says, HasSubstr("unplugged."));
    EXPECT_THAT(says, HasSubstr("Output is off and stays off."));
    EXPECT_THAT(says, HasSubstr("then reset"));
    EXPECT_EQ(window.findChild<QPushButton*>("stopButton")->geometry(), stopAt);
    EXPECT_EQ(window.findChild<QPushButton*>("armButton")->geometry().size(), resetAt.size());
    EXPECT_EQ(window.centralWidget()->geometry(), pagesAt);
}

class LayoutUnderANotice : public Layout {
protected:
    using Places = std::map<const QWidget*, QRect>;
    LayoutUnderANotice() : notice(*window.findChild<QFrame*>("banner")) { RecordProperty("hazard", "H12"); }
    /// The places of the page and everything in it, docks, bars, STOP and "Arm…".
    [[nodiscard]] Places places() {
        Places all;
        const auto add = [&](const QWidget& each) {
            if (each.isVisible()) all[&each] = QRect(each.mapTo(&window, QPoint()), each.size());
        };
        for (const auto* each : page().findChildren<QWidget*>()) add(*each);
        for (const auto* each : window.findChildren<QDockWidget*>()) add(*each);
        for (const auto* each : window.findChildren<QToolBar*>()) add(*each);
        for (const char* each : {"stopButton", "armButton"}) add(*window.findChild<QPushButton*>(each));
        add(page());
        return all;
    }
    [[nodiscard]] Places atRest() {
        auto before = places();
        EXPECT_IN_TIME(comesTrue([&] {
            letLive(100);
            return std::exchange(before, places()) == before;
        }));
        return before;
    }
    /// The names of the widgets that have moved.
    [[nodiscard]] std::string movedSince(const Places& before) {
        std::string moved;
        const auto now = atRest();
        for (const auto& [widget, place] : before)
            if (const auto found = now.find(widget); found == now.end() || found->second != place)
                moved += widgetName(*widget) + '\n';
        return moved;
    }
    void expectSaid(const char* what) {
        ASSERT_IN_TIME(comesTrue([&] { return banner().contains(what); })) << banner().toStdString();
        EXPECT_TRUE(window.rect().contains(QRect(notice.mapTo(&window, QPoint()), notice.size())));
        EXPECT_GE(notice.width(), 400);
        EXPECT_GE(notice.height(), notice.layout()->totalHeightForWidth(notice.width()));
        EXPECT_EQ(notice.visibleRegion(), QRegion(notice.rect())) << "nothing lies over it";
        EXPECT_EQ(cutTexts(notice).join('\n').toStdString(), "");
        const QRect covered(notice.mapTo(&window, QPoint()), notice.size());
        for (const auto* each : page().findChildren<QAbstractButton*>()) {
            if (!each->isVisible() || each->visibleRegion().isEmpty()) continue;
            EXPECT_FALSE(covered.intersects(QRect(each->mapTo(&window, QPoint()), each->size()))) << widgetName(*each);
        }
    }
    /// Declares a load that is not the connected one; arming is refused after the measurement.
    void armOnAnotherLoad(Places& before) {
        click(*window.findChild<QPushButton*>("armButton"));
        auto* second = window.findChild<QPushButton*>("armOutput");
        ASSERT_NE(second, nullptr);
        auto* load = second->window()->findChild<QLineEdit*>();
        load->selectAll();
        QTest::keyClicks(load, "5 kohm");
        before = atRest();
        click(*second);
        ASSERT_NO_FATAL_FAILURE(expectSaid("Output is off"));
    }
    QFrame& notice;
};

TEST_F(LayoutUnderANotice, ARefusedArmingMovesNothing) {
    for (const int workspace : {0, 2, 5}) {
        visit(workspace);
        const auto before = atRest();
        window.askToArm();
        ASSERT_NO_FATAL_FAILURE(expectSaid("Nothing to arm: no bench is open."));
        EXPECT_EQ(movedSince(before), "") << "workspace " << workspace;
        shot(window, QString("arming-refused-%1").arg(workspace));
        click(*find<QPushButton>(notice, "Dismiss"));
        EXPECT_EQ(movedSince(before), "") << "without it, too";
    }
}

TEST_F(LayoutUnderANotice, InLargeTextItIsReadWhole) {
    const LargeBesideDocks large(*this);
    for (int workspace = 0; workspace < 7; ++workspace) {
        visit(workspace);
        window.askToArm();
        letLive(100);
        SCOPED_TRACE(workspace);
        EXPECT_THAT(banner().toStdString(), HasSubstr("Nothing to arm: no bench is open."));
        EXPECT_GE(notice.width(), 400);
        EXPECT_GE(notice.height(), notice.layout()->totalHeightForWidth(notice.width()));
        EXPECT_EQ(cutTexts(notice).join('\n').toStdString(), "");
        shot(window, QString("arming-refused-large-%1").arg(workspace));
    }
}

TEST_F(LayoutUnderANotice, AnArmingThatTheBenchRefusesMovesNothing) {
    visit(0);
    ASSERT_NO_FATAL_FAILURE(open());
    Places before;
    ASSERT_NO_FATAL_FAILURE(armOnAnotherLoad(before));
    // Ignores the words about touch, which change by themselves, and the exposure, as the measuring pulse adds rows.
    std::erase_if(before, [this](const auto& each) {
        const auto* widget = each.first;
        return widget != &page() && qobject_cast<const QCustomPlot*>(widget) == nullptr &&
               qobject_cast<const QToolBar*>(widget) == nullptr && qobject_cast<const QPushButton*>(widget) == nullptr;
    });
    std::erase_if(before, [](const auto& each) { return each.first->accessibleName() == "Tactile plane"; });
    EXPECT_GE(before.size(), 5U);
    EXPECT_EQ(movedSince(before), "");
}

TEST_F(LayoutUnderANotice, ItStaysAtTheLowerEdgeBelowAMarksLine) {
    visit(0);
    ASSERT_NO_FATAL_FAILURE(open());
    Places before;
    ASSERT_NO_FATAL_FAILURE(armOnAnotherLoad(before));
    window.resize(1280, 720);
    const auto* centre = window.centralWidget();
    EXPECT_IN_TIME(comesTrue(
        [&] { return notice.width() == centre->width() && notice.geometry().bottom() == centre->rect().bottom(); }));
    window.activateWindow();  // the arming dialog had the focus
    ASSERT_IN_TIME(comesTrue([this] { return window.isActiveWindow(); }));
    key(Qt::Key_M, Qt::ControlModifier);
    const auto* mark = window.findChild<QFrame*>("markLine");
    ASSERT_IN_TIME(comesTrue([&] { return mark->isVisible(); }));
    EXPECT_FALSE(mark->geometry().intersects(notice.geometry())) << "both are read";
    shot(window, "arming-refused-and-mark");
    gui::applyTheme(gui::Theme::Dark);
    shot(window, "arming-refused-and-mark-dark");
}

TEST_F(Layout, ArmingSaysWhatTheFirstTrainIs) {
    RecordProperty("hazard", "H12");
    open();
    const auto says = [this] {
        click(*window.findChild<QPushButton*>("armButton"));
        const auto* first = window.findChild<QLabel*>("firstOutput");
        return first == nullptr ? std::string() : first->text().toStdString();
    };
    EXPECT_EQ(says(), "Drive is off: no train follows until you choose one.");
    window.controller().drive(DriveSource::Manual, 0.69, 0.8);
    EXPECT_IN_TIME(comesTrue([this] {
        return window.findChild<QLabel*>("firstOutput")->text().startsWith("Drive is by hand: the first train follows");
    }));
    EXPECT_THAT(window.findChild<QLabel*>("firstOutput")->text().toStdString(), HasSubstr("30.7"));
    auto armed = window.controller().telemetry();
    EXPECT_FALSE(gui::comingTrain(window.controller(), armed)) << "not armed yet";
    armed.state = InterlockState::Armed;
    const auto coming = gui::comingTrain(window.controller(), armed);
    ASSERT_TRUE(coming);
    const auto named = quantityText(std::get<Volts>(coming->train.amplitude).value(), "V", 3);
    EXPECT_THAT(window.findChild<QLabel*>("firstOutput")->text().toStdString(), HasSubstr(named.toStdString()))
        << "the oscilloscope draws what is named here";
    window.controller().drive(DriveSource::Sensor);
    EXPECT_IN_TIME(comesTrue(
        [this] { return window.findChild<QLabel*>("firstOutput")->text().startsWith("The fingertip drives"); }));
}

TEST_F(Layout, OfAMassagerTheFirstOutputIsAStrength) {
    RecordProperty("hazard", "H12");
    gui::LiveOrder order;
    order.uris.push_back(*DeviceUri::parse("sim:massager"));
    order.needed = {Role::Massager};
    order.profile = window.controller().profile();
    window.controller().openLive(order);
    ASSERT_IN_TIME(comesTrue([this] { return state() == InterlockState::Disarmed; }));
    window.controller().drive(DriveSource::Manual, 1, 1);
    auto* arm = window.findChild<QPushButton*>("armButton");
    ASSERT_IN_TIME(comesTrue([arm] { return arm->isEnabled(); }));
    click(*arm);
    EXPECT_IN_TIME(comesTrue([this] {
        const auto* first = window.findChild<QLabel*>("firstOutput");
        return first != nullptr &&
               first->text().startsWith("Drive is by hand: the first burst follows at once, at 100");
    }));
}

TEST_F(Layout, ResetPutsEverythingBack) {
    auto& drive = dock("driveDock");
    drive.fold(true);
    drive.setFloating(true);
    key(Qt::Key_D, Qt::ControlModifier);
    window.resetLayout();
    EXPECT_IN_TIME(comesTrue([&] { return drive.isVisible() && !drive.isFloating() && !drive.folded(); }));
}

TEST_F(Layout, ResetPutsPanelsAndColumnsOfAWorkspaceBackToo) {
    open();
    visit(0);
    auto* lanes = window.findChild<gui::LiveWorkspace*>()->findChild<QSplitter*>();
    ASSERT_IN_TIME(comesTrue([&] { return lanes->isVisible() && lanes->sizes().front() > 0; }));
    window.resetLayout();
    letLive(100);
    const auto first = lanes->sizes();
    lanes->setSizes({first[0] - 150, first[1] + 150});
    ASSERT_NE(lanes->sizes(), first);
    window.findChild<gui::TabbedPage*>("livePage")->setCurrentIndex(1);
    auto& scope = *window.findChild<gui::ScopeWorkspace*>();
    for (const auto* name : {"All measurements", "Spectrum tool", "Controls"})
        click(*find<QToolButton>(*scope.window(), name));
    ASSERT_IN_TIME(comesTrue([&] { return scope.table().isVisible(); }));
    window.resetLayout();
    EXPECT_IN_TIME(comesTrue([&] { return !scope.table().isVisible(); }));
    for (const auto* name : {"All measurements", "Spectrum tool", "Controls"})
        EXPECT_FALSE(find<QToolButton>(*scope.window(), name)->isChecked()) << name;
    window.findChild<gui::TabbedPage*>("livePage")->setCurrentIndex(0);
    EXPECT_IN_TIME(comesTrue([&] { return lanes->sizes() == first; }));
}

}  // namespace
}  // namespace tacto::test
