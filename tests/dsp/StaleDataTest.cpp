// Hazard H7: stale or corrupt sensor data never drive output; silence and static contact never read as rough.
#include <algorithm>
#include <cmath>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/base/Random.h"
#include "core/base/Statistics.h"
#include "core/dsp/RoughnessAnalysis.h"
#include "tests/dsp/RoughnessOracle.h"

using namespace tacto;
using namespace tacto::test;
using testing::Contains;

namespace {

RoughnessResult analysed(const Slide& slide, const DeclaredIntervals& declared = {}) {
    auto result = analyseRoughness(slide.streams, slide.blocks, {}, declared);
    EXPECT_TRUE(result) << result.error().message;
    return result ? *result : RoughnessResult{};
}

/// Returns a slide with one second of rest, then hard pressure without motion, under `factor` times the noise.
Slide pressedStill(double noise, double factor) {
    Random random(21, "still");
    Slide slide;
    slide.streams = {{StreamKind::Acceleration, StreamUnit::MetrePerSecondSquared, 3, 4000, ""},
                     {StreamKind::Force, StreamUnit::Newton, 1, 200, ""},
                     {StreamKind::Taxels, StreamUnit::Pascal, 8, 200, ""}};
    slide.blocks.resize(3);
    for (int i = 0; i < 16'000; ++i) {
        slide.blocks[0].t_s.push_back(i / 4000.0);
        for (int c = 0; c < 3; ++c) {
            slide.blocks[0].values.push_back(9.8 + noise * (i < 4000 ? 1 : factor) * random.normal());
        }
    }
    for (int i = 0; i < 800; ++i) {
        const bool pressed = i >= 200;
        slide.blocks[1].t_s.push_back(i / 200.0);
        slide.blocks[1].values.push_back(pressed ? 5.0 : 0.0);
        slide.blocks[2].t_s.push_back(i / 200.0);
        for (int c = 0; c < 8; ++c) slide.blocks[2].values.push_back(100 + random.normal() + (pressed ? 900.0 * c : 0));
    }
    return slide;
}

}  // namespace

TEST(StaleData, StaticContactNeverReadsAsRough) {
    RecordProperty("hazard", "H7");
    for (const double noise : {1e-4, 0.01, 1.0}) {
        const auto result = analysed(pressedStill(noise, 1));
        EXPECT_GT(result.summary.contactFrames, 150U);
        for (const auto& frame : result.frames) {
            if (!frame.contact) continue;
            ASSERT_FALSE(frame.sliding) << frame.t_s;
            ASSERT_FALSE(frame.R > 0) << frame.t_s;
        }
        EXPECT_GT(result.summary.h.mean, 0.7) << "the ratio alone would have said rough: noise is white";
    }
    EXPECT_GT(analysed(pressedStill(0.01, 10)).summary.R.n, 100U) << "and a real vibration is felt";
}

TEST(StaleData, SilenceNeverReadsAsRough) {
    RecordProperty("hazard", "H7");
    auto slide = pressedStill(0, 1);
    for (auto& value : slide.blocks[2].values) value = 100;
    for (const auto& frame : analysed(slide).frames) ASSERT_FALSE(frame.R > 0) << frame.t_s;
    // The level at rest is unknown, and the sensor sends nothing.
    slide.streams.resize(1);
    slide.blocks.resize(1);
    const auto result = analysed(slide);
    EXPECT_THAT(result.summary.flags, Contains("sliding assumed"));
    EXPECT_EQ(result.summary.R.n, 0U);
    EXPECT_EQ(result.summary.h.n, 0U);
}

TEST(StaleData, WithoutContactThereIsNoR) {
    RecordProperty("hazard", "H7");
    auto slide = makeSlide(4000, 3, 200, 200, 8);
    for (auto& force : slide.blocks[1].values) force = 0.02;
    const auto result = analysed(slide);
    EXPECT_EQ(result.summary.contactFrames, 0U);
    for (const auto& frame : result.frames) ASSERT_TRUE(std::isnan(frame.R));
}

TEST(StaleData, AForceThatStopsEndsContactAndIsCounted) {
    RecordProperty("hazard", "H7");
    auto slide = makeSlide(4000, 3, 200, 200, 8);
    auto& force = slide.blocks[1];
    force.t_s.resize(400);  // 2.0 s
    force.values.resize(400);
    const auto result = analysed(slide);
    for (const auto& frame : result.frames) {
        if (frame.t_s > 2.1) {
            ASSERT_FALSE(frame.contact) << frame.t_s;
            ASSERT_TRUE(std::isnan(frame.R)) << frame.t_s;
            ASSERT_TRUE(std::isnan(frame.pressure_pa)) << frame.t_s;
        }
    }
    EXPECT_TRUE(std::ranges::any_of(result.frames, [](const auto& f) { return f.t_s > 1.9 && f.R > 0; }));
    EXPECT_THAT(result.summary.flags, Contains("force stale: 1"));
}

TEST(StaleData, NoFrameStandsOnASampleThatIsNoNumber) {
    RecordProperty("hazard", "H7");
    auto slide = makeSlide(4000, 3, 200, 200, 8);
    slide.blocks[0].values[3 * 8000 + 1] = kNaN;  // 2.0 s
    const auto result = analysed(slide);
    for (const auto& frame : result.frames) {
        ASSERT_FALSE(frame.t_s > 2.0 - 0.032 && frame.t_s < 2.0 + 0.0318) << "window over the NaN at " << frame.t_s;
        if (frame.contact) {
            ASSERT_TRUE(std::isfinite(frame.h)) << "a NaN would stay in the filter for ever";
        }
    }
    EXPECT_GT(result.frames.back().t_s, 5.9);
    EXPECT_THAT(result.summary.flags, Contains("not a number in acceleration: 1"));
}

TEST(StaleData, NoWindowSpansAGap) {
    RecordProperty("hazard", "H7");
    auto slide = makeSlide(4000, 1, 200, 200, 8);
    auto& block = slide.blocks[0];
    block.t_s.erase(block.t_s.begin() + 8000, block.t_s.begin() + 8100);
    block.values.erase(block.values.begin() + 8000, block.values.begin() + 8100);
    const auto result = analysed(slide);
    const double before = 2.0;
    const double after = 8100 / 4000.0;
    double firstAfter = 1e9;
    for (const auto& frame : result.frames) {
        ASSERT_TRUE(frame.t_s + 0.03 < before || frame.t_s - 0.0321 > after - 0.001) << frame.t_s;
        if (frame.t_s > after) firstAfter = std::min(firstAfter, frame.t_s);
    }
    EXPECT_NEAR(firstAfter, after + 0.032, 1e-9) << "windows start again with the first sample behind the gap";
    EXPECT_THAT(result.summary.flags, Contains("gaps in acceleration: 1"));
}

TEST(StaleData, AClockSetBackIsNotUsedUntilItHasCaughtUp) {
    RecordProperty("hazard", "H7");
    auto slide = makeSlide(4000, 1, 200, 200, 8);
    for (std::size_t i = 8000; i < slide.blocks[0].samples(); ++i) slide.blocks[0].t_s[i] -= 0.5;
    const auto result = analysed(slide);
    for (std::size_t i = 1; i < result.frames.size(); ++i) {
        ASSERT_GT(result.frames[i].t_s, result.frames[i - 1].t_s) << "frames never go back in time";
    }
    EXPECT_THAT(result.summary.flags, Contains(testing::HasSubstr("repeats or clock steps in acceleration: ")));
}

TEST(StaleData, TaxelsThatStopHaveNoSay) {
    RecordProperty("hazard", "H7");
    auto slide = makeSlide(4000, 1, 200, 200, 8);
    slide.blocks[2].t_s.resize(400);
    slide.blocks[2].values.resize(400 * 8);
    const auto result = analysed(slide);
    for (const auto& frame : result.frames) {
        if (frame.t_s > 2.1) {
            ASSERT_TRUE(std::isnan(frame.v)) << frame.t_s;
        }
        if (frame.t_s > 1.6 && frame.t_s < 2.0) {
            ASSERT_FALSE(std::isnan(frame.v)) << frame.t_s;
        }
    }
}

TEST(StaleData, ATaxelThatIsNoNumberTakesItsSampleOut) {
    RecordProperty("hazard", "H7");
    auto slide = makeSlide(4000, 1, 200, 200, 8);
    for (std::size_t i = 320; i < 400; ++i) slide.blocks[2].values[i * 8 + 3] = kNaN;  // 1.6 to 2.0 s
    const auto result = analysed(slide);
    for (const auto& frame : result.frames) {
        if (frame.t_s > 1.71 && frame.t_s < 1.89) {
            ASSERT_TRUE(std::isnan(frame.v)) << frame.t_s;
        }
    }
    EXPECT_THAT(result.summary.flags, Contains("not a number in taxels: 80"));
}
