// Abilities.h - the settings that a libsigrok device offers, as plain values. Settings not listed here are not offered.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

namespace tacto::sigrok_driver {

/// libsigrok gives times and voltages as fractions, and accepts only these fractions.
struct Fraction {
    std::uint64_t p = 0;
    std::uint64_t q = 1;
    [[nodiscard]] double value() const noexcept { return static_cast<double>(p) / static_cast<double>(q); }
    bool operator==(const Fraction&) const = default;
};

struct ChannelAbilities {
    std::string name;
    std::vector<Fraction> voltsPerDivision;  ///< empty: the range cannot be set
    std::vector<std::uint64_t> probes;       ///< probe factors; empty: cannot be set
    bool coupling = false;                   ///< true if the coupling can be set to DC
};

struct Abilities {
    std::string driver;
    std::string vendor, model, serial, firmware;
    std::vector<ChannelAbilities> channels;   ///< the analog channels
    std::vector<Fraction> timebases;          ///< seconds per division; empty: the device streams
    int divisions = 10;                       ///< divisions across the screen
    std::vector<std::string> triggerSources;  ///< empty: cannot be set
    bool triggerSlope = false, triggerLevel = false, triggerPosition = false;
    bool frameLimit = false, sampleLimit = false;
    std::vector<std::string> dataSources;   ///< "Live", "Memory", ...; empty: cannot be set
    double rateMin_hz = 0, rateMax_hz = 0;  ///< range in which the sampling rate can be set freely
    double rateStep_hz = 0;                 ///< 0: only the listed rates
    std::vector<double> rates_hz;           ///< the possible rates, if the device lists them
    /// Samples of a whole record, all channels together; 0 if unknown. See RecordPlan.h.
    std::size_t memory = 0;

    [[nodiscard]] bool streams() const noexcept { return timebases.empty(); }
};

}  // namespace tacto::sigrok_driver
