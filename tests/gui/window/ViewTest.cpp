// Tests what the window shows and how it is laid out: the View menu's ticks, text that grows and shrinks again, docks
// that fold and share their column, and the page that an opened bench leads to.
#include <QAction>
#include <QMenu>
#include <QMenuBar>
#include <QScrollBar>
#include <QSettings>
#include <QSplitter>
#include <QStatusBar>
#include <cctype>
#include <random>
#include <sstream>

#include "app/gui/scope/ScopeWorkspace.h"
#include "app/gui/theme/TabbedPage.h"
#include "app/gui/theme/Told.h"
#include "app/gui/window/DockColumn.h"
#include "app/gui/window/FoldingDock.h"
#include "tests/gui/window/WindowFixture.h"

namespace tacto::test {
namespace {

class View : public Window {
protected:
    ~View() override {
        gui::applyTextSize(100);
        gui::applyTheme(gui::Theme::Light);
        window.close();
        QSettings().clear();
    }
    [[nodiscard]] QAction* entry(const QString& name) {
        for (auto* menu : window.menuBar()->findChildren<QMenu*>()) {
            emit menu->aboutToShow();
            for (auto* action : menu->actions())
                if (action->text().remove('&') == name) return action;
        }
        ADD_FAILURE() << "no entry " << name.toStdString();
        return nullptr;
    }
    /// Where everything is that a person can drag, and the window's size.
    [[nodiscard]] std::string places() const {
        auto all = fmt::format("window {} x {}\n", window.width(), window.height());
        for (const auto* dock : window.findChildren<gui::FoldingDock*>())
            all += fmt::format("{} at {} {}, {} x {}, folded {}\n", dock->objectName().toStdString(), dock->x(),
                               dock->y(), dock->width(), dock->height(), dock->folded());
        for (const auto* splitter : window.findChildren<QSplitter*>()) {
            if (!splitter->isVisible()) continue;
            all += "splitter";
            for (const int size : splitter->sizes()) all += fmt::format(" {}", size);
            all += '\n';
        }
        return all + fmt::format("status bar {}\n", window.statusBar()->height());
    }
    /// True if nothing differs by more than rounding may.
    [[nodiscard]] static bool areAlike(const std::string& one, const std::string& other) {
        std::istringstream first(one), second(other);
        for (std::string a, b; first >> a;) {
            if (!(second >> b)) return false;
            const bool numbers = std::isdigit(a.front()) != 0 && std::isdigit(b.front()) != 0;
            if (a != b && !(numbers && std::abs(std::stoi(a) - std::stoi(b)) <= 2)) return false;
        }
        return one.empty() == other.empty();
    }
    /// Docks that show a scroll bar in hardly any room although the column has blank room for them.
    [[nodiscard]] std::string crushed() const {
        std::string all;
        int blank = 0, bottom = -1;
        std::vector<const gui::FoldingDock*> docks;
        for (const auto* dock : window.findChildren<gui::FoldingDock*>())
            if (dock->isVisible() && !dock->isFloating()) docks.push_back(dock);
        std::ranges::sort(docks, {}, [](const auto* dock) { return dock->y(); });
        constexpr int kBetween = 16;  // more than a divider is wide
        for (const auto* dock : docks) {
            if (bottom >= 0) blank += std::max(0, dock->y() - bottom - kBetween);
            bottom = dock->y() + dock->height();
            if (!dock->folded()) blank += std::max(0, dock->height() - dock->wantedHeight() - kBetween);
        }
        blank += std::max(0, window.centralWidget()->geometry().bottom() - bottom - kBetween);
        for (const auto* dock : docks) {
            const int missing = dock->folded() ? 0 : dock->wantedHeight() - dock->height();
            if (missing > 0 && blank > kBetween)
                all += fmt::format("{} lacks {} pixels while {} are blank\n", dock->objectName().toStdString(), missing,
                                   blank);
        }
        return all;
    }
};

TEST_F(View, TheMenuTicksThemeAndTextSize) {
    const auto ticked = [this](std::initializer_list<const char*> names) {
        std::string all;
        for (const auto* name : names)
            if (const auto* action = entry(name); action != nullptr && action->isChecked()) all += name;
        return all;
    };
    const auto theme = [&] { return ticked({"Light", "Dark"}); };
    const auto size = [&] { return ticked({"100 %", "125 %", "150 %", "200 %"}); };
    EXPECT_EQ(theme(), "Light");
    EXPECT_EQ(size(), "100 %");
    entry("Dark")->trigger();
    EXPECT_EQ(theme(), "Dark");
    EXPECT_EQ(gui::currentTheme(), gui::Theme::Dark);
    entry("150 %")->trigger();
    EXPECT_EQ(size(), "150 %");
    entry("Light")->trigger();
    entry("Light")->trigger();
    EXPECT_EQ(theme(), "Light") << "a second click leaves it";
    EXPECT_EQ(size(), "150 %");
    entry("100 %")->trigger();
    EXPECT_EQ(size(), "100 %");
}

TEST_F(View, TextBackAtItsUsualSizeGivesTheOldLayoutBack) {
    std::mt19937 random(49);
    open();
    for (const int tab : {0, 1}) {
        window.findChild<gui::TabbedPage*>("livePage")->setCurrentIndex(tab);
        auto docks = window.findChildren<gui::FoldingDock*>();
        docks[int(random() % 4)]->fold(random() % 2 == 0);
        window.resizeDocks({docks[0]}, {300 + int(random() % 60)}, Qt::Horizontal);
        letLive(400);
        const auto before = places();
        for (const char* word : {"plain", "1 → 2", "⚠ 🔒 ≤ 3"}) {
            for (const char* size : {"200 %", "125 %", "100 %"}) {
                entry(size)->trigger();
                letLive(300);
            }
            emit gui::Told::all().said(word);  // also of taller fonts
            EXPECT_IN_TIME(comesTrue([&] { return areAlike(places(), before); })) << word << '\n'
                                                                                  << before << "is now\n"
                                                                                  << places();
        }
    }
}

TEST_F(View, AClickOnADocksHeaderFoldsItAndADragDoesNot) {
    for (auto* dock : window.findChildren<gui::FoldingDock*>()) {
        const bool before = dock->folded();
        auto* header = dock->titleBarWidget();
        click(*header);
        EXPECT_NE(dock->folded(), before) << dock->objectName().toStdString();
        click(*header);
        EXPECT_EQ(dock->folded(), before);
        QTest::mousePress(header, Qt::LeftButton, {}, {40, 8});
        QTest::mouseRelease(header, Qt::LeftButton, {}, {140, 8});
        EXPECT_EQ(dock->folded(), before) << "dragged";
        EXPECT_FALSE(dock->isFloating());
    }
}

/// Folds, text sizes and heights of the window drawn at random, with a bench and its figures.
TEST_F(View, NoDockIsCrushedWhileItsColumnHasBlankRoom) {
    std::mt19937 random(5);
    open();
    arm();
    deliver();
    letLive(600);
    for (int round = 0; round < 12; ++round) {
        gui::applyTextSize(round % 3 == 2 ? 125 : 100);
        window.resize(1440, 620 + int(random() % 460));
        window.findChild<gui::TabbedPage*>("livePage")->setCurrentIndex(int(random() % 2));
        for (auto* dock : window.findChildren<gui::FoldingDock*>()) dock->fold(random() % 3 == 0);
        letLive(150);
        EXPECT_IN_TIME(comesTrue([this] { return crushed().empty(); })) << "round " << round << '\n'
                                                                        << crushed() << places();
        shot(window, QString("docks_%1").arg(round));
    }
}

TEST_F(View, AnOpenedBenchLeadsToLive) {
    for (const int page : {1, 3, 5, 6}) {
        visit(page);
        open();
        EXPECT_EQ(window.workspace(), 0) << "from page " << page;
        window.controller().close();
        ASSERT_IN_TIME(comesTrue([this] { return window.controller().activity() == gui::Activity::Closed; }));
        EXPECT_EQ(window.workspace(), 0);
    }
}

TEST_F(View, ARunThatClosedTheBenchOpensItAgainAndItsResultStaysInSight) {
    RecordProperty("hazard", "H12");
    open();
    visit(3);
    letLive(200);  // its fields are shown in the next turns
    auto* repeats = find<QLineEdit>(window, "repeats");
    ASSERT_NE(repeats, nullptr);
    repeats->setText("2");
    const auto* before = find<QLabel>(window, "timeLeft");
    ASSERT_NE(before, nullptr);
    EXPECT_TRUE(before->text().contains("closes the open bench")) << before->text().toStdString();
    runsToItsEnd();
    ASSERT_IN_TIME(comesTrue([this] { return window.controller().activity() == gui::Activity::Live; }));
    EXPECT_EQ(state(), InterlockState::Disarmed);
    EXPECT_EQ(window.controller().telemetry().driving, DriveSource::Off);
    EXPECT_EQ(window.workspace(), 3);
    EXPECT_NE(find<QLabel>(window, "verdict"), nullptr);
}

TEST_F(View, AStoppedRunLeavesTheBenchClosed) {
    RecordProperty("hazard", "H2");
    open();
    visit(3);
    auto* run = find<QPushButton>(window, "runButton");
    ASSERT_NE(run, nullptr);
    ASSERT_IN_TIME(comesTrue([&] { return run->isEnabled(); }));
    click(*run);
    ASSERT_IN_TIME(comesTrue([this] { return window.controller().activity() == gui::Activity::Running; }));
    window.controller().stop("operator (Esc)");
    ASSERT_IN_TIME(comesTrue([this] { return window.controller().activity() == gui::Activity::Closed; }));
    letLive(300);
    EXPECT_EQ(window.controller().activity(), gui::Activity::Closed);
    EXPECT_NE(find<QPushButton>(window, "openAgain"), nullptr) << "a person opens it";
    const auto* line = window.findChild<QAbstractButton*>("lastMessage");
    EXPECT_FALSE(line->toolTip().contains(".js:")) << line->toolTip().toStdString();
    for (const auto* label : window.findChildren<QLabel*>())
        EXPECT_FALSE(label->isVisible() && label->text().contains(".js:")) << label->text().toStdString();
}

}  // namespace
}  // namespace tacto::test
