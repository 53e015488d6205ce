#include <cmath>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <limits>
#include <nlohmann/json.hpp>

#include "core/dsp/RoughnessSettings.h"

using namespace tacto;
using nlohmann::json;
using testing::HasSubstr;

namespace {

std::string complaintAbout(const json& section) {
    const auto settings = roughnessSettingsFromJson(section);
    EXPECT_FALSE(settings) << section.dump();
    return settings ? "" : settings.error().message;
}

}  // namespace

TEST(RoughnessSettings, DefaultsAreTheTexts) {
    const auto settings = roughnessSettingsFromJson(json::object());
    ASSERT_TRUE(settings);
    EXPECT_EQ(*settings, RoughnessSettings{});
    EXPECT_EQ(settings->spectral, SpectralFeature::Relative);
    EXPECT_EQ(settings->taxel, TaxelFeature::Static);
    EXPECT_EQ(settings->bandLow.value(), 200);
    EXPECT_EQ(settings->smoothing.count(), 0.05);
    EXPECT_EQ(settings->pressureMin.value(), 2000);
    EXPECT_EQ(settings->pressureMax.value(), 50000);
    EXPECT_FALSE(settings->calibrated);
    EXPECT_TRUE(validate(*settings));
}

TEST(RoughnessSettings, SurviveARoundTrip) {
    RoughnessSettings settings;
    settings.spectral = SpectralFeature::Absolute;
    settings.taxel = TaxelFeature::Dynamic;
    settings.bandLow = Hertz(120);
    settings.h = {0.7, 0.1};
    settings.calibrated = true;
    settings.smoothSurface = ReferenceSurface{"glass", Micrometres(0.01), Micrometres(0.08)};
    settings.roughSurface = ReferenceSurface{"P120", Micrometres(25), Micrometres(160)};
    settings.restMeanSquare = 2e-4;
    settings.restUnit = StreamUnit::Count;
    settings.uncertainty = RoughnessUncertainty{0.02, 5, 6, 2.3};
    settings.sensor = SensorScales{
        "B-1", SensorLine{0.004, -4, 1e-5}, StreamUnit::Count, {{2, -100, {}}, {-3, 0, 0.1}}, StreamUnit::Count};
    const auto again = roughnessSettingsFromJson(toJson(settings));
    ASSERT_TRUE(again) << again.error().message;
    EXPECT_EQ(*again, settings);
}

TEST(RoughnessSettings, RefuseUnknownKeysByName) {
    EXPECT_THAT(complaintAbout({{"smoothing", 0.05}}), HasSubstr("\"smoothing\" is not a known key; accepted are"));
    EXPECT_THAT(complaintAbout({{"references", {{"H", 1}}}}),
                HasSubstr("roughness.references: \"H\" is not a known key"));
    EXPECT_THAT(complaintAbout({{"references", {{"h", {{"low", 1}}}}}}), HasSubstr("roughness.references.h"));
}

TEST(RoughnessSettings, RefuseValuesThatMeanNothing) {
    EXPECT_THAT(complaintAbout({{"spectral_feature", "x"}}), HasSubstr("h or h_abs"));
    EXPECT_THAT(complaintAbout({{"taxel_feature", 3}}), HasSubstr("static or dynamic"));
    EXPECT_THAT(complaintAbout({{"band_low_hz", 1000}}), HasSubstr("\"band_low_hz\" is 1000 Hz"));
    EXPECT_THAT(complaintAbout({{"spectral_weight", -1}}), HasSubstr("\"spectral_weight\" is -1"));
    EXPECT_THAT(complaintAbout({{"spectral_weight", 0}, {"taxel_weight", 0}}), HasSubstr("above 0"));
    EXPECT_THAT(complaintAbout({{"smoothing_s", 0}}), HasSubstr("smoothing_s"));
    EXPECT_THAT(complaintAbout({{"contact_area_cm2", "1"}}),
                HasSubstr("\"contact_area_cm2\" is \"1\"; a number above 0 to 10000 cm² was expected"));
    EXPECT_THAT(complaintAbout({{"pressure_min_pa", 5e4}}), HasSubstr("pressure_max_pa"));
    EXPECT_THAT(complaintAbout({{"calibrated", 1}}), HasSubstr("true or false"));
    EXPECT_THAT(complaintAbout({{"rest", {{"unit", "count"}}}}),
                HasSubstr("roughness.rest: \"mean_square\" is missing"));
    EXPECT_THAT(complaintAbout(3), HasSubstr("3 stands where an object is expected"));
    EXPECT_THAT(complaintAbout({{"references", {{"h", {{"smooth", 0.3}, {"rough", 0.3}}}}}}),
                HasSubstr("two different readings"));
    EXPECT_THAT(complaintAbout({{"references", {{"v_static", {{"smooth", 0}, {"rough", 0.3}}}}}}),
                HasSubstr("a number above 0"));
    RoughnessSettings settings;
    settings.smoothing = Seconds(std::numeric_limits<double>::quiet_NaN());
    EXPECT_FALSE(validate(settings));
    settings = {};
    settings.hAbs.rough = std::numeric_limits<double>::infinity();
    EXPECT_FALSE(validate(settings));
}

TEST(RoughnessSettings, ScaleIsLogarithmicAndMayRunDownward) {
    const ReferenceScale up{0.01, 1};
    EXPECT_DOUBLE_EQ(up.g(0.1), 0.5);
    EXPECT_EQ(up.g(0.001), 0);
    EXPECT_EQ(up.g(10), 1);
    const ReferenceScale down{1, 0.01};
    EXPECT_DOUBLE_EQ(down.g(0.1), 0.5);
    EXPECT_EQ(down.g(10), 0);
    EXPECT_TRUE(std::isnan(up.g(0)));
    EXPECT_TRUE(std::isnan(up.g(-1)));
    EXPECT_TRUE(std::isnan(up.g(std::numeric_limits<double>::quiet_NaN())));
}
