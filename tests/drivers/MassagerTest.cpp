// The simulated massager: how its motor moves, and how its faults behave.
#include <cmath>
#include <gtest/gtest.h>

#include "core/safety/SafetyGate.h"
#include "drivers/simulated/SimulatedMassager.h"
#include "tests/drivers/SimBench.h"

namespace tacto::test {
namespace {

struct Motor {
    explicit Motor(const char* uri) : gate(bench.clock) { bench.open(uri); }
    const sim::SimulatedMassager& device() { return dynamic_cast<sim::SimulatedMassager&>(*bench.devices.massager); }
    Result<void> vibrate(double intensity, Seconds duration) {
        auto burst = gate.approve(VibrationBurst{intensity, duration});
        return bench.devices.massager->vibrate(std::move(*burst));
    }
    double amplitude() { return device().vibrationAt(bench.clock.now()).amplitude_m_s2; }
    SimBench bench;
    SafetyGate gate;
};

TEST(SimulatedMassager, SpinsUpAndDownAsACriticallyDampedMotor) {
    Motor motor("sim:massager?spinup=30ms&acceleration=10&frequency=200Hz");
    ASSERT_TRUE(motor.vibrate(1, Seconds(0.5)).has_value());
    double before = 0;
    for (int i = 1; i <= 49; ++i) {
        motor.bench.wait(Seconds(0.01));
        const double x = 1 - (1 + i * 0.01 / 0.03) * std::exp(-i * 0.01 / 0.03);
        EXPECT_NEAR(motor.amplitude(), 10 * x * x, 1e-6);
        EXPECT_GE(motor.amplitude(), before);
        before = motor.amplitude();
    }
    EXPECT_NEAR(motor.device().vibrationAt(motor.bench.clock.now()).frequency_hz, 200, 1);
    motor.bench.wait(Seconds(0.5));
    EXPECT_LT(motor.amplitude(), 1e-3);
}

TEST(MassagerFaults, StuckOnVibratesUntilSwitchedOff) {
    RecordProperty("hazard", "H2");
    Motor motor("sim:massager?fault=stuck-on");
    ASSERT_TRUE(motor.vibrate(1, Seconds(0.1)).has_value());
    motor.bench.wait(Seconds(3));
    EXPECT_GT(motor.amplitude(), 10);
    motor.bench.devices.massager->forceOff();
    motor.bench.wait(Seconds(0.5));
    EXPECT_LT(motor.amplitude(), 0.01);
}

TEST(MassagerFaults, LateAnswersAreTimeouts) {
    Motor motor("sim:massager?fault=late");
    EXPECT_EQ(motor.vibrate(1, Seconds(0.1)).error().code, ErrorCode::Timeout);
}

}  // namespace
}  // namespace tacto::test
