// The figures of a fingertip: a known weight, the scales of force and taxels, and R (roughness) of a slide.
#include <cmath>
#include <fmt/format.h>
#include <gtest/gtest.h>
#include <stdexcept>

#include "core/analysis/sensor_calibration/SensorCalibration.h"
#include "core/analysis/sensor_calibration/SensorReading.h"
#include "core/analysis/statistics/UncertaintyBudget.h"
#include "core/base/Random.h"
#include "tests/coverage/CoverageTable.h"
#include "tests/drivers/SimBench.h"

namespace tacto::test {
namespace {

/// Mass and local gravity, drawn within their stated uncertainties.
struct Weights {
    double mass = 0.01, gravity = 0.003;
    double truth = 1;  ///< true weight divided by nominal weight
};

Weights drawnWeights(Random& random) {
    Weights out;
    const auto within = [&random](double halfWidth) { return halfWidth * (2 * random.uniform() - 1); };
    out.truth = (1 + within(out.mass)) * (1 + within(out.gravity));
    return out;
}

/// Returns samples of a simulated finger under a weight, for 2 s.
SensorSamples pressed(SimBench& bench, double newtons) {
    if (const auto put =
            bench.devices.surface->present(newtons > 0 ? "glass" : "", MillimetresPerSecond(0), Newtons(newtons));
        !put)
        throw std::runtime_error(put.error().message);
    std::vector<SampleBlock> settling(3);
    bench.wait(Seconds(1.5));
    static_cast<void>(bench.devices.sensor->read(settling));
    SensorSamples out;
    out.streams.assign(bench.devices.sensor->streams().begin(), bench.devices.sensor->streams().end());
    out.blocks.resize(3);
    bench.wait(Seconds(2));
    static_cast<void>(bench.devices.sensor->read(out.blocks));
    return out;
}

TEST(Coverage, KnownWeight) {
    RecordProperty("hazard", "H9");
    CoverageTable table;
    for (std::uint64_t seed = 1; seed <= coverageRuns(); ++seed) {
        Random random(seed, "weights");
        const auto weights = drawnWeights(random);
        const double gain = 1 + 0.1 * (2 * random.uniform() - 1), reference_n = 2;
        SimBench bench("1 kohm", seed);
        bench.open(fmt::format("sim:finger?rate=400Hz&forcegain={}", gain));
        const auto rest = pressed(bench, 0), under = pressed(bench, reference_n * weights.truth);
        WeightReading reading{.mass_g = 200, .reference_n = reference_n};
        reading.inUse = ForceInUse{levelOf(under, StreamKind::Force).mean, StreamUnit::Newton,
                                   meanUncertainty(under, StreamKind::Force)};
        const ForceInUse atRest{levelOf(rest, StreamKind::Force).mean, StreamUnit::Newton,
                                meanUncertainty(rest, StreamKind::Force)};
        const auto off = weightError(reading, atRest, weights.mass, weights.gravity);
        // How much the reading exceeds the true weight, as a share of the nominal weight.
        const double truth = gain * weights.truth - weights.truth;
        table.add("error of a known weight", truth, off.value / reference_n, off.expanded / reference_n);
    }
    table.judge("fingertip");
}

TEST(Coverage, ScaleOfForceAndTaxels) {
    CoverageTable table;
    for (std::uint64_t seed = 1; seed <= coverageRuns(); ++seed) {
        for (const double noise : {0.001, 0.05}) {
            Random random(seed, "scale");
            const auto weights = drawnWeights(random);
            const double perNewton = 250 * (1 + 0.1 * random.normal()), zero = 100 * random.normal();
            std::vector<CalibrationReading> readings;
            for (int repeat = 0; repeat < 3; ++repeat) {
                for (const auto way : {SweepDirection::Up, SweepDirection::Down}) {
                    for (const double newtons : {0.2, 0.5, 1.0, 2.0, 5.0}) {
                        const double truth = newtons * weights.truth;
                        readings.push_back({newtons, zero + perNewton * (truth + noise * random.normal()), way});
                    }
                }
            }
            const auto found = fitSensorScale(readings, {weights.mass, weights.gravity}, "force").value();
            const auto scatter = noise < 0.01 ? std::string() : ", where readings scatter";
            table.add("scale" + scatter, 1 / perNewton, found.scale, found.scaleU);
            table.add("offset" + scatter, -zero / perNewton, found.offset, found.offsetU);
        }
    }
    table.judge("fingertip");
}

/// log10 of the features h and v of a surface, in the long run.
struct SurfaceTruth {
    double h, v, ra_um;
};
constexpr SurfaceTruth kSmooth{-1.6, -3.5, 1.6}, kMiddle{-1.05, -2.4, 10}, kRough{-0.5, -1.3, 42};

SlideReading slideOver(Random& random, const SurfaceTruth& surface) {
    constexpr double kScatter = 0.06;
    SlideReading out;
    const double shared = 0.5 * kScatter * random.normal();  // the features of one slide vary together
    out.h = std::pow(10, surface.h + shared + kScatter * random.normal());
    out.vStatic = std::pow(10, surface.v + shared + kScatter * random.normal());
    out.hAbs = 2 * out.h;
    out.vDynamic = out.vStatic / 2;
    out.force_n = 1;
    out.slidingFrames = 100;
    return out;
}

TEST(Coverage, RoughnessOfASlide) {
    RecordProperty("hazard", "H7");
    CoverageTable table;
    for (std::uint64_t seed = 1; seed <= 4 * coverageRuns(); ++seed) {
        Random random(seed, "slides");
        std::vector<SlidSurface> surfaces;
        for (const auto& [name, truth] : {std::pair("smooth", kSmooth), {"rough", kRough}, {"middle", kMiddle}}) {
            surfaces.push_back({name, truth.ra_um, 7 * truth.ra_um, {}});
            for (int slide = 0; slide < 5; ++slide) surfaces.back().slides.push_back(slideOver(random, truth));
        }
        const auto found = calibrateSensor(surfaces, {}, {}).value();
        ASSERT_TRUE(found.accepted && found.uncertainty) << seed;
        // One more slide. The references read their assigned R; halfway between them in both features, R is 0.5.
        for (const auto& [name, truth, R] : {std::tuple("R over the smooth reference", kSmooth, 0.0),
                                             {"R over the rough reference", kRough, 1.0},
                                             {"R over a surface between", kMiddle, 0.5}}) {
            const double read = roughnessOf(slideOver(random, truth), found.settings);
            table.add(name, R, read, found.uncertainty->expanded(R));
        }
    }
    table.judge("fingertip");
}

}  // namespace
}  // namespace tacto::test
