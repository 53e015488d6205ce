#include <array>
#include <cmath>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>
#include <vector>

#include "core/base/Random.h"
#include "core/dsp/Butterworth.h"
#include "tests/support/Figures.h"

using namespace tacto;

namespace {

struct Designed {
    double low, high, rate;
    double gain;              // b[0]
    std::array<double, 4> a;  // a1..a4
};
/// Reads the reference filters of tests/reference/butterworth.py.
std::vector<Designed> scipys() {
    std::vector<Designed> out;
    for (const auto& made : test::figuresOf("butterworth").at("filters"))
        out.push_back({made.at("low"), made.at("high"), made.at("rate"), made.at("b0"), made.at("a")});
    return out;
}

std::vector<double> filtered(AxesBandpass& filter, const std::vector<double>& x, std::size_t axes) {
    std::vector<std::vector<double>> out(axes, std::vector<double>(x.size() / axes));
    std::vector<double*> pointers;
    for (auto& axis : out) pointers.push_back(axis.data());
    filter.process(x.data(), x.size() / axes, pointers);
    std::vector<double> flat;
    for (const auto& axis : out) flat.insert(flat.end(), axis.begin(), axis.end());
    return flat;
}

}  // namespace

TEST(Butterworth, HasScipysCoefficients) {
    for (const auto& known : scipys()) {
        const auto s = butterworthBandpass(known.low, known.high, known.rate);
        const auto& p = s[0].a;
        const auto& q = s[1].a;
        EXPECT_NEAR(s[0].b[0] * s[1].b[0], known.gain, 1e-12 * known.gain) << known.rate;
        EXPECT_NEAR(p[0] + q[0], known.a[0], 1e-12) << known.rate;
        EXPECT_NEAR(p[1] + q[1] + p[0] * q[0], known.a[1], 1e-12);
        EXPECT_NEAR(p[0] * q[1] + p[1] * q[0], known.a[2], 1e-12);
        EXPECT_NEAR(p[1] * q[1], known.a[3], 1e-12);
    }
}

TEST(Butterworth, FollowsTheDifferenceEquation) {
    Random random(3, "filter");
    for (const auto& known : scipys()) {
        std::vector<double> x;
        for (int i = 0; i < 3000; ++i) x.push_back(5 + random.normal());
        AxesBandpass filter(known.low, known.high, known.rate, 1);
        filter.restart(x.data());
        const auto y = filtered(filter, x, 1);
        // Before the start, the filter is in its steady state: every x equals x[0] and every y is 0.
        std::vector<double> direct(x.size());
        for (std::size_t n = 0; n < x.size(); ++n) {
            const auto past = [&](std::size_t k) { return n >= k ? x[n - k] : x[0]; };
            direct[n] = known.gain * (past(0) - 2 * past(2) + past(4));
            for (std::size_t k = 1; k <= 4; ++k) direct[n] -= known.a[k - 1] * (n >= k ? direct[n - k] : 0);
            ASSERT_NEAR(y[n], direct[n], 1e-7) << "sample " << n << " at " << known.rate;
        }
    }
}

TEST(Butterworth, AnOffsetMakesNoTransient) {
    AxesBandpass filter(5, 1000, 4000, 3);
    const std::vector<double> x = [] {
        std::vector<double> out;
        for (int i = 0; i < 1000; ++i) out.insert(out.end(), {9.81, -1e4, 3e-5});
        return out;
    }();
    filter.restart(x.data());
    for (const double y : filtered(filter, x, 3)) ASSERT_NEAR(y, 0, 1e-8);
}

TEST(Butterworth, FiltersEachAxisAsIfItWereAlone) {
    Random random(4, "axes");
    for (const std::size_t axes : {1U, 2U, 3U}) {
        std::vector<double> x;
        for (std::size_t i = 0; i < 500 * axes; ++i) x.push_back(random.normal());
        AxesBandpass together(5, 1000, 4000, axes);
        together.restart(x.data());
        const auto all = filtered(together, x, axes);
        for (std::size_t a = 0; a < axes; ++a) {
            std::vector<double> one;
            for (std::size_t i = 0; i < 500; ++i) one.push_back(x[i * axes + a]);
            AxesBandpass alone(5, 1000, 4000, 1);
            alone.restart(one.data());
            const auto y = filtered(alone, one, 1);
            for (std::size_t i = 0; i < 500; ++i) ASSERT_EQ(y[i], all[a * 500 + i]);
        }
    }
}
