// A bench with a real unit continues from the unit's earlier deliveries and from the fault left by an earlier run.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/base/Clock.h"
#include "core/bench/Bench.h"
#include "core/bench/arming/CommandPreview.h"
#include "core/electrode/Load.h"
#include "core/safety/UnitRecord.h"
#include "tests/bench/FakeStimulator.h"
#include "tests/support/Limits.h"
#include "tests/support/Refused.h"
#include "tests/support/Support.h"

namespace tacto::test {
namespace {

using testing::HasSubstr;

/// A stimulator that is not marked as simulated.
class Unit final : public Stimulator {
public:
    explicit Unit(const Clock& clock) : fake(clock) {}
    [[nodiscard]] const DeviceIdentity& identity() const noexcept override { return unit_; }
    [[nodiscard]] const SourceTraits& traits() const noexcept override { return fake.traits(); }
    [[nodiscard]] Result<void> deliver(ApprovedTrain&& train) override { return fake.deliver(std::move(train)); }
    [[nodiscard]] Result<StimulatorStatus> status() override { return fake.status(); }
    [[nodiscard]] Result<void> keepAlive() override { return fake.keepAlive(); }
    void forceOff() noexcept override { fake.forceOff(); }

    FakeStimulator fake;

private:
    DeviceIdentity unit_{"fake:", Role::Stimulator, "A unit", "F7", "1", false};
};

/// An oscilloscope that hands out one record of 60 V when it was asked as often as the test says.
struct OneRecord final : Oscilloscope {
    [[nodiscard]] const DeviceIdentity& identity() const noexcept override { return who; }
    [[nodiscard]] const ScopeTraits& traits() const noexcept override { return what; }
    [[nodiscard]] Result<void> configure(const ScopeSettings&) override { return {}; }
    [[nodiscard]] Result<void> arm() override { return {}; }
    [[nodiscard]] Result<std::optional<Capture>> poll() override {
        if (left < 0 || left-- > 0) return std::nullopt;
        constexpr int kPart = 200;  // samples in each phase, and before and after
        constexpr std::array<float, 5> kLevels{0, 60, 0, -60, 0};
        Capture capture;
        capture.rate_hz = 1e6;
        capture.start_s = toSeconds(taken);
        capture.trigger_s = capture.start_s + kPart / capture.rate_hz;
        capture.stampTolerance_s = 0;
        CaptureChannel voltage{"voltage", "V", {}, -100, 100, 0.05};
        for (const float level : kLevels) voltage.samples.insert(voltage.samples.end(), kPart, level);
        auto current = voltage;
        current.name = "current";
        current.unit = "A";
        for (auto& sample : current.samples) sample /= 1000;
        capture.channels = {voltage, current};
        return capture;
    }
    void disarm() noexcept override {}

    DeviceIdentity who{"fake:", Role::Oscilloscope, "A scope", "S1", "1", true};
    ScopeTraits what{Hertz(1e6), 10000, 12, Hertz(1e6)};
    Instant taken{0};
    int left = -1;  ///< how often it is asked before; below 0: no record
};

/// The computer's time, which follows the bench's clock.
struct ComputerTime final : SystemTime {
    explicit ComputerTime(const Clock& clock) : clock_(clock) {}
    [[nodiscard]] Instant sinceBoot() const noexcept override { return std::chrono::hours(1) + clock_.now(); }
    [[nodiscard]] std::string boot() const override { return "boot"; }
    [[nodiscard]] std::chrono::sys_seconds wall() const noexcept override { return SystemTime::real().wall(); }
    const Clock& clock_;
};

class UnitBench : public testing::Test {
protected:
    void open(double ohm = 1000) {
        bench_.reset();
        auto unit = std::make_unique<Unit>(*clock_);
        unit->fake.impedance = Ohms(ohm);
        unit_ = &unit->fake;
        BenchConfig config;
        config.devices.stimulator = std::move(unit);
        auto scope = std::make_unique<OneRecord>();
        scope_ = scope.get();
        config.devices.oscilloscope = std::move(scope);
        config.clock = clock_;
        config.limits = limitSets();
        config.units = {folder_.path(), claims_.path()};
        config.systemTime = &time_;
        bench_ = accepted(Bench::create(std::move(config)));
    }
    [[nodiscard]] Result<void> arm(const char* load = "1 kohm") {
        const auto shown = armingText(bench_->devices().stimulator->identity(), &unit_->traits(), bench_->profile(),
                                      OutputMode::BenchLoad, parseLoad(load).value());
        return bench_->arm({.load = load, .operatorConfirmed = true, .confirmed = shown});
    }

    ScratchDir folder_;
    ScratchDir claims_;
    std::shared_ptr<VirtualClock> clock_ = std::make_shared<VirtualClock>();
    ComputerTime time_{*clock_};
    FakeStimulator* unit_ = nullptr;
    OneRecord* scope_ = nullptr;
    std::unique_ptr<Bench> bench_;
};

}  // namespace

TEST_F(UnitBench, OpensFaultedUntilTheFaultThatWasLeftIsReset) {
    RecordProperty("hazard", "H3");
    open();
    ASSERT_TRUE(arm());
    ASSERT_TRUE(bench_->drive(DriveSource::Manual, 1, 1));
    ASSERT_TRUE(bench_->wait(Seconds(1)));
    unit_->electrode = ElectrodeState::Open;
    ASSERT_FALSE(bench_->wait(Seconds(1)));

    open();  // as if the program was started again
    EXPECT_EQ(bench_->telemetry().state, InterlockState::Faulted);
    EXPECT_THAT(arm(), refusedSaying("left by an earlier run: the electrode is open"));
    unit_->statusFails = true;
    EXPECT_FALSE(bench_->resetFault()) << "the unit is looked at again";
    unit_->statusFails = false;
    accepted(bench_->resetFault());
    EXPECT_TRUE(arm());

    open();
    EXPECT_EQ(bench_->telemetry().state, InterlockState::Disarmed) << "a fault that was reset is over";
}

TEST_F(UnitBench, NoBrokenLimitIsLostInOrBesideALesserFault) {
    RecordProperty("hazard", "H1");
    int refused = 0, again = 0;
    for (int steps = 0; steps < 12; ++steps) {
        open();
        ASSERT_TRUE(arm());
        ASSERT_TRUE(bench_->drive(DriveSource::Manual, 1, 1));
        ASSERT_TRUE(bench_->wait(Seconds(1)));
        unit_->electrode = ElectrodeState::Open;
        ASSERT_FALSE(bench_->wait(Seconds(1)));
        unit_->electrode = ElectrodeState::Ok;
        ASSERT_TRUE(bench_->requestCaptures(1, {}));
        bench_->idle(Seconds(0.05));
        const auto known = bench_->telemetry();
        ASSERT_EQ(known.fault, FaultCause::OpenElectrode);
        scope_->taken = clock_->now();
        scope_->left = steps;
        for (int k = 0; k < steps / 4; ++k) bench_->idle(Seconds(0.005));  // it may come before the reset too
        const bool left = bench_->resetFault(known.causesCame).has_value();
        bench_->idle(Seconds(0.1));
        ++(left ? again : refused);
        const auto unit = bench_->unitFault();
        ASSERT_TRUE(unit) << steps;
        EXPECT_EQ(graveCause(unit->causes), FaultCause::LimitBroken) << steps;
        EXPECT_EQ(bench_->telemetry().fault, FaultCause::LimitBroken) << steps;
        EXPECT_THAT(bench_->resetFault(), refusedSaying("Run the safety check first")) << "also once it was seen";
        EXPECT_TRUE(bench_->resetFault({}, ResetBy::SafetyCheck));
        EXPECT_EQ(bench_->telemetry().state, InterlockState::Disarmed);
        open();  // the check was killed
        EXPECT_EQ(graveCause(bench_->unitFault()->causes), FaultCause::LimitBroken);
        EXPECT_THAT(arm(), refusedSaying("left by an earlier run"));
        bench_.reset();
        accepted(UnitRecord::open({folder_.path(), claims_.path()}, unitOf("F7", "fake:"), *clock_, time_))
            ->clearFault();
    }
    EXPECT_GT(refused, 0) << "while the fault was left";
    EXPECT_GT(again, 1) << "after the reset";
}

TEST_F(UnitBench, ArmingWaitsUntilAUnitWhosePastIsNotKnownHasRested) {
    RecordProperty("hazard", "H1");
    open();
    bench_.reset();
    std::filesystem::remove_all(folder_.path());  // as if another data folder was chosen
    open();
    const Instant opened = clock_->now();
    ASSERT_TRUE(bench_->wait(Seconds(0.01)));
    EXPECT_THAT(std::string(bench_->telemetry().reason.view()), HasSubstr("is not known"));
    accepted(arm());
    EXPECT_GE(clock_->now() - opened, UnitRecord::kRest);
    EXPECT_LT(clock_->now() - opened, UnitRecord::kRest + std::chrono::seconds(1));
    open();
    const Instant again = clock_->now();
    ASSERT_TRUE(arm());
    EXPECT_LT(clock_->now() - again, std::chrono::seconds(1)) << "known now";
}

TEST_F(UnitBench, ARunBeginsWithWhatTheRunsBeforeItDelivered) {
    RecordProperty("hazard", "H1");
    // 40 V every 0.5 s into 250 ohm, four runs of 2 s each: one alone gives 4.3 mA RMS over 5 s in the worst case.
    for (int k = 0; k < 4; ++k) {
        open(250);
        ASSERT_TRUE(arm("250 ohm"));
        ASSERT_TRUE(bench_->drive(DriveSource::Manual, 1, 1));
        ASSERT_TRUE(bench_->wait(Seconds(2)));
        const auto seen = bench_->telemetry();
        const auto rows = seen.exposure();
        const auto rms = std::find_if(rows.begin(), rows.end(), [](const ExposureRow& row) {
            return row.quantity == Quantity::RmsCurrent5s && row.set.view() == "paper";
        });
        ASSERT_NE(rms, rows.end());
        EXPECT_TRUE(rms->within) << rms->value;
        if (k == 0) {
            EXPECT_LT(rms->value, 4.5);
        } else if (k == 3) {
            EXPECT_GT(rms->value, 5.5) << "all that the unit had, not this run's part";
        }
    }
}

TEST_F(UnitBench, ASecondBenchOnTheSameUnitIsRefused) {
    RecordProperty("hazard", "H1");
    open();
    BenchConfig config;
    config.devices.stimulator = std::make_unique<Unit>(*clock_);
    config.clock = clock_;
    config.units = {folder_.path(), claims_.path()};
    config.systemTime = &time_;
    EXPECT_THAT(Bench::create(std::move(config)), refusedSaying("fake F7 is driven by"));
}

}  // namespace tacto::test
