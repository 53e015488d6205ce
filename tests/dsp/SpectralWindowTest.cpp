// Windows compared with their published figures, and levels measured through them.
#include <cmath>
#include <gtest/gtest.h>

#include "core/base/Random.h"
#include "core/dsp/PowerSpectrum.h"

namespace tacto::test {
namespace {

TEST(SpectralWindow, HasThePublishedNoiseBandwidth) {
    const auto bandwidth = [](SpectralWindow window) { return equivalentNoiseBandwidth(samplesOf(window, 4096)); };
    EXPECT_NEAR(bandwidth(SpectralWindow::Rectangular), 1, 1e-12);
    EXPECT_NEAR(bandwidth(SpectralWindow::Hann), 1.5, 1e-9);
    EXPECT_NEAR(bandwidth(SpectralWindow::BlackmanHarris), 2.0044, 1e-4);
    EXPECT_NEAR(bandwidth(SpectralWindow::FlatTop), 3.7702, 1e-4);
    EXPECT_EQ(samplesOf(SpectralWindow::Hann, 64), hannWindow(64));
    EXPECT_EQ(mainLobe(SpectralWindow::Rectangular), 1U);
    EXPECT_EQ(mainLobe(SpectralWindow::Hann), 2U);
    EXPECT_EQ(mainLobe(SpectralWindow::FlatTop), 5U);
}

/// Returns the RMS of the highest line for a sine of 2 V RMS at position `bin`.
double levelOf(SpectralWindow window, double bin) {
    constexpr std::size_t kLength = 2048;
    auto shape = samplesOf(window, kLength);
    const double bandwidth = equivalentNoiseBandwidth(shape);
    PowerSpectrum spectrum(std::move(shape), 1, 1);
    std::vector<double> sine(kLength);
    for (std::size_t i = 0; i < kLength; ++i) {
        sine[i] = 2 * std::sqrt(2.0) * std::sin(2 * M_PI * bin * static_cast<double>(i) / kLength);
    }
    const double* axis = sine.data();
    spectrum.transform({&axis, 1});
    double most = 0;
    for (std::size_t k = 1; k < kLength / 2; ++k) most = std::max(most, spectrum.density(k));
    return std::sqrt(most * spectrum.binWidth_hz() * bandwidth);
}

TEST(SpectralWindow, ASineHasItsLevelAsFarAsTheWindowPromises) {
    for (const auto window : kSpectralWindows) EXPECT_NEAR(levelOf(window, 200), 2, 1e-6) << nameOf(window);
    const auto decibels = [](double level) { return 20 * std::log10(level / 2); };
    // Half-way between two bins: the scalloping losses in Harris's table.
    EXPECT_NEAR(decibels(levelOf(SpectralWindow::Rectangular, 200.5)), -3.92, 0.02);
    EXPECT_NEAR(decibels(levelOf(SpectralWindow::Hann, 200.5)), -1.42, 0.01);
    EXPECT_NEAR(decibels(levelOf(SpectralWindow::BlackmanHarris, 200.5)), -0.83, 0.01);
    EXPECT_NEAR(decibels(levelOf(SpectralWindow::FlatTop, 200.5)), 0, 0.012);
}

TEST(SpectralWindow, NoiseHasTheSameDensityThroughEach) {
    constexpr std::size_t kLength = 1 << 15;
    Random random(5, "window noise");
    std::vector<double> noise(kLength);
    for (auto& x : noise) x = random.normal();
    const double* axis = noise.data();
    for (const auto window : kSpectralWindows) {
        PowerSpectrum spectrum(samplesOf(window, kLength), 1, 1);
        spectrum.transform({&axis, 1});
        EXPECT_NEAR(spectrum.power({16, kLength / 2 - 16}), 1, 0.06) << nameOf(window);
    }
}

TEST(SpectralPeaks, AreWhereTheLinesAreHighestFirst) {
    std::vector<double> level(1000, 1e-3);
    const auto line = [&](double at, double height) {
        for (std::size_t k = 0; k < level.size(); ++k) {
            level[k] += height * std::exp(-std::pow((static_cast<double>(k) - at) / 1.2, 2));
        }
    };
    line(100.3, 1);
    line(300, 4);
    line(305, 0.2);  // a line next to a larger one
    line(700.5, 0.5);
    line(900, 1e-3);  // a line within the noise
    const auto peaks = spectralPeaks(level, 8, 10, 5);
    ASSERT_EQ(peaks.size(), 3U);
    EXPECT_NEAR(peaks[0].bin, 300, 0.02);
    EXPECT_NEAR(peaks[0].level, 4, 0.01);
    EXPECT_NEAR(peaks[1].bin, 100.3, 0.05);
    EXPECT_NEAR(peaks[2].bin, 700.5, 0.1);
    EXPECT_EQ(spectralPeaks(level, 8, 10, 2).size(), 2U);
    EXPECT_TRUE(spectralPeaks(std::vector<double>(100, 1.0), 3, 10, 5).empty()) << "a plain has no peak";
    EXPECT_TRUE(spectralPeaks(std::vector<double>(2, 1.0), 3, 1, 5).empty());
}

}  // namespace
}  // namespace tacto::test
