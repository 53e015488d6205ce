// Tests that the bars in the exposure table match the numbers next to them.
#include <QPaintEvent>
#include <QTest>
#include <gtest/gtest.h>

#include "app/gui/theme/ExposureTable.h"
#include "tests/gui/Person.h"
#include "tests/support/InTime.h"

namespace tacto::test {
namespace {

/// Records the painted part of a widget.
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
        ASSERT_IN_TIME(QTest::qWaitForWindowExposed(&table));
        const std::vector<ExposureRow> before{peak(10)}, after{peak(30.7)};
        table.show(before, {});
        letLive(50);
        Painted painted;
        table.viewport()->installEventFilter(&painted);
        table.show(after, {});
        letLive(50);
        constexpr int kRow = 1;  // the row below the set's name
        const int barColumn = table.isColumnHidden(3) ? 0 : 3;
        const auto cell = table.visualRect(table.model()->index(kRow, barColumn));
        EXPECT_TRUE(painted.region.contains(cell.center())) << "the bar of 10 V stands beside 30.7 V, width " << width;
        painted.region = {};
        table.show(after, {});
        letLive(50);
        EXPECT_FALSE(painted.region.contains(cell.center())) << "nothing changed";
    }
}

TEST(ExposureTable, AValueStandsInTheUnitOfItsLimit) {
    RecordProperty("hazard", "H9");
    gui::ExposureTable table;
    table.resize(1200, 300);
    const auto shown = [&](double value) {
        auto row = peak(value);
        row.quantity = Quantity::RmsCurrent5s;
        row.unit = "mA";
        row.limit = 10;
        table.show(std::span(&row, 1), {});
        return table.item(1, 1)->text().replace(QChar(0x202f), ' ').toStdString();
    };
    EXPECT_EQ(shown(0.69), "0.69 mA") << "beside 10 mA, not 690 µA";
    EXPECT_EQ(shown(0.0004), "< 0.01 mA");
    EXPECT_EQ(shown(0), "0 mA");
}

TEST(ExposureTable, LimitSetsStandUnderTheirTitles) {
    LimitSet set;
    set.id = "paper";
    set.title = "The paper's own limits";
    auto ceiling = peak(10);
    ceiling.set = "profile";
    const std::vector<ExposureRow> rows{peak(10), ceiling};
    gui::ExposureTable table;
    table.resize(1200, 300);
    table.show(rows, std::span(&set, 1));
    EXPECT_EQ(table.item(0, 0)->text().toStdString(), "The paper's own limits");
    EXPECT_TRUE(table.item(1, 0)->toolTip().endsWith("limit of The paper's own limits"));
    EXPECT_EQ(table.item(2, 0)->text().toStdString(), "The encoding profile");
    table.resize(300, 300);  // narrow: the table is filled again
    EXPECT_EQ(table.item(0, 0)->text().toStdString(), "The paper's own limits");
}

}  // namespace
}  // namespace tacto::test
