#include "core/base/Random.h"

namespace tacto {

namespace {
// FNV-1a: std::hash may differ between libraries, and a seed must not.
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

double Random::normal() noexcept { return normal_(engine_); }

std::uint64_t Random::below(std::uint64_t bound) noexcept {
    return std::uniform_int_distribution<std::uint64_t>(0, bound - 1)(engine_);
}

}  // namespace tacto
