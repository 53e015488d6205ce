// A number with arrows, typed with a comma by real keys.
#include <QTest>
#include <gtest/gtest.h>

#include "app/gui/theme/TypedSpin.h"

namespace tacto::test {
namespace {

double typed(gui::TypedSpin& box, const char* keys) {
    box.selectAll();
    QTest::keyClicks(&box, keys);
    QTest::keyClick(&box, Qt::Key_Return);
    return box.value();
}

TEST(TypedSpin, ACommaIsTheDecimalPoint) {
    gui::TypedSpin box;
    box.setRange(0.05, 10);
    box.setDecimals(2);
    box.setSuffix(" N");
    EXPECT_EQ(typed(box, "0,5"), 0.5);
    EXPECT_EQ(typed(box, "1.25"), 1.25);
    EXPECT_EQ(typed(box, "2,50"), 2.5);
    EXPECT_EQ(typed(box, "7"), 7);
    EXPECT_EQ(box.text(), "7.00 N");
}

TEST(TypedSpin, AWholeNumberTakesNoComma) {
    gui::TypedSpin box;
    box.setRange(0, 200);
    box.setDecimals(0);
    typed(box, "4,");
    EXPECT_EQ(box.text(), "4");
}

}  // namespace
}  // namespace tacto::test
