// A page of rows that has no room for all of them draws none in part: neither a list's row nor a line of text.
#include <QLabel>
#include <QTest>
#include <QTreeWidget>
#include <QVBoxLayout>
#include <gtest/gtest.h>

#include "app/gui/theme/WholeRows.h"
#include "tests/gui/Person.h"
#include "tests/support/InTime.h"
#include "tests/support/Support.h"

namespace tacto::test {
namespace {

TEST(WholeRows, CutNeitherARowOfAListNorALineOfText) {
    auto* page = new QWidget;
    auto* column = new QVBoxLayout(page);
    column->setContentsMargins(0, 0, 0, 0);
    auto* list = new QTreeWidget(page);
    list->setHeaderHidden(true);
    list->setSizeAdjustPolicy(QAbstractScrollArea::AdjustToContents);
    list->setSizePolicy(QSizePolicy::Expanding, QSizePolicy::Maximum);
    for (const auto* name : {"one", "two", "three", "four"}) new QTreeWidgetItem(list, {name});
    column->addWidget(list);
    auto* text = new QLabel("first\nsecond\nthird\nfourth\nfifth", page);
    text->setWordWrap(true);
    column->addWidget(text);
    column->addStretch();
    gui::WholeRows rows(page, nullptr);
    rows.resize(200, 400);
    rows.show();
    ASSERT_IN_TIME(QTest::qWaitForWindowExposed(&rows));
    const auto bottomOf = [&](int i) {
        return list->viewport()->mapTo(page, list->visualItemRect(list->topLevelItem(i)).bottomLeft()).y();
    };
    const auto drawn = [&](int height) {
        rows.resize(200, height);
        return rows.widget()->mask().isEmpty() ? height : rows.widget()->mask().boundingRect().bottom();
    };
    EXPECT_EQ(drawn(bottomOf(1) + 1 + 10), bottomOf(1)) << "half of the third row";
    EXPECT_EQ(drawn(bottomOf(2) + 1), bottomOf(2)) << "just the third row";
    const int line = text->height() / 5;
    EXPECT_EQ(drawn(text->y() + line + line / 2), text->y() + line - 1) << "half of the second line";
}

TEST(WholeRows, ASentenceStandsWholeAndInLinesOnlyWhereItHasNoRoom) {
    auto* page = new QWidget;
    auto* column = new QVBoxLayout(page);
    column->setContentsMargins(0, 0, 0, 0);
    column->setSpacing(0);
    auto* head = new QLabel("one line", page);
    auto* text = new QLabel("first\nsecond\nthird", page);
    for (auto* label : {head, text}) {
        label->setWordWrap(true);
        column->addWidget(label);
    }
    column->addStretch();
    gui::WholeRows rows(page, nullptr);
    rows.resize(200, 400);
    rows.show();
    ASSERT_IN_TIME(QTest::qWaitForWindowExposed(&rows));
    const int line = text->height() / 3;
    rows.resize(200, head->height() + 2 * line + line / 2);
    EXPECT_EQ(page->mask().boundingRect().bottom(), text->y() - 1) << "not two of its three lines";
    head->hide();
    rows.resize(200, 2 * line + line / 2);
    EXPECT_IN_TIME(comesTrue([&] { return page->mask().boundingRect().bottom() == 2 * line - 1; }));
}

TEST(WholeRows, ATableThatScrollsCutsNoRowAtItsEnd) {
    QTreeWidget list;
    list.setHeaderHidden(true);
    for (int i = 0; i < 20; ++i) new QTreeWidgetItem(&list, {QString::number(i)});
    gui::keepRowsWhole(list);
    list.resize(200, 200);
    list.show();
    ASSERT_IN_TIME(QTest::qWaitForWindowExposed(&list));
    const int high = list.visualItemRect(list.topLevelItem(0)).height();
    auto& page = *list.viewport();
    for (const int more : {0, 3, high / 2}) {
        list.resize(200, list.height() - page.height() + 5 * high + more);
        EXPECT_IN_TIME(comesTrue([&] {
            const int drawn = page.mask().isEmpty() ? page.height() : page.mask().boundingRect().height();
            return drawn == 5 * high;
        })) << more;
    }
    list.resize(200, 40 * high);
    EXPECT_IN_TIME(comesTrue([&] { return page.mask().isEmpty(); })) << "all have room";
}

}  // namespace
}  // namespace tacto::test
