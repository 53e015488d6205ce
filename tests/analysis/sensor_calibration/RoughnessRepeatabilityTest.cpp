// The uncertainty of R, compared with numpy (tests/reference/roughness_uncertainty.py), and its unknown parts.
#include <cmath>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "core/analysis/sensor_calibration/SensorCalibration.h"
#include "tests/support/Figures.h"
#include "tests/support/Refused.h"

namespace tacto {
namespace {

std::vector<SlidSurface> referenceSlides(const nlohmann::json& reference) {
    std::vector<SlidSurface> out;
    for (const auto& surface : reference.at("surfaces")) {
        SlidSurface slid{std::to_string(out.size()), 1, 7, {}};
        for (std::size_t i = 0; i < surface.at("h").size(); ++i) {
            SlideReading slide;
            slide.h = surface.at("h")[i];
            slide.vStatic = surface.at("v")[i];
            slid.slides.push_back(slide);
        }
        out.push_back(std::move(slid));
    }
    return out;
}

double geometricMean(const SlidSurface& surface, SensorFeature feature) {
    double sum = 0;
    for (const auto& slide : surface.slides) sum += std::log10(valueOf(slide, feature));
    return std::pow(10, sum / static_cast<double>(surface.slides.size()));
}

RoughnessSettings scaledTo(const std::vector<SlidSurface>& surfaces) {
    RoughnessSettings out;
    out.h = {geometricMean(surfaces[0], SensorFeature::H), geometricMean(surfaces[1], SensorFeature::H)};
    out.vStatic = {geometricMean(surfaces[0], SensorFeature::VStatic),
                   geometricMean(surfaces[1], SensorFeature::VStatic)};
    return out;
}

const nlohmann::json& reference() { return test::figuresOf("roughness_uncertainty"); }

TEST(RoughnessRepeatability, GivesTheExpandedUncertaintyThatNumpyGives) {
    const auto& expected = reference();
    const auto surfaces = referenceSlides(expected);
    const auto found = test::accepted(roughnessRepeatability(surfaces, scaledTo(surfaces)));
    EXPECT_EQ(found.smoothSlides, 5U);
    EXPECT_EQ(found.roughSlides, 7U);
    for (const auto& at : expected.at("expanded"))
        EXPECT_NEAR(found.expanded(at.at("R")), at.at("U").get<double>(), 1e-6 * at.at("U").get<double>()) << at.dump();
    EXPECT_NEAR(expected.at("coverage").get<double>(), 0.95, 0.01) << "of 4000 slides whose R is known";
}

TEST(RoughnessRepeatability, OfOneFeatureIsItsOwn) {
    const auto surfaces = referenceSlides(reference());
    auto settings = scaledTo(surfaces);
    const auto both = roughnessRepeatability(surfaces, settings);
    settings.taxelWeight = 0;
    const auto one = roughnessRepeatability(surfaces, settings);
    ASSERT_TRUE(both && one);
    EXPECT_NE(both->slideSd, one->slideSd);
    EXPECT_TRUE(std::isnan(one->expanded(NAN))) << "R that is absent";
}

TEST(RoughnessRepeatability, IsNotKnownWhereNothingWasRepeatedOrAFeatureWasAbsent) {
    auto surfaces = referenceSlides(reference());
    const auto settings = scaledTo(surfaces);
    surfaces[2].slides[1].vStatic = NAN;
    EXPECT_FALSE(roughnessRepeatability(surfaces, settings));
    surfaces.pop_back();
    for (auto& surface : surfaces) surface.slides.resize(1);
    EXPECT_FALSE(roughnessRepeatability(surfaces, settings));
}

}  // namespace
}  // namespace tacto
