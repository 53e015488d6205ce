// What the safety bar shows and does, in each state.
#include <QTest>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "app/gui/look/Look.h"
#include "app/gui/window/SafetyBar.h"
#include "tests/gui/Person.h"

namespace tacto::test {
namespace {

ExposureRow row(Quantity quantity, double value, double limit, const char* unit) {
    ExposureRow made;
    made.quantity = quantity;
    made.value = value;
    made.limit = limit;
    made.unit = unit;
    made.evaluated = !std::isnan(value);
    made.within = value <= limit;
    made.set = "paper";
    return made;
}

TEST(LimitBar, SaysValueAndLimitAndTheShareOfIt) {
    gui::LimitBar bar("5 s RMS");
    bar.show(row(Quantity::RmsCurrent5s, 2.5, 10, "mA"));
    EXPECT_EQ(bar.text().replace(QChar(0x202f), ' ').replace(QChar(0x2009), ' '), "2.50 mA of 10 mA");
    EXPECT_DOUBLE_EQ(bar.share(), 0.25);
}

TEST(LimitBar, NeverShowsANumberForWhatWasNotEvaluated) {
    RecordProperty("hazard", "H9");
    gui::LimitBar bar("Density");
    bar.show(row(Quantity::PowerDensity, std::nan(""), 0.25, "W/cm2"));
    EXPECT_EQ(bar.text(), "not evaluated");
    EXPECT_TRUE(std::isnan(bar.share()));
    bar.show(std::nullopt);
    EXPECT_EQ(bar.text(), QString("–"));
}

TEST(Tightest, IsTheRowNearestItsLimitAndNotEvaluatedComesFirst) {
    RecordProperty("hazard", "H9");
    const std::vector<ExposureRow> rows{row(Quantity::RmsCurrent5s, 2, 50, "mA"),
                                        row(Quantity::RmsCurrent5s, 2, 10, "mA"),
                                        row(Quantity::PulseEnergy, 1, 300, "mJ")};
    EXPECT_DOUBLE_EQ(gui::tightest(rows, {Quantity::RmsCurrent5s})->limit, 10);
    EXPECT_FALSE(gui::tightest(rows, {Quantity::PowerDensity}));
    auto more = rows;
    more.push_back(row(Quantity::RmsCurrent5s, std::nan(""), 80, "mA"));
    EXPECT_DOUBLE_EQ(gui::tightest(more, {Quantity::RmsCurrent5s})->limit, 80);
}

class Bar : public testing::Test {
protected:
    Bar() {
        bar.resize(1400, bar.sizeHint().height());
        bar.show();
    }
    Telemetry in(InterlockState state, const char* reason = "") {
        Telemetry telemetry;
        telemetry.state = state;
        telemetry.reason = reason;
        return telemetry;
    }
    QString word() { return bar.findChild<QLabel*>("interlockState")->text(); }
    gui::BenchDesk desk{simulatedRegistry};
    gui::CalibrationBook calibrations{desk};
    gui::SafetyBar bar{desk, calibrations};
};

TEST_F(Bar, HasAWordAndAShapeForEveryState) {
    QStringList words, shapes;
    for (int state = 0; state <= int(InterlockState::Faulted); ++state) {
        bar.refresh(in(InterlockState(state), "why"));
        const auto look = gui::stateLook(InterlockState(state));
        EXPECT_EQ(word(), look.word);
        EXPECT_FALSE(words.contains(look.word) || shapes.contains(look.shape)) << look.word.toStdString();
        words << look.word;
        shapes << look.shape;
        shot(bar, "safetybar-" + look.word.toLower());
    }
}

TEST_F(Bar, StopIsThereAndEnabledInEveryState) {
    auto* stop = find<QPushButton>(bar, "STOP");
    ASSERT_NE(stop, nullptr);
    for (int state = 0; state <= int(InterlockState::Faulted); ++state) {
        bar.refresh(in(InterlockState(state)));
        EXPECT_TRUE(stop->isVisible() && stop->isEnabled());
    }
}

TEST_F(Bar, StopSwitchesOffWhenThePressGoesDown) {
    RecordProperty("hazard", "H5");
    gui::LiveOrder order;
    order.uris.push_back(*DeviceUri::parse("sim:"));
    order.profile = desk.profile();
    desk.openLive(order);
    ASSERT_TRUE(comesTrue([this] { return desk.activity() == gui::Activity::Live; }));
    ArmRequest request;
    request.operatorConfirmed = true;
    desk.arm(request);
    ASSERT_TRUE(comesTrue([this] { return desk.telemetry().state == InterlockState::Armed; }));
    QTest::mousePress(find<QPushButton>(bar, "STOP"), Qt::LeftButton);
    EXPECT_EQ(desk.telemetry().state, InterlockState::Disarmed);
}

TEST_F(Bar, ArmingOnlyAsks) {
    RecordProperty("hazard", "H6");
    gui::LiveOrder order;
    order.uris.push_back(*DeviceUri::parse("sim:"));
    order.profile = desk.profile();
    desk.openLive(order);
    ASSERT_TRUE(comesTrue([this] { return desk.activity() == gui::Activity::Live; }));
    bar.refresh(desk.telemetry());
    int asked = 0;
    QObject::connect(&bar, &gui::SafetyBar::armRequested, [&] { ++asked; });
    click(*bar.findChild<QPushButton*>("armButton"));
    EXPECT_EQ(asked, 1);
    QTest::qWait(200);
    EXPECT_EQ(desk.telemetry().state, InterlockState::Disarmed);
}

TEST_F(Bar, SaysWhyItFaultedAndThatOutputIsOff) {
    bar.refresh(in(InterlockState::Faulted, "electrode open"));
    bool said = false;
    for (const auto* label : bar.findChildren<QLabel*>())
        said = said || label->toolTip() == "electrode open. Output is off.";
    EXPECT_TRUE(said);
}

}  // namespace
}  // namespace tacto::test
