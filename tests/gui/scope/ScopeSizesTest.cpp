// Tests the oscilloscope in small and large windows, with small and large text, light and dark.
#include <QMenu>
#include <QScrollArea>
#include <QScrollBar>
#include <QTableWidget>
#include <QToolButton>
#include <algorithm>
#include <gtest/gtest.h>

#include "app/gui/theme/Theme.h"
#include "tests/gui/scope/Captures.h"
#include "tests/gui/scope/ScopeBench.h"
#include "tests/support/InTime.h"

namespace tacto::test {
namespace {

/// The page's size in windows of 1024x640 and 1440x900 with docks, at every text size.
class ScopeSizes : public Scope, public testing::WithParamInterface<std::tuple<QSize, int>> {
protected:
    ScopeSizes() : before_(QApplication::font()) { writeAt(before_.pointSizeF() * std::get<1>(GetParam()) / 100); }
    ~ScopeSizes() override {
        writeAt(before_.pointSizeF());
        gui::applyTheme(gui::Theme::Light);
    }

    /// True if a tool without room is in the menu of the last button in its row.
    bool isInMoreTools(const char* name) {
        auto* more = scope.findChild<QToolButton*>("moreTools");
        if (more == nullptr || !more->isVisible()) return false;
        emit more->menu()->aboutToShow();
        return std::ranges::any_of(more->menu()->actions(), [&](const auto* action) { return action->text() == name; });
    }

private:
    /// Changes the text size as the window does: a style sheet would keep its first fonts.
    void writeAt(double points) {
        auto font = before_;
        font.setPointSizeF(points);
        const auto sheet = qApp->styleSheet();
        qApp->setStyleSheet({});
        QApplication::setFont(font);
        qApp->setStyleSheet(sheet);
    }

    QFont before_;
};

TEST_P(ScopeSizes, NothingIsCutOrFoldedAway) {
    const auto [size, percent] = GetParam();
    scope.resize(size);
    showTwoPulses();
    for (int i = 0; i < 5; ++i) QCoreApplication::processEvents();  // the layouts settle
    EXPECT_EQ(scope.size(), size) << "nothing forces it to be larger";
    draw();
    const QRect all = scope.rect();
    for (auto* button : scope.findChildren<QAbstractButton*>()) {
        if (!button->isVisible() || button->text().isEmpty()) continue;
        EXPECT_GE(button->width(), button->minimumSizeHint().width()) << button->text().toStdString();
    }
    for (const auto* name : {"Run", "Single", "Auto", "Fit", "Time cursors", "Mask", "Save", "Controls"}) {
        auto* button = find<QAbstractButton>(scope, name);
        if (button == nullptr && isInMoreTools(name)) continue;
        ASSERT_NE(button, nullptr) << name;
        EXPECT_TRUE(all.contains(QRect(button->mapTo(&scope, QPoint()), button->size()))) << name;
    }
    const auto* cells = scope.findChild<QTableWidget*>("measurements");
    for (int row = 0; row < cells->rowCount(); ++row) {
        for (int c = 0; c < cells->columnCount(); ++c) {
            if (cells->isColumnHidden(c)) continue;  // the tool tip shows what a hidden column contains
            const auto* item = cells->item(row, c);
            EXPECT_GE(cells->columnWidth(c) - 4, QFontMetrics(item->font()).horizontalAdvance(item->text()))
                << item->text().toStdString();
        }
    }
    EXPECT_EQ(cells->horizontalScrollBar()->maximum(), 0);
    EXPECT_GT(scope.screen().axisRect()->width(), 100);
    EXPECT_GT(scope.screen().axisRect()->height(), 60);
    // The column of controls scrolls down; its contents have their full width.
    auto* controls = scope.findChild<QScrollArea*>("scopeControls");
    ASSERT_NE(controls, nullptr);
    if (controls->isVisible()) {
        EXPECT_GE(controls->viewport()->width(), controls->widget()->minimumSizeHint().width());
        EXPECT_GE(controls->widget()->height(), controls->widget()->minimumSizeHint().height());
    }
    const auto name = QString("size-%1x%2-%3").arg(size.width()).arg(size.height()).arg(percent);
    shot(scope, name);
    gui::applyTheme(gui::Theme::Dark);
    QCoreApplication::processEvents();
    draw();
    shot(scope, name + "-dark");
}

std::string nameOfSize(const testing::TestParamInfo<std::tuple<QSize, int>>& of) {
    return "w" + std::to_string(std::get<0>(of.param).width()) + "text" + std::to_string(std::get<1>(of.param));
}

INSTANTIATE_TEST_SUITE_P(Window, ScopeSizes,
                         testing::Combine(testing::Values(QSize(640, 470), QSize(960, 720)),
                                          testing::Values(100, 125, 150, 200)),
                         nameOfSize);

TEST_F(Scope, TheControlsColumnGoesWhereThereIsNoRoomAndComesWhenAskedFor) {
    showTwoPulses();
    auto* button = find<QToolButton>(scope, "Controls");
    auto* controls = scope.findChild<QScrollArea*>("scopeControls");
    // If the button has no room, the More menu has an entry that clicks it.
    const auto ask = [&] { button->isVisible() ? click(*button) : button->click(); };
    EXPECT_TRUE(controls->isVisible());
    scope.resize(420, 480);
    QCoreApplication::processEvents();
    EXPECT_FALSE(controls->isVisible());
    EXPECT_FALSE(button->isChecked());
    ask();
    EXPECT_TRUE(controls->isVisible()) << "asked for, it comes";
    ask();
    scope.resize(1280, 760);
    QCoreApplication::processEvents();
    EXPECT_FALSE(controls->isVisible()) << "sent away, it stays away";
    ask();
    EXPECT_TRUE(controls->isVisible());
}

}  // namespace
}  // namespace tacto::test
