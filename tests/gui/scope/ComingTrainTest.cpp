// Tests the first train of an armed output, drawn over the last train before it comes.
#include <gmock/gmock.h>

#include "app/gui/theme/Theme.h"
#include "tests/gui/Looks.h"
#include "tests/gui/scope/Captures.h"
#include "tests/gui/scope/ScopeBench.h"

namespace tacto::test {
namespace {

using testing::HasSubstr;

class Coming : public Scope {
protected:
    /// Leaves the last train of an output that is off on the screen.
    void holdATrain() {
        openBench();
        deliver();
        ASSERT_IN_TIME(comes([this] { return triggered() && scope.table().statistics().captures() >= 2; }));
        controller.stop("test");
        ASSERT_IN_TIME(comes([this] { return scope.model().held(); }));
    }
    /// The bench's telemetry between arming and the first train.
    Telemetry telling(InterlockState state, DriveSource driving) const {
        auto telemetry = controller.telemetry();
        telemetry.state = state;
        telemetry.driving = driving;
        telemetry.impedance_ohm = 1000;
        return telemetry;
    }
    const std::vector<gui::OverlayState::Coming>& drawn() { return scope.screen().overlay().coming; }
    void see(InterlockState state, DriveSource driving) { scope.refresh(telling(state, driving)); }
};

TEST_F(Coming, TheFirstTrainOfAnArmedOutputIsDrawnDashedOverTheLastOne) {
    RecordProperty("hazard", "H12");
    holdATrain();
    controller.drive(DriveSource::Manual, 0.69, 0.8);
    see(InterlockState::Armed, DriveSource::Manual);
    ASSERT_EQ(drawn().size(), 2U);
    EXPECT_EQ(drawn()[0].text, "next train 30.7\u202fV");
    EXPECT_EQ(drawn()[1].text, "30.7\u202fmA at 1.00\u202fkΩ");
    const auto& volts = *scope.model().lane("channel/voltage");
    double top = -gui::kHalfUp, end_s = 0;
    for (const auto& point : drawn()[0].line) {
        top = std::max(top, point.y());
        end_s = std::max(end_s, point.x());
    }
    EXPECT_NEAR(scope.model().scaleOf(volts).levelAt(top), 30.7, 0.01);
    EXPECT_GT(end_s, 500e-6) << "both phases and the gap between them";
    EXPECT_TRUE(scope.model().held()) << "what is below it is the past";
    for (const auto theme : {gui::Theme::Dark, gui::Theme::Light}) {
        gui::applyTheme(theme);
        see(InterlockState::Armed, DriveSource::Manual);
        draw();
        shot(scope, theme == gui::Theme::Dark ? "coming-dark" : "coming");
    }
    // Looks for ink where only the coming train has its plateau.
    const auto picture = scope.screen().grab().toImage();
    const auto first = scope.model().scaleOf(volts).heightOf(30.7);
    int coloured = 0;
    for (int x = atTime(scope.screen(), 0, 0).x(); x < atTime(scope.screen(), 200e-6, 0).x(); ++x) {
        const auto pixel = picture.pixelColor(x, atTime(scope.screen(), 0, first).y());
        coloured += pixel.blue() > pixel.red() + 40;
    }
    const int across = atTime(scope.screen(), 200e-6, 0).x() - atTime(scope.screen(), 0, 0).x();
    EXPECT_GT(coloured, across / 3) << "7 of 12 pixels of a dash";
    EXPECT_LT(coloured, across * 9 / 10);
}

TEST_F(Coming, NothingIsDrawnUnlessItIsKnownWhatComes) {
    RecordProperty("hazard", "H12");
    holdATrain();
    controller.drive(DriveSource::Manual, 0.69, 0.8);
    for (const auto state : {InterlockState::Disconnected, InterlockState::Disarmed, InterlockState::Checking,
                             InterlockState::Delivering, InterlockState::Paused, InterlockState::Faulted}) {
        see(InterlockState::Armed, DriveSource::Manual);
        ASSERT_EQ(drawn().size(), 2U);
        see(state, DriveSource::Manual);
        EXPECT_TRUE(drawn().empty()) << nameOf(state);
    }
    controller.setHand({DriveSource::Manual, 0.69, 0.8});
    see(InterlockState::Armed, DriveSource::Off);
    ASSERT_EQ(drawn().size(), 2U) << "what would follow";
    EXPECT_EQ(drawn()[0].text, "by hand: 30.7\u202fV") << "and not that it does";
    see(InterlockState::Disarmed, DriveSource::Off);
    EXPECT_TRUE(drawn().empty());
    see(InterlockState::Armed, DriveSource::Sensor);
    EXPECT_TRUE(drawn().empty()) << "what the fingertip will feel is not known";
    auto unmeasured = telling(InterlockState::Armed, DriveSource::Manual);
    unmeasured.impedance_ohm = NAN;
    scope.refresh(unmeasured);
    ASSERT_EQ(drawn().size(), 1U) << "no current without the load";
    EXPECT_THAT(drawn()[0].text.toStdString(), HasSubstr("next train"));
    scope.setMode(gui::ScopeMode::Roll);
    see(InterlockState::Armed, DriveSource::Manual);
    EXPECT_TRUE(drawn().empty()) << "on the session's time its moment is not known";
    scope.setMode(gui::ScopeMode::Auto);
    controller.drive(DriveSource::Off, 0, 0);
    see(InterlockState::Armed, DriveSource::Manual);
    EXPECT_TRUE(drawn().empty()) << "it was switched off; the bench has not said so yet";
    EXPECT_THAT(complaints, testing::IsEmpty());
}

TEST_F(Coming, TheNextTrainComesWithTheArmedOutputAndGoesWithTheFirstOne) {
    RecordProperty("hazard", "H12");
    holdATrain();
    controller.pause();
    ArmRequest request;
    request.load = "1 kohm";
    request.operatorConfirmed = true;
    controller.arm(request);
    ASSERT_IN_TIME(comes([this] { return controller.telemetry().state == InterlockState::Armed; }));
    ASSERT_IN_TIME(comes([this] { return drawn().size() == 2; }));
    EXPECT_THAT(drawn()[0].text.toStdString(), testing::StartsWith("by hand: ")) << "a stop switched the drive off";
    controller.drive(DriveSource::Manual, 0.9, 0.8);
    ASSERT_IN_TIME(comes([this] { return drawn().size() == 2 && drawn()[0].text.startsWith("next train "); }))
        << "paused: it waits";
    controller.resume();
    ASSERT_IN_TIME(comes([this] { return controller.telemetry().state == InterlockState::Delivering; }));
    EXPECT_TRUE(drawn().empty());
    ASSERT_IN_TIME(comes([this] { return !scope.model().held(); }));
}

}  // namespace
}  // namespace tacto::test
