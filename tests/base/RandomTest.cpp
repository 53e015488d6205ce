#include <array>
#include <cmath>
#include <gtest/gtest.h>

#include "core/base/Random.h"

namespace tacto {
namespace {

TEST(Random, GivesTheSameDrawsForTheSameSeedAndStream) {
    Random a(7, "noise");
    Random b(7, "noise");
    for (int i = 0; i < 1000; ++i) {
        ASSERT_EQ(a.uniform(), b.uniform());
        ASSERT_EQ(a.normal(), b.normal());
        ASSERT_EQ(a.below(17), b.below(17));
    }
}

TEST(Random, GivesOtherDrawsForAnotherSeedOrStream) {
    Random a(7, "noise");
    Random otherSeed(8, "noise");
    Random otherStream(7, "jitter");
    int sameSeed = 0;
    int sameStream = 0;
    for (int i = 0; i < 100; ++i) {
        const double x = a.uniform();
        sameSeed += x == otherSeed.uniform() ? 1 : 0;
        sameStream += x == otherStream.uniform() ? 1 : 0;
    }
    EXPECT_EQ(sameSeed, 0);
    EXPECT_EQ(sameStream, 0);
}

TEST(Random, UniformStaysInRangeWithTheRightMean) {
    Random random(1, "uniform");
    double sum = 0;
    constexpr int kDraws = 100'000;
    for (int i = 0; i < kDraws; ++i) {
        const double x = random.uniform();
        ASSERT_GE(x, 0.0);
        ASSERT_LT(x, 1.0);
        sum += x;
    }
    EXPECT_NEAR(sum / kDraws, 0.5, 5 * std::sqrt(1.0 / 12 / kDraws));
}

/// libstdc++ 12 draws these numbers; they must not change, so that old recordings can be made again.
TEST(Random, NormalDrawsAreTheSameWithEveryLibrary) {
    Random random(7, "noise");
    constexpr double kDrawn[] = {0x1.1d8b2787a1d62p-1, -0x1.56f431494af6p-1, 0x1.d4d231dea8e6cp-1,
                                 0x1.c897e8819dc46p-1};
    for (const double expected : kDrawn) EXPECT_EQ(random.normal(), expected);
}

TEST(Random, NormalHasMeanZeroAndVarianceOne) {
    Random random(1, "normal");
    double sum = 0;
    double squares = 0;
    constexpr int kDraws = 100'000;
    for (int i = 0; i < kDraws; ++i) {
        const double x = random.normal();
        sum += x;
        squares += x * x;
    }
    EXPECT_NEAR(sum / kDraws, 0.0, 5 / std::sqrt(double{kDraws}));
    EXPECT_NEAR(squares / kDraws, 1.0, 5 * std::sqrt(2.0 / kDraws));
}

TEST(Random, BelowReachesEveryValueEquallyOften) {
    Random random(3, "below");
    std::array<int, 6> seen{};
    constexpr int kDraws = 60'000;
    for (int i = 0; i < kDraws; ++i) {
        const auto x = random.below(6);
        ASSERT_LT(x, 6U);
        ++seen[x];
    }
    for (const int count : seen) EXPECT_NEAR(count, kDraws / 6, 5 * std::sqrt(kDraws * (1.0 / 6) * (5.0 / 6)));
}

TEST(Random, BelowOneIsZero) {
    Random random(3, "below");
    for (int i = 0; i < 100; ++i) EXPECT_EQ(random.below(1), 0U);
}

}  // namespace
}  // namespace tacto
