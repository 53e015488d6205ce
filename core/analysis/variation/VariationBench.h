// VariationBench.h - predicts how much amplitude and interval differ between benches within their data sheets.
//
// Monte Carlo (GUM Supplement 1): each draw is one bench, with errors of stimulator, oscilloscope and load drawn evenly
// from within their tolerances; it reads each condition once. Default half-widths: gain 2 % (the laboratory's
// tolerance, science.md section 9), load 5 % (from load-safety), oscilloscope 0.5 % and 0.1 % of range (as stated by
// the simulated oscilloscope), clocks 100 ppm and jitter 10 µs (choice).
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "core/analysis/statistics/Estimate.h"
#include "core/encoding/Encoder.h"

namespace tacto {

struct BenchTolerances {
    double stimulatorGain = 0.02;  ///< relative
    Volts stimulatorOffset{0.1};   ///< for a current source at its nominal load
    double load = 0.05;            ///< relative; used for a current source, because its voltage is measured
    double scopeGain = 0.005;      ///< relative
    double scopeOffset = 0.001;    ///< share of the input range, which is twice the condition's amplitude
    double clock = 1e-4;           ///< relative, stimulator clock against oscilloscope clock
    Micros jitter{10};             ///< half-width of the variation of one interval
};

/// Median and 5 to 95 % over the drawn benches.
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
    std::vector<BenchPair> pairs;  ///< index of a below index of b
};

/// `drive` is Voltage or Current. Errors: InvalidArgument for an invalid profile, a tolerance outside 0 to 0.5 (volts
/// and microseconds: negative or not finite), or a number of draws outside 100 to 1000000.
[[nodiscard]] Result<BenchVariation> predictBench(const EncodingProfile& encoding, Drive drive,
                                                  const BenchTolerances& tolerances, std::size_t draws,
                                                  std::uint64_t seed);

/// Median and 5 to 95 % of the values, by linear interpolation between sorted values. NaN values are ignored; without
/// any other value the result is NaN.
[[nodiscard]] Estimate spreadOf(std::vector<double> values);

}  // namespace tacto
