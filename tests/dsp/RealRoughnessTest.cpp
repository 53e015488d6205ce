// Real recordings against numbers computed once with scipy 1.10 / numpy 1.24:
//   fs = (len(t)-1) / (t[-1]-t[0]); sos = butter(2, [5, 0.45*fs], 'bandpass', fs=fs, output='sos')
//   y = sosfilt(sos, x, zi=sosfilt_zi(sos)*x[0])[0] / np.maximum(np.interp(t, tF, F), 0.1)
//   N = floor(0.064*fs + .5); H = floor(0.016*fs + .5); w = .5 - .5*cos(2*pi*arange(N)/N)
//   S = 2*abs(rfft(y[k*H:k*H+N]*w))**2 / (fs*sum(w**2)); h = S[f>=200].sum() / S[f>=5].sum(), f <= 0.45*fs
//   u = maximum(c - c[tc < tc[0]+.25].mean(0), 0); v = u.var(1) / u.mean(1)**2 where u.mean(1) >= the floor
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/acquisition/Recording.h"
#include "core/dsp/RoughnessAnalysis.h"
#include "tests/support/Support.h"

using namespace tacto;
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

}  // namespace

TEST(RealRoughness, BioTacSlidesGiveScipysNumbers) {
    struct Known {
        const char* name;
        std::size_t frames;
        double h, hSd, hAbs, pressure_pa;
    };
    const auto folder = sharedData("biotac");
    if (!folder) GTEST_SKIP() << kNoSharedData;
    for (const auto& known : {Known{"mat1_1", 374, 0.0956067163195, 0.0933116517764, 71.7889446796, 17442.3467852},
                              Known{"mat6_1", 499, 0.093193423272, 0.0841738305864, 48.5047374036, 26364.3388736},
                              Known{"mat11_1", 499, 0.050753411068, 0.0647692718928, 18.4600196195, 23357.9888901},
                              Known{"mat16_1", 499, 0.231066741356, 0.210712061184, 23.1834278538, 23077.1946467}}) {
        const auto result = analysed(*folder / known.name);
        const auto& summary = result.summary;
        EXPECT_EQ(summary.frames, known.frames) << known.name;
        EXPECT_EQ(summary.contactFrames, known.frames);
        EXPECT_NEAR(summary.h.mean, known.h, 1e-9 * known.h);
        EXPECT_NEAR(summary.h.sd, known.hSd, 1e-9 * known.hSd);
        EXPECT_NEAR(summary.pressure_pa.mean, known.pressure_pa, 1e-9 * known.pressure_pa);
        EXPECT_NEAR(summary.rate_hz, 2200, 0.001);
        EXPECT_EQ(summary.v.n, 0U) << "touched from the start: all under the assumed baseline's noise floor";
        EXPECT_THAT(summary.flags, ElementsAre("band truncated", "sliding assumed", "baseline assumed",
                                               "uncalibrated R", "uncalibrated units"));
        RoughnessSettings absolute;
        absolute.spectral = SpectralFeature::Absolute;
        EXPECT_NEAR(analysed(*folder / known.name, absolute).summary.h.mean, known.hAbs, 1e-9 * known.hAbs);
    }
}

TEST(RealRoughness, FabricSlideHasTaxelsOnly) {
    struct Known {
        const char* name;
        std::size_t frames, present;
        double vStatic, vDynamic;
    };
    const auto folder = sharedData("fabric_slide");
    if (!folder) GTEST_SKIP() << kNoSharedData;
    for (const auto& known : {Known{"Linen_F150_V20mmps_0.json", 1059, 996, 1.68242510754, 0.368128395422},
                              Known{"Board2mm_F120_V-5mmps_0.json", 1079, 797, 0.90037321205, 0.021790116651}}) {
        const auto summary = analysed(*folder / known.name).summary;
        EXPECT_EQ(summary.frames, known.frames) << "a frame per taxel sample";
        EXPECT_EQ(summary.v.n, known.present);
        EXPECT_NEAR(summary.v.mean, known.vStatic, 1e-9 * known.vStatic);
        EXPECT_EQ(summary.R.n, known.present);
        EXPECT_EQ(summary.h.n, 0U);
        EXPECT_EQ(summary.P.n, 0U) << "counts are no pressure";
        EXPECT_THAT(summary.flags,
                    ElementsAre("no spectral feature", "not force-normalised", "contact assumed", "sliding assumed",
                                "baseline assumed", "uncalibrated R", "uncalibrated units"));
        RoughnessSettings dynamic;
        dynamic.taxel = TaxelFeature::Dynamic;
        EXPECT_NEAR(analysed(*folder / known.name, dynamic).summary.v.mean, known.vDynamic, 1e-9 * known.vDynamic);
    }
}

TEST(RealRoughness, HapmatIsTooSlowForAnyFeature) {
    const auto file = sharedData("hapmat/Fabric.json");
    if (!file) GTEST_SKIP() << kNoSharedData;
    const auto summary = analysed(*file).summary;
    EXPECT_EQ(summary.frames, 2998U);
    EXPECT_EQ(summary.R.n, 0U);
    EXPECT_NEAR(summary.rate_hz, 100, 1e-9);
    EXPECT_THAT(summary.flags, ElementsAre("band truncated", "no spectral feature", "not force-normalised",
                                           "contact assumed", "sliding assumed", "uncalibrated R"));
}
