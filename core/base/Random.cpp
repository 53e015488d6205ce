#include "core/base/Random.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace tacto {

namespace {
// FNV-1a, because std::hash may differ between libraries, but a seed must give the same numbers everywhere.
std::uint64_t hashOf(std::string_view text) noexcept {
    std::uint64_t hash = 0xcbf29ce484222325ULL;
    for (const char c : text) {
        hash ^= static_cast<unsigned char>(c);
        hash *= 0x100000001b3ULL;
    }
    return hash;
}

std::mt19937_64 engineFor(std::uint64_t seed, std::string_view stream) {
    const std::uint64_t name = hashOf(stream);
    std::seed_seq mix{static_cast<std::uint32_t>(seed), static_cast<std::uint32_t>(seed >> 32U),
                      static_cast<std::uint32_t>(name), static_cast<std::uint32_t>(name >> 32U)};
    return std::mt19937_64(mix);
}
}  // namespace

Random::Random(std::uint64_t seed, std::string_view stream) : engine_(engineFor(seed, stream)) {}

double Random::uniform() noexcept { return static_cast<double>(engine_() >> 11U) * 0x1.0p-53; }

// Marsaglia's polar method (Marsaglia and Bray 1964). std::normal_distribution differs between libraries; under clang
// libstdc++'s is nine times slower (114 ns), since it computes a constant logarithm every time.
double Random::normal() noexcept {
    if (spare_) return *std::exchange(spare_, std::nullopt);
    const auto coordinate = [this] {
        constexpr double kBelowOne = 1 - 0x1.0p-53;
        return 2 * std::min(static_cast<double>(engine_()) * 0x1.0p-64, kBelowOne) - 1;
    };
    double x = 0, y = 0, square = 0;
    do {
        x = coordinate();
        y = coordinate();
        square = x * x + y * y;
    } while (square > 1 || square == 0);
    const double scale = std::sqrt(-2 * std::log(square) / square);
    spare_ = x * scale;
    return y * scale;
}

std::uint64_t Random::below(std::uint64_t bound) noexcept {
    return std::uniform_int_distribution<std::uint64_t>(0, bound - 1)(engine_);
}

}  // namespace tacto
