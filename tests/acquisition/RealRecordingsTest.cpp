#include <complex>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>
#include <numbers>

#include "core/acquisition/Recording.h"
#include "tests/support/Figures.h"
#include "tests/support/Support.h"

using namespace tacto;
using tacto::test::figuresOf;
using tacto::test::kNoSharedData;
using tacto::test::sharedData;

namespace {

/// Returns the power of all taxels at one frequency, with a Hann window, by the definition of the Fourier transform.
double powerAt(const RecordedStream& stream, double f_hz) {
    const auto& t = stream.samples.t_s;
    const std::size_t n = t.size();
    const double length = t.back() - t.front();
    std::vector<std::complex<double>> wave(n);
    for (std::size_t i = 0; i < n; ++i) {
        const double phase = 2 * std::numbers::pi * (t[i] - t.front());
        wave[i] = (0.5 - 0.5 * std::cos(phase / length)) * std::polar(1.0, -phase * f_hz);
    }
    double power = 0;
    for (std::size_t c = 0; c < stream.info.channels; ++c) {
        double mean = 0;
        for (std::size_t i = 0; i < n; ++i) mean += stream.samples.values[i * stream.info.channels + c];
        mean /= static_cast<double>(n);
        std::complex<double> sum = 0;
        for (std::size_t i = 0; i < n; ++i) {
            sum += (stream.samples.values[i * stream.info.channels + c] - mean) * wave[i];
        }
        power += std::norm(sum);
    }
    return power;
}

}  // namespace

TEST(RealRecordings, BioTacSlidesOpenAsTheyAre) {
    const auto folder = sharedData("biotac");
    if (!folder) GTEST_SKIP() << kNoSharedData;
    for (const auto& numpy : figuresOf("real_slides").at("biotac")) {
        const auto recording = Recording::open(*folder / numpy.at("name").get<std::string>());
        ASSERT_TRUE(recording) << recording.error().message;
        EXPECT_NEAR(recording->find(StreamKind::Acceleration)->info.rate_hz, numpy.at("rate_hz").get<double>(), 1e-6)
            << "the median of its printed steps says 2197.8";
        EXPECT_EQ(recording->find(StreamKind::Acceleration)->info.unit, StreamUnit::Count);
        EXPECT_TRUE(recording->find(StreamKind::Acceleration)->health.continuous());
        EXPECT_NEAR(recording->find(StreamKind::Taxels)->info.rate_hz, numpy.at("taxel_rate_hz").get<double>(), 1e-6);
        EXPECT_EQ(recording->find(StreamKind::Taxels)->info.channels, 19U);
        EXPECT_GT(recording->find(StreamKind::Force)->health.gaps, 50U) << "force comes in bursts";
    }
}

TEST(RealRecordings, HapmatIsGravitiesAtAHundredHertz) {
    const auto file = sharedData("hapmat/Fabric.json");
    if (!file) GTEST_SKIP() << kNoSharedData;
    const auto recording = Recording::open(*file);
    ASSERT_TRUE(recording) << recording.error().message;
    const auto& stream = recording->streams.at(0);
    const auto& numpy = figuresOf("real_slides").at("stick");
    EXPECT_EQ(stream.samples.samples(), numpy.at("samples").get<std::size_t>())
        << "the blank last line is not a sample";
    EXPECT_NEAR(stream.info.rate_hz, numpy.at("rate_hz").get<double>(), 1e-9);
    EXPECT_DOUBLE_EQ(stream.samples.values[0], -0.000542 * 9.80665);
}

// The grating's period does not depend on the sliding speed, so the line is at speed / period.
TEST(RealRecordings, FabricSlideShowsTheGratingAtEverySpeed) {
    const auto folder = sharedData("fabric_slide");
    if (!folder) GTEST_SKIP() << kNoSharedData;
    for (const auto& numpy : figuresOf("real_slides").at("grating")) {
        const auto speed_mmps = numpy.at("speed_mmps").get<double>();
        const auto recording = Recording::open(*folder / fmt::format("Board2mm_F120_V-{}mmps_0.json", speed_mmps));
        ASSERT_TRUE(recording) << recording.error().message;
        const auto& stream = recording->streams.at(0);
        EXPECT_NEAR(stream.info.rate_hz, numpy.at("taxel_rate_hz").get<double>(), 1e-6);
        double best_hz = 0;
        double best = 0;
        for (double f = 0.15 * speed_mmps; f < 0.45 * speed_mmps; f += 0.003 * speed_mmps) {
            const double power = powerAt(stream, f);
            if (power > best) {
                best = power;
                best_hz = f;
            }
        }
        EXPECT_NEAR(speed_mmps / best_hz, numpy.at("period_mm").get<double>(), 0.06) << "at " << speed_mmps << " mm/s";
    }
}

TEST(RealRecordings, TheShippedExampleOpensAndCarriesItsLicence) {
    const auto folder = tacto::test::sourceDir() / "resources/examples/linen-slide";
    const auto recording = Recording::open(folder);
    ASSERT_TRUE(recording) << recording.error().message;
    EXPECT_EQ(recording->licence, "MIT");
    EXPECT_TRUE(std::filesystem::exists(folder / "LICENSE"));
    EXPECT_EQ(recording->streams.at(0).samples.samples(), 1059U);
    EXPECT_TRUE(recording->streams.at(0).health.continuous());
}
