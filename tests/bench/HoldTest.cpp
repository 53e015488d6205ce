// Delivering into a load that changes: what the profile holds stays, the limits hold, and what jumps ends it.
#include "core/measure/PulseMeasurement.h"
#include "tests/bench/BenchFixture.h"

namespace tacto {
namespace {

struct Delivered {
    double charge_uC = 0;  // per phase
    double energy_uJ = 0;  // per phase
    double voltage_V = 0;
};

class HoldTest : public test::BenchFixture {
protected:
    void hold(Hold what, const std::string& mode) {
        profile_.encoding.hold = what;
        open({"sim:stimulator?load=1kohm, drift 1.5 %/s&mode=" + mode});
        ASSERT_TRUE(arm());
        ASSERT_TRUE(bench_->drive(DriveSource::Manual, 0.5, 1));  // 25 V, every 0.5 s
    }
    [[nodiscard]] Delivered next() {
        const auto captures = bench_->capture(1, ScopeSettings{});
        if (!captures) {
            ADD_FAILURE() << captures.error().message;
            return {};
        }
        const auto volts = measureTrains(*captures, "voltage");
        const auto amps = measureTrains(*captures, "current");
        return {amps->charge.mean * 1e6, volts->amplitude.mean * amps->charge.mean * 1e6, volts->amplitude.mean};
    }
};

TEST_F(HoldTest, ChargeStaysWhileTheVoltageFollowsTheImpedance) {
    for (const char* mode : {"voltage", "current"}) {
        hold(Hold::Charge, mode);
        const auto before = next();
        ASSERT_TRUE(bench_->wait(Seconds(9)));
        const auto after = next();
        EXPECT_NEAR(after.charge_uC / before.charge_uC, 1, 0.015) << mode;
        EXPECT_NEAR(after.voltage_V / before.voltage_V, 1.14, 0.02) << mode;
    }
}

TEST_F(HoldTest, EnergyStaysWhileTheVoltageFollowsTheRootOfTheImpedance) {
    for (const char* mode : {"voltage", "current"}) {
        hold(Hold::Energy, mode);
        const auto before = next();
        ASSERT_TRUE(bench_->wait(Seconds(9)));
        const auto after = next();
        EXPECT_NEAR(after.energy_uJ / before.energy_uJ, 1, 0.02) << mode;
        EXPECT_NEAR(after.voltage_V / before.voltage_V, std::sqrt(1.14), 0.02) << mode;
    }
}

TEST_F(HoldTest, AsEncodedTheVoltageStays) {
    hold(Hold::Voltage, "voltage");
    const auto before = next();
    ASSERT_TRUE(bench_->wait(Seconds(9)));
    const auto after = next();
    EXPECT_NEAR(after.voltage_V / before.voltage_V, 1, 0.01);
    EXPECT_NEAR(after.charge_uC / before.charge_uC, 1 / 1.14, 0.015);
}

TEST_F(HoldTest, NothingIsHeldBeyondALimit) {
    RecordProperty("hazard", "H1");
    hold(Hold::Charge, "voltage");
    ASSERT_TRUE(bench_->drive(DriveSource::Manual, 1, 1));  // 40 V, and the paper allows no more
    const auto waited = bench_->wait(Seconds(9));
    ASSERT_FALSE(waited);
    EXPECT_EQ(waited.error().code, ErrorCode::LimitExceeded);
    EXPECT_NE(waited.error().message.find("at most 40 V"), std::string::npos) << waited.error().message;
}

TEST_F(HoldTest, ALoadThatLeavesItsRangeEndsDelivery) {
    RecordProperty("hazard", "H3");
    hold(Hold::Charge, "voltage");
    const auto waited = bench_->wait(Seconds(20));
    ASSERT_FALSE(waited);
    EXPECT_EQ(state(), InterlockState::Faulted);
    EXPECT_NE(waited.error().message.find("20 % more or less"), std::string::npos) << waited.error().message;
}

}  // namespace
}  // namespace tacto
