// The board's encoder is silent while a sensor is late, ahead, stuck or out of all proportion, and says which (H7).
#include <algorithm>
#include <cmath>
#include <gtest/gtest.h>
#include <limits>
#include <memory>

#include "app/run/EncoderComparison.h"
#include "core/base/Random.h"

namespace tacto::test {
namespace {

constexpr std::int64_t kMillisecond_ns = 1'000'000;
constexpr std::uint32_t kNone = 0;

/// A finger that rests for half a second and then slides, on a board that is asked every 10 ms.
class SlidingFinger : public testing::Test {
protected:
    SlidingFinger() {
        RecordProperty("hazard", "H7");
        const std::vector<StreamInfo> streams{
            {StreamKind::Acceleration, StreamUnit::MetrePerSecondSquared, 2, 1000, "acceleration"},
            {StreamKind::Force, StreamUnit::Newton, 1, 100, "force"},
            {StreamKind::Taxels, StreamUnit::Pascal, 4, 100, "taxels"}};
        const auto profile = encoderProfile(streams, {}, {}, idealOutput());
        EXPECT_TRUE(profile) << profile.error().message;
        EXPECT_EQ(te_init(state_.get(), &*profile), TE_ACCEPTED);
        profile_ = *profile;
        te_rested(state_.get());
    }

    /// Goes on for `ms`; returns the trains. `spoil` changes what the sensors give.
    template <class Spoil>
    int slide(int ms, Spoil spoil) {
        int trains = 0;
        for (int k = 0; k < ms / 10; ++k) {
            now_ns_ += 10 * kMillisecond_ns;
            const bool touches = now_ns_ > 500 * kMillisecond_ns;
            std::vector<float> acceleration, force{touches ? 1.0F : 0.0F}, taxels;
            for (int i = 0; i < 20; ++i) acceleration.push_back(noise(touches ? 1 : 0.02));
            for (int i = 0; i < 4; ++i) taxels.push_back(500 + noise(5) + (touches ? 3000.0F + 300.0F * float(i) : 0));
            force[0] += noise(0.002);
            spoil(acceleration, force, taxels);
            give(TE_ACCELERATION, acceleration, 2, kMillisecond_ns);
            give(TE_FORCE, force, 1, 10 * kMillisecond_ns);
            give(TE_TAXEL_ARRAY, taxels, 4, 10 * kMillisecond_ns);
            while (takesFrames_ && te_frame(state_.get(), &frame_) != 0) {
            }
            te_train train{};
            trains += te_next_train(state_.get(), now_ns_, &train);
        }
        return trains;
    }
    int slide(int ms) {
        return slide(ms, [](auto&, auto&, auto&) {});
    }
    [[nodiscard]] std::uint32_t fault(std::int64_t later_ns = 0) const {
        return te_fault(state_.get(), now_ns_ + later_ns);
    }

    float noise(double size) { return static_cast<float>(size * random_.normal()); }

    te_profile profile_{};
    std::unique_ptr<te_state> state_ = std::make_unique<te_state>();
    std::int64_t now_ns_ = 0;
    bool takesFrames_ = true;
    te_reading frame_{};  // the newest

private:
    void give(te_stream stream, const std::vector<float>& values, std::size_t columns, std::int64_t step_ns) {
        if (values.empty()) return;
        const auto count = static_cast<std::uint32_t>(values.size() / columns);
        te_samples(state_.get(), stream, now_ns_ - (count - 1) * step_ns, static_cast<std::int32_t>(step_ns),
                   values.data(), count);
    }
    Random random_{7, "finger"};
};

}  // namespace

TEST_F(SlidingFinger, IsFelt) {
    EXPECT_NE(fault() & TE_FAULT_STALE, kNone) << "nothing came yet";
    EXPECT_GE(slide(5000), 3);
    EXPECT_EQ(fault(), kNone);
}

TEST_F(SlidingFinger, IsAssumedToSlideWhereItDidNotRestBefore) {
    slide(2000);
    EXPECT_EQ(frame_.sliding, 1U);
    EXPECT_EQ(frame_.sliding_assumed, kNone);
    ASSERT_EQ(te_init(state_.get(), &profile_), TE_ACCEPTED);
    slide(1000, [](auto& acceleration, auto&, auto&) {
        for (auto& value : acceleration) value *= 0.02F;
    });
    EXPECT_EQ(frame_.sliding, 1U) << "noise alone";
    EXPECT_EQ(frame_.sliding_assumed, 1U);
}

TEST_F(SlidingFinger, IsNotFeltWhileAStreamIsSilent) {
    slide(3000);
    EXPECT_EQ(slide(100, [](auto&, auto& force, auto&) { force.clear(); }), 0);
    EXPECT_EQ(slide(4000, [](auto&, auto& force, auto&) { force.clear(); }), 0);
    EXPECT_EQ(fault(), TE_FAULT_STALE);
    EXPECT_GE(slide(3000), 1) << "and is again when it speaks";
    EXPECT_EQ(slide(3000, [](auto&, auto&, auto& taxels) { taxels.clear(); }), 0);
    slide(1000);
    EXPECT_EQ(fault(99 * kMillisecond_ns), kNone);
    EXPECT_EQ(fault(101 * kMillisecond_ns), TE_FAULT_STALE);
    EXPECT_EQ(fault(-200 * kMillisecond_ns), TE_FAULT_FUTURE);
    EXPECT_EQ(te_fault(state_.get(), -1), TE_FAULT_FUTURE);
}

TEST_F(SlidingFinger, TouchesAnewAfterASilence) {
    const auto lightly = [](auto&, auto& force, auto&) { force = {0.07F}; };
    slide(3000);
    slide(300, lightly);
    EXPECT_TRUE(state_->latest.contact) << "contact goes on down to 0.05 N";
    slide(300, [](auto&, auto& force, auto&) { force.clear(); });
    slide(300, lightly);
    EXPECT_FALSE(state_->latest.contact) << "and begins at 0.1 N";
}

TEST_F(SlidingFinger, IsNotFeltWhileASensorRepeatsItself) {
    slide(3000);
    std::vector<std::vector<float>> kept;
    // A buffer of 50 samples that is sent again and again, as by a transfer that hangs.
    slide(50, [&](auto& acceleration, auto&, auto&) { kept.push_back(acceleration); });
    std::size_t next = 0;
    const auto again = [&](auto& acceleration, auto&, auto&) { acceleration = kept[next++ % kept.size()]; };
    slide(300, again);
    EXPECT_EQ(fault(), TE_FAULT_STUCK);
    EXPECT_EQ(slide(3000, again), 0);
    slide(1000);
    EXPECT_EQ(fault(), kNone);
    // One axis alone.
    slide(300, [](auto& acceleration, auto&, auto&) {
        for (std::size_t i = 1; i < acceleration.size(); i += 2) acceleration[i] = 9.8F;
    });
    EXPECT_EQ(fault(), TE_FAULT_STUCK);
    slide(1000);
    EXPECT_EQ(fault(), kNone);
    // One axis alone, in blocks.
    int k = 0;
    const auto axisAgain = [&](auto& acceleration, auto&, auto&) {
        for (std::size_t i = 0; i < acceleration.size(); i += 2) acceleration[i] = 0.1F * float(7 * k++ % 16) - 0.8F;
    };
    slide(300, axisAgain);
    EXPECT_EQ(fault(), TE_FAULT_STUCK);
    EXPECT_EQ(slide(3000, axisAgain), 0);
    slide(1000);
    EXPECT_EQ(fault(), kNone);
    // Taxels, which are touched; force alone may stand still.
    slide(1000, [](auto&, auto&, auto& taxels) { taxels = {3500, 3800, 4100, 4400}; });
    EXPECT_EQ(fault(), TE_FAULT_STUCK);
    slide(1000, [](auto&, auto& force, auto&) { force = {1}; });
    EXPECT_EQ(fault(), kNone);
}

TEST_F(SlidingFinger, IsNotFeltWhileABufferComesAgainInWhichEachValueOccursTwice) {
    // A sensor that gives 500 samples/s to a board that asks 1000 times: its values repeat, and that is no fault.
    std::vector<float> before(2);
    std::size_t seen = 0;
    const auto doubled = [&](auto& acceleration, auto&, auto&) {
        for (std::size_t i = 0; i < acceleration.size(); i += 2, ++seen) {
            if (seen % 2 == 1) std::copy_n(before.begin(), 2, acceleration.begin() + static_cast<std::ptrdiff_t>(i));
            before = {acceleration[i], acceleration[i + 1]};
        }
    };
    slide(1000, doubled);
    EXPECT_GE(slide(5000, doubled), 2);
    EXPECT_EQ(fault(), kNone);
    std::vector<float> buffer;
    while (buffer.size() < 64) {
        slide(10, [&](auto& acceleration, auto& force, auto& taxels) {
            doubled(acceleration, force, taxels);
            buffer.insert(buffer.end(), acceleration.begin(), acceleration.end());
        });
    }
    seen = 0;
    const auto again = [&](auto& acceleration, auto&, auto&) {
        for (auto& value : acceleration) value = buffer[seen++ % 64];
    };
    slide(300, again);
    EXPECT_EQ(fault(), TE_FAULT_STUCK);
    EXPECT_EQ(slide(3000, again), 0);
    seen = 0;
    slide(1000, doubled);
    EXPECT_EQ(fault(), kNone);
}

TEST_F(SlidingFinger, IsNotFeltForATenthOfASecondAfterAnImpossibleReading) {
    for (const float bad : {std::numeric_limits<float>::quiet_NaN(), std::numeric_limits<float>::infinity(), 201.0F}) {
        slide(3000);
        slide(10, [&](auto&, auto& force, auto&) { force = {bad}; });
        EXPECT_EQ(fault(), TE_FAULT_IMPLAUSIBLE) << bad;
        slide(90);
        EXPECT_EQ(fault(), TE_FAULT_IMPLAUSIBLE) << bad;
        slide(20);
        EXPECT_EQ(fault(), kNone) << bad;
    }
}

TEST_F(SlidingFinger, IsNotFeltAfterAStop) {
    RecordProperty("hazard", "H2");
    slide(3000);
    te_stop(state_.get());
    EXPECT_EQ(slide(5000), 0);
    EXPECT_EQ(fault(), TE_FAULT_STOPPED);
}

TEST_F(SlidingFinger, IsNotFeltUntilTheBoardHasRested) {
    RecordProperty("hazard", "H1");
    ASSERT_EQ(te_init(state_.get(), &profile_), TE_ACCEPTED);
    EXPECT_EQ(slide(8000), 0);
    EXPECT_EQ(fault(), TE_FAULT_RESTING);
    EXPECT_GE(slide(3000), 1);
    EXPECT_EQ(fault(), kNone);
    // A board that is reset again and again never begins.
    for (int k = 0; k < 5; ++k) {
        ASSERT_EQ(te_init(state_.get(), &profile_), TE_ACCEPTED);
        EXPECT_EQ(slide(4000), 0);
    }
}

TEST_F(SlidingFinger, RestsHoweverItsClockJumps) {
    RecordProperty("hazard", "H1");
    ASSERT_EQ(te_init(state_.get(), &profile_), TE_ACCEPTED);
    slide(1000);
    now_ns_ += 3'600'000 * kMillisecond_ns;  // a clock that is set
    EXPECT_EQ(slide(5000), 0);
    EXPECT_EQ(fault(), TE_FAULT_RESTING);
    slide(2000);
    EXPECT_EQ(fault(), kNone) << "a second of the jump counts";
}

TEST_F(SlidingFinger, IsNotFeltAfterAnImpossibleReadingWithAnOlderOneBehindIt) {
    slide(3000);
    slide(10, [](auto&, auto& force, auto&) { force = {201}; });
    const float older[] = {std::numeric_limits<float>::quiet_NaN(), 1, 1, 1};
    te_samples(state_.get(), TE_TAXEL_ARRAY, now_ns_ - 95 * kMillisecond_ns, 0, older, 1);
    EXPECT_EQ(fault(50 * kMillisecond_ns), TE_FAULT_IMPLAUSIBLE);
}

TEST_F(SlidingFinger, IsFeltInBlocksOf160SamplesAndNotOfMore) {
    auto profile = profile_;
    profile.acceleration_hz = 4000;
    profile.hash = te_hash(&profile);
    ASSERT_EQ(te_init(state_.get(), &profile), TE_ACCEPTED);
    std::vector<float> values(2 * (TE_BLOCK + 1));
    for (auto& value : values) value = noise(1);
    int frames = 0;
    for (int block = 0; block < 100; ++block) {
        const std::int64_t first_ns = 40 * kMillisecond_ns * block;
        for (int k = 0; k < 4; ++k) {
            const std::int64_t t_ns = first_ns + 10 * k * kMillisecond_ns;
            const float force = 1 + noise(0.002), taxels[] = {3500 + noise(5), 3800 + noise(5), 4100, 4400};
            te_samples(state_.get(), TE_FORCE, t_ns, 0, &force, 1);
            te_samples(state_.get(), TE_TAXEL_ARRAY, t_ns, 0, taxels, 1);
        }
        EXPECT_EQ(te_samples(state_.get(), TE_ACCELERATION, first_ns, 250'000, values.data(), TE_BLOCK + 1), kNone);
        ASSERT_EQ(te_samples(state_.get(), TE_ACCELERATION, first_ns, 250'000, values.data(), TE_BLOCK), TE_BLOCK);
        while (te_frame(state_.get(), &frame_) != 0) ++frames;
    }
    EXPECT_EQ(state_->windows_lost, 0U);
    EXPECT_GT(frames, 230);
}

TEST_F(SlidingFinger, IsNotFeltWhileNobodyTakesItsFrames) {
    slide(3000);
    EXPECT_EQ(state_->windows_lost, 0U);
    takesFrames_ = false;
    slide(150);
    EXPECT_EQ(slide(3000), 0);
    EXPECT_EQ(fault(), TE_FAULT_STALE) << "the newest frame is old, and no stream is";
    EXPECT_GT(state_->windows_lost, 0U);
    takesFrames_ = true;
    EXPECT_GE(slide(5000), 2);
}

}  // namespace tacto::test
