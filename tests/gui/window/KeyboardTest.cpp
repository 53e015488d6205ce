// Tests use without a mouse: Tab reaches every control of the window and its dialogs once, the focus is visible, and
// Shift+F1 explains the focused control.
#include <QDialog>
#include <QLineEdit>
#include <QMenu>
#include <QMenuBar>
#include <QStackedWidget>
#include <QWhatsThis>
#include <gmock/gmock.h>

#include "app/gui/runner/ProtocolWorkspace.h"
#include "tests/gui/Looks.h"
#include "tests/gui/window/TabRound.h"
#include "tests/gui/window/WindowFixture.h"
#include "tests/support/InTime.h"

namespace tacto::test {
namespace {

constexpr int kWorkspaces = 7;

class Keyboard : public Window {
protected:
    /// Activates a window. QTest takes a dialog for active if its parent is.
    static void activate(QWidget& top) {
        top.activateWindow();
        ASSERT_IN_TIME(comesTrue([&] { return QApplication::activeWindow() == &top; }));
    }
    void show(int workspace) {
        visit(workspace);
        letLive(100);  // time for the layout and a first drawing
    }
    [[nodiscard]] QPushButton& stopButton() { return *window.findChild<QPushButton*>("stopButton"); }
    [[nodiscard]] QDialog* visibleDialog() {
        for (auto* dialog : window.findChildren<QDialog*>()) {
            if (dialog->isVisible()) return dialog;
        }
        return nullptr;
    }
    /// Opens a dialog with its entry in the menus.
    void choose(const QString& menu, const QString& entry) {
        for (auto* action : window.menuBar()->actions()) {
            if (action->text().remove('&') != menu) continue;
            emit action->menu()->aboutToShow();
            for (auto* found : action->menu()->actions()) {
                if (found->text().remove('&') == entry) return found->trigger();
            }
        }
        ADD_FAILURE() << "no entry " << entry.toStdString();
    }
};

TEST_F(Keyboard, TabReachesEveryControlOfEveryWorkspaceAndComesRound) {
    open();
    for (int workspace = 0; workspace < kWorkspaces; ++workspace) {
        SCOPED_TRACE(workspace);
        show(workspace);
        expectAllReached(window, tabFrom(stopButton()));
    }
}

TEST_F(Keyboard, TabGoesThroughEachWorkspaceInTheOrderOfReading) {
    open();
    for (int workspace = 0; workspace < kWorkspaces; ++workspace) {
        SCOPED_TRACE(workspace);
        show(workspace);
        std::vector<const QWidget*> order;
        const auto* page = window.findChild<QWidget*>("centre")->findChild<QStackedWidget*>();
        ASSERT_NE(page, nullptr);
        tabFrom(stopButton(), [&](QWidget& at) {
            if (page->isAncestorOf(&at)) order.push_back(&at);
        });
        EXPECT_GE(order.size(), 3U);
        EXPECT_EQ(stepsBack(order), "");
    }
}

TEST_F(Keyboard, F5RunsWhatIsShownAndShiftF5CancelsIt) {
    RecordProperty("hazard", "H2");
    for (int workspace = 0; workspace < kWorkspaces; ++workspace) {
        SCOPED_TRACE(workspace);
        show(workspace);
        gui::ProtocolWorkspace* shown = nullptr;
        for (auto* one : window.findChildren<gui::ProtocolWorkspace*>()) {
            if (one->isVisible()) shown = one;
        }
        if (shown == nullptr) {
            key(Qt::Key_F5);
            letLive(200);
            EXPECT_EQ(window.controller().activity(), gui::Activity::Closed) << "nothing is shown that runs";
            continue;
        }
        if (auto* area = shown->findChild<QLineEdit*>("area")) {
            key(Qt::Key_F5);
            EXPECT_FALSE(shown->running()) << "it asks for the electrode first";
            QTest::keyClicks(area, "3");
        }
        ASSERT_IN_TIME(comesTrue([&] { return shown->ready(); }));
        letLive(200);  // judged a moment after it is shown
        key(Qt::Key_F5);
        ASSERT_IN_TIME(comesTrue([&] { return shown->running(); }));
        for (const auto* other : window.findChildren<gui::ProtocolWorkspace*>())
            EXPECT_EQ(other->running(), other == shown) << other->accessibleName().toStdString();
        key(Qt::Key_F5, Qt::ShiftModifier);
        ASSERT_IN_TIME(comesTrue([&] { return window.controller().activity() == gui::Activity::Closed; }));
        EXPECT_FALSE(shown->running());
    }
}

TEST_F(Keyboard, TabReachesEveryControlOfADialogAndComesRound) {
    open();
    const std::pair<const char*, std::function<void()>> dialogs[] = {
        {"Keys", [this] { choose("Help", "Keys"); }},
        {"Definitions and limits", [this] { choose("Help", "Definitions and limits"); }},
        {"Messages", [this] { choose("View", "Messages"); }},
        {"Operator and sample", [this] { choose("Bench", "Operator and sample…"); }},
        {"second step of arming",
         [this] {
             auto* first = window.findChild<QPushButton*>("armButton");
             ASSERT_IN_TIME(comesTrue([&] { return first->isEnabled() && first->text().contains("…"); }));
             click(*first);
         }},
    };
    for (const auto& [name, opens] : dialogs) {
        SCOPED_TRACE(name);
        opens();
        ASSERT_IN_TIME(comesTrue([this] { return visibleDialog() != nullptr; }));
        auto* dialog = visibleDialog();
        ASSERT_NO_FATAL_FAILURE(activate(*dialog));
        const auto controls = controlsOf(*dialog);
        ASSERT_FALSE(controls.empty()) << "not even a way to close it";
        expectAllReached(*dialog, tabFrom(*controls.front()));
        dialog->close();
        ASSERT_IN_TIME(comesTrue([this] { return visibleDialog() == nullptr; }));
        ASSERT_NO_FATAL_FAILURE(activate(window));
    }
}

/// The bench is closed, so nothing changes by itself.
TEST_F(Keyboard, TheFocusIsSeen) {
    ASSERT_NO_FATAL_FAILURE(activate(window));
    stopButton().setFocus();
    QTest::keyClick(&stopButton(), Qt::Key_Tab);  // before the first Tab, Qt assumes that a mouse is used
    for (int workspace = 0; workspace < kWorkspaces; ++workspace) {
        SCOPED_TRACE(workspace);
        show(workspace);
        QWidget* before = nullptr;
        QImage focused;
        std::size_t seen = 0;
        const auto around = [this](const QWidget& widget) {
            constexpr int kFrame = 4;
            return QRect(widget.mapTo(&window, QPoint()), widget.size()).adjusted(-kFrame, -kFrame, kFrame, kFrame);
        };
        const auto controls = controlsOf(window);
        tabFrom(stopButton(), [&](QWidget& at) {
            if (before != nullptr) {
                EXPECT_NE(window.grab(around(*before)).toImage(), focused) << widgetName(*before);
                ++seen;
            }
            before = nullptr;
            if (std::ranges::find(controls, &at) == controls.end()) return;
            before = &at;
            focused = window.grab(around(at)).toImage();
        });
        EXPECT_GE(seen, 5U);
    }
}

TEST_F(Keyboard, ShiftF1ExplainsWhateverHasTheFocus) {
    const auto explanation = []() -> QWidget* {
        for (auto* widget : QApplication::topLevelWidgets()) {
            if (widget->isVisible() && widget->inherits("QWhatsThat")) return widget;
        }
        return nullptr;
    };
    const auto pictureOf = [&] {
        EXPECT_IN_TIME(comesTrue([&] { return explanation() != nullptr; }));
        const auto picture = explanation() != nullptr ? explanation()->grab().toImage() : QImage();
        QWhatsThis::hideText();
        return picture;
    };
    open();
    for (const char* own : {"stopButton", "armButton"}) {
        const auto* button = window.findChild<QPushButton*>(own);
        EXPECT_FALSE(button->toolTip().isEmpty() && button->whatsThis().isEmpty()) << own;
    }
    std::size_t explained = 0;
    for (int workspace = 0; workspace < kWorkspaces; ++workspace) {
        SCOPED_TRACE(workspace);
        show(workspace);
        std::vector<QWidget*> reached;
        tabFrom(stopButton(), [&](QWidget& at) { reached.push_back(&at); });
        for (auto* at : reached) {
            if (!at->isVisible() || !at->isEnabled()) continue;
            at->setFocus(Qt::TabFocusReason);
            // A part without a text of its own is explained by the widget around it.
            const QWidget* says = at;
            while (says != nullptr && says->toolTip().isEmpty() && says->whatsThis().isEmpty())
                says = says->parentWidget();
            if (says == nullptr) continue;
            const auto words = says->whatsThis().isEmpty() ? says->toolTip() : says->whatsThis();
            key(Qt::Key_F1, Qt::ShiftModifier);
            const auto shown = pictureOf();
            QWhatsThis::showText(window.mapToGlobal(QPoint(50, 50)), words, at);
            EXPECT_EQ(shown, pictureOf()) << widgetName(*at) << " should say \"" << words.toStdString() << '"';
            ++explained;
        }
    }
    RecordProperty("explained", static_cast<int>(explained));
    EXPECT_GE(explained, 60U);
}

TEST_F(Keyboard, WhateverTabReachesSaysWhatItIs) {
    open();
    for (int workspace = 0; workspace < kWorkspaces; ++workspace) {
        SCOPED_TRACE(workspace);
        show(workspace);
        tabFrom(stopButton(), [](const QWidget& at) {
            const QWidget* says = &at;
            while (says != nullptr && says->toolTip().isEmpty() && says->whatsThis().isEmpty())
                says = says->parentWidget();
            EXPECT_NE(says, nullptr) << widgetName(at) << ": Shift+F1 says that nothing has the focus";
        });
    }
}

}  // namespace
}  // namespace tacto::test
