// The encoder's own transform and CMSIS-DSP's in its place (TE_CMSIS_DSP) give the same spectra and powers, to the
// rounding of single precision.
#include <cmath>
#include <gtest/gtest.h>
#include <memory>
#include <numbers>

#include "core/base/Random.h"
#include "resources/firmware/tactile_encoder/tactile_encoder.h"

extern "C" {
#include "resources/firmware/tactile_encoder/te_parts.h"
void te_rfft256_of_cmsis(float* x, const float* cosine, const float* sine);
te_power te_window_power_of_cmsis(te_spectrum* spectrum, const te_acceleration* from, std::uint32_t axes,
                                  std::uint32_t first, int undone);
}

namespace tacto::test {
namespace {

float within(Random& random, double most) { return static_cast<float>(most * (2 * random.uniform() - 1)); }

}  // namespace

TEST(Transform, IsTheSameWithCmsis) {
    Random random(3, "transform");
    const auto spectrum = std::make_unique<te_spectrum>();
    te_spectrum_init(spectrum.get(), 4000, TE_WINDOW, 100, 1000);
    for (int k = 0; k < 50; ++k) {
        std::array<float, TE_WINDOW> own{};
        for (auto& value : own) value = within(random, std::pow(10, k % 7 - 3));
        double energy = 0;
        for (const double value : own) energy += value * value;
        auto theirs = own;
        te_rfft256(own.data(), spectrum->cosine, spectrum->sine);
        te_rfft256_of_cmsis(theirs.data(), spectrum->cosine, spectrum->sine);
        for (std::size_t i = 0; i < TE_WINDOW; ++i)
            ASSERT_NEAR(own[i], theirs[i], 1e-6 * std::sqrt(energy * TE_WINDOW)) << i;
    }
}

TEST(Transform, GivesTheSamePowersWithCmsis) {
    Random random(4, "powers");
    const auto spectrum = std::make_unique<te_spectrum>();
    const auto felt = std::make_unique<te_acceleration>();
    te_spectrum_init(spectrum.get(), 4000, TE_WINDOW, 100, 1000);
    for (int k = 0; k < 50; ++k) {
        for (auto& axis : felt->x)
            for (auto& value : axis) value = within(random, 10);
        for (auto& slot : felt->slot) slot.divisor = 1 + within(random, 0.5);
        const auto first = static_cast<std::uint32_t>(random.below(TE_RING));
        const auto own = te_window_power(spectrum.get(), felt.get(), TE_AXES, first, k % 2);
        const auto theirs = te_window_power_of_cmsis(spectrum.get(), felt.get(), TE_AXES, first, k % 2);
        ASSERT_GT(own.low, 0);
        ASSERT_NEAR(own.low, theirs.low, 1e-5 * double{own.low});
        ASSERT_NEAR(own.high, theirs.high, 1e-5 * double{own.high});
    }
}

}  // namespace tacto::test
