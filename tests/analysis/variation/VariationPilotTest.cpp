#include <cmath>
#include <gtest/gtest.h>

#include "core/analysis/statistics/Binomial.h"
#include "core/analysis/variation/VariationPilot.h"
#include "tests/analysis/statistics/CountedOut.h"

namespace tacto {
namespace {

TEST(VariationPilot, SomeoneWhoIsNotServedShowsNothing) {
    const double accuracies[] = {0.9, 0.5, 0.3};
    const auto found = outlookOf({accuracies, 6}, 4, 40, 0.25);
    EXPECT_EQ(found.people, 4U);
    EXPECT_EQ(found.rightFrom, aboveChanceFrom(40, 0.25));
    EXPECT_NEAR(found.allServed, std::pow(0.5, 4), 1e-12);
    double one = 0;
    for (const double p : accuracies) one += test::countedOut(found.rightFrom, 40, p) / 6;
    EXPECT_NEAR(found.allAboveChance, std::pow(one, 4), 1e-10);
    EXPECT_GT(found.width.high, found.width.low);
}

}  // namespace
}  // namespace tacto
