// Tests that the search for visible faults finds faults made on purpose, and accepts sound widgets.
#include <QHeaderView>
#include <QLabel>
#include <QLineEdit>
#include <QScrollArea>
#include <QTableWidget>
#include <QTest>
#include <QVBoxLayout>
#include <gtest/gtest.h>
#include <qcustomplot.h>

#include "app/gui/theme/Labels.h"
#include "app/gui/theme/Theme.h"
#include "tests/gui/HeightLooks.h"
#include "tests/gui/Looks.h"
#include "tests/gui/Person.h"
#include "tests/gui/PlotLooks.h"
#include "tests/gui/RoomLooks.h"
#include "tests/support/InTime.h"

namespace tacto::test {
namespace {

class WalkOfLooks : public testing::Test {
protected:
    WalkOfLooks() {
        gui::applyTheme(gui::Theme::Light);
        window.resize(480, 360);
    }
    void show() {
        window.show();
        ASSERT_IN_TIME(QTest::qWaitForWindowExposed(&window));
        letLive(20);
    }
    QWidget window;
    QVBoxLayout layout{&window};
};

class WalkOfPlots : public WalkOfLooks {
protected:
    WalkOfPlots() : plot(*new QCustomPlot(&window)) {
        layout.addWidget(&plot);
        plot.xAxis->setLabel("Time (s)");
        plot.yAxis->setLabel("Voltage (V)");
        plot.addGraph()->setData({0.0, 1.0, 2.0}, {0.0, 2.0, 4.0});
        plot.graph()->setName("channel 1");
        plot.xAxis->setRange(0, 2);
        plot.yAxis->setRange(0, 4);
        gui::stylePlot(plot);
        gui::addWatermark(*plot.axisRect());
        show();
        plot.replot();
    }
    QCPItemText& text(const QString& words, double x, double y) {
        auto* item = new QCPItemText(&plot);
        item->setText(words);
        item->position->setCoords(x, y);
        item->setFont(gui::textFont(gui::TextSize::Body));
        plot.replot();
        return *item;
    }
    QCustomPlot& plot;
};

TEST_F(WalkOfPlots, SeesTickLabelsTitlesAndItems) {
    text("a mark", 1, 3);
    QStringList all;
    for (const auto& word : wordsOf(plot)) all << word.text;
    for (const auto* seen : {"a mark", "Time", "Voltage", "2"})
        EXPECT_TRUE(all.join('|').contains(seen)) << seen << ": " << all.join('|').toStdString();
    EXPECT_FALSE(all.join('|').contains("SIMULATED")) << "a watermark lies behind everything by right";
    EXPECT_EQ(faultsOf(window), "");
}

TEST_F(WalkOfPlots, FindsWordsOverEachOther) {
    text("one word", 1, 3);
    text("another", 1.02, 3);
    EXPECT_TRUE(plotWordFaults(window).join('\n').contains("lie over each other"));
}

TEST_F(WalkOfPlots, FindsWordsThatAnEdgeCuts) {
    auto& item = text("a mark at the edge", 2, 3);
    EXPECT_TRUE(plotWordFaults(window).join('\n').contains("is cut")) << "by its axes";
    item.setClipToAxisRect(false);
    plot.replot();
    EXPECT_TRUE(plotWordFaults(window).join('\n').contains("is cut")) << "by the plot";
    item.position->setCoords(1, 3);
    plot.replot();
    EXPECT_EQ(plotWordFaults(window).join('\n').toStdString(), "");
}

TEST_F(WalkOfPlots, FindsPaleWords) {
    auto& item = text("a mark", 1, 3);
    EXPECT_EQ(palePlotWords(window).join('\n').toStdString(), "");
    item.setColor(QColor(0x999999));
    plot.replot();
    EXPECT_EQ(palePlotWords(window).size(), 1) << palePlotWords(window).join('\n').toStdString();
    item.setBrush(Qt::black);
    plot.replot();
    EXPECT_EQ(palePlotWords(window).join('\n').toStdString(), "") << "on a ground of its own";
}

TEST_F(WalkOfPlots, FindsTitlesOfAxesInSmallLetters) {
    EXPECT_EQ(smallAxisTitles(window).join('\n').toStdString(), "");
    plot.yAxis->setLabel("voltage (V)");
    EXPECT_EQ(smallAxisTitles(window).size(), 1);
}

TEST_F(WalkOfPlots, FindsALegendOverData) {
    plot.legend->setVisible(true);
    plot.axisRect()->insetLayout()->setInsetAlignment(0, Qt::AlignTop | Qt::AlignRight);
    plot.replot();
    EXPECT_EQ(legendsOverData(window).size(), 1) << "the line ends there";
    plot.axisRect()->insetLayout()->setInsetAlignment(0, Qt::AlignTop | Qt::AlignLeft);
    plot.replot();
    EXPECT_EQ(legendsOverData(window).join('\n').toStdString(), "");
}

TEST_F(WalkOfLooks, FindsPagesThatAreCutSideways) {
    auto* area = new QScrollArea(&window);
    auto* page = new QLabel("a page");
    area->setWidgetResizable(true);
    area->setWidget(page);
    layout.addWidget(area);
    show();
    EXPECT_EQ(cutSideways(window).join('\n').toStdString(), "");
    page->setMinimumHeight(2000);
    letLive(20);
    EXPECT_EQ(cutSideways(window).join('\n').toStdString(), "") << "it may scroll down";
    page->setMinimumWidth(900);
    letLive(20);
    EXPECT_EQ(cutSideways(window).size(), 1);
    area->setHorizontalScrollBarPolicy(Qt::ScrollBarAlwaysOff);
    letLive(20);
    EXPECT_EQ(cutSideways(window).size(), 1) << "without a way to scroll there";
}

TEST_F(WalkOfLooks, FindsWhatStandsPartlyOutside) {
    auto* holder = new QWidget(&window);
    auto* row = new QVBoxLayout(holder);
    auto* button = new QLineEdit("whole", holder);
    row->addWidget(button);
    layout.addWidget(holder);
    show();
    EXPECT_EQ(beyondTheirPlace(window).join('\n').toStdString(), "");
    button->move(button->x(), holder->height() - button->height() / 2);
    EXPECT_EQ(beyondTheirPlace(window).size(), 1);
}

TEST_F(WalkOfLooks, FindsCellsWithoutRoom) {
    auto* table = new QTableWidget(1, 3, &window);
    const QString words = "more words than have room";
    for (int column = 0; column < 3; ++column) table->setItem(0, column, new QTableWidgetItem(words));
    table->setWordWrap(false);
    table->horizontalHeader()->setStretchLastSection(true);
    layout.addWidget(table);
    window.resize(900, 200);
    show();
    table->resizeColumnsToContents();
    EXPECT_EQ(cutCells(window).join('\n').toStdString(), "");
    table->setColumnWidth(0, 40);
    table->item(0, 0)->setToolTip(words);
    EXPECT_EQ(cutCells(window).size(), 1) << "only the last one may elide";
    table->resizeColumnsToContents();
    window.resize(table->columnWidth(0) * 2 + 120, 200);
    letLive(20);
    EXPECT_EQ(cutCells(window).size(), 1) << "the last one says it nowhere";
    table->item(0, 2)->setToolTip(words);
    EXPECT_EQ(cutCells(window).join('\n').toStdString(), "");
}

TEST_F(WalkOfLooks, FindsFieldsWithoutRoom) {
    auto* edit = new QLineEdit("a text of several words", &window);
    layout.addWidget(edit);
    show();
    EXPECT_EQ(cutFields(window).join('\n').toStdString(), "");
    edit->setFixedWidth(80);
    letLive(20);
    EXPECT_EQ(cutFields(window).size(), 1);
    edit->setToolTip("It says: a text of several words.");
    EXPECT_EQ(cutFields(window).size(), 0);
}

TEST_F(WalkOfLooks, FindsTextThatIsHigherThanItsPlace) {
    auto* table = new QTableWidget(1, 1, &window);
    table->setItem(0, 0, new QTableWidgetItem("a cell"));
    auto* edit = new QLineEdit("a field", &window);
    auto* label = new gui::ElidedLabel("a line", &window);
    for (QWidget* each : std::initializer_list<QWidget*>{table, edit, label}) layout.addWidget(each);
    show();
    EXPECT_EQ(lowTexts(window).join('\n').toStdString(), "");
    table->verticalHeader()->hide();
    table->verticalHeader()->setMinimumSectionSize(4);
    table->setRowHeight(0, 8);
    for (QWidget* each : std::initializer_list<QWidget*>{edit, label}) each->setFixedHeight(9);
    letLive(20);
    const auto found = lowTexts(window).join('\n').toStdString();
    for (const auto* what : {"a cell", "a field", "a line"}) EXPECT_NE(found.find(what), found.npos) << found;
}

TEST_F(WalkOfLooks, FindsRowsThatAnEdgeCutsWithoutAScrollBar) {
    auto* list = new QTableWidget(8, 1, &window);
    for (int row = 0; row < 8; ++row) list->setItem(row, 0, new QTableWidgetItem("a row"));
    layout.addWidget(list);
    show();
    list->setFixedHeight(list->horizontalHeader()->height() + 2 * list->frameWidth() + 5 * list->rowHeight(0) / 2);
    letLive(20);
    EXPECT_EQ(cutBelow(window).join('\n').toStdString(), "") << "its scroll bar leads there";
    list->setVerticalScrollBarPolicy(Qt::ScrollBarAlwaysOff);
    letLive(20);
    EXPECT_EQ(cutBelow(window).size(), 2) << "half a row, and what lies below it";
}

TEST_F(WalkOfLooks, FindsWordsThatAPageCutsWithoutAScrollBar) {
    auto* area = new QScrollArea(&window);
    auto* page = new QWidget;
    auto* column = new QVBoxLayout(page);
    auto* above = new QWidget(page);
    above->setFixedHeight(40);
    auto* words = new QLabel("some words", page);
    words->setFixedHeight(30);
    column->addWidget(above);
    column->addWidget(words);
    column->addStretch();
    area->setWidgetResizable(true);
    area->setWidget(page);
    layout.addWidget(area);
    show();
    EXPECT_EQ(cutBelow(window).join('\n').toStdString(), "");
    area->setFixedHeight(words->y() + 15);
    letLive(20);
    EXPECT_EQ(cutBelow(window).join('\n').toStdString(), "") << "its scroll bar leads there";
    area->setVerticalScrollBarPolicy(Qt::ScrollBarAlwaysOff);
    letLive(20);
    EXPECT_EQ(cutBelow(window).size(), 2) << cutBelow(window).join('\n').toStdString();
}

TEST_F(WalkOfLooks, FindsElidedWordsThatNoToolTipTells) {
    auto* label = new gui::ElidedLabel("a line of several words that may end", &window);
    layout.addWidget(label);
    show();
    EXPECT_EQ(untoldElisions(window).join('\n').toStdString(), "");
    label->setFixedWidth(120);
    letLive(20);
    EXPECT_EQ(untoldElisions(window).size(), 1);
    label->setToolTip(label->text());
    EXPECT_EQ(untoldElisions(window).size(), 0);
}

}  // namespace
}  // namespace tacto::test
