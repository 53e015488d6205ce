// Tests that a measured value stands next to the set value, in amber if they differ.
#include <QImage>
#include <gmock/gmock.h>

#include "app/gui/theme/ExposureTable.h"
#include "app/gui/theme/Theme.h"
#include "app/gui/window/LimitBar.h"
#include "app/gui/window/StateWords.h"
#include "tests/gui/Looks.h"
#include "tests/gui/Person.h"

namespace tacto::test {
namespace {

using testing::HasSubstr;

ExposureRow commanded(double set, double measured, bool beyond) {
    ExposureRow row;
    row.quantity = Quantity::CommandVoltage;
    row.value = set;
    row.limit = 40;
    row.unit = unitOf(row.quantity);
    row.evaluated = row.within = true;
    row.measured = measured;
    row.beyond = beyond;
    return row;
}

bool hasColour(const QImage& image, const QColor& colour) {
    for (int y = 0; y < image.height(); ++y)
        for (int x = 0; x < image.width(); ++x)
            if (image.pixelColor(x, y) == colour) return true;
    return false;
}

TEST(MeasuredRow, StandsBesideWhatWasSetAndIsAmberWhereItIsNotThat) {
    testing::Test::RecordProperty("hazard", "H1");
    for (const auto theme : {gui::Theme::Light, gui::Theme::Dark}) {
        gui::applyTheme(theme);
        for (const auto shape : {gui::LimitBar::Shape::Stacked, gui::LimitBar::Shape::Line}) {
            gui::LimitBar bar("Peak", nullptr, shape);
            bar.resize(400, bar.sizeHint().height());
            bar.show(commanded(20, NAN, false));
            EXPECT_FALSE(bar.text().contains("measured"));
            bar.show(commanded(20, 20.1, false));
            EXPECT_THAT(bar.shownText().toStdString(), HasSubstr("20.0 of 40"));
            EXPECT_THAT(bar.shownText().toStdString(), HasSubstr("20.1"));
            EXPECT_FALSE(hasColour(bar.grab().toImage(), gui::colours().amber));
            bar.show(commanded(20, 23, true));
            EXPECT_THAT(bar.shownText().toStdString(), HasSubstr("⚠ 23.0"));
            EXPECT_TRUE(hasColour(bar.grab().toImage(), gui::colours().amber));
            shot(bar, QString("measured_%1_%2").arg(theme == gui::Theme::Light ? "light" : "dark").arg(int(shape)));
            // If only one of them fits, it is the more important one.
            bar.resize(110, bar.height());
            EXPECT_TRUE(bar.shownText().startsWith("⚠ 23.0")) << bar.shownText().toStdString();
        }
    }
    gui::applyTheme(gui::Theme::Light);
}

TEST(MeasuredRow, IsOfNoOutputThatIsOff) {
    testing::Test::RecordProperty("hazard", "H9");
    Telemetry telemetry;
    telemetry.exposureRows[telemetry.exposureCount++] = commanded(20, 23, true);
    telemetry.state = InterlockState::Delivering;
    EXPECT_TRUE(gui::exposureNow(telemetry).front().beyond);
    telemetry.state = InterlockState::Disarmed;
    const auto off = gui::exposureNow(telemetry);
    EXPECT_FALSE(off.front().beyond);
    EXPECT_EQ(gui::measuredText(off.front()), "");
}

}  // namespace
}  // namespace tacto::test
