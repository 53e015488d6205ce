// Tests the way back after a fault in Live: a reset acknowledges it, and a second deliberate press arms again.
#include <random>

#include "app/gui/window/ArmDialog.h"
#include "app/gui/window/FaultBanner.h"
#include "tests/gui/window/WindowFixture.h"

namespace tacto::test {
namespace {

class FaultRecovery : public Window {
protected:
    void openWith(const std::string& fault) {
        gui::LiveOrder order;
        for (const auto& uri : {"sim:stimulator?fault=" + fault, std::string("sim:")})
            order.uris.push_back(*DeviceUri::parse(uri));
        order.profile = window.controller().profile();
        window.controller().openLive(order);
        ASSERT_IN_TIME(comesTrue([this] { return window.controller().activity() == gui::Activity::Live; }));
    }
    QPushButton& action() { return *window.findChild<QPushButton*>("armButton"); }
    void faultsWhileDrivenBy(DriveSource source) {
        arm();
        window.controller().drive(source, 0.5, 1);
        ASSERT_IN_TIME(comesTrue([this] { return state() == InterlockState::Faulted; }));
        ASSERT_IN_TIME(comesTrue([this] { return action().text().contains("Reset"); }));
        letLive(kDebounced_ms);
    }
    [[nodiscard]] QPushButton* shown(const char* name) { return find<QPushButton>(window, name); }
    static constexpr int kDebounced_ms = 600;  // longer than ConfirmButton's
};

TEST_F(FaultRecovery, TakesTwoPressesAndDrivesAsBefore) {
    RecordProperty("hazard", "H12");
    std::mt19937 random(4949);
    for (const auto source : {DriveSource::Manual, DriveSource::Sensor}) {
        const bool lifts = std::bernoulli_distribution()(random);
        SCOPED_TRACE(lifts ? "open" : "short");
        ASSERT_NO_FATAL_FAILURE(
            openWith(std::string(lifts ? "open" : "short") + "@4s..8s"));  // longer than the longest interval
        window.controller().setHand({DriveSource::Manual, 1, 1});          // older and larger than what drives
        ASSERT_NO_FATAL_FAILURE(faultsWhileDrivenBy(source));
        ASSERT_IN_TIME(comesTrue([this] { return toSeconds(window.controller().telemetry().at) > 8.2; }));
        EXPECT_EQ(shown("armAndDrive"), nullptr) << "nothing asks before the fault was acknowledged";
        const auto before = window.controller().telemetry().trainsDelivered;
        click(action());
        ASSERT_IN_TIME(comesTrue([this] { return shown("armAndDrive") != nullptr; }));
        EXPECT_EQ(state(), InterlockState::Disarmed) << "a reset alone arms nothing";
        EXPECT_FALSE(shown("armAndDrive")->isDefault());
        EXPECT_TRUE(faultsOf(*shown("armAndDrive")->window()).empty()) << faultsOf(*shown("armAndDrive")->window());
        if (source == DriveSource::Manual) {
            const auto says = shown("armAndDrive")->window()->findChild<QLabel*>("firstOutput")->text();
            EXPECT_TRUE(says.contains("R 0.50, P 1.00")) << says.toStdString();
        }
        click(*shown("armAndDrive"));
        EXPECT_IN_TIME(comesTrue([&] { return window.controller().telemetry().trainsDelivered > before; }))
            << banner().toStdString();
        EXPECT_EQ(window.controller().telemetry().driving, source);
        if (source == DriveSource::Manual) {
            EXPECT_EQ(window.controller().lastDrive().roughness, 0.5) << "as before the fault";
        }
        window.controller().close();
        ASSERT_IN_TIME(comesTrue([this] { return window.controller().activity() == gui::Activity::Closed; }));
    }
}

TEST_F(FaultRecovery, NothingDrivesAfterArmingWasRefusedOrStopped) {
    RecordProperty("hazard", "H2");
    ASSERT_NO_FATAL_FAILURE(openWith("open@500s"));
    auto& controller = window.controller();
    const auto driving = [&] { return controller.telemetry().driving; };
    for (const bool stopped : {true, false}) {
        const auto asked = controller.mark();
        if (stopped) controller.stop("a test");
        controller.drive(DriveSource::Manual, 0.5, 1);
        ASSERT_IN_TIME(comesTrue([&] { return driving() == DriveSource::Manual; }));
        ArmRequest request;
        request.operatorConfirmed = true;
        if (!stopped) request.load = "no load";  // refused before its check
        controller.arm(request, asked);
        EXPECT_IN_TIME(comesTrue([&] { return driving() == DriveSource::Off; })) << stopped;
        EXPECT_EQ(state(), InterlockState::Disarmed);
    }
}

TEST_F(FaultRecovery, NothingThatWasOffIsOfferedToDrive) {
    RecordProperty("hazard", "H12");
    ASSERT_NO_FATAL_FAILURE(openWith("unplug@4s..5s"));
    ASSERT_NO_FATAL_FAILURE(faultsWhileDrivenBy(DriveSource::Off));
    ASSERT_IN_TIME(comesTrue([this] { return toSeconds(window.controller().telemetry().at) > 5.2; }));
    click(action());
    ASSERT_IN_TIME(comesTrue([this] { return shown("armOutput") != nullptr; }));
    EXPECT_EQ(shown("armAndDrive"), nullptr);
    window.controller().stop("a test");
    EXPECT_IN_TIME(comesTrue([this] { return shown("armOutput") == nullptr; })) << "a stop ends the question";
}

TEST_F(FaultRecovery, ABrokenLimitIsNotResetByHand) {
    RecordProperty("hazard", "H1");
    window.controller().setSpeed(4);
    ASSERT_NO_FATAL_FAILURE(openWith("drift"));
    arm();
    window.controller().drive(DriveSource::Manual, 1, 1);
    ASSERT_IN_TIME(comesTrue([this] { return state() == InterlockState::Faulted; }));
    ASSERT_IN_TIME(comesTrue([this] { return action().text().contains("Reset"); }));
    ASSERT_FALSE(window.findChild<gui::FaultBanner*>()->mayArmNext()) << banner().toStdString();
    letLive(kDebounced_ms);
    EXPECT_FALSE(action().isEnabled());
    EXPECT_TRUE(action().toolTip().contains("Run the safety check first")) << action().toolTip().toStdString();
    click(action());
    letLive(300);
    EXPECT_EQ(state(), InterlockState::Faulted);
    EXPECT_EQ(shown("armOutput"), nullptr) << "the safety check comes first";
}

}  // namespace
}  // namespace tacto::test
