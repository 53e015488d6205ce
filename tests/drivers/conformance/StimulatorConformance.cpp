#include "tests/drivers/conformance/StimulatorConformance.h"

#include <atomic>
#include <chrono>
#include <thread>

#include "core/devices/DeviceUri.h"
#include "tests/support/BenchGate.h"
#include "tests/support/InTime.h"
#include "tests/support/Refused.h"

namespace tacto::test {

Amplitude smallAmplitude(const SourceTraits& source) {
    if (source.drive == Drive::Current) return Milliamps(5);
    return Volts(5);
}

void StimulatorConformance::SetUp() {
    rig_ = GetParam().make();
    ASSERT_NE(rig_, nullptr);
    gate_ = benchGate(rig_->clock(), device().traits());
}

ApprovedTrain StimulatorConformance::approved(int pulses) {
    PulseTrain train;
    train.amplitude = smallAmplitude(device().traits());
    train.pulses = pulses;
    return approve(*gate_, rig_->clock(), train);
}

StimulatorStatus StimulatorConformance::status() { return accepted(device().status()); }

void StimulatorConformance::expectOutput(bool on) {
    if (const auto seen = rig_->outputOn()) {
        EXPECT_EQ(*seen, on);
    }
}

TEST_P(StimulatorConformance, SaysWhatItIs) {
    const auto& identity = device().identity();
    EXPECT_EQ(identity.role, Role::Stimulator);
    EXPECT_FALSE(identity.name.empty());
    EXPECT_FALSE(identity.serial.empty());
    EXPECT_TRUE(DeviceUri::parse(identity.uri).has_value()) << identity.uri;
}

TEST_P(StimulatorConformance, DeclaresTraitsThatAGateCanUse) {
    const auto& traits = device().traits();
    EXPECT_NE(traits.drive, Drive::HighImpedance);
    EXPECT_GT(traits.amplitudeMax, 0);
    EXPECT_TRUE(traits.amplitudeStep >= 0 && traits.amplitudeStep <= traits.amplitudeMax / 10) << traits.amplitudeStep;
    EXPECT_GT(traits.compliance.value(), 0);
    EXPECT_LT(traits.widthMin.count(), traits.widthMax.count());
    EXPECT_GE(traits.pulsesMax, 1);
}

TEST_P(StimulatorConformance, DeliversOneTrainPerApprovalAndCountsIt) {
    const auto before = status().trainsDelivered;
    for (std::uint64_t i = 1; i <= 3; ++i) {
        ASSERT_TRUE(device().deliver(approved()).has_value());
        rig_->wait(Seconds(0.06));
        EXPECT_EQ(status().trainsDelivered, before + i);
    }
}

TEST_P(StimulatorConformance, TrainEndsByItself) {
    RecordProperty("hazard", "H2");
    ASSERT_TRUE(device().deliver(approved(5)).has_value());
    rig_->wait(Seconds(0.02));
    EXPECT_TRUE(status().delivering);
    rig_->wait(Seconds(0.05));
    EXPECT_FALSE(status().delivering);
    expectOutput(false);
}

TEST_P(StimulatorConformance, RefusesAnExpiredApproval) {
    RecordProperty("hazard", "H1");
    auto old = approved();
    rig_->wait(Seconds(0.15));
    const auto before = status().trainsDelivered;
    EXPECT_THAT(device().deliver(std::move(old)), refused(ErrorCode::Timeout));
    rig_->wait(Seconds(0.06));
    EXPECT_EQ(status().trainsDelivered, before);
    expectOutput(false);
}

TEST_P(StimulatorConformance, RefusesATrainInTheOtherSourcesUnit) {
    RecordProperty("hazard", "H4");
    SourceTraits other = device().traits();
    other.drive = other.drive == Drive::Current ? Drive::Voltage : Drive::Current;
    const auto gate = benchGate(rig_->clock(), other);
    TrainRequest request;
    request.train.amplitude = smallAmplitude(other);
    request.onset = rig_->clock().now();
    auto approval = accepted(gate->approve(request));
    EXPECT_THAT(device().deliver(std::move(approval)), refused(ErrorCode::Device));
    expectOutput(false);
}

TEST_P(StimulatorConformance, ForceOffIsSafeWhenIdleAndAgain) {
    device().forceOff();
    device().forceOff();
    EXPECT_FALSE(status().delivering);
    expectOutput(false);
}

TEST_P(StimulatorConformance, ForceOffEndsTheTrainInProgress) {
    RecordProperty("hazard", "H2");
    ASSERT_TRUE(device().deliver(approved(50)).has_value());
    rig_->wait(Seconds(0.1));
    expectOutput(true);
    device().forceOff();
    rig_->wait(Seconds(0.01));
    EXPECT_FALSE(status().delivering);
    expectOutput(false);
    rig_->wait(Seconds(0.5));
    expectOutput(false);
}

TEST_P(StimulatorConformance, DeliversAgainAfterForceOff) {
    ASSERT_TRUE(device().deliver(approved(50)).has_value());
    rig_->wait(Seconds(0.1));
    device().forceOff();
    rig_->wait(Seconds(0.05));
    const auto before = status().trainsDelivered;
    ASSERT_TRUE(device().deliver(approved()).has_value());
    rig_->wait(Seconds(0.06));
    EXPECT_EQ(status().trainsDelivered, before + 1);
}

TEST_P(StimulatorConformance, ForceOffFromAnotherThreadWhileDelivering) {
    RecordProperty("hazard", "H2");
    std::atomic<bool> done{false};
    std::thread stopper([&] {
        while (!done.load()) device().forceOff();
    });
    for (int i = 0; i < 20; ++i) {
        // A stop may come in between: the train is then refused or cut. Both are fine; a crash or a hang is not.
        static_cast<void>(device().deliver(approved(3)));
        rig_->wait(Seconds(0.05));
    }
    done = true;
    stopper.join();
    device().forceOff();
    rig_->wait(Seconds(0.05));
    EXPECT_FALSE(status().delivering);
    expectOutput(false);
}

TEST_P(StimulatorConformance, StatusComesWithin50Milliseconds) {
    ASSERT_TRUE(device().deliver(approved(3)).has_value());
    for (int i = 0; i < 10; ++i) {
        const auto begin = std::chrono::steady_clock::now();
        const auto read = device().status();
        const auto took = std::chrono::steady_clock::now() - begin;
        ASSERT_TRUE(read.has_value());
        EXPECT_IN_TIME(took <= std::chrono::milliseconds(50));
        EXPECT_LE(read->at, rig_->clock().now());
        rig_->wait(Seconds(0.01));
    }
}

TEST_P(StimulatorConformance, ReadsTheLoadBackIfItSaysSo) {
    if (!device().traits().readsBack) GTEST_SKIP() << "this device has no read-back";
    ASSERT_TRUE(device().deliver(approved()).has_value());
    rig_->wait(Seconds(0.06));
    const auto read = status();
    EXPECT_EQ(read.electrode, ElectrodeState::Ok);
    ASSERT_TRUE(read.impedance.has_value());
    EXPECT_NEAR(read.impedance->value(), 1000, 50);
    if (read.imbalance) {
        EXPECT_TRUE(read.imbalanceUncertainty.has_value());
    }
}

TEST_P(StimulatorConformance, ClosingWhileDeliveringTurnsOff) {
    RecordProperty("hazard", "H2");
    ASSERT_TRUE(device().deliver(approved(50)).has_value());
    rig_->wait(Seconds(0.1));
    rig_->close();
    rig_->wait(Seconds(0.01));
    expectOutput(false);
}

TEST_P(StimulatorConformance, AcceptsKeepAliveAtAnyTime) {
    EXPECT_TRUE(device().keepAlive().has_value());
    ASSERT_TRUE(device().deliver(approved(3)).has_value());
    EXPECT_TRUE(device().keepAlive().has_value());
}

TEST_P(StimulatorConformance, UnpluggedIsAnErrorAndNotACrash) {
    RecordProperty("hazard", "H2");
    if (!rig_->unplug()) GTEST_SKIP() << "this rig cannot pull the plug";
    EXPECT_THAT(device().deliver(approved()), refused(ErrorCode::Device));
    EXPECT_THAT(device().status(), refused(ErrorCode::Device));
    EXPECT_FALSE(device().keepAlive().has_value());
    device().forceOff();
    expectOutput(false);
}

GTEST_ALLOW_UNINSTANTIATED_PARAMETERIZED_TEST(StimulatorConformance);

}  // namespace tacto::test
