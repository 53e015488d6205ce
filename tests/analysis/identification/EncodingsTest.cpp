#include <gtest/gtest.h>
#include <set>

#include "core/analysis/identification/Encodings.h"
#include "core/analysis/statistics/Binomial.h"

namespace tacto {
namespace {

TEST(Encodings, TwoAlternate) {
    using Order = std::vector<std::size_t>;
    EXPECT_EQ(williamsOrder(2, 0), (Order{0, 1}));
    EXPECT_EQ(williamsOrder(2, 1), (Order{1, 0}));
    EXPECT_EQ(williamsOrder(2, 2), (Order{0, 1}));
    EXPECT_EQ(williamsOrder(1, 5), (Order{0}));
    EXPECT_TRUE(williamsOrder(0, 0).empty());
    EXPECT_EQ(williamsRows(3), 6U);
    EXPECT_EQ(williamsRows(4), 4U);
}

/// Each in each place, and each after each other, equally often.
TEST(Encodings, TheDesignIsBalanced) {
    for (const std::size_t n : {2U, 3U, 4U, 5U, 6U}) {
        std::map<std::pair<std::size_t, std::size_t>, std::size_t> places, following;
        std::set<std::vector<std::size_t>> orders;
        for (std::size_t row = 0; row < williamsRows(n); ++row) {
            const auto order = williamsOrder(n, row);
            EXPECT_EQ(std::set(order.begin(), order.end()).size(), n);
            orders.insert(order);
            for (std::size_t i = 0; i < n; ++i) {
                ++places[{order[i], i}];
                if (i > 0) ++following[{order[i - 1], order[i]}];
            }
        }
        EXPECT_EQ(orders.size(), williamsRows(n)) << n;
        EXPECT_EQ(places.size(), n * n) << n;
        EXPECT_EQ(following.size(), n * (n - 1)) << n;
        for (const auto& [place, count] : places) EXPECT_EQ(count, williamsRows(n) / n) << n;
        for (const auto& [pair, count] : following) EXPECT_EQ(count, williamsRows(n) / n) << n;
    }
}

TEST(Encodings, TheLaterIsHeldAgainstTheEarlier) {
    const auto found = compareEncodings(
        {{.encoding = "paper", .n = 80, .hits = 56}, {.encoding = "swapped", .n = 80, .hits = 68}}, "swapped");
    ASSERT_EQ(found.pairs.size(), 1U);
    EXPECT_EQ(found.pairs[0].a, "swapped");
    EXPECT_NEAR(found.pairs[0].difference.value, 0.15, 1e-12);
    EXPECT_GT(found.pairs[0].difference.low, 0);
    const auto all = std::vector{found, found, compareEncodings({{.encoding = "paper"}, {.encoding = "swapped"}})};
    EXPECT_EQ(preferences(all), (std::map<std::string, std::size_t>{{"paper", 0}, {"swapped", 2}}));
}

}  // namespace
}  // namespace tacto
