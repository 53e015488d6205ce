// Real recordings compared with numpy and scipy (tests/reference/real_slides.py).
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "core/acquisition/Recording.h"
#include "core/dsp/RoughnessAnalysis.h"
#include "tests/support/Figures.h"
#include "tests/support/Support.h"

using namespace tacto;
using tacto::test::figuresOf;
using tacto::test::kNoSharedData;
using tacto::test::sharedData;
using testing::ElementsAre;

namespace {

RoughnessResult analysed(const std::filesystem::path& path, const RoughnessSettings& settings = {}) {
    const auto recording = Recording::open(path);
    EXPECT_TRUE(recording) << recording.error().message;
    auto result = analyseRoughness(recording->infos(), recording->blocks(), settings, recording->declared);
    EXPECT_TRUE(result) << result.error().message;
    return result ? *result : RoughnessResult{};
}

void expectNear(double found, double expected) { EXPECT_NEAR(found, expected, 1e-9 * expected); }

}  // namespace

TEST(RealRoughness, BioTacSlidesGiveScipysNumbers) {
    const auto folder = sharedData("biotac");
    if (!folder) GTEST_SKIP() << kNoSharedData;
    for (const auto& scipy : figuresOf("real_slides").at("biotac")) {
        const auto slide = *folder / scipy.at("name").get<std::string>();
        const auto summary = analysed(slide).summary;
        EXPECT_EQ(summary.frames, scipy.at("frames").get<std::size_t>()) << slide;
        EXPECT_EQ(summary.contactFrames, summary.frames);
        expectNear(summary.h.mean, scipy.at("h"));
        expectNear(summary.h.sd, scipy.at("h_sd"));
        expectNear(summary.pressure_pa.mean, scipy.at("pressure_pa"));
        expectNear(summary.rate_hz, scipy.at("rate_hz"));
        EXPECT_EQ(summary.v.n, 0U) << "touched from the start: all under the assumed baseline's noise floor";
        EXPECT_THAT(summary.flags, ElementsAre("band truncated", "sliding assumed", "baseline assumed",
                                               "uncalibrated R", "uncalibrated units"));
        RoughnessSettings absolute;
        absolute.spectral = SpectralFeature::Absolute;
        expectNear(analysed(slide, absolute).summary.h.mean, scipy.at("h_abs"));
    }
}

TEST(RealRoughness, FabricSlideHasTaxelsOnly) {
    const auto folder = sharedData("fabric_slide");
    if (!folder) GTEST_SKIP() << kNoSharedData;
    for (const auto& numpy : figuresOf("real_slides").at("fabric")) {
        const auto slide = *folder / (numpy.at("name").get<std::string>() + ".json");
        const auto summary = analysed(slide).summary;
        EXPECT_EQ(summary.frames, numpy.at("frames").get<std::size_t>()) << "a frame per taxel sample";
        EXPECT_EQ(summary.v.n, numpy.at("present").get<std::size_t>());
        expectNear(summary.v.mean, numpy.at("v_static"));
        EXPECT_EQ(summary.R.n, summary.v.n);
        EXPECT_EQ(summary.h.n, 0U);
        EXPECT_EQ(summary.P.n, 0U) << "counts are not pressure";
        EXPECT_THAT(summary.flags,
                    ElementsAre("no spectral feature", "not force-normalised", "contact assumed", "sliding assumed",
                                "baseline assumed", "uncalibrated R", "uncalibrated units"));
        RoughnessSettings dynamic;
        dynamic.taxel = TaxelFeature::Dynamic;
        expectNear(analysed(slide, dynamic).summary.v.mean, numpy.at("v_dynamic"));
    }
}

TEST(RealRoughness, HapmatIsTooSlowForAnyFeature) {
    const auto file = sharedData("hapmat/Fabric.json");
    if (!file) GTEST_SKIP() << kNoSharedData;
    const auto summary = analysed(*file).summary;
    const auto& numpy = figuresOf("real_slides").at("stick");
    EXPECT_EQ(summary.frames, numpy.at("frames").get<std::size_t>());
    EXPECT_EQ(summary.R.n, 0U);
    expectNear(summary.rate_hz, numpy.at("rate_hz"));
    EXPECT_THAT(summary.flags, ElementsAre("band truncated", "no spectral feature", "not force-normalised",
                                           "contact assumed", "sliding assumed", "uncalibrated R"));
}
