// Tests that after the output went off, no bar shows what was delivered as if it were still on.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "app/gui/theme/ExposureTable.h"
#include "app/gui/theme/Labels.h"
#include "app/gui/theme/TabbedPage.h"
#include "app/gui/theme/Theme.h"
#include "app/gui/window/OutputDocks.h"
#include "app/gui/window/StateWords.h"
#include "tests/gui/window/WindowFixture.h"

namespace tacto::test {
namespace {

using testing::HasSubstr;
using testing::StartsWith;

TEST(ExposureNow, WhileTheOutputIsOffNothingOfAPulseIsDeliveredAndAWindowKeepsItsTrains) {
    RecordProperty("hazard", "H9");
    Telemetry telemetry;
    for (const auto quantity : {Quantity::PeakVoltage, Quantity::PulseEnergy, Quantity::RmsCurrent5s}) {
        auto& row = telemetry.exposureRows[telemetry.exposureCount++];
        row.quantity = quantity;
        row.value = 7;
        row.limit = 5;
        row.evaluated = true;
    }
    auto& area = telemetry.exposureRows[telemetry.exposureCount++];
    area.quantity = Quantity::PowerDensity;
    area.value = NAN;
    for (int state = 0; state <= int(InterlockState::Faulted); ++state) {
        telemetry.state = InterlockState(state);
        const bool off = telemetry.state == InterlockState::Disconnected ||
                         telemetry.state == InterlockState::Disarmed || telemetry.state == InterlockState::Faulted;
        EXPECT_EQ(gui::outputIsOff(telemetry.state), off);
        const auto rows = gui::exposureNow(telemetry);
        ASSERT_EQ(rows.size(), 4U);
        for (const std::size_t pulse : {0U, 1U}) {
            EXPECT_EQ(rows[pulse].value, off ? 0 : 7);
            EXPECT_EQ(rows[pulse].within, off);
        }
        EXPECT_EQ(rows[2].value, 7) << "the gate counts them as long as they are in its window";
        EXPECT_FALSE(rows[2].within);
        EXPECT_FALSE(rows[3].evaluated);
        EXPECT_TRUE(std::isnan(rows[3].value)) << "what was not evaluated is not 0";
    }
}

TEST(ExposureNow, BeforeAnythingIsJudgedNoQuantityIsCalledZero) {
    RecordProperty("hazard", "H9");
    Telemetry telemetry;
    for (const auto quantity : {Quantity::RmsCurrentTrain, Quantity::RmsCurrent1s}) {
        auto& row = telemetry.exposureRows[telemetry.exposureCount++];
        row.quantity = quantity;
        row.value = 0;
        row.limit = NAN;
        row.evaluated = true;
    }
    telemetry.state = InterlockState::Disarmed;
    EXPECT_TRUE(gui::exposureNow(telemetry).empty());
    telemetry.state = InterlockState::Armed;
    EXPECT_EQ(gui::exposureNow(telemetry).size(), 2U);
}

class ExposureInTheWindow : public Window {
protected:
    ExposureInTheWindow() { RecordProperty("hazard", "H9"); }
    [[nodiscard]] static const gui::LimitBar* barCalled(const QWidget& in, const QString& name) {
        for (const auto* bar : in.findChildren<gui::LimitBar*>())
            if (bar->accessibleName().startsWith(name)) return bar;
        return nullptr;
    }
};

TEST_F(ExposureInTheWindow, TheNearestLimitIsInSightInADockThatHasNoRoomForAll) {
    open();
    arm();
    deliver();
    visit(0);
    auto& tabs = *window.findChild<gui::TabbedPage*>("livePage");
    tabs.setCurrentIndex(1);
    auto& dock = *window.findChild<gui::ExposureDock*>();
    for (auto* each : window.findChildren<gui::FoldingDock*>()) each->fold(false);
    for (const int height : {720, 760, 900}) {
        window.resize(1280, height);
        EXPECT_IN_TIME(comesTrue([&] {
            const auto bars = dock.findChildren<gui::LimitBar*>();
            return !bars.isEmpty() && bars.first()->visibleRegion() == QRegion(bars.first()->rect());
        })) << height;
    }
    window.resetLayout();
    tabs.setCurrentIndex(0);
}

TEST_F(ExposureInTheWindow, AfterAStopItSaysThatNothingIsDelivered) {
    open();
    arm();
    deliver();
    auto& bar = *window.findChild<QWidget*>("safetyBar");
    auto& dock = *window.findChild<gui::ExposureDock*>();
    const auto* says = static_cast<gui::ElidedLabel*>(dock.findChild<QLabel*>("exposureNow"));
    ASSERT_NE(says, nullptr);
    const auto shareOf = [](const QWidget& in, const char* name) {
        const auto* found = barCalled(in, name);
        return found == nullptr ? NAN : found->share();
    };
    ASSERT_IN_TIME(comesTrue([&] { return shareOf(bar, "Voltage set") > 0.5 || shareOf(bar, "Peak") > 0.5; }));
    ASSERT_IN_TIME(comesTrue([&] { return shareOf(dock, "RMS current over 5 s") > 0; }));
    EXPECT_EQ(says->text(), "Worst case, with the last 5 s.");
    ASSERT_IN_TIME(
        comesTrue([&] { return barCalled(bar, "Net charge") != nullptr && !std::isnan(shareOf(bar, "Net charge")); }));
    window.controller().stop("operator (STOP)");
    ASSERT_IN_TIME(comesTrue([&] { return says->text() == "Output is off: nothing is delivered."; }));
    EXPECT_EQ(says->shownText(), says->text()) << "it is cut";
    for (const auto* one : dock.findChildren<gui::LimitBar*>()) {
        if (one->accessibleName().contains("over")) continue;
        EXPECT_FALSE(one->share() > 0) << one->accessibleName().toStdString();
    }
    EXPECT_EQ(shareOf(bar, "Peak"), 0);
    EXPECT_NE(barCalled(bar, "Last net charge"), nullptr) << "a figure that is held is named as such";
    shot(window, "exposure-after-stop");
    ASSERT_IN_TIME(comesTrue([&] { return shareOf(dock, "RMS current over 5 s") == 0; }))
        << "what the window holds runs out with it";
}

TEST_F(ExposureInTheWindow, AfterAFaultTheBarsAndTheDriveSayWhatIsAndWhatWas) {
    RecordProperty("hazard", "H12");
    ASSERT_NO_FATAL_FAILURE(open());
    ASSERT_NO_FATAL_FAILURE(unplugWhile(0.4, 0.6));
    const auto* says = window.findChild<QLabel*>("exposureNow");
    ASSERT_IN_TIME(comesTrue([&] { return says->text() == "Output is off: nothing is delivered."; }));
    const auto* drive = window.findChild<QLabel*>("driveSays");
    EXPECT_IN_TIME(comesTrue([&] { return drive->text().startsWith("Was by hand, R 0.40, P 0.60."); }))
        << drive->text().toStdString();
    EXPECT_EQ(window.findChild<QLabel*>("driveOutput")->text(), "Off");
    EXPECT_LE(drive->heightForWidth(drive->width()), 2 * drive->fontMetrics().lineSpacing() + 2)
        << "what stands below moves";
    EXPECT_THAT(window.findChild<QLabel*>("faultText")->text().toStdString(), HasSubstr(" · "));
    shot(window, "exposure-after-fault");
}

}  // namespace
}  // namespace tacto::test
