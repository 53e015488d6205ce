#include <algorithm>
#include <cmath>
#include <gtest/gtest.h>
#include <map>
#include <numeric>

#include "tests/drivers/NaiveFeatures.h"
#include "tests/drivers/SimBench.h"
#include "tests/support/Refused.h"

namespace tacto::test {
namespace {

using Blocks = std::vector<SampleBlock>;

Blocks slide(const std::string& uri, Seconds duration, Seconds step = Seconds(0.01), std::uint64_t seed = 1) {
    SimBench bench("1 kohm", seed);
    bench.open(uri);
    Blocks blocks(3);
    for (Seconds t(0); t < duration; t += step) {
        bench.wait(std::min(step, duration - t));
        if (const auto read = bench.devices.sensor->read(blocks); !read) ADD_FAILURE() << read.error().message;
    }
    return blocks;
}

std::vector<double> baselineOf(const SampleBlock& taxels, double until_s) {
    std::vector<double> mean(8);
    std::size_t n = 0;
    for (std::size_t i = 0; i < taxels.samples() && taxels.t_s[i] < until_s; ++i, ++n) {
        for (std::size_t c = 0; c < 8; ++c) mean[c] += taxels.values[i * 8 + c];
    }
    for (auto& m : mean) m /= static_cast<double>(n);
    return mean;
}

struct Features {
    std::vector<NaiveFrame> frames;
    double h = 0, v = 0, power = 0, rest = 0, centroid = 0;
    template <class Get>
    double share(const Get& holds) const {
        return static_cast<double>(std::count_if(frames.begin(), frames.end(), holds)) /
               static_cast<double>(frames.size());
    }
};

Features featuresOf(const std::string& uri, Seconds duration = Seconds(6)) {
    const auto blocks = slide(uri, duration);
    const auto baseline = baselineOf(blocks[1], 0.45);
    const auto all = naiveFrames(blocks[0], blocks[1], baseline, 0);
    Features out;
    double resting = 0;
    for (const auto& frame : all) {
        if (frame.t_s < 0.44) {
            out.rest += frame.power;
            ++resting;
        }
        if (frame.t_s > 1) out.frames.push_back(frame);
    }
    out.rest /= resting;
    for (const auto& frame : out.frames) {
        const auto n = static_cast<double>(out.frames.size());
        out.h += frame.h / n;
        out.v += frame.v / n;
        out.power += frame.power / n;
        out.centroid += frame.centroid / n;
    }
    return out;
}

std::string fingerOn(std::string_view material, double force, double speed = 50) {
    return fmt::format("sim:finger?material={}&force={}N&speed={}mm/s&lift=0", material, force, speed);
}

TEST(Finger, FeaturesRankTheReferenceSurfaces) {
    double h = 0, v = 0;
    for (const auto* material : {"glass", "plastic", "paper", "P400", "P120", "P60"}) {
        const auto found = featuresOf(fingerOn(material, 1));
        EXPECT_GT(found.h, 1.15 * h) << material;
        EXPECT_GT(found.v, 1.3 * v) << material;
        h = found.h;
        v = found.v;
    }
}

TEST(Finger, GlassAndP60LieBeyondTheReferencesAtBothEndsOfForce) {
    const auto smooth = featuresOf(fingerOn("plastic", 1));
    const auto rough = featuresOf(fingerOn("P120", 1));
    for (const double force : {0.15, 6.0}) {
        const auto glass = featuresOf(fingerOn("glass", force));
        const auto coarse = featuresOf(fingerOn("P60", force));
        EXPECT_LT(glass.h, 0.4 * smooth.h) << force;
        EXPECT_LT(glass.v, 0.4 * smooth.v) << force;
        EXPECT_GT(coarse.h, 1.4 * rough.h) << force;
        EXPECT_GT(coarse.v, 3 * rough.v) << force;
        EXPECT_GT(glass.share([&](const NaiveFrame& f) { return f.h < smooth.h && f.v < smooth.v; }), 0.97) << force;
        EXPECT_GT(coarse.share([&](const NaiveFrame& f) { return f.h > rough.h; }), 0.93) << force;
        EXPECT_GT(coarse.share([&](const NaiveFrame& f) { return f.v > rough.v; }), 0.93) << force;
    }
}

TEST(Finger, SlidingStandsOutFromRestEvenOnGlassAtALightTouch) {
    const auto glass = featuresOf(fingerOn("glass", 0.15));
    EXPECT_GT(glass.share([&](const NaiveFrame& f) { return f.power > 3 * glass.rest; }), 0.999);
}

TEST(Finger, PressingWithoutSlidingIsAsQuietAsRest) {
    RecordProperty("hazard", "H7");
    const auto still = featuresOf(fingerOn("P60", 6, 0));
    EXPECT_LT(still.share([&](const NaiveFrame& f) { return f.power > 3 * still.rest; }), 0.02);
}

TEST(Finger, FasterSlidingShiftsTheSpectrumUp) {
    // A fine grating on glass: its spatial frequency times the speed gives 40 Hz to 160 Hz.
    const std::string grating = "&grating=1mm&depth=200um&tremor=0";
    double last = 0;
    for (const double speed : {40.0, 80.0, 160.0}) {
        const auto found = featuresOf(fingerOn("plastic", 1, speed) + grating);
        EXPECT_GT(found.centroid, last);
        last = found.centroid;
    }
}

TEST(Finger, TouchesAfterTheRestAndPressesAsAsked) {
    const auto blocks = slide("sim:finger?force=2N&stroke=1s&lift=0.5s", Seconds(4));
    const auto& force = blocks[2];
    double sum = 0, n = 0;
    for (std::size_t i = 0; i < force.samples(); ++i) {
        const double t = force.t_s[i];
        if (t < 0.5) {
            EXPECT_LT(std::abs(force.values[i]), 0.02) << t;
        }
        if (t > 0.8 && t < 1.5) {
            sum += force.values[i];
            ++n;
        }
        if (t > 1.8 && t < 2.0) {
            EXPECT_LT(std::abs(force.values[i]), 0.02) << "lifted, at " << t;
        }
        if (t > 2.3 && t < 3.0) {
            EXPECT_GT(force.values[i], 1.5) << "the next stroke, at " << t;
        }
    }
    EXPECT_NEAR(sum / n, 2, 0.1);
}

TEST(Finger, TrembleAtEightToTwelveHertz) {
    const auto blocks = slide("sim:finger?force=2N&lift=0&tremor=2", Seconds(20), Seconds(0.1));
    const auto& force = blocks[2].values;
    const std::size_t from = 300;
    double mean = 0;
    for (std::size_t i = from; i < force.size(); ++i) mean += force[i];
    mean /= static_cast<double>(force.size() - from);
    std::map<int, double> power;  // power per hertz
    for (int tenth = 20; tenth < 300; tenth += 2) {
        double re = 0, im = 0;
        for (std::size_t i = from; i < force.size(); ++i) {
            const double phase = 2 * std::numbers::pi * tenth * 0.1 * static_cast<double>(i) / 200;
            re += (force[i] - mean) * std::cos(phase);
            im += (force[i] - mean) * std::sin(phase);
        }
        power[tenth / 10] += re * re + im * im;
    }
    const double total = std::accumulate(power.begin(), power.end(), 0.0,
                                         [](double sum, const auto& entry) { return sum + entry.second; });
    const double tremor = power[8] + power[9] + power[10] + power[11];
    EXPECT_GT(tremor, 0.6 * total);
}

TEST(Finger, TaxelsShareTheForceOverTheContact) {
    const auto blocks = slide(fingerOn("glass", 4), Seconds(2));
    const auto baseline = baselineOf(blocks[1], 0.45);
    const auto& taxels = blocks[1];
    double mean = 0, n = 0;
    for (std::size_t i = taxels.samples() - 100; i < taxels.samples(); ++i) {
        for (std::size_t c = 0; c < 8; ++c) mean += taxels.values[i * 8 + c] - baseline[c];
        n += 8;
    }
    EXPECT_NEAR(mean / n, 4 / 1e-4, 0.1 * 4 / 1e-4);  // contact area 1 cm²
}

TEST(Finger, SameSeedSameBytesAndAnotherSeedOthers) {
    const auto a = slide("sim:finger?material=P60", Seconds(2));
    const auto b = slide("sim:finger?material=P60", Seconds(2));
    const auto other = slide("sim:finger?material=P60", Seconds(2), Seconds(0.01), 2);
    for (std::size_t i = 0; i < 3; ++i) {
        EXPECT_EQ(a[i].values, b[i].values);
        EXPECT_EQ(a[i].t_s, b[i].t_s);
    }
    EXPECT_NE(a[0].values, other[0].values);
    EXPECT_NE(a[1].values, other[1].values);
}

TEST(Finger, SamplesDoNotDependOnHowOftenTheyAreRead) {
    for (const auto* uri : {"sim:finger?material=P60", "sim:finger?material=P60&rate=500&taxelrate=100",
                            "sim:finger?dropouts=0.05&fault=nan@0.7s..0.8s&fault=stuck@1s&fault=drift@0.6s"}) {
        const auto often = slide(uri, Seconds(2), Seconds(0.0013));
        const auto once = slide(uri, Seconds(2), Seconds(2));
        for (std::size_t i = 0; i < 3; ++i) {
            ASSERT_EQ(often[i].t_s, once[i].t_s) << uri;
            ASSERT_EQ(often[i].values.size(), once[i].values.size());
            for (std::size_t k = 0; k < once[i].values.size(); ++k) {
                const double x = often[i].values[k], y = once[i].values[k];
                ASSERT_TRUE(x == y || (std::isnan(x) && std::isnan(y))) << uri << " value " << k;
            }
        }
    }
}

TEST(Finger, PresentingActsAtItsMomentHoweverLateTheReading) {
    const auto run = [](bool readInBetween) {
        SimBench bench;
        bench.open("sim:finger");
        Blocks blocks(3);
        const auto step = [&](double s) {
            bench.wait(Seconds(s));
            if (readInBetween) {
                EXPECT_TRUE(bench.devices.sensor->read(blocks).has_value());
            }
        };
        step(0.1);
        EXPECT_TRUE(bench.devices.surface->present("glass", MillimetresPerSecond(50), Newtons(0.5)).has_value());
        step(1.5);
        EXPECT_TRUE(bench.devices.surface->present("P60", MillimetresPerSecond(80), Newtons(3)).has_value());
        step(1.0);
        EXPECT_TRUE(bench.devices.surface->present("", MillimetresPerSecond(0), Newtons(0)).has_value());
        step(1.0);
        EXPECT_TRUE(bench.devices.sensor->read(blocks).has_value());
        return blocks;
    };
    const auto often = run(true), once = run(false);
    EXPECT_EQ(often[0].values, once[0].values);
    EXPECT_EQ(often[2].values, once[2].values);
    const auto& force = once[2];
    const auto at = [&](double t) { return force.values[static_cast<std::size_t>(t * 200)]; };
    EXPECT_LT(std::abs(at(0.45)), 0.02);  // at rest first, for the baseline
    EXPECT_NEAR(at(1.5), 0.5, 0.1);
    EXPECT_LT(std::abs(at(1.83)), 0.05);  // lifted between the two materials
    EXPECT_NEAR(at(2.5), 3, 0.5);
    EXPECT_LT(std::abs(at(3.5)), 0.02);
}

TEST(Finger, PresentRefusesWhatNoFingerCanDo) {
    SimBench bench;
    bench.open("sim:finger");
    auto& rig = *bench.devices.surface;
    EXPECT_THAT(rig.present("velvet", MillimetresPerSecond(50), Newtons(1)),
                refusedSaying(testing::AllOf(testing::HasSubstr("velvet"), testing::HasSubstr("P120"))));
    const double nan = std::nan("");
    EXPECT_FALSE(rig.present("glass", MillimetresPerSecond(-1), Newtons(1)).has_value());
    EXPECT_FALSE(rig.present("glass", MillimetresPerSecond(nan), Newtons(1)).has_value());
    EXPECT_FALSE(rig.present("glass", MillimetresPerSecond(50), Newtons(nan)).has_value());
    EXPECT_FALSE(rig.present("glass", MillimetresPerSecond(50), Newtons(1e9)).has_value());
}

TEST(Finger, QuantisesAndClipsAsItsConverterDoes) {
    const auto blocks = slide("sim:finger?material=P60&force=6N&bits=8&range=2g&lift=0", Seconds(2));
    const double lsb = 4 * 9.80665 / 256;
    double largest = 0;
    for (const double a : blocks[0].values) {
        EXPECT_NEAR(a / lsb, std::round(a / lsb), 1e-6);
        largest = std::max(largest, std::abs(a));
    }
    EXPECT_LE(largest, 2 * 9.80665 + lsb);
}

// --- faults ---------------------------------------------------------------------------------------------------------

TEST(FingerFaults, StaleStopsTheSamplesWithoutAnError) {
    RecordProperty("hazard", "H7");
    const auto blocks = slide("sim:finger?fault=stale@1s", Seconds(3));
    for (const auto& block : blocks) EXPECT_LT(block.t_s.back(), 1.0);
}

TEST(FingerFaults, StaleAndBack) {
    const auto blocks = slide("sim:finger?fault=stale@1s..2s", Seconds(3));
    const auto& t = blocks[0].t_s;
    EXPECT_GT(t.back(), 2.9);
    double gap = 0;
    for (std::size_t i = 1; i < t.size(); ++i) gap = std::max(gap, t[i] - t[i - 1]);
    EXPECT_NEAR(gap, 1, 0.01);
}

TEST(FingerFaults, UnplugIsAnErrorFromItsTimeOn) {
    SimBench bench;
    bench.open("sim:finger?fault=unplug@1s");
    Blocks blocks(3);
    bench.wait(Seconds(0.99));
    EXPECT_TRUE(bench.devices.sensor->read(blocks).has_value());
    bench.wait(Seconds(0.02));
    EXPECT_THAT(bench.devices.sensor->read(blocks), refused(ErrorCode::Device));
}

TEST(FingerFaults, GarbageIsAnErrorWhileItLasts) {
    SimBench bench;
    bench.open("sim:finger?fault=garbage@1s..2s");
    Blocks blocks(3);
    bench.wait(Seconds(1.5));
    EXPECT_FALSE(bench.devices.sensor->read(blocks).has_value());
    bench.wait(Seconds(1));
    EXPECT_TRUE(bench.devices.sensor->read(blocks).has_value());
}

TEST(FingerFaults, NanReachesTheReader) {
    const auto blocks = slide("sim:finger?fault=nan@1s", Seconds(2));
    for (const auto& block : blocks) {
        EXPECT_FALSE(std::isnan(block.values.front()));
        EXPECT_TRUE(std::isnan(block.values.back()));
    }
}

TEST(FingerFaults, StuckRepeatsTheLastValue) {
    const auto blocks = slide("sim:finger?fault=stuck@1s", Seconds(3));
    const auto& a = blocks[0];
    for (std::size_t i = 4010; i < a.samples(); ++i) ASSERT_EQ(a.values[3 * i], a.values[3 * i - 3]);
    EXPECT_GT(a.t_s.back(), 2.9);
}

TEST(FingerFaults, DriftMovesForceAway) {
    const auto good = slide("sim:finger?lift=0", Seconds(5));
    const auto bad = slide("sim:finger?lift=0&fault=drift@1s", Seconds(5));
    EXPECT_NEAR(bad[2].values.back() - good[2].values.back(), 0.2, 0.02);
}

TEST(FingerFaults, DropoutLosesPacketsButNotOrder) {
    const auto blocks = slide("sim:finger?fault=dropout@0s", Seconds(5));
    const auto& t = blocks[0].t_s;
    EXPECT_NEAR(static_cast<double>(t.size()), 0.7 * 20'000, 0.07 * 20'000);
    EXPECT_TRUE(std::is_sorted(t.begin(), t.end()));
}

TEST(FingerFaults, LateSamplesComeTwoTenthsLate) {
    const auto blocks = slide("sim:finger?fault=late", Seconds(2));
    EXPECT_NEAR(blocks[0].t_s.back(), 1.8, 0.01);
}

}  // namespace
}  // namespace tacto::test
