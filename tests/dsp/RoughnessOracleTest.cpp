#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/dsp/RoughnessAnalysis.h"
#include "tests/dsp/RoughnessOracle.h"

using namespace tacto;
using namespace tacto::test;

namespace {

constexpr double kTolerance = 1e-9;

void compare(const Slide& slide, const RoughnessSettings& settings, const DeclaredIntervals& declared = {}) {
    const auto result = analyseRoughness(slide.streams, slide.blocks, settings, declared);
    ASSERT_TRUE(result) << result.error().message;
    expectSameFrames(result->frames, oracleFrames(slide.streams, slide.blocks, settings, declared), kTolerance);
}

std::size_t slidingFrames(std::span<const RoughnessFrame> frames) {
    return static_cast<std::size_t>(std::ranges::count_if(frames, [](const auto& f) { return f.sliding; }));
}

}  // namespace

TEST(Roughness, IsWhatTheTextSays) {
    const auto slide = makeSlide(4000, 3, 200, 200, 8);
    compare(slide, {});
    const auto frames = oracleFrames(slide.streams, slide.blocks, {});
    EXPECT_NEAR(static_cast<double>(slidingFrames(frames)), 1.5 / 0.016, 8) << "the slide must hold what it tests";
}

TEST(Roughness, AbsolutePowerAndDynamicTaxels) {
    RoughnessSettings settings;
    settings.spectral = SpectralFeature::Absolute;
    settings.taxel = TaxelFeature::Dynamic;
    settings.spectralWeight = 0.2;
    settings.taxelWeight = 0.7;
    settings.smoothing = Seconds(0.2);
    settings.contactArea = SquareCentimetres(0.5);
    compare(makeSlide(4000, 2, 200, 200, 8), settings);
}

TEST(Roughness, TruncatedBandAndOddWindow) {
    compare(makeSlide(2200, 1, 150, 100, 19), {});  // N = 141
    compare(makeSlide(1000, 3, 200, 200, 4), {});
}

TEST(Roughness, SlowAccelerationHasNoSpectralFeature) { compare(makeSlide(100, 3, 100, 40, 4), {}); }

TEST(Roughness, WithoutForceItIsNotNormalised) {
    const auto slide = makeSlide(4000, 3, 0, 200, 8);
    compare(slide, {});
    DeclaredIntervals declared;
    declared.contact = {{1.0, 4.5}};
    compare(slide, {}, declared);
}

TEST(Roughness, DeclaredBaselineServesTheWholeRecordingWhereverItLies) {
    const auto slide = makeSlide(4000, 1, 200, 200, 8);
    DeclaredIntervals declared;
    for (const TimeInterval baseline : {TimeInterval{0.1, 0.9}, TimeInterval{4.7, 5.7}, TimeInterval{4.7, 60}}) {
        declared.baseline = baseline;
        compare(slide, {}, declared);
    }
}

TEST(Roughness, TaxelsAlone) {
    compare(makeSlide(0, 0, 0, 35.6, 16), {});  // one frame per sample
    compare(makeSlide(0, 0, 0, 200, 8), {});    // one frame every 16 ms
    compare(makeSlide(0, 0, 200, 200, 8), {});  // with force
}

TEST(Roughness, LowerEndOfTheRoughBandIsTheProfiles) {
    RoughnessSettings settings;
    settings.bandLow = Hertz(80);
    compare(makeSlide(4000, 1, 200, 0, 0), settings);
}

TEST(Roughness, RestHoldsThenDecaysAndLostContactClears) {
    const auto slide = makeSlide(4000, 3, 200, 200, 8);
    const auto result = analyseRoughness(slide.streams, slide.blocks, {});
    ASSERT_TRUE(result);
    const auto at = [&](double t) {
        return *std::ranges::find_if(result->frames, [&](const auto& f) { return f.t_s >= t; });
    };
    EXPECT_TRUE(std::isnan(at(0.5).R));
    EXPECT_TRUE(std::isnan(at(1.3).R)) << "R starts with the first sliding frame";
    const double last = at(2.95).R;
    EXPECT_GT(last, 0.1);
    EXPECT_EQ(at(3.06).R, at(3.25).R) << "held for 250 ms";
    EXPECT_LT(at(4.2).R, 0.05 * last) << "then it decays";
    EXPECT_TRUE(at(4.2).contact);
    EXPECT_FALSE(at(4.2).sliding);
    EXPECT_GT(at(4.2).P, 0.1) << "pressure alone is felt";
    EXPECT_TRUE(std::isnan(at(4.7).R));
}

TEST(Roughness, SummaryCountsContactFramesOnly) {
    const auto slide = makeSlide(4000, 3, 200, 200, 8);
    const auto result = analyseRoughness(slide.streams, slide.blocks, {});
    ASSERT_TRUE(result);
    const auto& summary = result->summary;
    EXPECT_EQ(summary.frames, result->frames.size());
    EXPECT_NEAR(static_cast<double>(summary.contactFrames), 3.5 / 0.016, 2);
    EXPECT_EQ(summary.h.n, summary.contactFrames);
    EXPECT_EQ(summary.rate_hz, 4000);
    EXPECT_NEAR(summary.frameRate_hz, 62.5, 1e-9);
    EXPECT_THAT(summary.flags, testing::ElementsAre("uncalibrated R"));
    const auto csv = framesCsv(result->frames);
    EXPECT_THAT(csv, testing::StartsWith("t_s,contact,sliding,h,v,R,pressure_pa,P\n0.032,0,0,0."));
    EXPECT_THAT(csv, testing::HasSubstr(",,,")) << "absent values are empty";
    EXPECT_THAT(csv, testing::Not(testing::HasSubstr("nan")));
}

TEST(Roughness, RefusesWhatItCannotJudge) {
    const auto refuses = [](std::vector<StreamInfo> streams) {
        return !RoughnessChain::create(streams, {}).has_value();
    };
    const StreamInfo force{StreamKind::Force, StreamUnit::Newton, 1, 200, ""};
    EXPECT_TRUE(refuses({}));
    EXPECT_TRUE(refuses({force, force}));
    EXPECT_TRUE(refuses({{StreamKind::Force, StreamUnit::Newton, 2, 200, ""}}));
    EXPECT_TRUE(refuses({{StreamKind::Force, StreamUnit::Newton, 1, std::nan(""), ""}}));
    EXPECT_TRUE(refuses({{StreamKind::Acceleration, StreamUnit::Count, 1, 50, ""}}));
    EXPECT_TRUE(refuses({{StreamKind::Acceleration, StreamUnit::Count, 1, 40'000, ""}}));
    EXPECT_TRUE(refuses({{StreamKind::Acceleration, StreamUnit::Count, 4, 4000, ""}}));
    EXPECT_TRUE(refuses({{StreamKind::Taxels, StreamUnit::Count, 1, 100, ""}}));
    EXPECT_FALSE(refuses({force}));
    EXPECT_FALSE(refuses({{StreamKind::Acceleration, StreamUnit::Count, 1, 20'000, ""}}));
    EXPECT_FALSE(refuses({{StreamKind::Acceleration, StreamUnit::Count, 1, 99.9999, ""}}));
}
