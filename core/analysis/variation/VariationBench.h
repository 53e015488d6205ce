// VariationBench.h - how far amplitude and interval would spread from one bench to the next, within data sheets.
//
// Monte Carlo (GUM Supplement 1): each draw is a bench of its own, whose stimulator, oscilloscope and load are off by
// amounts drawn evenly from within their tolerances; each condition is then read once. Half-widths, defaults: gain
// 2 % (the laboratory's tolerance, science.md section 9), load 5 % (load-safety's own), oscilloscope 0.5 % and 0.1 %
// of the range (what the simulated one states), clocks 100 ppm and jitter 10 µs (choice).
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "core/analysis/statistics/Estimate.h"
#include "core/encoding/Encoder.h"

namespace tacto {

struct BenchTolerances {
    double stimulatorGain = 0.02;  ///< relative
    Volts stimulatorOffset{0.1};   ///< at the nominal load, where the source is a current source
    double load = 0.05;            ///< relative; concerns a current source, whose voltage is read
    double scopeGain = 0.005;      ///< relative
    double scopeOffset = 0.001;    ///< share of the range, which is twice the condition's amplitude
    double clock = 1e-4;           ///< relative, stimulator against oscilloscope
    Micros jitter{10};             ///< spread of one interval
};

/// Median and 5 to 95 % over the draws.
struct BenchCondition {
    std::string name;
    Estimate amplitude_v;
    Estimate interval_s;
};
struct BenchPair {
    std::string a;
    std::string b;
    Estimate amplitude_jnd;
    Estimate interval_jnd;
};
struct BenchVariation {
    std::size_t draws = 0;
    std::vector<BenchCondition> conditions;
    std::vector<BenchPair> pairs;  ///< a before b
};

/// `drive` is Voltage or Current. Errors: InvalidArgument for a profile that is not valid, a tolerance that is not 0 to
/// 0.5 (volts and microseconds: 0 or more and finite), or draws outside 100 to 1000000.
[[nodiscard]] Result<BenchVariation> predictBench(const EncodingProfile& encoding, Drive drive,
                                                  const BenchTolerances& tolerances, std::size_t draws,
                                                  std::uint64_t seed);

/// Median and 5 to 95 % of values by linear interpolation between order statistics; NaN among them are left out,
/// and everything is NaN without any.
[[nodiscard]] Estimate spreadOf(std::vector<double> values);

}  // namespace tacto
