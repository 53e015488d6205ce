// Dice.h - random draws for tests, identical for the same seed with any standard library.
//
// Thread-safety: a value in the test's own thread.
#pragma once

#include <cmath>
#include <cstdint>
#include <random>

namespace tacto::test {

class Dice {
public:
    explicit Dice(std::uint64_t seed) : engine_(seed) {}
    double unit() { return static_cast<double>(engine_() >> 11U) * 0x1p-53; }
    double between(double low, double high) { return low + (high - low) * unit(); }
    double decade(double low, double high) { return low * std::pow(high / low, unit()); }
    bool chance(double p) { return unit() < p; }
    int pick(int n) { return static_cast<int>(engine_() % static_cast<std::uint64_t>(n)); }

private:
    std::mt19937_64 engine_;
};

}  // namespace tacto::test
