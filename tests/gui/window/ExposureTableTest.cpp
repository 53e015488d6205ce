// The bars of the exposure table are those of the numbers beside them.
#include <QPaintEvent>
#include <QTest>
#include <gtest/gtest.h>

#include "app/gui/look/ExposureTable.h"

namespace tacto::test {
namespace {

/// What of a widget was painted.
class Painted final : public QObject {
public:
    QRegion region;

protected:
    bool eventFilter(QObject*, QEvent* event) override {
        if (event->type() == QEvent::Paint) region += static_cast<QPaintEvent*>(event)->region();
        return false;
    }
};

ExposureRow peak(double volts) {
    ExposureRow row;
    row.quantity = Quantity::CommandVoltage;
    row.unit = "V";
    row.value = volts;
    row.limit = 40;
    row.set = "paper";
    row.evaluated = row.within = true;
    return row;
}

TEST(ExposureTable, ANewValueDrawsItsBarAgainAlsoWhereItStandsUnderTheQuantity) {
    RecordProperty("hazard", "H9");
    for (const int width : {240, 1200}) {
        gui::ExposureTable table;
        table.resize(width, 300);
        table.setVisible(true);
        ASSERT_TRUE(QTest::qWaitForWindowExposed(&table));
        const std::vector<ExposureRow> before{peak(10)}, after{peak(30.7)};
        table.show(before);
        QTest::qWait(50);
        Painted painted;
        table.viewport()->installEventFilter(&painted);
        table.show(after);
        QTest::qWait(50);
        constexpr int kRow = 1;  // below the set's name
        const int barColumn = table.isColumnHidden(3) ? 0 : 3;
        const auto cell = table.visualRect(table.model()->index(kRow, barColumn));
        EXPECT_TRUE(painted.region.contains(cell.center())) << "the bar of 10 V stands beside 30.7 V, width " << width;
        painted.region = {};
        table.show(after);
        QTest::qWait(50);
        EXPECT_FALSE(painted.region.contains(cell.center())) << "nothing changed";
    }
}

}  // namespace
}  // namespace tacto::test
