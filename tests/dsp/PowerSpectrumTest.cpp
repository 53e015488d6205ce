#include <cmath>
#include <complex>
#include <gtest/gtest.h>
#include <numbers>

#include "core/base/Random.h"
#include "core/dsp/PowerSpectrum.h"

using namespace tacto;

namespace {

std::vector<double> noise(std::size_t count) {
    Random random(5, "spectrum");
    std::vector<double> x(count);
    for (auto& value : x) value = random.normal();
    return x;
}

/// Computes the density by its definition, one bin at a time.
double directDensity(const std::vector<std::vector<double>>& axes, double rate, std::size_t k) {
    const std::size_t n = axes[0].size();
    double energy = 0;
    double sum = 0;
    for (std::size_t i = 0; i < n; ++i) {
        const double w = 0.5 * (1 - std::cos(2 * std::numbers::pi * static_cast<double>(i) / static_cast<double>(n)));
        energy += w * w;
    }
    for (const auto& axis : axes) {
        std::complex<double> x = 0;
        for (std::size_t i = 0; i < n; ++i) {
            const double angle = 2 * std::numbers::pi * static_cast<double>(i) / static_cast<double>(n);
            x += axis[i] * 0.5 * (1 - std::cos(angle)) * std::polar(1.0, -angle * static_cast<double>(k));
        }
        sum += std::norm(x);
    }
    const bool single = k == 0 || (n % 2 == 0 && k == n / 2);
    return (single ? 1 : 2) * sum / (rate * energy);
}

}  // namespace

TEST(PowerSpectrum, IsTheFourierSum) {
    for (const std::size_t n : {6U, 64U, 141U, 256U}) {
        const std::vector<std::vector<double>> axes{noise(n), noise(n), noise(n)};
        PowerSpectrum spectrum(n, 3, 4000);
        const double* pointers[] = {axes[0].data(), axes[1].data(), axes[2].data()};
        spectrum.transform(pointers);
        double total = 0;
        for (std::size_t k = 0; k <= n / 2; ++k) {
            const double expected = directDensity(axes, 4000, k);
            EXPECT_NEAR(spectrum.density(k), expected, 1e-12 * (1 + expected)) << n << " bin " << k;
            total += expected * spectrum.binWidth_hz();
        }
        EXPECT_NEAR(spectrum.power({0, n / 2}), total, 1e-9 * total);
        EXPECT_NEAR(spectrum.power({1, 2}), (spectrum.density(1) + spectrum.density(2)) * spectrum.binWidth_hz(),
                    1e-9 * total);
        EXPECT_EQ(spectrum.power({}), 0);
    }
}

TEST(PowerSpectrum, GivesASinesMeanSquare) {
    std::vector<double> x;
    for (int i = 0; i < 256; ++i) x.push_back(3 * std::sin(2 * std::numbers::pi * 250 * i / 4000.0));
    PowerSpectrum spectrum(256, 1, 4000);
    const double* pointers[] = {x.data()};
    spectrum.transform(pointers);
    EXPECT_NEAR(spectrum.power(spectrum.bins(200, 300)), 4.5, 1e-9);
}

TEST(PowerSpectrum, BothEndsOfABandBelongToIt) {
    const PowerSpectrum spectrum(256, 1, 4000);  // 15.625 Hz per bin
    EXPECT_EQ(spectrum.bins(5, 1000).first, 1U);
    EXPECT_EQ(spectrum.bins(5, 1000).last, 64U) << "1 kHz is bin 64";
    EXPECT_EQ(spectrum.bins(203.125, 1000).first, 13U) << "bin 13 is 203.125 Hz";
    EXPECT_TRUE(spectrum.bins(204, 210).empty());
    for (const double rate : {4000 * (1 + 1e-13), 4000 * (1 - 1e-13)}) {
        EXPECT_EQ(PowerSpectrum(256, 1, rate).bins(5, 1000).last, 64U) << "a measured rate rounds";
    }
}

TEST(PowerSpectrum, WhiteNoiseHasEightTenthsOfItsPowerAbove200Hz) {
    double high = 0;
    double whole = 0;
    Random random(6, "white");
    PowerSpectrum spectrum(256, 1, 4000);
    for (int run = 0; run < 400; ++run) {
        std::vector<double> x(256);
        for (auto& value : x) value = random.normal();
        const double* pointers[] = {x.data()};
        spectrum.transform(pointers);
        high += spectrum.power(spectrum.bins(200, 1000));
        whole += spectrum.power(spectrum.bins(5, 1000));
    }
    EXPECT_NEAR(high / whole, 0.8, 0.02);
}
