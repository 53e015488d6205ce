// ReadBack.h - what the 128 samples of a pulse say about the electrodes.
//
// The device measures either its current or its voltage during a pulse, and only the magnitude. So:
//   voltage  gives |Z| at the end of the leading phase (science.md section 4), over the current that was commanded; the
//            current itself is not measured, and the device says so with a result of its own when it is not reached.
//   current  gives the amplitude; |Z| stays unknown.
// The net charge cannot be known from magnitudes: two phases of equal sign look like a balanced pulse. Unequal
// magnitudes do prove a net charge, of at least their difference: that is reported, and balance never is.
//
// Unverified on hardware: that the first sample is taken at the onset, and what the sample time counts. A sample time
// shorter than the pulse is taken as the step between samples, a longer one as the length of all 128 (the vendor's
// example draws it so).
//
// Thread-safety: pure functions; nothing allocates.
#pragma once

#include "core/devices/Stimulator.h"
#include "drivers/sciencemode/Acks.h"
#include "drivers/sciencemode/PulsePlan.h"

namespace tacto::sciencemode {

inline constexpr double kSampleUnit = 0.01;  ///< V or mA: the last digit of a sample
inline constexpr Ohms kTouching{20};         ///< below it the electrodes touch: less than any skin or bench load
inline constexpr double kAtCompliance =
    0.95;  ///< share of the compliance; from there on the source found no path for its current

/// The device's samples during a pulse. They are magnitudes: it sends no sign, so that both phases look alike.
struct SampledPulse {
    Measurement measurement = Measurement::Voltage;  ///< Voltage: V; Current: mA
    Micros step{0};
    std::array<float, kSamples> magnitudes{};
};

/// One pulse as the device measured it.
struct PulseReading {
    ElectrodeState electrode = ElectrodeState::NotMeasured;
    std::optional<Milliamps> amplitude;  ///< at the end of the leading phase
    std::optional<Ohms> impedance;
    std::optional<double> imbalance;             ///< at least so large; absent where magnitudes prove none
    std::optional<double> imbalanceUncertainty;  ///< 95 %: where the samples meet the edges
    std::optional<SampledPulse> samples;         ///< the samples from which all this was read
};

/// The step between samples, or nothing when the ack states none.
[[nodiscard]] std::optional<Micros> sampleStep(const ChannelConfigAck& ack, const PulsePlan& plan) noexcept;

[[nodiscard]] PulseReading readPulse(const ChannelConfigAck& ack, const PulsePlan& plan, Volts compliance) noexcept;

}  // namespace tacto::sciencemode
