// The pyramid compared with a loop over all samples, for any record and stretch, growing or not.
#include <cmath>
#include <gtest/gtest.h>

#include "core/base/Random.h"
#include "core/measure/MinMaxPyramid.h"

namespace tacto::test {
namespace {

const float kNaN = std::numeric_limits<float>::quiet_NaN();

Envelope naive(std::span<const float> record, std::size_t first, std::size_t last) {
    Envelope e;
    for (std::size_t i = first; i < std::min(last, record.size()); ++i) {
        if (std::isnan(record[i])) {
            e.gap = true;
            continue;
        }
        e.low = std::min(e.low, record[i]);
        e.high = std::max(e.high, record[i]);
    }
    return e;
}

/// Returns noise in which a share `missing` of the samples is NaN, singly and in runs.
std::vector<float> noise(std::size_t n, double missing, Random& random) {
    std::vector<float> record(n);
    std::size_t run = 0;
    for (auto& x : record) {
        if (run == 0 && random.uniform() < missing / 8) run = static_cast<std::size_t>(1 + 14 * random.uniform());
        x = run > 0 ? kNaN : static_cast<float>(random.normal());
        if (run > 0) --run;
    }
    return record;
}

std::size_t below(std::size_t limit, Random& random) {
    return static_cast<std::size_t>(random.uniform() * static_cast<double>(limit));
}

TEST(MinMaxPyramid, AgreesWithALoopOverAnyStretch) {
    Random random(20261121, "pyramid stretches");
    for (int round = 0; round < 60; ++round) {
        const auto record = noise(below(40'000, random), round % 3 == 0 ? 0.2 : 0, random);
        MinMaxPyramid pyramid;
        pyramid.extend(record);
        ASSERT_EQ(pyramid.samples(), record.size());
        for (int k = 0; k < 200; ++k) {
            const auto first = below(record.size() + 10, random);
            const auto last = k % 2 == 0 ? first + below(300, random) : below(record.size() + 10, random);
            ASSERT_EQ(pyramid.over(first, last), naive(record, first, last))
                << "round " << round << ": " << first << " to " << last << " of " << record.size();
        }
    }
}

TEST(MinMaxPyramid, GrowsWithoutReadingOrForgettingWhatItKnew) {
    Random random(7, "growing pyramid");
    const auto whole = noise(30'000, 0.1, random);
    std::vector<float> record;  // moves in memory as it grows
    MinMaxPyramid pyramid;
    while (record.size() < whole.size()) {
        const auto more = std::min(whole.size() - record.size(), below(700, random));
        const auto begin = whole.begin() + static_cast<std::ptrdiff_t>(record.size());
        record.insert(record.end(), begin, begin + static_cast<std::ptrdiff_t>(more));
        pyramid.extend(record);
        ASSERT_EQ(pyramid.over(0, record.size()), naive(record, 0, record.size()));
        const auto first = below(record.size() + 1, random);
        const auto last = below(record.size() + 1, random);
        ASSERT_EQ(pyramid.over(first, last), naive(record, first, last));
    }
}

TEST(MinMaxPyramid, NothingAndOneSample) {
    MinMaxPyramid pyramid;
    EXPECT_TRUE(pyramid.over(0, 100).empty());
    const std::vector<float> one{-0.5F};
    pyramid.extend(one);
    EXPECT_EQ(pyramid.over(0, 1), (Envelope{-0.5F, -0.5F, false}));
    EXPECT_TRUE(pyramid.over(1, 5).empty());
    EXPECT_FALSE(pyramid.over(1, 5).gap);
}

TEST(MinMaxPyramid, MissingSamplesAreAGapAndNeverAnExtreme) {
    std::vector<float> record(1000, kNaN);
    MinMaxPyramid pyramid;
    pyramid.extend(record);
    EXPECT_TRUE(pyramid.over(0, 1000).empty());
    EXPECT_TRUE(pyramid.over(0, 1000).gap);
    record[500] = std::numeric_limits<float>::infinity();  // infinity is the largest number, but still a number
    pyramid.clear();
    pyramid.extend(record);
    EXPECT_EQ(pyramid.over(0, 1000), (Envelope{record[500], record[500], true}));
    record.assign(4096, 1.0F);
    record[64 * 3 + 5] = kNaN;
    pyramid.clear();
    pyramid.extend(record);
    EXPECT_TRUE(pyramid.over(0, 4096).gap);
    EXPECT_FALSE(pyramid.over(64 * 3 + 6, 4096).gap);
    EXPECT_FALSE(pyramid.over(0, 64 * 3 + 5).gap);
}

TEST(MinMaxPyramid, AShorterRecordBeginsAnew) {
    const std::vector<float> old(500, 9.0F);
    const std::vector<float> fresh(100, 2.0F);
    MinMaxPyramid pyramid;
    pyramid.extend(old);
    pyramid.extend(fresh);
    EXPECT_EQ(pyramid.samples(), 100U);
    EXPECT_EQ(pyramid.over(0, 500), (Envelope{2.0F, 2.0F, false}));
}

}  // namespace
}  // namespace tacto::test
