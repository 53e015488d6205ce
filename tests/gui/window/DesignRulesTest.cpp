// Tests the design's rules for everything shown: grid, text sizes, icons, one variant of each control.
#include <QAbstractItemView>
#include <QAbstractSpinBox>
#include <QComboBox>
#include <QRegularExpression>
#include <QSettings>
#include <QTabBar>
#include <QToolButton>
#include <algorithm>
#include <cmath>
#include <map>
#include <set>

#include "app/gui/live/StripPlots.h"
#include "app/gui/scope/screen/ScopeScreen.h"
#include "app/gui/theme/TabbedPage.h"
#include "app/gui/theme/Theme.h"
#include "app/gui/window/DockColumn.h"
#include "tests/gui/Looks.h"
#include "tests/gui/window/WindowFixture.h"
#include "tests/support/InTime.h"

namespace tacto::test {
namespace {

class DesignRules : public Window {
protected:
    ~DesignRules() override { QSettings().clear(); }
    /// Calls `follow` on each workspace and the oscilloscope; on the live one with every dock open.
    template <class Follow>
    void onEachPage(Follow follow) {
        for (int page = 0; page < 8; ++page) {
            visit(page % 7);
            window.findChild<gui::TabbedPage*>("livePage")->setCurrentIndex(page / 7);
            for (auto* dock : window.findChildren<gui::FoldingDock*>()) dock->fold(false);
            letLive(60);
            follow(page);
        }
        window.findChild<gui::TabbedPage*>("livePage")->setCurrentIndex(0);
    }
    template <class T>
    std::vector<T*> shown() {
        std::vector<T*> all;
        for (auto* widget : window.findChildren<T*>())
            if (widget->isVisible() && widget->window() == &window) all.push_back(widget);
        return all;
    }
    /// Expects small, body, large and display text, each `times` as large; the state's word may be smaller.
    void expectSizesOfText(double times) {
        std::map<std::string, std::string> others;
        const double designed[] = {9 * times, 10.5 * times, 15 * times, 28 * times};
        onEachPage([&](int page) {
            for (auto* widget : shown<QWidget>()) {
                const bool words = qobject_cast<QLabel*>(widget) || qobject_cast<QAbstractButton*>(widget) ||
                                   qobject_cast<QLineEdit*>(widget) || qobject_cast<QComboBox*>(widget) ||
                                   qobject_cast<QTabBar*>(widget) || qobject_cast<QAbstractItemView*>(widget) ||
                                   qobject_cast<QAbstractSpinBox*>(widget);
                const double size = widget->font().pointSizeF();
                const bool known =
                    std::ranges::any_of(designed, [&](double each) { return std::abs(each - size) < 0.26 * times; });
                if (words && !known) others[widgetName(*widget)] = fmt::format("{:.2f} pt on page {}", size, page);
            }
        });
        for (const auto& [name, size] : others) ADD_FAILURE() << name << ": " << size;
    }
};

TEST_F(DesignRules, ThreeSizesOfTextAndOneForAWord) {
    open();
    expectSizesOfText(1);
}

TEST_F(DesignRules, EveryTextGrowsWithAChangeOfSizeAlsoWhereItWasNotShownBefore) {
    gui::applyTextSize(200);
    expectSizesOfText(2);
    gui::applyTextSize(100);
    expectSizesOfText(1);
}

TEST_F(DesignRules, RailAndToolsHaveIcons) {
    open();
    onEachPage([&](int page) {
        for (auto* button : shown<QToolButton>()) {
            const bool drawsItself = button->parentWidget()->objectName() == "dockStrip";
            if (button->size().isEmpty() || (!button->text().isEmpty() && button->objectName() != "workspaceButton"))
                continue;
            EXPECT_TRUE(drawsItself || !button->icon().isNull()) << page << widgetName(*button);
        }
    });
}

TEST_F(DesignRules, StackedPlotsHaveBothEdgesInLine) {
    open();
    visit(0);
    letLive(300);
    auto& strips = *window.findChild<gui::StripPlots*>();
    for (const int percent : {100, 200}) {
        gui::applyTextSize(percent);
        letLive(300);
        std::set<int> lefts, rights;
        for (const auto* axes : strips.axisRects()) {
            if (!axes->visible() || axes->height() < 2) continue;
            lefts.insert(axes->left());
            rights.insert(axes->right());
        }
        EXPECT_EQ(lefts.size(), 1U) << percent;
        EXPECT_EQ(rights.size(), 1U) << percent;
        EXPECT_GE(strips.axisRects().size(), 5);
    }
}

TEST_F(DesignRules, APageHasOneFilledButtonAtMost) {
    const auto check = [this](int page) {
        QStringList filled;
        for (auto* button : shown<QPushButton>()) {
            if (button->property("role") == "segment") continue;  // chooses one of several, which is no action
            // Looks next to the text.
            const auto ground = button->grab().toImage().pixelColor(QPoint(6, button->height() / 2));
            if (button->isEnabled() && ground == gui::colours().primary) filled << button->text();
        }
        EXPECT_LE(filled.size(), 1) << page << ": " << filled.join(", ").toStdString();
        return filled;
    };
    onEachPage(check);
    open();
    int filledWhileOpen = 0;
    onEachPage([&](int page) { filledWhileOpen += int(check(page).size()); });
    EXPECT_GE(filledWhileOpen, 3) << "or it could not tell";
    ASSERT_NO_FATAL_FAILURE(arm());
    ASSERT_NO_FATAL_FAILURE(deliver());
    ASSERT_NO_FATAL_FAILURE(unplug());
    onEachPage([&](int page) { EXPECT_EQ(check(page), QStringList{"&Reset"}) << page; });
}

TEST_F(DesignRules, UnitsAndLimitSetsAreWrittenForPeople) {
    QStringList forbidden{R"(\b[Oo]hms?\b)", R"(\bkohm\b)"};
    for (const auto& set : window.controller().limits().sets)
        if (set.id != "paper") forbidden << QRegularExpression::escape(QString::fromStdString(set.id));
    const QRegularExpression inTips(forbidden.join('|'));
    const QRegularExpression machine((forbidden << R"(\b[a-z]+_[a-z_]+\b)").join('|'));  // tips name script words
    std::set<std::string> found;
    int looked = 0;
    const auto lookFor = [&](const QRegularExpression& words, const QString& text) {
        ++looked;
        if (const auto match = words.match(text); match.hasMatch())
            found.insert(match.captured().toStdString() + " in \"" + text.toStdString() + '"');
    };
    const auto look = [&](const QString& text) { lookFor(machine, text); };
    open();
    arm();
    onEachPage([&](int) {
        for (const auto* widget : shown<QWidget>()) {
            lookFor(inTips, widget->toolTip());
            if (const auto* label = qobject_cast<const QLabel*>(widget)) look(label->text());
            if (const auto* button = qobject_cast<const QAbstractButton*>(widget)) look(button->text());
            if (const auto* box = qobject_cast<const QComboBox*>(widget))
                for (int i = 0; i < box->count(); ++i) look(box->itemText(i));
            const auto* view = qobject_cast<const QAbstractItemView*>(widget);
            if (view == nullptr || view->model() == nullptr) continue;
            for (int row = 0; row < view->model()->rowCount(view->rootIndex()); ++row)
                for (int column = 0; column < view->model()->columnCount(view->rootIndex()); ++column)
                    look(view->model()->index(row, column, view->rootIndex()).data().toString());
        }
    });
    for (const auto& each : found) ADD_FAILURE() << each;
    EXPECT_GE(looked, 500);
}

TEST_F(DesignRules, NoWorkspaceHasTwoOfPauseOrStop) {
    RecordProperty("hazard", "H2");
    open();
    arm();
    deliver();
    onEachPage([&](int page) {
        std::map<QString, int> seen;
        for (const auto* button : shown<QAbstractButton>()) {
            if (!button->isEnabled()) continue;
            const auto words = QString(button->text()).remove('&').toLower();
            for (const auto* each : {"pause", "stop"})
                if (words == each || words.startsWith(QString(each) + " ")) ++seen[each];
        }
        for (const auto& [word, count] : seen) EXPECT_LE(count, 1) << page << word.toStdString();
    });
    EXPECT_EQ(shown<QPushButton>().empty(), false);
}

}  // namespace
}  // namespace tacto::test
