// After a stop the panel of the drive says what drove, so that the operator goes on knowingly; it goes on with nothing.
#include <QDoubleSpinBox>
#include <QPushButton>
#include <cmath>

#include "app/gui/theme/Theme.h"
#include "tests/gui/live/LiveBench.h"
#include "tests/support/InTime.h"

namespace tacto::test {
namespace {

using testing::StartsWith;

class DriveThatWas : public LiveBench {
protected:
    DriveThatWas() {
        RecordProperty("hazard", "H2");
        RecordProperty("hazard", "H12");
    }
    [[nodiscard]] std::string says() { return drive.findChild<QLabel*>("driveSays")->text().toStdString(); }
    [[nodiscard]] bool saysOff() {
        return comesTrue([this] { return drive.chosen() == DriveSource::Off && drive.headline() == "Off"; });
    }
};

TEST_F(LiveBench, TheFirstOfTheDrivesChoicesHasItsLeftEdge) {
    ASSERT_IN_TIME(openSimulated());
    auto* hand = drive.findChild<QPushButton*>("driveByHand");
    hand->click();
    auto* off = find<QPushButton>(drive, "Off");
    ASSERT_IN_TIME(comesTrue([&] { return hand->isChecked() && drive.isEnabled(); }));
    const auto picture = drive.grab().toImage();
    const auto at = off->mapTo(&drive, QPoint());
    int edges = 0;
    for (int x = std::max(0, at.x() - 1); x < at.x() + 2; ++x)
        edges += picture.pixelColor(x, at.y() + off->height() / 2) == gui::colours().edge;
    EXPECT_EQ(edges, 1);
}

TEST_F(DriveThatWas, IsNamedAfterAStopAndStartsNothing) {
    ASSERT_IN_TIME(openSimulated());
    ASSERT_IN_TIME(comesTrue([this] { return drive.isEnabled(); }));
    EXPECT_THAT(says(), StartsWith("Nothing drives the output."));
    ASSERT_IN_TIME(armed());
    controller.drive(DriveSource::Manual, 0.4, 0.6);
    ASSERT_IN_TIME(comesTrue([this] { return controller.telemetry().trainsDelivered > 0; }));
    ASSERT_IN_TIME(comesTrue([this] { return drive.chosen() == DriveSource::Manual; }));
    controller.stop("test");
    ASSERT_IN_TIME(saysOff());
    EXPECT_THAT(says(), StartsWith("Was by hand, R 0.40, P 0.60."));
    const auto delivered = controller.telemetry().trainsDelivered;
    ASSERT_IN_TIME(armed());
    ASSERT_IN_TIME(passes(2.5));
    EXPECT_EQ(controller.telemetry().trainsDelivered, delivered) << "what was does not go on by itself";
    EXPECT_EQ(controller.telemetry().driving, DriveSource::Off);
}

/// Why the fingertip drives no train is what is known of it, not more.
TEST_F(LiveBench, TheDriveSaysOfTheFingertipWhatIsKnown) {
    RecordProperty("hazard", "H7");
    ASSERT_IN_TIME(openSimulated());
    ASSERT_IN_TIME(comesTrue([this] { return drive.isEnabled(); }));
    ASSERT_IN_TIME(armed());
    controller.drive(DriveSource::Sensor);
    ASSERT_IN_TIME(comesTrue([this] { return drive.chosen() == DriveSource::Sensor; }));
    for (const auto finger : {FingerStanding::Stale, FingerStanding::Implausible, FingerStanding::Fresh}) {
        for (const bool contact : {false, true}) {
            auto telemetry = controller.telemetry();
            telemetry.state = InterlockState::Delivering;
            telemetry.finger = finger;
            telemetry.contact = contact;
            telemetry.amplitude_v = telemetry.interval_s = NAN;
            drive.refresh(telemetry);
            const auto says = drive.findChild<QLabel*>("driveSays")->text().toStdString();
            const bool feels = finger == FingerStanding::Fresh;
            EXPECT_EQ(says.find("touches nothing") != says.npos, feels && !contact) << says;
            EXPECT_EQ(says.find("no roughness") != says.npos, feels && contact) << says;
            EXPECT_EQ(says.find("samples are old") != says.npos, finger == FingerStanding::Stale) << says;
            EXPECT_EQ(says.find("no readings") != says.npos, finger == FingerStanding::Implausible) << says;
        }
    }
}

TEST_F(DriveThatWas, ByHandSaysBeforeArmingWhatItAsksForAndAfterwardsWhatWasSet) {
    ASSERT_IN_TIME(openSimulated());
    ASSERT_IN_TIME(comesTrue([this] { return drive.isEnabled(); }));
    drive.findChild<QPushButton*>("driveByHand")->click();
    drive.findChild<QDoubleSpinBox*>("driveRoughness")->setValue(0.69);
    ASSERT_IN_TIME(comesTrue([this] {
        const auto telemetry = controller.telemetry();
        drive.refresh(telemetry);
        return telemetry.driving == DriveSource::Manual && std::isfinite(telemetry.roughness);
    }));
    ASSERT_NE(controller.telemetry().roughness, 0.69) << "while it is off the bench tells of the fingertip";
    EXPECT_EQ(drive.headline(), "Off") << "nothing is delivered";
    EXPECT_EQ(says(), "By hand asks for 30.7\u202fV every 2.00\u202fs once the output is armed.");
    controller.stop("test");
    ASSERT_IN_TIME(saysOff());
    EXPECT_THAT(says(), StartsWith("Was by hand, R 0.69, P 0.00."));
}

TEST_F(DriveThatWas, IsTheFingertipWhereItDroveAndAnotherBenchKnowsOfNone) {
    ASSERT_IN_TIME(openSimulated());
    ASSERT_IN_TIME(armed());
    controller.present("P120", 50, 1);
    controller.drive(DriveSource::Sensor);
    ASSERT_IN_TIME(comesTrue([this] { return controller.telemetry().trainsDelivered > 0; }));
    ASSERT_IN_TIME(comesTrue([this] { return drive.chosen() == DriveSource::Sensor; }));
    ASSERT_IN_TIME(comesTrue([this] {
        const auto telemetry = controller.telemetry();
        drive.refresh(telemetry);
        return std::isfinite(telemetry.roughness) && std::isfinite(telemetry.pressure);
    }));
    controller.disarm();
    ASSERT_IN_TIME(saysOff());
    EXPECT_THAT(says(), StartsWith("Was the fingertip, R "));
    controller.close();
    ASSERT_IN_TIME(comesTrue([this] { return controller.activity() == gui::Activity::Closed; }));
    ASSERT_IN_TIME(openSimulated());
    ASSERT_IN_TIME(comesTrue([this] { return says().starts_with("Nothing drives the output."); }));
}

}  // namespace
}  // namespace tacto::test
