#include <cmath>
#include <gtest/gtest.h>
#include <numbers>

#include "drivers/simulated/Surface.h"

namespace tacto::sim {
namespace {

class EveryMaterial : public testing::TestWithParam<Material> {};

TEST_P(EveryMaterial, HasTheStatedRoughness) {
    const Surface surface(GetParam(), 3);
    if (GetParam().gratingPeriod.value() > 0) {
        EXPECT_NEAR(surface.ra().value(), 24, 1);  // as the material's source says, for relief and ridges together
    } else {
        EXPECT_NEAR(surface.ra().value(), GetParam().ra.value(), 1e-3 * GetParam().ra.value());
    }
    EXPECT_NEAR(surface.rz().value(), GetParam().rz.value(), 0.35 * GetParam().rz.value());
}

TEST_P(EveryMaterial, HasTheStatedCorrelationLength) {
    if (GetParam().gratingPeriod.value() > 0) GTEST_SKIP() << "a grating correlates for ever";
    const Surface surface(GetParam(), 3);
    const auto lag = static_cast<std::size_t>(GetParam().correlationLength.value() * 1e-6 / Surface::kCell_m);
    double product = 0, square = 0;
    for (std::size_t i = 0; i < Surface::kCells; ++i) {
        product += surface.profile(i) * surface.profile(i + lag);
        square += surface.profile(i) * surface.profile(i);
    }
    EXPECT_NEAR(product / square, std::exp(-1), 0.08);
}

TEST_P(EveryMaterial, HasNoSeamWhereItRepeats) {
    const Surface surface(GetParam(), 3);
    double step = 0;
    for (std::size_t i = 0; i < 2000; ++i) step = std::max(step, std::abs(surface.profile(i + 1) - surface.profile(i)));
    EXPECT_LT(std::abs(surface.profile(Surface::kCells) - surface.profile(Surface::kCells - 1)), 2 * step);
}

INSTANTIATE_TEST_SUITE_P(Surface, EveryMaterial, testing::ValuesIn(materials().begin(), materials().end()),
                         [](const auto& kind) { return std::string(kind.param.name); });

TEST(Surface, SameSeedIsTheSameSpecimen) {
    const auto& material = *findMaterial("P120");
    const Surface a(material, 5), b(material, 5), other(material, 6);
    bool differs = false;
    for (std::size_t i = 0; i < Surface::kCells; ++i) {
        ASSERT_EQ(a.profile(i), b.profile(i));
        differs = differs || a.profile(i) != other.profile(i);
    }
    EXPECT_TRUE(differs);
}

TEST(Surface, GratingStandsOutAtItsPeriod) {
    const Surface surface(*findMaterial("denim"), 1);
    const double length = surface.length().value() * 1e-3;
    const auto powerAt = [&](double period_m) {
        double re = 0, im = 0;
        const double waves = std::round(length / period_m);
        for (std::size_t i = 0; i < Surface::kCells; ++i) {
            const double phase =
                2 * std::numbers::pi * waves * static_cast<double>(i) / static_cast<double>(Surface::kCells);
            re += surface.profile(i) * std::cos(phase);
            im += surface.profile(i) * std::sin(phase);
        }
        return re * re + im * im;
    };
    EXPECT_GT(powerAt(0.85e-3), 20 * powerAt(0.70e-3));
    EXPECT_GT(powerAt(0.85e-3), 20 * powerAt(1.1e-3));
}

TEST(Surface, UnknownMaterialIsNone) {
    EXPECT_EQ(findMaterial("p120"), nullptr);
    EXPECT_EQ(findMaterial(""), nullptr);
    EXPECT_NE(materialNames().find("denim"), std::string::npos);
}

}  // namespace
}  // namespace tacto::sim
