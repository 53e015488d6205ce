// Delivery into a changing load: the profile's held quantity stays constant, limits are kept, a jump ends delivery.
#include "core/bench/sensing/CaptureLoad.h"
#include "core/measure/PulseMeasurement.h"
#include "tests/bench/BenchFixture.h"
#include "tests/bench/LoopRig.h"
#include "tests/support/Refused.h"

namespace tacto {
namespace {

using test::accepted;
using test::refused;
using test::refusedSaying;

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
        ASSERT_TRUE(armAndDrive(0.5, 1));  // 25 V, every 0.5 s
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
    ASSERT_TRUE(bench_->drive(DriveSource::Manual, 1, 1));  // 40 V, the most that the paper allows
    EXPECT_THAT(bench_->wait(Seconds(9)), refused(ErrorCode::LimitExceeded, "at most 40 V"));
}

TEST_F(HoldTest, ALoadThatLeavesItsRangeEndsDelivery) {
    RecordProperty("hazard", "H3");
    hold(Hold::Charge, "voltage");
    const auto waited = bench_->wait(Seconds(20));
    ASSERT_FALSE(waited);
    EXPECT_EQ(state(), InterlockState::Faulted);
    EXPECT_NE(waited.error().message.find("20 % more or less"), std::string::npos) << waited.error().message;
}

/// A stimulator that cannot read its load back, on a bench with an oscilloscope that measures the load.
class SeenLoadTest : public HoldTest {
protected:
    void deliver(Hold what, const std::string& load) {
        profile_.encoding.hold = what;
        open({"sim:stimulator?readback=no&" + load});
        accepted(arm());
        ASSERT_TRUE(bench_->drive(DriveSource::Manual, 0.5, 1));
    }
    /// Captures once a second; returns the error that ended delivery, or nothing after `times` captures.
    [[nodiscard]] std::optional<Error> watch(int times) {
        for (int k = 0; k < times; ++k) {
            const auto captures = bench_->capture(1, ScopeSettings{});
            if (!captures) return captures.error();
            const auto waited = bench_->wait(Seconds(0.5));
            if (!waited) return waited.error();
        }
        return std::nullopt;
    }
};

TEST_F(SeenLoadTest, ChargeStaysByWhatTheCapturesShow) {
    deliver(Hold::Charge, "load=1kohm, drift 1.5 %/s");
    const auto before = next();
    const auto ended = watch(9);
    ASSERT_FALSE(ended) << ended->message;
    const auto after = next();
    EXPECT_NEAR(after.charge_uC / before.charge_uC, 1, 0.025) << "a second behind";
    EXPECT_GT(after.voltage_V / before.voltage_V, 1.1);
    EXPECT_NEAR(bench_->telemetry().impedance_ohm, 1140, 40);
}

TEST_F(SeenLoadTest, UntilACaptureThereIsTheLoadThatArmingSaw) {
    deliver(Hold::Charge, "load=1kohm, drift 1.5 %/s");
    EXPECT_NEAR(bench_->telemetry().impedance_ohm, 1000, 30);
    ASSERT_TRUE(bench_->wait(Seconds(5)));
    EXPECT_NEAR(bench_->telemetry().impedance_ohm, 1000, 30) << "it was not measured since";
    EXPECT_NEAR(bench_->telemetry().trainAmplitude, 25, 0.01);
    EXPECT_GT(bench_->telemetry().trainsDelivered, 8U);
}

TEST_F(SeenLoadTest, IsLookedAtBySmallPulseBeforeAnythingIsArmed) {
    RecordProperty("hazard", "H4");
    struct Case {
        const char* uri;
        const char* why;
        InterlockState after;
    };
    constexpr auto kDisarmed = InterlockState::Disarmed, kFaulted = InterlockState::Faulted;
    for (const auto& [uri, why, after] :
         {Case{"sim:stimulator?readback=no&load=300ohm", "the declared load is 1 kohm", kDisarmed},
          Case{"sim:stimulator?readback=no&load=open", "electrode is open", kDisarmed},
          Case{"sim:stimulator?readback=no&flaws=none&gain=1.3", "1.3 V; 1 V was commanded", kFaulted},
          Case{"sim:stimulator?readback=no&flaws=none&gain=0.7", " V; 1 V was commanded", kFaulted}}) {
        open({uri});
        EXPECT_THAT(arm(), refusedSaying(why)) << uri;
        EXPECT_EQ(state(), after) << uri;
        ASSERT_TRUE(bench_->drive(DriveSource::Manual, 1, 1));
        bench_->idle(Seconds(3));
        EXPECT_EQ(bench_->telemetry().trainsDelivered, 0U) << uri;
    }
    open({"sim:stimulator?readback=no", "sim:oscilloscope?fault=unplug@0s"});
    EXPECT_THAT(arm(), refused(ErrorCode::NotArmed)) << "nothing is armed on an oscilloscope that sees nothing";
    open({"sim:stimulator?readback=no"}, {Role::Stimulator});
    ASSERT_TRUE(arm()) << "without an oscilloscope the operator's word for the load stands";
    EXPECT_TRUE(std::isnan(bench_->telemetry().impedance_ohm)) << "and declared is not measured";
}

TEST_F(SeenLoadTest, ConfirmsOnlyWhatWasCommandedIntoALoad) {
    RecordProperty("hazard", "H4");
    deliver(Hold::Voltage, "load=1kohm");
    const auto captures = bench_->capture(1, ScopeSettings{});
    ASSERT_TRUE(captures);
    const Capture& shown = captures->front();
    PulseTrain commanded;
    commanded.amplitude = Volts(shown.programmed);
    const auto load = accepted(loadConfirmedBy(shown, commanded));
    EXPECT_NEAR(load.value(), 1000, 30);
    for (const double factor : {0.79, 1.27}) {
        commanded.amplitude = Volts(factor * shown.programmed);
        EXPECT_FALSE(loadConfirmedBy(shown, commanded)) << factor;
    }
    commanded.amplitude = Milliamps(shown.programmed);
    EXPECT_TRUE(loadConfirmedBy(shown, commanded)) << "as many mA as volts into 1 kohm";
    commanded.amplitude = Volts(shown.programmed);
    Capture silent = shown;
    for (auto& sample : silent.channels[1].samples) sample = 0;
    EXPECT_FALSE(loadConfirmedBy(silent, commanded)) << "voltage and no current";
    silent = shown;
    silent.channels.pop_back();
    EXPECT_FALSE(loadConfirmedBy(silent, commanded)) << "nothing that measures a current";
    silent = shown;
    for (auto& sample : silent.channels[0].samples) sample = 0;
    EXPECT_FALSE(loadConfirmedBy(silent, commanded)) << "no pulse";
}

TEST_F(SeenLoadTest, ALoadThatLeavesItsRangeEndsDelivery) {
    RecordProperty("hazard", "H3");
    for (const auto what : {Hold::Voltage, Hold::Charge}) {
        deliver(what, "load=1kohm, drift 3 %/s");
        const auto ended = watch(20);
        ASSERT_TRUE(ended) << nameOf(what);
        EXPECT_EQ(state(), InterlockState::Faulted);
        EXPECT_NE(ended->message.find("20 % more or less"), std::string::npos) << ended->message;
    }
}

/// Uses a stimulator that reports nothing about its electrode; the simulated one would detect an open lead itself.
TEST(SeenLoad, WithoutAnyCurrentEndsDelivery) {
    RecordProperty("hazard", "H3");
    test::LoopRig rig(false);
    const auto step = [&] {
        rig.clock.advanceTo(rig.clock.now() + ControlLoop::kPeriod);
        rig.loop.step(rig.clock.now());
    };
    step();
    ASSERT_EQ(rig.interlock.state(), InterlockState::Armed);
    rig.loop.noteLoad({Ohms(1100), true, rig.clock.now()});
    step();
    EXPECT_EQ(rig.interlock.state(), InterlockState::Armed) << "so little current is not news of a load of 1 kohm";
    rig.loop.noteLoad({Ohms(5000), true, Instant(-1)});
    step();
    EXPECT_EQ(rig.interlock.state(), InterlockState::Armed) << "from before it was armed";
    rig.loop.noteLoad({Ohms(5000), true, rig.clock.now()});
    step();
    EXPECT_EQ(rig.interlock.state(), InterlockState::Faulted);
    EXPECT_NE(rig.interlock.reason().view().find("shows voltage and no current"), std::string_view::npos)
        << rig.interlock.reason().view();
    EXPECT_GT(rig.device.offs, 0);
}

TEST(SeenLoad, IsNothingWhereTheCaptureCannotTell) {
    Capture capture;
    capture.rate_hz = 1e6;
    capture.trigger_s = 2;
    CaptureChannel volts{.name = "voltage", .unit = "V", .samples = {}, .low = -50, .high = 50, .lsb = 0.4};
    for (int i = 0; i < 1000; ++i) volts.samples.push_back(i >= 200 && i < 400 ? 20.0F : 0.0F);
    CaptureChannel amps = volts;
    amps.name = "current";
    amps.unit = "A";
    amps.low = -0.05;
    amps.high = 0.05;
    amps.lsb = 4e-4;
    for (auto& sample : amps.samples) sample /= 1000;
    capture.channels = {volts, amps};
    const auto seen = loadSeenIn(capture);
    ASSERT_TRUE(seen);
    EXPECT_NEAR(seen->impedance.value(), 1000, 1);
    EXPECT_FALSE(seen->atLeast);
    EXPECT_EQ(seen->at, toInstant(Seconds(2)));

    auto without = capture;
    without.channels.pop_back();
    EXPECT_FALSE(loadSeenIn(without)) << "no current channel";
    auto untriggered = capture;
    untriggered.untriggered = true;
    EXPECT_FALSE(loadSeenIn(untriggered));
    auto reversed = capture;
    for (auto& sample : reversed.channels[1].samples) sample = -sample;
    EXPECT_FALSE(loadSeenIn(reversed)) << "a probe the wrong way round";

    auto open = capture;
    std::fill(open.channels[1].samples.begin(), open.channels[1].samples.end(), 4e-4F);
    const auto least = loadSeenIn(open);
    ASSERT_TRUE(least);
    EXPECT_TRUE(least->atLeast);
    EXPECT_NEAR(least->impedance.value(), 20 / 4e-3, 1);
    open.channels[1].lsb = 0;
    EXPECT_FALSE(loadSeenIn(open)) << "no telling what the channel could have shown";
}

}  // namespace
}  // namespace tacto
