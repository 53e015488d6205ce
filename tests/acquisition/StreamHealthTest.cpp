#include <bit>
#include <cmath>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <limits>
#include <random>
#include <vector>

#include "core/acquisition/StreamHealth.h"
#include "core/base/Random.h"
#include "tests/support/Trials.h"

using namespace tacto;
using testing::HasSubstr;

namespace {

HealthReport examine(const std::vector<double>& stamps, double rate_hz) {
    StreamHealth health(rate_hz);
    for (const double t : stamps) health.feed(t);
    return health.report();
}

std::vector<double> regular(std::size_t count, double rate_hz, double from = 0) {
    std::vector<double> stamps;
    for (std::size_t i = 0; i < count; ++i) stamps.push_back(from + static_cast<double>(i) / rate_hz);
    return stamps;
}

double printed(double t, double resolution) { return std::round(t / resolution) * resolution; }

}  // namespace

TEST(StreamHealth, FindsNothingInARegularStream) {
    const auto report = examine(regular(1000, 200), 200);
    EXPECT_TRUE(report.continuous());
    EXPECT_EQ(report.samples, 1000U);
    EXPECT_NEAR(report.rate_hz, 200, 1e-9);
    EXPECT_EQ(report.text(), "continuous");
}

TEST(StreamHealth, TakesJitterBelowHalfAStepForRegular) {
    RecordProperty("hazard", "H7");
    Random random(7, "jitter");
    auto stamps = regular(5000, 200, 10);
    for (auto& t : stamps) t += (random.uniform() - 0.5) * 0.8 / 200;
    EXPECT_EQ(examine(stamps, 200).gaps, 0U);
    EXPECT_EQ(examine(stamps, 200).irregular, 0U);
}

TEST(StreamHealth, FindsASingleLostSample) {
    RecordProperty("hazard", "H7");
    Random random(8, "jitter");
    auto stamps = regular(1000, 200);
    for (auto& t : stamps) t += (random.uniform() - 0.5) * 0.4 / 200;
    stamps.erase(stamps.begin() + 500);
    const auto report = examine(stamps, 200);
    EXPECT_EQ(report.gaps, 1U);
    EXPECT_EQ(report.missingSamples, 1U);
    EXPECT_EQ(report.repeats + report.clockSteps + report.irregular, 0U);
}

TEST(StreamHealth, CountsGapsRepeatsAndClockSteps) {
    RecordProperty("hazard", "H7");
    auto stamps = regular(100, 100);                                    // up to 0.99 s
    for (const double t : regular(100, 100, 1.5)) stamps.push_back(t);  // a gap of 0.51 s, then up to 2.49 s
    stamps.push_back(2.49);                                             // a repeat
    stamps.push_back(2.50);
    stamps.push_back(1.00);  // the clock steps back
    const auto report = examine(stamps, 100);
    EXPECT_EQ(report.gaps, 1U);
    EXPECT_EQ(report.missingSamples, 50U);
    EXPECT_NEAR(report.longestGap_s, 0.51, 1e-9);
    EXPECT_EQ(report.repeats, 1U);
    EXPECT_EQ(report.clockSteps, 1U);
    EXPECT_FALSE(report.continuous());
    EXPECT_THAT(report.text(), HasSubstr("1 gap (longest 0.51 s, about 50 samples missing)"));
}

TEST(StreamHealth, MeasuresTheRateOverTheLongestGapFreeStretch) {
    auto stamps = regular(100, 1000);
    for (const double t : regular(1001, 1010, 5)) stamps.push_back(t);  // the longer stretch has a slightly higher rate
    for (const double t : regular(50, 1000, 20)) stamps.push_back(t);
    EXPECT_NEAR(examine(stamps, 1000).rate_hz, 1010, 1e-6);
}

TEST(StreamHealth, IsNotMisledByRoundedStamps) {
    auto stamps = regular(13200, 2200);
    for (auto& t : stamps) t = printed(t, 1e-6);
    EXPECT_NEAR(roughRate_hz(stamps), 2200, 0.01);
    const auto report = examine(stamps, roughRate_hz(stamps));
    EXPECT_NEAR(report.rate_hz, 2200, 0.001) << "the median step says 2197.8";
    EXPECT_TRUE(report.continuous());
}

TEST(StreamHealth, CountsWhatIsNotANumber) {
    RecordProperty("hazard", "H7");
    const double nan = std::numeric_limits<double>::quiet_NaN();
    StreamHealth health(100);
    SampleBlock block{{0, 0.01, nan, 0.03}, {1, 2, 3, nan, 5, 6, 7, 8}};
    health.feed(block, 2);
    EXPECT_EQ(health.report().invalidStamps, 1U);
    EXPECT_EQ(health.report().invalidSamples, 1U);
    EXPECT_EQ(health.report().gaps, 1U) << "behind a stamp that is not a number a sample is missing";
}

TEST(StreamHealth, KnowsItsAge) {
    RecordProperty("hazard", "H7");
    StreamHealth health(100);
    EXPECT_TRUE(health.stale(0)) << "nothing came yet";
    health.feed(1.0);
    EXPECT_NEAR(health.age_s(1.05), 0.05, 1e-12);
    EXPECT_FALSE(health.stale(1.05));
    EXPECT_TRUE(health.stale(1.11));
    EXPECT_TRUE(health.stale(std::numeric_limits<double>::quiet_NaN()));
    health.feed(0.5);
    EXPECT_NEAR(health.age_s(1.05), 0.05, 1e-12) << "a stamp from the past makes nothing younger";
}

TEST(StreamHealth, SpreadsStampsThatArePrintedTooCoarsely) {
    auto stamps = regular(4001, 4000);
    for (auto& t : stamps) t = std::floor(t * 1000 + 1e-9) / 1000;
    ASSERT_TRUE(stampsAreCoarse(stamps));
    spreadCoarseStamps(stamps);
    EXPECT_FALSE(stampsAreCoarse(stamps));
    EXPECT_NEAR(examine(stamps, roughRate_hz(stamps)).rate_hz, 4000, 1);
    EXPECT_TRUE(examine(stamps, roughRate_hz(stamps)).continuous());
}

TEST(StreamHealth, LeavesAFewRepeatsToBeCounted) {
    auto stamps = regular(20, 100);
    stamps.insert(stamps.begin() + 10, stamps[10]);
    EXPECT_FALSE(stampsAreCoarse(stamps));
}

namespace tacto::test {
namespace {

/// Returns the readings of a sensor at rest, in steps, with this noise.
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
        // The time limit depends on how often this noise repeats a value: nine times in ten at 0.3 steps.
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

/// Feeds each sample separately, so that each is judged.
template <class Judge>
void feedEach(Standstill& still, const SampleBlock& block, std::size_t channels, Judge judge) {
    for (std::size_t i = 0; i < block.t_s.size(); ++i) {
        SampleBlock one;
        one.t_s.push_back(block.t_s[i]);
        for (std::size_t c = 0; c < channels; ++c) one.values.push_back(block.values[i * channels + c]);
        still.feed(one);
        judge(block.t_s[i]);
    }
}

SampleBlock noise(std::mt19937& draw, double begin_s, double rate_hz, std::size_t count, std::size_t channels,
                  double steps) {
    SampleBlock block;
    std::normal_distribution<double> level(0, steps);
    for (std::size_t i = 0; i < count; ++i) {
        block.t_s.push_back(begin_s + static_cast<double>(i) / rate_hz);
        for (std::size_t c = 0; c < channels; ++c) block.values.push_back(std::round(level(draw)));
    }
    return block;
}

TEST(Standstill, OfOneAxisOrOfABlockThatRepeatsIsFound) {
    RecordProperty("hazard", "H7");
    std::mt19937 draw(9);
    const auto whole = [&](std::size_t low, std::size_t high) {
        return std::uniform_int_distribution<std::size_t>(low, high)(draw);
    };
    for (int trial = 0; trial < 60; ++trial) {
        const double rate_hz = std::uniform_real_distribution(200.0, 4000.0)(draw);
        const std::size_t channels = 3, period = whole(1, Standstill::kPeriods);
        const double steps = std::uniform_real_distribution(1.0, 50.0)(draw);
        const auto before = whole(2000, 6000), after = static_cast<std::size_t>(0.6 * rate_hz) + 200;
        auto block = noise(draw, 0, rate_hz, before + after, channels, steps);
        const std::size_t axis = whole(0, channels);  // channels: all axes
        for (std::size_t i = before; i < before + after; ++i) {
            for (std::size_t c = 0; c < channels; ++c) {
                if (axis == channels || axis == c)
                    block.values[i * channels + c] = block.values[(i - period) * channels + c];
            }
        }
        Standstill still(channels, true);
        const double begin_s = block.t_s[before];
        double found_s = NAN;
        feedEach(still, block, channels, [&](double t_s) {
            if (const auto since = still.repeatsSince(); since && std::isnan(found_s)) {
                found_s = t_s;
                EXPECT_NEAR(*since, begin_s, 0.05 + 3 / rate_hz) << trial;
            }
        });
        EXPECT_GT(found_s, begin_s) << trial << ": not before it hangs";
        EXPECT_LE(found_s - begin_s, 0.11 + 41 / rate_hz) << trial << ", period " << period << ", axis " << axis;
    }
}

TEST(Standstill, OfAFingertipThatFeelsIsNone) {
    RecordProperty("hazard", "H7");
    std::mt19937 draw(10);
    for (const double steps : {50.0, 5.0, 1.0, 0.5, 0.3, 0.1}) {
        Standstill still(3, true);
        feedEach(still, noise(draw, 0, 1000, 20'000, 3, steps), 3,
                 [&](double t_s) { ASSERT_FALSE(still.repeatsSince()) << steps << " steps of noise, at " << t_s; });
    }
    // A board may lack an axis; this is not a standstill.
    Standstill two(3, true);
    auto block = noise(draw, 0, 1000, 5000, 3, 5);
    for (std::size_t i = 0; i < block.t_s.size(); ++i) block.values[i * 3 + 1] = 0;
    two.feed(block);
    EXPECT_FALSE(two.repeatsSince());
    EXPECT_FALSE(two.since());
}

/// What the header says of a standstill, with every comparison written out.
class PlainStandstill {
public:
    explicit PlainStandstill(std::size_t channels)
        : channels_(channels), rows_((1 + channels) * Standstill::kPeriods) {}

    void feed(double t_s, std::span<const double> values) {
        t_s_.push_back(t_s);
        values_.emplace_back(values.begin(), values.end());
        const auto i = values_.size() - 1;
        for (std::size_t r = 0; r < rows_.size(); ++r) {
            auto& row = rows_[r];
            const auto period = r % Standstill::kPeriods + 1, of = r / Standstill::kPeriods;
            bool same = i >= period;
            for (std::size_t c = 0; same && c < channels_; ++c)
                same = (of != 0 && of != c + 1) || std::bit_cast<std::uint64_t>(values_[i][c]) ==
                                                       std::bit_cast<std::uint64_t>(values_[i - period][c]);
            if (same && row.run == 0) row.since_s = t_s_[i - 1];
            if (!same && row.run > 0) {
                row.noise += row.run > kEnough && moves(row, i, period) ? kEnough : row.run;
                row.matched += row.run;
            }
            row.run = same ? row.run + 1 : 0;
        }
    }
    [[nodiscard]] std::optional<double> since() const {
        const auto& row = rows_[0];
        const double share = (row.noise + 1) / (row.noise + changed(row, t_s_.size(), 1) + 2);
        if (row.run == 0 || t_s_.back() - row.since_s <= 0.1 || row.run * std::log(share) > std::log(1e-9)) return {};
        return row.since_s;
    }
    [[nodiscard]] std::optional<double> repeatsSince() const {
        std::optional<double> earliest;
        for (std::size_t r = Standstill::kPeriods; r < rows_.size(); ++r) {
            const auto& row = rows_[r];
            if (row.run < kEnough || t_s_.back() - row.since_s <= 0.1) continue;
            if (!moves(row, t_s_.size(), r % Standstill::kPeriods + 1)) continue;
            if (!earliest || row.since_s < *earliest) earliest = row.since_s;
        }
        return earliest;
    }

private:
    static constexpr double kEnough = 40;
    struct Row {
        double since_s = 0, run = 0, matched = 0, noise = 0;
    };
    static double changed(const Row& row, std::size_t seen, std::size_t period) {
        const double compared = static_cast<double>(seen) - static_cast<double>(period);
        return std::max(0.0, compared - row.matched - row.run);
    }
    static bool moves(const Row& row, std::size_t seen, std::size_t period) {
        return changed(row, seen, period) >= 100 && row.noise < changed(row, seen, period);
    }
    std::size_t channels_;
    std::vector<Row> rows_;
    std::vector<double> t_s_;
    std::vector<std::vector<double>> values_;
};

TEST(Standstill, IsWhatThePlainDefinitionSays) {
    RecordProperty("hazard", "H7");
    int found = 0;
    const int streams = test::trials<int>({.local = 30, .ci = 150, .campaign = 1500});
    for (int seed = 0; seed < streams; ++seed) {
        std::mt19937_64 draw(static_cast<std::uint64_t>(seed));
        const std::size_t channels = 1 + draw() % 3;
        const double rate_hz = 300 + static_cast<double>(draw() % 2000);
        const auto levels = 2 + draw() % 60;
        const double odd[] = {NAN, -0.0, 0.0, INFINITY};
        Standstill still(channels, true);
        PlainStandstill plain(channels);
        std::vector<std::vector<double>> rows;
        std::size_t left = 0, period = 0, axis = 0;  // of a repetition
        const std::size_t together = seed % 2 == 0 ? 1 : 120;
        SampleBlock block;
        for (std::size_t i = 0; i < 2500; ++i) {
            if (left == 0 && i > 300 && draw() % 300 == 0) {
                left = draw() % 600;
                period = 1 + draw() % Standstill::kPeriods;
                axis = draw() % (channels + 1);
            }
            auto& row = rows.emplace_back();
            for (std::size_t c = 0; c < channels; ++c) {
                const bool hangs = left > 0 && (axis == c || axis == channels);
                const double value = draw() % 50 == 0 ? odd[draw() % 4] : static_cast<double>(draw() % levels);
                row.push_back(hangs ? rows[i - period][c] : value);
            }
            if (left > 0) --left;
            block.t_s.push_back(static_cast<double>(i) / rate_hz);
            block.values.insert(block.values.end(), row.begin(), row.end());
            plain.feed(block.t_s.back(), row);
            if (draw() % together != 0) continue;
            still.feed(block);
            block.clear();
            ASSERT_EQ(still.since(), plain.since()) << "seed " << seed << ", sample " << i;
            ASSERT_EQ(still.repeatsSince(), plain.repeatsSince()) << "seed " << seed << ", sample " << i;
            found += plain.repeatsSince() && together == 1 ? 1 : 0;
        }
    }
    EXPECT_GT(found, 50 * streams);
}

/// Ten minutes of standstill do not change what is learnt: the next standstill is found as soon.
TEST(Standstill, IsNoNoiseHoweverLongItLasts) {
    RecordProperty("hazard", "H7");
    std::mt19937 draw(11);
    Standstill still(1);
    const double rate_hz = 100;
    double t_s = 0;
    for (const std::size_t hangs : {60'000UL, 600UL, 60'000UL, 600UL}) {
        still.feed(noise(draw, t_s, rate_hz, 400, 1, 3));
        t_s += 400 / rate_hz;
        EXPECT_FALSE(still.since());
        SampleBlock block;
        for (std::size_t i = 0; i < hangs; ++i) {
            block.t_s.push_back(t_s + static_cast<double>(i) / rate_hz);
            block.values.push_back(17);
        }
        double found_s = NAN;
        feedEach(still, block, 1, [&](double now_s) {
            if (std::isnan(found_s) && still.since()) found_s = now_s;
        });
        EXPECT_LE(found_s - t_s, 0.4);
        t_s += static_cast<double>(hangs) / rate_hz;
    }
}

}  // namespace
}  // namespace tacto::test
