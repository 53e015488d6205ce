// Tests that the wheel changes no setting without the focus, wherever it is turned (H12).
#include <QAbstractSlider>
#include <QAbstractSpinBox>
#include <QComboBox>
#include <QDateTimeEdit>
#include <QDoubleSpinBox>
#include <QScrollArea>
#include <QScrollBar>
#include <QTabBar>
#include <QWheelEvent>
#include <QWindow>
#include <qcustomplot.h>
#include <random>

#include "app/gui/pilot/PilotWorkspace.h"
#include "app/gui/theme/Style.h"
#include "app/gui/theme/TabbedPage.h"
#include "tests/gui/window/WindowFixture.h"

namespace tacto::test {
namespace {

/// Turns the wheel as a mouse does: through the window, which sets the focus by policy and finds the widget.
void turn(const QWidget& widget, int notches) {
    auto& top = *widget.window();
    const auto at = widget.mapTo(&top, widget.rect().center());
    QWheelEvent event(at, top.mapToGlobal(at), {}, {0, 120 * notches}, Qt::NoButton, Qt::NoModifier, Qt::NoScrollPhase,
                      false);
    QSpontaneKeyEvent::setSpontaneous(&event);
    qApp->notify(top.windowHandle(), &event);
}

/// The present value of a setting.
QString settingOf(const QWidget& widget) {
    if (const auto* list = qobject_cast<const QComboBox*>(&widget))
        return QString("%1 %2").arg(list->currentIndex()).arg(list->currentText());
    if (const auto* slider = qobject_cast<const QAbstractSlider*>(&widget)) return QString::number(slider->value());
    if (const auto* tabs = qobject_cast<const QTabBar*>(&widget)) return QString::number(tabs->currentIndex());
    if (const auto* spin = qobject_cast<const QAbstractSpinBox*>(&widget)) return spin->text();
    return {};
}

/// Finds the settings without WheelGuard::isSetting(), which is being tested.
std::vector<QWidget*> settingsIn(const QWidget& in) {
    std::vector<QWidget*> found;
    for (auto* each : in.findChildren<QWidget*>()) {
        const bool sets = each->inherits("QComboBox") || each->inherits("QAbstractSpinBox") ||
                          each->inherits("QSlider") || each->inherits("QDial") || each->inherits("QTabBar");
        const auto seen = each->visibleRegion().contains(each->rect().center());
        if (sets && each->isVisible() && each->isEnabled() && seen) found.push_back(each);
    }
    return found;
}

class Wheel : public Window {
protected:
    Wheel() { RecordProperty("hazard", "H12"); }
    std::mt19937 random{47};
    int turned = 0;

    void turnOverAll(const QWidget& in) {
        for (auto* each : settingsIn(in)) {
            if (each->hasFocus()) each->clearFocus();
            const auto before = settingOf(*each);
            for (int times = 0; times < 3; ++times) {
                const int notches = std::uniform_int_distribution(1, 4)(random);
                turn(*each, random() % 2 == 0 ? notches : -notches);
                EXPECT_EQ(settingOf(*each), before)
                    << each->metaObject()->className() << ' ' << each->objectName().toStdString() << ' '
                    << each->toolTip().toStdString();
                EXPECT_FALSE(each->hasFocus()) << "the wheel gives no focus";
            }
            ++turned;
        }
    }
};

TEST_F(Wheel, ChangesNoSettingOfAnyWorkspaceThatHasNotTheFocus) {
    open();
    for (int page = 0; page < 7; ++page) {
        visit(page);
        letLive(50);
        if (page == 0) {
            for (const int tab : {0, 1}) {
                window.findChild<gui::TabbedPage*>("livePage")->setCurrentIndex(tab);
                letLive(50);
                turnOverAll(window);
            }
        }
        turnOverAll(window);
    }
    EXPECT_GT(turned, 30) << "there is something to turn over";
    window.askForSimulatedBench();
    letLive(50);
    for (auto* top : QApplication::topLevelWidgets())
        if (top->isVisible() && top != &window) turnOverAll(*top);
    RecordProperty("turned", turned);
}

TEST_F(Wheel, ScrollsThePageUnderAPlotThatDoesNotZoom) {
    QScrollArea area;
    auto* inside = new QWidget;
    auto* column = new QVBoxLayout(inside);
    auto* plot = new QCustomPlot;
    column->addWidget(plot);
    inside->setMinimumHeight(2000);
    area.setWidget(inside);
    area.setWidgetResizable(true);
    area.resize(400, 300);
    area.show();
    ASSERT_IN_TIME(QTest::qWaitForWindowExposed(&area));
    const auto turnedOver = [&] {
        const auto at = QPoint(100, 100);
        QWheelEvent event(at, area.mapToGlobal(at), {}, {0, -120}, Qt::NoButton, Qt::NoModifier, Qt::NoScrollPhase,
                          false);
        QSpontaneKeyEvent::setSpontaneous(&event);
        const int before = area.verticalScrollBar()->value();
        qApp->notify(area.windowHandle(), &event);
        return area.verticalScrollBar()->value() - before;
    };
    EXPECT_GT(turnedOver(), 0);
    plot->setInteraction(QCP::iRangeZoom);
    const auto before = plot->xAxis->range();
    EXPECT_EQ(turnedOver(), 0);
    EXPECT_NE(plot->xAxis->range().size(), before.size()) << "it zooms";
    plot->setInteraction(QCP::iRangeZoom, false);
    EXPECT_GT(turnedOver(), 0);
}

TEST_F(Wheel, ChangesWhatHasTheFocusAndElseScrollsWhatItStandsIn) {
    QScrollArea area;
    auto* inside = new QWidget;
    auto* column = new QVBoxLayout(inside);
    auto* list = new QComboBox;
    list->addItems({"a", "b", "c", "d", "e"});
    list->setCurrentIndex(2);
    auto* number = new QDoubleSpinBox;
    number->setValue(5);
    auto* slider = new QSlider(Qt::Horizontal);
    slider->setValue(50);
    auto* tabs = new QTabBar;
    for (const auto* tab : {"x", "y", "z"}) tabs->addTab(tab);
    tabs->setCurrentIndex(1);
    tabs->setFocusPolicy(Qt::StrongFocus);
    auto* day = new QDateEdit(QDate(2026, 11, 29));
    const std::vector<QWidget*> all{list, number, slider, tabs, day};
    for (auto* each : all) column->addWidget(each);
    column->addStretch();
    inside->setMinimumHeight(2000);
    area.setWidget(inside);
    area.setWidgetResizable(true);
    area.resize(400, 300);
    area.show();
    ASSERT_IN_TIME(QTest::qWaitForWindowExposed(&area));
    area.activateWindow();
    ASSERT_IN_TIME(QTest::qWaitForWindowActive(&area));
    for (auto* each : all) {
        inside->setFocus();
        area.verticalScrollBar()->setValue(0);
        const auto before = settingOf(*each);
        turn(*each, -1);
        EXPECT_EQ(settingOf(*each), before) << each->metaObject()->className();
        EXPECT_GT(area.verticalScrollBar()->value(), 0) << each->metaObject()->className() << ": the page scrolls";
        area.verticalScrollBar()->setValue(0);
        each->setFocus();
        ASSERT_TRUE(each->hasFocus());
        turn(*each, -1);
        EXPECT_NE(settingOf(*each), before) << each->metaObject()->className() << " has the focus";
    }
}

}  // namespace
}  // namespace tacto::test
