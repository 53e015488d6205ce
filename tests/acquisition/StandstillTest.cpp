#include <cmath>
#include <gtest/gtest.h>
#include <random>

#include "core/acquisition/Standstill.h"

namespace tacto::test {
namespace {

/// What a sensor with that noise, in steps, says at rest.
SampleBlock samples(std::mt19937& draw, double begin_s, double rate_hz, std::size_t count, double noiseInSteps) {
    SampleBlock block;
    std::normal_distribution<double> noise(0, noiseInSteps);
    for (std::size_t i = 0; i < count; ++i) {
        block.t_s.push_back(begin_s + static_cast<double>(i) / rate_hz);
        block.values.push_back(std::round(noise(draw)));
    }
    return block;
}

TEST(Standstill, OfASensorAtRestIsNoneHoweverCoarseItIs) {
    RecordProperty("hazard", "H7");
    std::mt19937 draw(7);
    for (const double noise : {5.0, 1.0, 0.5, 0.3, 0.2}) {
        Standstill still(1);
        for (int second = 0; second < 20; ++second) {
            const auto block = samples(draw, second, 1000, 1000, noise);
            for (std::size_t i = 0; i < block.t_s.size(); ++i) {
                SampleBlock one;
                one.t_s.push_back(block.t_s[i]);
                one.values.push_back(block.values[i]);
                still.feed(one);
                ASSERT_FALSE(still.since()) << noise << " steps of noise, at " << block.t_s[i];
            }
        }
    }
}

TEST(Standstill, IsFoundWithinTheTimeThatNoiseAllows) {
    RecordProperty("hazard", "H7");
    std::mt19937 draw(8);
    for (const double noise : {5.0, 1.0, 0.5, 0.3}) {
        Standstill still(1);
        still.feed(samples(draw, 0, 1000, 3000, noise));
        const double held = std::round(noise);
        double found_s = NAN;
        for (int i = 0; i < 3000 && std::isnan(found_s); ++i) {
            SampleBlock one;
            one.t_s.push_back(3 + i * 1e-3);
            one.values.push_back(held);
            still.feed(one);
            if (still.since()) found_s = i * 1e-3;
        }
        // By the share of repeats that this noise has: at 0.3 steps nine in ten.
        EXPECT_LE(found_s, noise >= 0.5 ? 0.15 : 0.4) << noise;
        EXPECT_GE(found_s, 0.09) << noise;
        EXPECT_NEAR(*still.since(), 3, 0.1);
        SampleBlock other;
        other.t_s.push_back(6.5);
        other.values.push_back(held + 1);
        still.feed(other);
        EXPECT_FALSE(still.since()) << "it moves again";
    }
}

TEST(Standstill, OfOneThatNeverMovedIsFoundToo) {
    RecordProperty("hazard", "H7");
    Standstill still(3);
    SampleBlock block;
    for (int i = 0; i < 40; ++i) {
        block.t_s.push_back(i * 0.005);
        block.values.insert(block.values.end(), {0, 0, 9.81});
    }
    still.feed(block);
    EXPECT_TRUE(still.since());
}

}  // namespace
}  // namespace tacto::test
