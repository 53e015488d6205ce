// Tests what users expect of any program: it opens dropped files, lists recent ones, offers help, and starts as it was
// left.
#include <QComboBox>
#include <QDockWidget>
#include <QDropEvent>
#include <QMenu>
#include <QMenuBar>
#include <QMimeData>
#include <QPointer>
#include <QPushButton>
#include <QRegularExpression>
#include <QScrollBar>
#include <QSettings>
#include <QTabBar>
#include <QTabWidget>
#include <QTableWidget>
#include <QTextBlock>
#include <QTextBrowser>
#include <QToolBar>
#include <QTreeWidget>
#include <gmock/gmock.h>
#include <set>

#include "app/gui/theme/Pages.h"
#include "app/gui/theme/TabbedPage.h"
#include "app/gui/theme/Theme.h"
#include "tests/gui/window/WindowFixture.h"
#include "tests/support/InTime.h"
#include "tests/support/Support.h"

namespace tacto::test {
namespace {

using gui::Activity;
using testing::HasSubstr;

const auto kExample = sourceDir() / "resources" / "examples" / "linen-slide";

class Habits : public Window {
protected:
    void drop(const std::filesystem::path& path) {
        QMimeData data;
        data.setUrls({QUrl::fromLocalFile(QString::fromStdString(path.string()))});
        QDragEnterEvent enter({400, 400}, Qt::CopyAction, &data, Qt::LeftButton, Qt::NoModifier);
        QApplication::sendEvent(&window, &enter);
        ASSERT_TRUE(enter.isAccepted());
        QDropEvent event({400, 400}, Qt::CopyAction, &data, Qt::LeftButton, Qt::NoModifier);
        QApplication::sendEvent(&window, &event);
    }
    [[nodiscard]] QAction* menuEntry(const QString& menu, const QString& entry) {
        for (auto* action : window.menuBar()->actions()) {
            if (action->text().remove('&') != menu) continue;
            emit action->menu()->aboutToShow();
            for (auto* found : action->menu()->actions()) {
                if (found->text().remove('&') == entry) return found;
            }
        }
        return nullptr;
    }
};

TEST_F(Habits, ARecordingThatIsDroppedReplaysAndIsRemembered) {
    drop(kExample);
    ASSERT_IN_TIME(comesTrue([this] { return window.controller().activity() == Activity::Live; }));
    auto* recent = menuEntry("File", "Recent");
    ASSERT_NE(recent, nullptr);
    emit recent->menu()->aboutToShow();
    ASSERT_FALSE(recent->menu()->actions().isEmpty());
    EXPECT_EQ(recent->menu()->actions().first()->text().toStdString(), kExample.string());
}

TEST_F(Habits, TheBenchMenuOffersWhatCanBeDoneAndSaysWhyNotTheRest) {
    RecordProperty("hazard", "H2");
    const auto whyNot = [this](const char* entry) {
        const auto* action = menuEntry("Bench", entry);
        return action == nullptr ? "not there" : action->isEnabled() ? "" : action->toolTip().toStdString();
    };
    EXPECT_EQ(whyNot("Disarm"), "No bench is open.");
    ASSERT_NO_FATAL_FAILURE(open());
    EXPECT_EQ(whyNot("Disarm"), "The output is not armed.");
    EXPECT_EQ(whyNot("Pause"), "Nothing is delivered.");
    EXPECT_EQ(whyNot("Resume"), "Nothing is paused.");
    EXPECT_EQ(whyNot("Reset fault"), "There is no fault.");
    EXPECT_EQ(whyNot("Arm…"), "");
    ASSERT_NO_FATAL_FAILURE(unplug());
    EXPECT_EQ(whyNot("Reset fault"), "");
    EXPECT_EQ(whyNot("Disarm"), "The output is not armed.");
}

TEST_F(Habits, TheBenchMenuPausesAndDisarmsWhatIsDelivered) {
    RecordProperty("hazard", "H2");
    ASSERT_NO_FATAL_FAILURE(open());
    ASSERT_NO_FATAL_FAILURE(arm());
    EXPECT_TRUE(menuEntry("Bench", "Disarm")->isEnabled());
    ASSERT_NO_FATAL_FAILURE(deliver());
    letLive(80);
    EXPECT_TRUE(menuEntry("Bench", "Pause")->isEnabled());
    EXPECT_FALSE(menuEntry("Bench", "Resume")->isEnabled());
    menuEntry("Bench", "Pause")->trigger();
    EXPECT_IN_TIME(comesTrue([this] { return state() == InterlockState::Paused; }));
    letLive(80);
    EXPECT_TRUE(menuEntry("Bench", "Resume")->isEnabled());
    menuEntry("Bench", "Disarm")->trigger();
    EXPECT_IN_TIME(comesTrue([this] { return state() == InterlockState::Disarmed; }));
    EXPECT_FALSE(menuEntry("Bench", "Disarm")->isEnabled());
}

TEST_F(Habits, ACaptureThatIsDroppedOpensInTheOscilloscope) {
    const ScratchDir folder;
    drop(folder.write("pulse.csv", "time_s,voltage_V\n0,0\n0.0001,10\n0.0002,10\n0.0003,0\n0.0004,0\n"));
    EXPECT_EQ(banner().toStdString(), "");
    EXPECT_EQ(window.workspace(), 0);
    EXPECT_EQ(window.findChild<gui::TabbedPage*>("livePage")->currentIndex(), 1);
}

TEST_F(Habits, AForeignFileThatIsDroppedIsRefusedInWords) {
    const ScratchDir folder;
    drop(folder.write("photo.jpeg", "not for us"));
    EXPECT_THAT(banner().toStdString(), HasSubstr("photo.jpeg"));
    EXPECT_EQ(window.controller().activity(), Activity::Closed);
}

TEST_F(Habits, TheKeysAreOneKeyAway) {
    key(Qt::Key_Question);
    QTextBrowser* guide = nullptr;
    ASSERT_IN_TIME(comesTrue([&] { return (guide = find<QTextBrowser>(window, "guide")) != nullptr; }));
    shot(*guide->window(), "keys");
    const auto words = guide->toPlainText();
    for (const auto* wanted : {"Esc", "Space", "Ctrl+1", "F5", "F1"})
        EXPECT_THAT(words.toStdString(), HasSubstr(wanted));
    guide->window()->close();
}

TEST_F(Habits, F1OpensTheGuideAtTheWorkspaceInFront) {
    const auto folder = sourceDir() / "resources" / "help" / "guide";
    const auto opened = [this](const auto& open) -> QDialog* {
        open();
        QDialog* found = nullptr;
        EXPECT_IN_TIME(comesTrue([&] {
            for (auto* dialog : window.findChildren<QDialog*>())
                if (dialog->isVisible() && dialog->findChild<QTextBrowser*>("guide") != nullptr) found = dialog;
            return found != nullptr;
        }));
        return found;
    };
    const auto pageOf = [](QDialog& guide) { return guide.findChild<QTextBrowser*>("guide")->source().fileName(); };
    const char* const pages[] = {
        "live.md",     "stimulator-calibration.md", "load-safety.md", "separability.md", "pilot.md", "sessions.md",
        "protocols.md"};
    for (int workspace = 0; workspace < 7; ++workspace) {
        window.showWorkspace(workspace);
        window.activateWindow();
        ASSERT_IN_TIME(comesTrue([this] { return QApplication::activeWindow() == &window; }));
        auto* guide = opened([this] { key(Qt::Key_F1); });
        ASSERT_NE(guide, nullptr);
        EXPECT_EQ(pageOf(*guide), pages[workspace]);
        const QPointer shown = guide;
        guide->close();
        ASSERT_IN_TIME(comesTrue([&] { return shown == nullptr; }));
    }
    auto* guide = opened([this] { menuEntry("Help", "Definitions and limits")->trigger(); });
    ASSERT_NE(guide, nullptr);
    EXPECT_EQ(pageOf(*guide), "definitions.md");
    menuEntry("Help", "Guide")->trigger();
    EXPECT_EQ(pageOf(*guide), pages[6]) << "the open one turns to it";
    menuEntry("Help", "Definitions and limits")->trigger();
    auto* browser = guide->findChild<QTextBrowser*>("guide");
    browser->clearHistory();
    QPushButton *contents = nullptr, *back = nullptr;
    for (auto* button : guide->findChildren<QPushButton*>()) {
        if (button->text() == "&Contents") contents = button;
        if (button->text() == "&Back") back = button;
    }
    ASSERT_TRUE(contents != nullptr && back != nullptr);
    EXPECT_FALSE(back->isEnabled());
    contents->click();
    EXPECT_EQ(pageOf(*guide), "index.md");
    // The links in the contents lead to all pages, and each page has a heading.
    std::set<QString> linked;
    for (auto block = browser->document()->begin(); block.isValid(); block = block.next())
        for (auto part = block.begin(); !part.atEnd(); ++part)
            if (const auto link = part.fragment().charFormat().anchorHref(); !link.isEmpty()) linked.insert(link);
    for (const auto& entry : std::filesystem::directory_iterator(folder)) {
        const auto name = QString::fromStdString(entry.path().filename().string());
        if (name == "index.md") continue;
        EXPECT_TRUE(linked.contains(name)) << name.toStdString();
        browser->setSource(name);
        EXPECT_EQ(pageOf(*guide), name);
        EXPECT_EQ(browser->document()->begin().blockFormat().headingLevel(), 1) << name.toStdString();
        for (auto block = browser->document()->begin(); block.isValid(); block = block.next()) {
            if (!block.text().startsWith("tactoscope-cli ")) continue;
            const auto room = block.blockFormat(), below = block.next().blockFormat();
            EXPECT_GT(room.leftMargin(), 0) << block.text().toStdString();
            EXPECT_TRUE(room.bottomMargin() > 0 || below.leftMargin() > 0) << block.text().toStdString();
        }
        EXPECT_EQ(browser->horizontalScrollBar()->maximum(), 0) << name.toStdString() << " is read whole";
        shot(*guide, "guide-" + name.section('.', 0, 0));
        back->click();
        EXPECT_EQ(pageOf(*guide), "index.md");
    }
    guide->close();
    window.showWorkspace(0);  // the next window starts on the page where this one ends
}

/// A place is written *Menu → Entry* or *Workspace → Tab → Button*; each part is something that can be pressed.
TEST_F(Habits, EachPlaceThatTheGuideNamesIsThere) {
    std::set<QString> there;
    const auto add = [&](const QString& text) { there.insert(QString(text).remove('&')); };
    for (int each = 0; each < 7; ++each) window.showWorkspace(each);
    for (const auto* menu : window.menuBar()->actions()) {
        emit menu->menu()->aboutToShow();
        add(menu->text());
        for (const auto* entry : menu->menu()->actions()) add(entry->text());
    }
    for (const auto* button : window.findChildren<QAbstractButton*>()) add(button->text());
    for (const auto* tabs : window.findChildren<QTabBar*>())
        for (int tab = 0; tab < tabs->count(); ++tab) add(tabs->tabText(tab));
    for (const auto* box : window.findChildren<QComboBox*>())
        for (int item = 0; item < box->count(); ++item) add(box->itemText(item));
    const QRegularExpression place("\\*([^*\n]* → [^*\n]*)\\*");
    int places = 0;
    for (const auto& entry : std::filesystem::directory_iterator(sourceDir() / "resources" / "help" / "guide")) {
        QFile file(QString::fromStdString(entry.path().string()));
        ASSERT_TRUE(file.open(QIODevice::ReadOnly));
        for (auto found = place.globalMatch(QString::fromUtf8(file.readAll())); found.hasNext(); ++places) {
            const auto whole = found.next().captured(1);
            for (const auto& part : whole.split(" → "))
                EXPECT_TRUE(there.contains(part))
                    << entry.path().filename() << ": " << whole.toStdString() << " has no " << part.toStdString();
        }
    }
    EXPECT_GT(places, 15);
    window.showWorkspace(0);  // the next window starts on the page where this one ends
}

TEST_F(Habits, DefinitionsAndLimitsAreTheOnesThatJudge) {
    auto* entry = menuEntry("Help", "Definitions and limits");
    ASSERT_NE(entry, nullptr);
    entry->trigger();
    QDialog* help = nullptr;
    ASSERT_IN_TIME(comesTrue([&] {
        for (auto* dialog : window.findChildren<QDialog*>()) {
            if (dialog->isVisible()) help = dialog;
        }
        return help != nullptr;
    }));
    auto* tabs = help->findChild<QTabWidget*>();
    ASSERT_NE(tabs, nullptr);
    shot(*help, "help-definitions");
    tabs->setCurrentIndex(1);
    auto* chooser = help->findChild<QComboBox*>("limitSet");
    auto* rows = help->findChild<QTableWidget*>("limitRows");
    ASSERT_NE(chooser, nullptr);
    const auto& sets = window.controller().limits().sets;
    ASSERT_EQ(chooser->count(), int(sets.size()));
    for (int i = 0; i < chooser->count(); ++i) {
        chooser->setCurrentIndex(i);
        const auto& set = sets[std::size_t(i)];
        EXPECT_EQ(chooser->currentText().toStdString(), set.title);
        ASSERT_EQ(rows->rowCount(), int(set.rows.size()));
        for (int line = 0; line < rows->rowCount(); ++line) {
            const auto& row = set.rows[std::size_t(line)];
            EXPECT_THAT(rows->item(line, 1)->text().toStdString(), HasSubstr(row.strict ? "<" : "≤"));
            EXPECT_EQ(rows->item(line, 2)->text() == "one pulse", windowOf(row.quantity) == 0);
            const auto source =
                QString::fromStdString(row.source).replace("kohm", "kΩ").replace(" ohm", " Ω").replace("cm2", "cm²");
            EXPECT_EQ(rows->item(line, 5)->text().toStdString(), source.toStdString());
        }
        shot(*help, QString("help-limits-%1").arg(i + 1));
    }
    help->close();
}

TEST_F(Habits, ABenchIsMadeOfWhatIsTicked) {
    auto* list = window.findChild<QTreeWidget*>();
    ASSERT_NE(list, nullptr);
    ASSERT_IN_TIME(comesTrue([&] { return list->topLevelItemCount() >= 3; }));
    const auto tick = [&](const QString& name) {
        for (int i = 0; i < list->topLevelItemCount(); ++i) {
            auto* item = list->topLevelItem(i);
            if (item->text(0) != name) continue;
            ASSERT_TRUE(item->data(0, Qt::CheckStateRole).isValid()) << name.toStdString();
            list->setCurrentItem(item);
            list->setFocus();
            QTest::keyClick(list, Qt::Key_Return);
            EXPECT_EQ(item->checkState(0), Qt::Checked);
        }
    };
    for (int i = 0; i < list->topLevelItemCount(); ++i)
        EXPECT_TRUE(list->topLevelItem(i)->data(0, Qt::CheckStateRole).isValid())
            << "what cannot be opened from here is not listed: " << list->topLevelItem(i)->text(0).toStdString();
    for (int i = 0; i < list->topLevelItemCount(); ++i)
        EXPECT_TRUE(list->topLevelItem(i)->data(0, Qt::CheckStateRole).isValid())
            << "what cannot be opened from here is not listed: " << list->topLevelItem(i)->text(0).toStdString();
    tick("simulated stimulator");
    tick("simulated oscilloscope");
    auto* opens = window.findChild<QPushButton*>("openBench");
    EXPECT_TRUE(opens->text().contains("2")) << opens->text().toStdString();
    click(*opens);
    ASSERT_IN_TIME(comesTrue([this] { return window.controller().activity() == Activity::Live; }));
    EXPECT_TRUE(window.controller().open()->streams.empty()) << "no fingertip was asked for";
    EXPECT_TRUE(window.controller().open()->source.has_value());
    arm();
    deliver();
}

TEST_F(Habits, TheWindowIsAsItWasLeft) {
    visit(5);
    auto* dark = menuEntry("View", "Dark");
    ASSERT_NE(dark, nullptr);
    dark->trigger();
    auto* exposure = window.findChild<QDockWidget*>("exposureDock");
    exposure->hide();
    window.resize(1111, 777);
    window.close();
    {
        gui::MainWindow again(simulatedRegistry);
        again.show();
        EXPECT_EQ(again.workspace(), 5);
        EXPECT_EQ(gui::currentTheme(), gui::Theme::Dark);
        EXPECT_TRUE(again.findChild<QDockWidget*>("exposureDock")->isHidden());
        EXPECT_EQ(again.size(), QSize(1111, 777));
        again.close();
    }
    QSettings().clear();
}

TEST_F(Habits, ADamagedWindowStateDoesNotHideStop) {
    RecordProperty("hazard", "H2");
    auto* top = window.findChild<QToolBar*>("safetyToolBar");
    ASSERT_NE(top, nullptr);
    top->hide();
    window.addToolBar(Qt::BottomToolBarArea, top);
    window.close();  // saves this state
    {
        gui::MainWindow again(simulatedRegistry);
        again.show();
        auto* stop = again.findChild<QToolBar*>("safetyToolBar")->findChild<QWidget*>("stopButton");
        ASSERT_NE(stop, nullptr);
        EXPECT_TRUE(stop->isVisible());
        EXPECT_LT(stop->mapTo(&again, QPoint()).y(), again.height() / 3);
        again.close();
    }
    QSettings().clear();
}

}  // namespace
}  // namespace tacto::test
