// A single presentation of a pilot session, from the command to the output.
#include <gmock/gmock.h>
#include <limits>

#include "tests/bench/FakeStimulator.h"
#include "tests/bench/PersonFixture.h"
#include "tests/support/Refused.h"

namespace tacto {
namespace {

using namespace std::chrono_literals;
using test::accepted;
using test::refusedSaying;
using testing::HasSubstr;

constexpr double kNotANumber = std::numeric_limits<double>::quiet_NaN();

std::vector<double> secondsOf(const std::vector<Seconds>& times) {
    std::vector<double> out;
    for (const Seconds time : times) out.push_back(time.count());
    return out;
}

TEST(Presentation, TheThreeKindsHaveTheirOnsets) {
    const auto test = testPresentation(Milliamps(2), Seconds(0.5));
    EXPECT_EQ(test.onsets.size(), 9U) << "0, 0.5 ... 4 s";
    EXPECT_DOUBLE_EQ(test.duration.count(), 4.2);
    EXPECT_EQ(testPresentation(Milliamps(2), Seconds(2)).onsets.size(), 3U);
    EXPECT_EQ(testPresentation(Milliamps(2), Seconds(0.8)).onsets.size(), 6U) << "the last at 4.0 s in decimals";
    EXPECT_DOUBLE_EQ(testPresentation(Milliamps(2), Seconds(2)).duration.count(), 4.2)
        << "as long whatever the interval";
    EXPECT_THAT(secondsOf(ascendingPresentation(Milliamps(2), Seconds(0.5)).onsets), testing::ElementsAre(0, 0.5, 1));
    const auto first = detectionPresentation(Milliamps(2), false, Seconds(0.1), Seconds(0.5));
    const auto second = detectionPresentation(Milliamps(2), true, Seconds(0.1), Seconds(0.5));
    EXPECT_THAT(secondsOf(first.onsets), testing::ElementsAre(testing::DoubleEq(0.35)));
    EXPECT_THAT(secondsOf(second.onsets), testing::ElementsAre(testing::DoubleEq(1.75)));
    EXPECT_DOUBLE_EQ(first.duration.count(), 2.2);
    const auto both = comparisonPresentation(Milliamps(2), Milliamps(3), Seconds(0.1), Seconds(0.5));
    EXPECT_THAT(secondsOf(both.onsets), testing::ElementsAre(testing::DoubleEq(0.35), testing::DoubleEq(1.75)));
    EXPECT_EQ(both.level, StimulusLevel(Milliamps(3))) << "the higher, wherever it comes";
    EXPECT_EQ(both.levelOf(0), StimulusLevel(Milliamps(2)));
    EXPECT_EQ(both.levelOf(1), StimulusLevel(Milliamps(3)));
    EXPECT_EQ(comparisonPresentation(Milliamps(3), Milliamps(2), Seconds(0.1), Seconds(0.5)).level, both.level);
    EXPECT_EQ(both.duration, first.duration) << "as long as a detection trial";
    for (const auto& made : {test, first, second, both, ascendingPresentation(VibrationIntensity{1}, Seconds(0.5))}) {
        const auto valid = validate(made);
        EXPECT_TRUE(valid) << valid.error().message;
    }
}

TEST(Presentation, ItsIntervalsPassAtTheirTimes) {
    for (const auto& [since, interval] :
         {std::pair(-0.1, 0), {0.0, 1}, {0.79, 1}, {0.8, 0}, {1.39, 0}, {1.4, 2}, {2.2, 2}, {2.3, 2}})
        EXPECT_EQ(detectionIntervalAt(Seconds(since)), interval) << since << " s";
}

TEST(Presentation, WhatIsNoPresentationIsRefused) {
    RecordProperty("hazard", "H1");
    const auto sound = testPresentation(Milliamps(2), Seconds(0.5));
    const auto refusal = [&](auto spoil) {
        Presentation spoilt = sound;
        spoil(spoilt);
        const auto valid = validate(spoilt);
        return valid ? std::string() : valid.error().message;
    };
    EXPECT_THAT(refusal([](auto& p) { p.level = Milliamps(kNotANumber); }), HasSubstr("level nan mA"));
    EXPECT_THAT(refusal([](auto& p) { p.level = Milliamps(-1); }), HasSubstr("level -1 mA"));
    EXPECT_THAT(refusal([](auto& p) { p.level = VibrationIntensity{1.01}; }), HasSubstr("intensity 1.01"));
    EXPECT_THAT(refusal([](auto& p) { p.level = VibrationIntensity{kNotANumber}; }), HasSubstr("intensity nan"));
    EXPECT_THAT(refusal([](auto& p) { p.interval = Seconds(0); }), HasSubstr("an interval of 0 s"));
    EXPECT_THAT(refusal([](auto& p) { p.interval = Seconds(kNotANumber); }), HasSubstr("an interval of nan s"));
    EXPECT_THAT(refusal([](auto& p) { p.onsets.clear(); }), HasSubstr("0 onsets"));
    EXPECT_THAT(refusal([](auto& p) { p.onsets.assign(65, Seconds(0)); }), HasSubstr("65 onsets"));
    EXPECT_THAT(refusal([](auto& p) { p.onsets[0] = Seconds(-0.1); }), HasSubstr("a first onset at -0.1 s"));
    EXPECT_THAT(refusal([](auto& p) { p.onsets[1] = Seconds(0.4); }), HasSubstr("onsets 0.4 s apart"));
    EXPECT_THAT(refusal([](auto& p) { p.onsets[1] = Seconds(kNotANumber); }), HasSubstr("onsets nan s apart"));
    EXPECT_THAT(refusal([](auto& p) { p.duration = Seconds(4); }), HasSubstr("a presentation of 4 s"));
    EXPECT_THAT(refusal([](auto& p) { p.duration = Seconds(61); }), HasSubstr("a presentation of 61 s"));
    EXPECT_THAT(refusal([](auto& p) { p.duration = Seconds(kNotANumber); }), HasSubstr("a presentation of nan s"));
    const auto levels = [&](std::vector<StimulusLevel> each) {
        return refusal([&](auto& p) {
            p.onsets.resize(2);
            p.levels = each;
        });
    };
    EXPECT_EQ(levels({Milliamps(1), Milliamps(2)}), "");
    EXPECT_THAT(levels({Milliamps(2)}), HasSubstr("1 levels for 2 onsets"));
    EXPECT_THAT(levels({Milliamps(1), Milliamps(3)}), HasSubstr("the highest level of the trains is 3"));
    EXPECT_THAT(levels({Milliamps(1), Milliamps(1)}), HasSubstr("that of the presentation, 2 mA, is expected"));
    EXPECT_THAT(levels({Milliamps(0), Milliamps(2)}), HasSubstr("a train of 0 mA"));
    EXPECT_THAT(levels({VibrationIntensity{1}, Milliamps(2)}), HasSubstr("a train of intensity 1"));
    EXPECT_THAT(levels({Milliamps(kNotANumber), Milliamps(2)}), HasSubstr("level nan mA"));
    EXPECT_THAT(levels({Milliamps(-1), Milliamps(2)}), HasSubstr("level -1 mA"));
    EXPECT_EQ(refusal([](auto&) {}), "");
    EXPECT_FALSE(validate(testPresentation(Milliamps(2), Seconds(0.01)))) << "more trains than a presentation has";
}

class PresentationTest : public test::PersonFixture {};

TEST_F(PresentationTest, EveryTrainIsApprovedDeliveredAndReadBack) {
    RecordProperty("hazard", "H1");
    openArmed();
    rampTo(4.5);
    auto wanted = testPresentation(Milliamps(4.5), Seconds(0.5));
    wanted.notBefore = clock_->now() + 1500ms;
    const auto presented = accepted(bench_->present(wanted));
    EXPECT_EQ(presented.end, PresentationEnd::Complete) << presented.reason;
    EXPECT_FALSE(presented.isVoid());
    EXPECT_EQ(presented.began, wanted.notBefore);
    ASSERT_EQ(presented.trains.size(), 9U);
    for (std::size_t k = 0; k < presented.trains.size(); ++k) {
        const auto& train = presented.trains[k];
        EXPECT_EQ(train.onset, wanted.notBefore + static_cast<int>(k) * Instant(500ms))
            << "on the virtual clock to the nanosecond";
        EXPECT_EQ(train.approved, StimulusLevel(Milliamps(4.5)));
        EXPECT_EQ(train.interval, Seconds(0.5));
        ASSERT_TRUE(train.readBack);
        EXPECT_NEAR(train.readBack->value(), 4.5, 0.05 * 4.5);
        ASSERT_TRUE(train.impedance);
        EXPECT_NEAR(train.impedance->value(), 3100, 100);
    }
    EXPECT_GE(presented.ended - presented.began, 4200ms);
    EXPECT_LE(presented.ended - presented.began, 4200ms + 2 * ControlLoop::kPeriod);
}

TEST_F(PresentationTest, EachOfTwoTrainsIsApprovedDeliveredAndJudgedAtItsOwnLevel) {
    RecordProperty("hazard", "H1");
    openArmed();
    rampTo(4.5);
    for (const auto& [first, second] : {std::pair(2.0, 4.5), {4.5, 2.0}, {4.0, 4.5}}) {
        const auto presented = accepted(
            bench_->present(comparisonPresentation(Milliamps(first), Milliamps(second), Seconds(0.001), Seconds(0.5))));
        ASSERT_EQ(presented.end, PresentationEnd::Complete) << presented.reason;
        ASSERT_EQ(presented.trains.size(), 2U);
        EXPECT_EQ(presented.trains[1].onset - presented.trains[0].onset, 1400ms);
        for (const auto& [train, mA] : {std::pair(presented.trains[0], first), {presented.trains[1], second}}) {
            EXPECT_EQ(train.approved, StimulusLevel(Milliamps(mA)));
            ASSERT_TRUE(train.readBack);
            EXPECT_NEAR(train.readBack->value(), mA, 0.05 * mA) << "a train of one level is not the other's";
        }
    }
}

TEST_F(PresentationTest, ATrainThatMayNotBeIsRefusedAlsoBesideOneThatMay) {
    RecordProperty("hazard", "H6");
    openArmed();
    rampTo(2);
    const auto compared = [&](double first, double second) {
        return bench_->present(
            comparisonPresentation(Milliamps(first), Milliamps(second), Seconds(0.001), Seconds(0.5)));
    };
    for (const bool strongFirst : {true, false}) {
        const auto refused = accepted(strongFirst ? compared(4, 1) : compared(1, 4));
        EXPECT_EQ(refused.end, PresentationEnd::Refused);
        EXPECT_THAT(refused.reason, HasSubstr("the ramp rule"));
        EXPECT_EQ(refused.trains.size(), strongFirst ? 0U : 1U);
        EXPECT_FALSE(bench_->accept(Milliamps(4))) << "what was refused was not felt";
    }
    const auto delivered = bench_->telemetry().trainsDelivered;
    EXPECT_THAT(compared(0.7, 1), refusedSaying("a level of 0.7 mA; multiples of the device's step"));
    EXPECT_EQ(bench_->telemetry().trainsDelivered, delivered);
}

TEST_F(PresentationTest, AnEmptyOneTakesTheSameTimeAndDeliversNothing) {
    RecordProperty("hazard", "H1");
    openArmed();
    for (const auto& [interval, gap] : {std::pair(0.5, 0s), std::pair(2.0, 20s)}) {
        const auto full = [&](double mA) {
            bench_->idle(Seconds(gap));  // lets the reading of |Z| grow old
            const Instant asked = clock_->now();
            const auto before = bench_->telemetry();
            const auto made = presentTest(mA, interval, 4);
            EXPECT_EQ(made.end, PresentationEnd::Complete) << made.reason;
            EXPECT_TRUE(made.impedance) << "known, if from before";
            return std::tuple(made.began - asked, made.ended - made.began, bench_->telemetry().state,
                              bench_->telemetry().trainsDelivered - before.trainsDelivered, made.trains.size());
        };
        const auto empty = full(0);
        const auto delivered = full(0.5);
        EXPECT_EQ(std::get<0>(empty), std::get<0>(delivered)) << "with a check pulse before both, or neither";
        EXPECT_EQ(std::get<1>(empty), std::get<1>(delivered));
        EXPECT_EQ(std::get<2>(empty), std::get<2>(delivered));
        EXPECT_EQ(std::get<3>(empty), 0U);
        EXPECT_EQ(std::get<4>(empty), 0U);
        EXPECT_EQ(std::get<4>(delivered), static_cast<std::size_t>(4 / interval) + 1);
    }
}

TEST_F(PresentationTest, AnOldReadingIsRenewedBeforeTheFirstTrain) {
    RecordProperty("hazard", "H3");
    openArmed("&fault=open@20s");
    bench_->idle(Seconds(25));
    auto wanted = testPresentation(Milliamps(0), Seconds(0.5));
    const auto presented = accepted(bench_->present(wanted));
    EXPECT_EQ(presented.end, PresentationEnd::Faulted) << "an empty one finds the open electrode too";
    EXPECT_TRUE(presented.trains.empty());
}

TEST_F(PresentationTest, WhatTheDeviceCannotSetIsRefusedAndNeverRounded) {
    RecordProperty("hazard", "H1");
    openArmed();
    const auto delivered = bench_->telemetry().trainsDelivered;
    const std::vector<std::pair<StimulusLevel, const char*>> wrong{
        {Milliamps(0.7), "a level of 0.7 mA; multiples of the device's step, 0.5"},
        {Milliamps(0.25), "multiples of the device's step"},
        {Milliamps(0.5 + 1e-5), "multiples of the device's step"},
        {Milliamps(200), "above 0 to 130 mA"},
        {Milliamps(kNotANumber), "level nan mA"},
        {VibrationIntensity{0.5}, "a current is accepted"}};
    for (const auto& [level, words] : wrong) {
        EXPECT_THAT(bench_->present(testPresentation(level, Seconds(0.5), Seconds(1))), refusedSaying(words))
            << textOf(level);
    }
    EXPECT_EQ(bench_->telemetry().trainsDelivered, delivered);
    auto far = testPresentation(Milliamps(0.5), Seconds(0.5));
    far.notBefore = clock_->now() + 61s;
    EXPECT_FALSE(bench_->present(far));
}

TEST_F(PresentationTest, NeedsAnArmedBenchThatDrivesNothing) {
    RecordProperty("hazard", "H2");
    openPerson();
    const auto wanted = testPresentation(Milliamps(0.5), Seconds(0.5), Seconds(1));
    EXPECT_EQ(bench_->present(wanted).error().code, ErrorCode::NotArmed);
    ASSERT_TRUE(armAndDrive(0, 0));
    EXPECT_THAT(bench_->present(wanted).error().message, HasSubstr("while the output is driven"));
    ASSERT_TRUE(bench_->drive(DriveSource::Off));
    EXPECT_TRUE(bench_->present(wanted));
    bench_->stop("test");
    EXPECT_EQ(bench_->present(wanted).error().code, ErrorCode::Stopped);
    open({"sim:stimulator"}, {Role::Stimulator});
    EXPECT_FALSE(arm()) << "a voltage source for a person";
    person_.reset();
    open({"sim:stimulator"}, {Role::Stimulator});
    ASSERT_TRUE(arm());
    EXPECT_EQ(bench_->present(wanted).error().code, ErrorCode::Unsupported);
}

TEST_F(PresentationTest, APulledOrShortedElectrodeEndsItBeforeTheNextTrain) {
    RecordProperty("hazard", "H3");
    for (const auto& [fault, cause] :
         {std::pair("open", FaultCause::OpenElectrode), std::pair("short", FaultCause::ShortElectrode),
          std::pair("unplug", FaultCause::DeviceFault)}) {
        openArmed(fmt::format("&fault={}@3s", fault));
        auto wanted = testPresentation(Milliamps(1), Seconds(0.5));
        wanted.notBefore = Instant(1700ms);
        const auto presented = accepted(bench_->present(wanted));
        EXPECT_EQ(presented.end, PresentationEnd::Faulted) << fault;
        EXPECT_TRUE(presented.isVoid());
        EXPECT_FALSE(presented.reason.empty());
        EXPECT_LE(presented.trains.size(), 4U) << fault << ": at 1.7, 2.2, 2.7 and, found at it, 3.2 s";
        EXPECT_GE(presented.trains.size(), 3U);
        EXPECT_LT(presented.ended, Instant(3700ms)) << "before the next train";
        EXPECT_EQ(state(), InterlockState::Faulted);
        EXPECT_TRUE(bench_->faultPersists(cause)) << fault;
        const auto delivered = bench_->telemetry().trainsDelivered;
        bench_->idle(Seconds(5));
        EXPECT_EQ(bench_->telemetry().trainsDelivered, delivered);
        EXPECT_FALSE(bench_->present(wanted));
        EXPECT_FALSE(bench_->accept(Milliamps(1))) << "a void presentation cannot be accepted";
    }
}

TEST_F(PresentationTest, AStopAtAnyMomentMakesItVoidAndNothingFollows) {
    RecordProperty("hazard", "H2");
    for (int turn = 0; turn < 60; ++turn) {
        openArmed();
        struct Stopping {
            Bench& bench;
            int turns;
        } stopping{*bench_, turn};
        bench_->onProgress(
            [](void* context) {
                auto& [bench, turns] = *static_cast<Stopping*>(context);
                if (turns-- == 0) bench.stop("the participant");
            },
            &stopping);
        auto wanted = testPresentation(Milliamps(1), Seconds(0.5));
        wanted.notBefore = clock_->now() + 100ms;
        const auto presented = bench_->present(wanted);
        bench_->onProgress(nullptr, nullptr);
        if (stopping.turns >= 0) break;  // the presentation ended before it could be stopped
        ASSERT_TRUE(presented) << presented.error().message;
        EXPECT_EQ(presented->end, PresentationEnd::Stopped) << turn;
        EXPECT_FALSE(presented->reason.empty());
        EXPECT_EQ(state(), InterlockState::Disarmed);
        const auto delivered = bench_->telemetry().trainsDelivered;
        ASSERT_TRUE(bench_->begin(bench_->stops().mark()));
        ASSERT_TRUE(arm());
        bench_->idle(Seconds(5));
        EXPECT_LE(bench_->telemetry().trainsDelivered, delivered + 1) << "the one that was under way";
        EXPECT_EQ(presentTest(0.5).end, PresentationEnd::Complete) << "and another may follow";
    }
}

TEST_F(PresentationTest, APauseMakesItVoid) {
    RecordProperty("hazard", "H2");
    openArmed();
    int turns = 3;
    struct Pausing {
        Bench& bench;
        int& turns;
    } pausing{*bench_, turns};
    bench_->onProgress(
        [](void* context) {
            auto& [bench, left] = *static_cast<Pausing*>(context);
            if (left-- != 0) return;
            bench.pause();
            bench.resume();
        },
        &pausing);
    const auto presented = presentTest(1, 0.5, 4);
    bench_->onProgress(nullptr, nullptr);
    EXPECT_EQ(presented.end, PresentationEnd::Paused);
    EXPECT_EQ(presentTest(1).end, PresentationEnd::Complete);
    bench_->pause();
    EXPECT_EQ(bench_->present(testPresentation(Milliamps(1), Seconds(0.5))).error().code, ErrorCode::NotArmed);
}

/// A current source that behaves as the test says, on a bench load.
class FakedPresentationTest : public testing::Test {
protected:
    void open() {
        bench_.reset();
        clock_ = std::make_shared<VirtualClock>();
        BenchConfig config;
        auto device = std::make_unique<test::FakeStimulator>(*clock_);
        device->traits_.drive = Drive::Current;
        device->traits_.amplitudeStep = 0.5;
        device_ = device.get();
        config.devices.stimulator = std::move(device);
        config.clock = clock_;
        config.limits = {test::generousLimits()};
        config.watched = [this] { return watched_.load(); };
        bench_ = Bench::create(std::move(config)).value();
        ASSERT_TRUE(bench_->arm(ArmRequest{"1 kohm", true, true}));
    }
    [[nodiscard]] Result<Presented> present(double interval_s = 0.5) {
        return bench_->present(testPresentation(Milliamps(1), Seconds(interval_s)));
    }

    std::shared_ptr<Clock> clock_;
    std::unique_ptr<Bench> bench_;
    test::FakeStimulator* device_ = nullptr;
    std::atomic<bool> watched_{true};
};

TEST_F(FakedPresentationTest, EndsWhenItsOwnerNoLongerLooksAfterIt) {
    RecordProperty("hazard", "H2");
    open();
    watched_ = false;
    const auto presented = accepted(present());
    EXPECT_EQ(presented.end, PresentationEnd::Stopped);
    EXPECT_THAT(presented.reason, HasSubstr("did not look after it for 2 s"));
    EXPECT_LE(presented.ended - presented.began, 2100ms);
    EXPECT_EQ(bench_->telemetry().state, InterlockState::Disarmed);
}

TEST_F(FakedPresentationTest, ATrainThatWouldComeLateIsNotSent) {
    RecordProperty("hazard", "H1");
    open();
    const int before = device_->delivered;
    device_->onDeliver = [this] { device_->stillOnUntil = clock_->now() + 570ms; };
    const auto presented = accepted(present());
    EXPECT_EQ(presented.end, PresentationEnd::Late) << presented.reason;
    EXPECT_THAT(presented.reason, AllOf(HasSubstr("train 2 is"), HasSubstr("ms late")));
    EXPECT_EQ(device_->delivered, before + 1);
    EXPECT_EQ(bench_->telemetry().state, InterlockState::Delivering);
}

TEST_F(FakedPresentationTest, AStopDuringAWriteSwitchesOffAfterTheWrite) {
    RecordProperty("hazard", "H2");
    open();
    device_->onDeliver = [this] { bench_->stop("test"); };
    const auto presented = present();
    device_->onDeliver = nullptr;
    ASSERT_TRUE(presented) << presented.error().message;
    EXPECT_EQ(presented->end, PresentationEnd::Stopped);
    EXPECT_FALSE(device_->on);
}

}  // namespace
}  // namespace tacto
