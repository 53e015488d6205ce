// Presentations on the steady clock, with a thread for each device: same loop, same bounds; also on a massager.
#include <gmock/gmock.h>
#include <thread>

#include "core/bench/Bench.h"
#include "tests/bench/FakeMassager.h"
#include "tests/bench/FakeStimulator.h"
#include "tests/support/FailsInTime.h"
#include "tests/support/InTime.h"
#include "tests/support/Refused.h"

namespace tacto {
namespace {

using namespace std::chrono_literals;
using std::chrono::steady_clock;
using test::accepted;
using test::refusedSaying;

class PresentationTimeTest : public testing::Test {
protected:
    void open(bool realTime, bool massager = false) {
        bench_.reset();
        if (realTime)
            clock_ = std::make_shared<SteadyClock>();
        else
            clock_ = std::make_shared<VirtualClock>();
        BenchConfig config;
        if (massager) {
            auto device = std::make_unique<test::FakeMassager>(*clock_);
            massager_ = device.get();
            config.devices.massager = std::move(device);
        } else {
            auto device = std::make_unique<test::FakeStimulator>(*clock_);
            device->traits_.drive = Drive::Current;
            device->traits_.amplitudeStep = 0.5;
            device_ = device.get();
            config.devices.stimulator = std::move(device);
        }
        config.clock = clock_;
        config.limits = {test::generousLimits()};
        bench_ = Bench::create(std::move(config)).value();
        ASSERT_IN_TIME(bench_->arm(ArmRequest{"1 kohm", true, true}));
    }

    std::shared_ptr<Clock> clock_;
    std::unique_ptr<Bench> bench_;
    test::FakeStimulator* device_ = nullptr;
    test::FakeMassager* massager_ = nullptr;
};

TEST_F(PresentationTimeTest, NeverBeginsBeforeItsTime) {
    RecordProperty("hazard", "H1");
    open(true);
    auto wanted = ascendingPresentation(Milliamps(1), Seconds(0.5));
    wanted.notBefore = clock_->now() + 300ms;
    const auto presented = bench_->present(wanted);
    ASSERT_IN_TIME(presented);
    ASSERT_IN_TIME(presented->end == PresentationEnd::Complete) << presented->reason;
    ASSERT_EQ(presented->trains.size(), 3U);
    for (std::size_t k = 0; k < 3; ++k)
        EXPECT_GE(presented->trains[k].onset, wanted.notBefore + static_cast<int>(k) * Instant(500ms));
    EXPECT_GE(presented->ended - wanted.notBefore, 1200ms);
}

TEST_F(PresentationTimeTest, AStopAtAnyMomentIsAtTheOutputWithinTenMilliseconds) {
    RecordProperty("hazard", "H2");
    int soon = 0;
    constexpr int kRounds = 30;
    for (int round = 0; round < kRounds; ++round) {
        open(true);
        std::atomic<bool> stopped{false};
        std::atomic<int> afterStop{0};
        device_->onDeliver = [&] {
            if (stopped) ++afterStop;
        };
        steady_clock::duration took{};
        std::thread stopper([&, round] {
            std::this_thread::sleep_for(std::chrono::milliseconds(3 * round));
            const auto begun = steady_clock::now();
            bench_->stop("the participant");  // returns after forceOff
            took = steady_clock::now() - begun;
            stopped = true;
        });
        const auto presented = bench_->present(testPresentation(Milliamps(1), Seconds(0.5)));
        stopper.join();
        std::this_thread::sleep_for(15ms);  // three turns of the loop
        if (took < 10ms) ++soon;
        EXPECT_EQ(afterStop, 0) << "round " << round;
        EXPECT_FALSE(device_->on);
        if (!presented) {
            EXPECT_CODE_IN_TIME(presented.error().code, ErrorCode::Stopped) << presented.error().message;
            continue;
        }
        EXPECT_IN_TIME(presented->end == PresentationEnd::Stopped) << presented->reason;
        EXPECT_TRUE(presented->isVoid());
    }
    EXPECT_IN_TIME(soon >= kRounds - 1) << soon << " of " << kRounds << " within 10 ms";
}

TEST_F(PresentationTimeTest, APauseMakesItVoid) {
    RecordProperty("hazard", "H2");
    open(true);
    std::thread pauser([this] {
        std::this_thread::sleep_for(200ms);
        bench_->pause();
    });
    const auto presented = bench_->present(testPresentation(Milliamps(1), Seconds(0.5)));
    pauser.join();
    ASSERT_IN_TIME(presented);
    EXPECT_IN_TIME(presented->end == PresentationEnd::Paused) << presented->reason;
    EXPECT_TRUE(presented->isVoid());
    EXPECT_IN_TIME(bench_->telemetry().state == InterlockState::Paused);
}

TEST_F(PresentationTimeTest, AMassagerVibratesAtTheSameOnsets) {
    open(false, true);
    auto wanted = testPresentation(VibrationIntensity{0.4}, Seconds(0.5));
    wanted.notBefore = clock_->now() + 1s;
    const auto presented = accepted(bench_->present(wanted));
    EXPECT_EQ(presented.end, PresentationEnd::Complete) << presented.reason;
    ASSERT_EQ(presented.trains.size(), 9U);
    const auto sent = massager_->sent();
    ASSERT_EQ(sent.size(), 9U);
    for (std::size_t k = 0; k < sent.size(); ++k) {
        EXPECT_EQ(sent[k].at, wanted.notBefore + static_cast<int>(k) * Instant(500ms));
        EXPECT_DOUBLE_EQ(sent[k].burst.intensity, 0.4);
        EXPECT_EQ(presented.trains[k].approved, StimulusLevel(VibrationIntensity{0.4}));
        EXPECT_FALSE(presented.trains[k].readBack) << "nothing of a burst is read back";
        EXPECT_FALSE(presented.trains[k].impedance);
    }
    const auto empty = accepted(bench_->present(testPresentation(VibrationIntensity{0}, Seconds(0.5))));
    EXPECT_EQ(empty.end, PresentationEnd::Complete);
    EXPECT_EQ(massager_->sent().size(), 9U);
    EXPECT_EQ(empty.ended - empty.began, presented.ended - presented.began);
}

TEST_F(PresentationTimeTest, AMassagerTakesNoCurrentAndEndsWithItsFault) {
    RecordProperty("hazard", "H4");
    open(false, true);
    EXPECT_THAT(bench_->present(testPresentation(Milliamps(1), Seconds(0.5))),
                refusedSaying(testing::Eq("a presentation at 1 mA on fake massager; an intensity is accepted")));
    EXPECT_FALSE(bench_->present(testPresentation(VibrationIntensity{1.1}, Seconds(0.5))));
    EXPECT_EQ(bench_->accept(Milliamps(1)).error().code, ErrorCode::NotArmed);
    massager_->unplugged = true;
    const auto unplugged = accepted(bench_->present(testPresentation(VibrationIntensity{1}, Seconds(0.5))));
    EXPECT_EQ(unplugged.end, PresentationEnd::Faulted);
    EXPECT_TRUE(unplugged.trains.empty());
    EXPECT_TRUE(massager_->sent().empty());
}

TEST_F(PresentationTimeTest, AStopOfAMassagerIsAStop) {
    RecordProperty("hazard", "H2");
    open(false, true);
    massager_->onVibrate = [this] { bench_->stop("test"); };
    const auto presented = accepted(bench_->present(testPresentation(VibrationIntensity{1}, Seconds(0.5))));
    EXPECT_EQ(presented.end, PresentationEnd::Stopped);
    EXPECT_EQ(massager_->sent().size(), 1U);
    EXPECT_GT(massager_->offs, 0);
}

}  // namespace
}  // namespace tacto
