#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/dsp/RoughnessAnalysis.h"
#include "tests/dsp/RoughnessOracle.h"

using namespace tacto;
using namespace tacto::test;
using testing::Contains;
using testing::Not;

namespace {

/// Returns the slide from 0.85 s on, with stamps from 0: its 150 ms of rest are too short.
Slide lateStart() {
    auto slide = makeSlide(4000, 1, 200, 200, 8);
    for (std::size_t s = 0; s < slide.streams.size(); ++s) {
        auto& block = slide.blocks[s];
        const auto drop = static_cast<std::ptrdiff_t>(0.85 * slide.streams[s].rate_hz);
        block.values.erase(block.values.begin(),
                           block.values.begin() + drop * static_cast<std::ptrdiff_t>(slide.streams[s].channels));
        block.t_s.resize(block.t_s.size() - static_cast<std::size_t>(drop));
    }
    return slide;
}

std::vector<std::string> flagsOf(const Slide& slide, const RoughnessSettings& settings = {},
                                 const DeclaredIntervals& declared = {}) {
    const auto result = analyseRoughness(slide.streams, slide.blocks, settings, declared);
    EXPECT_TRUE(result);
    return result->summary.flags;
}

}  // namespace

TEST(Rest, TooShortBeforeContactIsAssumedAndSaid) {
    const auto flags = flagsOf(lateStart());
    EXPECT_THAT(flags, Contains("baseline assumed"));
    for (const auto& flag : flags) EXPECT_TRUE(flagSentence(flag).ends_with('.')) << flag;
    EXPECT_THAT(flags, Contains("sliding assumed"));
}

TEST(Rest, ProfilesLevelServesOnlyInItsUnit) {
    RoughnessSettings settings;
    settings.restMeanSquare = 0.02 * 0.02 * 0.5;
    EXPECT_THAT(flagsOf(lateStart(), settings), Not(Contains("sliding assumed")));
    settings.restUnit = StreamUnit::Count;
    EXPECT_THAT(flagsOf(lateStart(), settings), Contains("sliding assumed"));
}

TEST(Rest, ProfilesLevelTellsSlidingFromResting) {
    const auto slide = lateStart();
    RoughnessSettings settings;
    // The sensor's mean square at rest, 5 Hz..1 kHz: half of the white noise of 0.02 m/s2. The division by 0.1 N is
    // undone.
    settings.restMeanSquare = 0.02 * 0.02 * 0.5;
    const auto result = analyseRoughness(slide.streams, slide.blocks, settings);
    ASSERT_TRUE(result);
    for (const auto& frame : result->frames) {
        const double t = frame.t_s + 0.85;
        if (t > 1.6 && t < 2.9) {
            ASSERT_TRUE(frame.sliding) << t;
        }
        if ((t > 1.1 && t < 1.4) || (t > 3.1 && t < 4.4)) {
            ASSERT_FALSE(frame.sliding) << t;
        }
    }
}

TEST(Rest, DeclaredBaselineComesBeforeEverything) {
    DeclaredIntervals declared;
    declared.baseline = {3.9, 4.9};  // after the lift, in the time of this slide
    const auto flags = flagsOf(lateStart(), {}, declared);
    EXPECT_THAT(flags, Not(Contains("baseline assumed")));
    EXPECT_THAT(flags, Not(Contains("sliding assumed")));
}

TEST(Rest, LiveNothingIsFeltBeforeADeclaredBaselineHasPassed) {
    RecordProperty("hazard", "H7");
    const auto slide = makeSlide(4000, 1, 200, 200, 8);
    DeclaredIntervals declared;
    declared.baseline = {1.0, 2.0};
    auto chain = RoughnessChain::create(slide.streams, {}, declared);
    std::vector<RoughnessFrame> frames;
    (*chain)->feed(slide.blocks, frames);
    (*chain)->finish(frames);
    for (const auto& frame : frames) {
        if (frame.t_s < 1.96) {
            ASSERT_TRUE(std::isnan(frame.R)) << frame.t_s;
        }
    }
    ASSERT_NE((*chain)->rest(), nullptr);
    EXPECT_GT((*chain)->rest()->slidingMeanSquare, 0);
}

TEST(Rest, FlagsSayWhatIsMissing) {
    auto slide = makeSlide(4000, 1, 0, 200, 8);
    slide.streams[1].unit = StreamUnit::Count;
    EXPECT_THAT(flagsOf(slide), testing::ElementsAre("not force-normalised", "contact assumed", "sliding assumed",
                                                     "baseline assumed", "uncalibrated R", "uncalibrated units"));
    RoughnessSettings calibrated;
    calibrated.calibrated = true;
    EXPECT_THAT(flagsOf(makeSlide(4000, 3, 200, 200, 8), calibrated), testing::IsEmpty());
    EXPECT_THAT(flagsOf(makeSlide(2000, 3, 200, 200, 8), calibrated), testing::ElementsAre("band truncated"));
    EXPECT_THAT(flagsOf(makeSlide(400, 3, 200, 200, 8), calibrated),
                testing::ElementsAre("band truncated", "no spectral feature"));
}
