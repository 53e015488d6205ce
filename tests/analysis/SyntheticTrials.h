// SyntheticTrials.h - makes trials without a random generator, so that numpy can make exactly the same ones:
// tests/reference/trials.py.
//
// Thread-safety: pure functions.
#pragma once

#include <array>
#include <cmath>
#include <numbers>
#include <string>
#include <vector>

#include "core/analysis/separability/Separability.h"

namespace tacto::test {

inline const std::array<std::string, 4> kFourConditions{"smooth-low", "smooth-high", "rough-low", "rough-high"};

struct TrialDesign {
    std::array<double, 4> amplitude{10, 10, 40, 40};
    std::array<double, 4> interval_s{2, 0.5, 2, 0.5};
    double amplitudeSd = 0.3;
    double intervalSd_s = 0.01;
    int repeats = 25;
};

/// Returns a wave with mean square 1 and mean 0 over many i: a sine at multiples of the golden ratio, evenly spread.
inline double wave(int i, int k) {
    return std::sqrt(2.0) * std::sin(2 * std::numbers::pi * std::fmod((i + 1) * 0.6180339887498949 * (k + 1), 1.0));
}

/// Amplitude and interval have a correlation of 0.5. Each repeat presents all conditions, one after the other, as a
/// protocol does.
inline std::vector<SeparabilityTrial> trialsOf(const TrialDesign& design) {
    std::vector<SeparabilityTrial> trials;
    for (int i = 0; i < design.repeats; ++i) {
        for (int c = 0; c < 4; ++c) {
            const auto k = static_cast<std::size_t>(c);
            const double u = wave(i, c);
            const double v = 0.5 * u + std::sqrt(0.75) * wave(i, c + 4);
            trials.push_back({kFourConditions[k], design.amplitude[k] + design.amplitudeSd * u,
                              design.interval_s[k] + design.intervalSd_s * v, 0, 0});
        }
    }
    return trials;
}

inline TrialDesign overlapping() { return {{10, 10.5, 11, 11.5}, {2, 1.9, 2.1, 2.0}, 0.4, 0.08, 23}; }

}  // namespace tacto::test
