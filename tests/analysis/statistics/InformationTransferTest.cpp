#include <cmath>
#include <gtest/gtest.h>

#include "core/analysis/statistics/InformationTransfer.h"

namespace tacto {
namespace {

TEST(InformationTransfer, IsThatOfKnownTables) {
    const std::vector<std::vector<double>> perfect = {{9, 0, 0, 0}, {0, 9, 0, 0}, {0, 0, 9, 0}, {0, 0, 0, 9}};
    const std::vector<std::vector<double>> none = {{5, 5}, {5, 5}};
    const std::vector<std::vector<double>> channel = {{0.9, 0.1}, {0.1, 0.9}};
    EXPECT_NEAR(informationTransfer(perfect), 2, 1e-12);
    EXPECT_NEAR(informationTransfer(none), 0, 1e-12);
    EXPECT_NEAR(informationTransfer(channel), 1 + 0.9 * std::log2(0.9) + 0.1 * std::log2(0.1), 1e-12);
    EXPECT_TRUE(std::isnan(informationTransfer(std::vector<std::vector<double>>{{0, 0}})));
}

TEST(InformationTransfer, BiasIsThatOfMillerAndMadow) {
    EXPECT_NEAR(informationBias(4, 6, 80), 0.135, 0.0005);  // pilot.md section 7
    EXPECT_NEAR(informationBias(2, 2, 10), 1 / (20 * std::log(2.0)), 1e-12);
    EXPECT_TRUE(std::isnan(informationBias(4, 6, 0)));
}

}  // namespace
}  // namespace tacto
