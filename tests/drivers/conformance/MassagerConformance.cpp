#include "tests/drivers/conformance/MassagerConformance.h"

#include <stdexcept>

#include "tests/support/FailsInTime.h"
#include "tests/support/InTime.h"
#include "tests/support/Refused.h"

namespace tacto::test {

void MassagerConformance::SetUp() {
    rig_ = GetParam().make();
    ASSERT_NE(rig_, nullptr);
    gate_ = std::make_unique<SafetyGate>(rig_->clock());
}

ApprovedBurst MassagerConformance::approved(double intensity, Seconds duration) {
    return accepted(gate_->approve(VibrationBurst{intensity, duration}));
}

void MassagerConformance::expectVibration(bool on) {
    const auto felt = rig_->vibrating();
    if (!felt) return;
    if (on)
        EXPECT_IN_TIME(*felt);
    else
        EXPECT_FALSE(*felt);
}

TEST_P(MassagerConformance, ABurstEndsByItself) {
    EXPECT_EQ(device().identity().role, Role::Massager);
    EXPECT_GE(device().step(), 0);
    EXPECT_LE(device().step(), 1);
    ASSERT_IN_TIME(device().vibrate(approved(1, Seconds(0.3))));
    rig_->wait(Seconds(0.25));
    expectVibration(true);
    rig_->wait(Seconds(0.5));
    expectVibration(false);
}

TEST_P(MassagerConformance, ForceOffEndsABurstAndMayBeRepeated) {
    RecordProperty("hazard", "H2");
    device().forceOff();
    ASSERT_IN_TIME(device().vibrate(approved(1, Seconds(1))));
    rig_->wait(Seconds(0.2));
    expectVibration(true);
    device().forceOff();
    device().forceOff();
    rig_->wait(Seconds(0.5));
    expectVibration(false);
}

TEST_P(MassagerConformance, RefusesAnExpiredApproval) {
    RecordProperty("hazard", "H1");
    auto old = approved(1, Seconds(0.5));
    rig_->wait(Seconds(0.2));
    EXPECT_THAT(device().vibrate(std::move(old)), refused(ErrorCode::Timeout));
    rig_->wait(Seconds(0.2));
    expectVibration(false);
}

TEST_P(MassagerConformance, UnpluggedIsAnErrorAndNotACrash) {
    if (!rig_->unplug()) GTEST_SKIP() << "this rig cannot pull the plug";
    const auto refused = device().vibrate(approved(1, Seconds(0.1)));
    ASSERT_FALSE(refused.has_value());
    EXPECT_CODE_IN_TIME(refused.error().code, ErrorCode::Device);
    device().forceOff();
}

GTEST_ALLOW_UNINSTANTIATED_PARAMETERIZED_TEST(MassagerConformance);

}  // namespace tacto::test
