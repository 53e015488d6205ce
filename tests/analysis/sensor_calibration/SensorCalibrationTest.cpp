// Reference scales, distances and ranking for slides of known truth, and sensor readings compared with references.
#include <cmath>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/analysis/sensor_calibration/SensorCalibrationJson.h"
#include "core/base/Random.h"
#include "tests/support/Refused.h"

namespace tacto {
namespace {

using testing::HasSubstr;

/// Returns a slide with readings `h` and `v`.
SlideReading slideOf(double h, double v) {
    SlideReading out;
    out.h = h;
    out.hAbs = 2 * h;
    out.vStatic = v;
    out.vDynamic = v / 2;
    out.force_n = 1;
    out.slidingFrames = 100;
    return out;
}

/// Draws slides with log10 of both features around the given means, with standard deviation `sd`.
SlidSurface surfaceOf(Random& random, const char* name, double ra_um, double logH, double logV, double sd, int n = 5) {
    SlidSurface out{name, ra_um, 7 * ra_um, {}};
    for (int i = 0; i < n; ++i) {
        out.slides.push_back(
            slideOf(std::pow(10, logH + sd * random.normal()), std::pow(10, logV + sd * random.normal())));
    }
    return out;
}

SensorRest restOf(double meanSquare) {
    SensorRest out;
    out.levels.taxelBaseline = {1, 2, 3};
    out.levels.taxelFloor = 0.5;
    out.levels.slidingMeanSquare = meanSquare;
    return out;
}

TEST(SensorCalibration, GivesTheScalesOfItsReferences) {
    Random random(1, "sensor");
    const auto found = calibrateSensor({surfaceOf(random, "plastic", 1.6, -1.6, -3.5, 0.02, 20),
                                        surfaceOf(random, "P120", 42, -0.5, -1.3, 0.02, 20)},
                                       {}, restOf(3e-4))
                           .value();
    ASSERT_TRUE(found.accepted) << found.reasons.front();
    const auto& settings = found.settings;
    EXPECT_TRUE(settings.calibrated);
    EXPECT_NEAR(std::log10(settings.h.smooth), -1.6, 0.02);
    EXPECT_NEAR(std::log10(settings.h.rough), -0.5, 0.02);
    EXPECT_NEAR(std::log10(settings.vStatic.smooth), -3.5, 0.02);
    EXPECT_NEAR(std::log10(settings.vStatic.rough), -1.3, 0.02);
    EXPECT_NEAR(std::log10(settings.hAbs.smooth), -1.6 + std::log10(2), 0.02);
    EXPECT_EQ(settings.restMeanSquare, 3e-4);
    EXPECT_EQ(settings.smoothSurface->name, "plastic");
    EXPECT_EQ(settings.roughSurface->ra, Micrometres(42));
    EXPECT_EQ(settings.roughSurface->rz, Micrometres(294));
    EXPECT_NEAR(found.distances[0]->magnitude().value, 1.1 / 0.02, 0.25 * 1.1 / 0.02);
    EXPECT_NEAR(found.surfaces[0].R.mean, 0, 0.02);
    EXPECT_NEAR(found.surfaces[1].R.mean, 1, 0.02);
    EXPECT_FALSE(found.ranking) << "two surfaces";
    // The section is part of a profile and reads back unchanged.
    EXPECT_EQ(roughnessSettingsFromJson(toJson(found)["roughness"]).value(), settings);
}

TEST(SensorCalibration, RefusesSurfacesThatCannotBeToldApartAndChangesNothing) {
    RecordProperty("hazard", "H7");
    int refused = 0;
    for (std::uint64_t seed = 0; seed < 100; ++seed) {
        Random random(seed, "alike");
        const auto found =
            calibrateSensor({surfaceOf(random, "a", 1.6, -1, -2, 0.1), surfaceOf(random, "b", 3, -1, -2, 0.1)}, {},
                            restOf(3e-4))
                .value();
        if (found.accepted) continue;
        ++refused;
        EXPECT_EQ(found.settings, RoughnessSettings{});
        EXPECT_FALSE(found.settings.calibrated);
        EXPECT_THAT(found.reasons.front(), HasSubstr("tell them apart"));
        EXPECT_EQ(toJson(found)["verdict"], "fail");
    }
    EXPECT_EQ(refused, 100);
}

// The feature's scale would come from another rig, and would still affect R when the feature is measured.
TEST(SensorCalibration, AFeatureThatIsMeasuredNowAndThenIsARefusalAndOneThatNeverIsAWarning) {
    RecordProperty("hazard", "H7");
    Random random(4, "now and then");
    std::vector surfaces{surfaceOf(random, "a", 1.6, -1.6, -3.5, 0.02), surfaceOf(random, "b", 42, -0.5, -1.3, 0.02)};
    surfaces[0].slides[0].h = kNaN;
    const auto sometimes = calibrateSensor(surfaces, {}, restOf(3e-4)).value();
    EXPECT_FALSE(sometimes.accepted);
    EXPECT_FALSE(sometimes.settings.calibrated);
    EXPECT_THAT(sometimes.reasons.front(), HasSubstr("h was measured in some slides"));
    for (auto& surface : surfaces)
        for (auto& slide : surface.slides) slide.h = kNaN;
    const auto never = calibrateSensor(surfaces, {}, restOf(3e-4)).value();
    EXPECT_TRUE(never.accepted) << never.reasons.front();
    EXPECT_THAT(never.warnings.front(), HasSubstr("h was absent; R stands on what is left"));
}

TEST(SensorCalibration, AFeatureInUseThatTellsNothingIsARefusalAndOneOutOfUseAWarning) {
    Random random(3, "one feature");
    const std::vector surfaces{surfaceOf(random, "a", 1.6, -1.6, -2, 0.05), surfaceOf(random, "b", 42, -0.5, -2, 0.05)};
    const auto both = calibrateSensor(surfaces, {}, restOf(1e-4)).value();
    EXPECT_FALSE(both.accepted);
    EXPECT_THAT(both.reasons.front(), HasSubstr("v_static"));
    RoughnessSettings spectralOnly;
    spectralOnly.taxelWeight = 0;
    const auto one = calibrateSensor(surfaces, spectralOnly, restOf(1e-4)).value();
    EXPECT_TRUE(one.accepted) << one.reasons.front();
    EXPECT_THAT(one.warnings.front(), HasSubstr("its scale stays as it was"));
    EXPECT_EQ(one.settings.vStatic, kSimulatedVStatic);
}

TEST(SensorCalibration, ARigWithoutTaxelsStandsOnItsAcceleration) {
    Random random(4, "no taxels");
    std::vector surfaces{surfaceOf(random, "a", 1.6, -1.6, -3, 0.05), surfaceOf(random, "b", 42, -0.5, -1, 0.05)};
    for (auto& surface : surfaces) {
        for (auto& slide : surface.slides) slide.vStatic = slide.vDynamic = NAN;
    }
    const auto found = calibrateSensor(surfaces, {}, restOf(NAN)).value();
    EXPECT_TRUE(found.accepted) << found.reasons.front();
    EXPECT_FALSE(found.distances[2]);
    EXPECT_TRUE(toJson(found)["d_prime"]["v"].is_null());
    EXPECT_FALSE(found.settings.restMeanSquare) << "no rest was measured";
}

TEST(SensorCalibration, RanksFiveSurfacesAgainstTheirRa) {
    Random random(5, "ranks");
    const auto at = [&](const char* name, double ra, double place) {
        return surfaceOf(random, name, ra, -1.6 + 1.1 * place, -3.5 + 2.2 * place, 0.005);
    };
    // R ranks c below b: 1 - 6·2 / (5·24) = 0.9.
    const auto found =
        calibrateSensor({at("a", 1, 0), at("e", 40, 1), at("b", 3, 0.4), at("c", 9, 0.2), at("d", 20, 0.8)}, {},
                        restOf(1e-4))
            .value();
    ASSERT_TRUE(found.accepted) << found.reasons.front();
    ASSERT_TRUE(found.ranking);
    EXPECT_NEAR(found.ranking->rho.value, 0.9, 1e-12);
    EXPECT_EQ(found.ranking->n, 5U);
    EXPECT_NEAR(found.surfaces[2].R.mean, 0.4, 0.03);
    EXPECT_EQ(toJson(found)["spearman"]["n"], 5);
}

TEST(SensorCalibration, RefusesReferencesThatAreNone) {
    Random random(6, "references");
    const auto a = surfaceOf(random, "a", 1.6, -1.6, -3, 0.05), b = surfaceOf(random, "b", 42, -0.5, -1, 0.05);
    const auto few = surfaceOf(random, "few", 42, -0.5, -1, 0.05, 2);
    const auto unknown = surfaceOf(random, "unknown", NAN, -0.5, -1, 0.05);
    const std::pair<std::vector<SlidSurface>, const char*> wrong[] = {{{a}, "1 surfaces"},
                                                                      {{a, few}, "2 slides over few"},
                                                                      {{b, a}, "Ra of the rough reference a is 1.6"},
                                                                      {{a, unknown}, "nan"},
                                                                      {{a, b, a}, "surface a is given twice"}};
    for (const auto& [surfaces, message] : wrong) {
        EXPECT_THAT(calibrateSensor(surfaces, {}, restOf(1e-4)), test::refusedSaying(message)) << message;
    }
}

TEST(SensorCalibration, TheReferencesReadWhatTheyAreAssigned) {
    RecordProperty("hazard", "H7");
    // Half of the slides over a reference lie beyond it. Limiting each R to 0..1 would bias the mean inwards.
    for (std::uint64_t seed = 1; seed <= 50; ++seed) {
        Random random(seed, "assigned");
        const auto found = calibrateSensor({surfaceOf(random, "smooth", 1.6, -1.6, -3.5, 0.1),
                                            surfaceOf(random, "rough", 42, -0.5, -1.3, 0.1),
                                            surfaceOf(random, "rougher", 90, -0.2, -0.9, 0.1)},
                                           {}, restOf(3e-4))
                               .value();
        ASSERT_TRUE(found.accepted) << seed;
        EXPECT_NEAR(found.surfaces[0].R.mean, 0, 1e-12);
        EXPECT_NEAR(found.surfaces[1].R.mean, 1, 1e-12);
        EXPECT_LT(found.surfaces[0].R.min, 0);
        EXPECT_GT(found.surfaces[1].R.max, 1);
        const auto shown = toJson(found)["surfaces"];
        EXPECT_NEAR(shown[0]["R"].get<double>(), 0, 1e-12);
        EXPECT_EQ(shown[2]["R"], 1) << "what is shown stays within 0 to 1";
    }
}

std::vector<CalibrationReading> weighed(Random& random, double perNewton, double zero, double noise, int repeats) {
    std::vector<CalibrationReading> out;
    for (int repeat = 0; repeat < repeats; ++repeat) {
        for (const double force : {0.5, 1.0, 2.0, 5.0}) {
            for (const auto way : {SweepDirection::Up, SweepDirection::Down}) {
                out.push_back({force, zero + perNewton * force + noise * random.normal(), way});
            }
        }
    }
    return out;
}

TEST(SensorScale, TurnsReadingsIntoTheReferencesUnit) {
    Random random(8, "weights");
    const auto found = fitSensorScale(weighed(random, 250, 1000, 0, 2), {}, "force").value();
    EXPECT_NEAR(found.scale, 0.004, 1e-12);  // in N per count
    EXPECT_NEAR(found.offset, -4, 1e-9);     // at rest the reading is 1000 counts
    EXPECT_NEAR(found.scaleU, 0, 1e-9);
}

TEST(SensorScale, ItsIntervalsHoldTheTruthIn95OfA100) {
    constexpr int kRuns = 1000;
    Random random(9, "scale coverage");
    int scale = 0, offset = 0;
    for (int run = 0; run < kRuns; ++run) {
        // All weights of a set have the same relative error, within their tolerance.
        const double tolerance = 0.01, off = 1 + tolerance * (2 * random.uniform() - 1);
        const auto found = fitSensorScale(weighed(random, 250 * off, 1000, 10, 3), {tolerance}, "force").value();
        scale += std::abs(found.scale - 0.004) <= found.scaleU ? 1 : 0;
        offset += std::abs(found.offset + 4) <= std::hypot(found.offsetU, 4 * tolerance) ? 1 : 0;
    }
    EXPECT_GE(scale, 930);
    EXPECT_LE(scale, 970);
    EXPECT_GE(offset, 930);
}

TEST(SensorScale, TheOffsetsIntervalIsAsWideAsItShouldBe) {
    constexpr int kRuns = 2000;
    Random random(10, "offset coverage");
    int covered = 0;
    for (int run = 0; run < kRuns; ++run) {
        const auto found = fitSensorScale(weighed(random, 250, 1000, 10, 3), {}, "force").value();
        covered += std::abs(found.offset + 4) <= found.offsetU ? 1 : 0;
    }
    EXPECT_GE(covered, 0.93 * kRuns);
    EXPECT_LE(covered, 0.97 * kRuns);
}

TEST(SensorScale, IsAsUncertainAsItsReferencesAndUnknownWithThem) {
    Random random(11, "tolerance");
    const auto readings = weighed(random, 250, 1000, 0, 2);
    const auto found = fitSensorScale(readings, {0.03}, "taxel 1").value();
    // Rectangular: 95 % lie within 0.95 · 3 % of the scale, and of its offset.
    EXPECT_NEAR(found.scaleU / found.scale, 0.95 * 0.03, 2e-4);
    EXPECT_NEAR(found.offsetU, 4 * 0.95 * 0.03, 1e-3);
    const auto unknown = fitSensorScale(readings, {0.03, NAN}, "taxel 1").value();
    EXPECT_NEAR(unknown.scale, 0.004, 1e-12);
    EXPECT_TRUE(std::isnan(unknown.scaleU)) << "not known is not 0";
    EXPECT_TRUE(std::isnan(unknown.offsetU));
}

TEST(SensorScale, RefusesASensorThatDoesNotFollow) {
    RecordProperty("hazard", "H7");
    Random random(12, "dead");
    EXPECT_THAT(fitSensorScale(weighed(random, 0, 1000, 10, 3), {}, "taxel 3"),
                test::refused(ErrorCode::Device, "taxel 3 does not follow the references"));
    EXPECT_FALSE(fitSensorScale(weighed(random, 250, 0, 1, 1), {1.0}, "force"));
}

}  // namespace
}  // namespace tacto
