// ReadBack.h - derives the state of the electrodes from the 128 samples of a pulse.
//
// During a pulse the device measures either its current or its voltage, and only the magnitude:
//   voltage  gives |Z| at the end of the leading phase (science.md section 4) as voltage over commanded current; the
//            current is not measured, but a result code of the device tells if the current was not reached.
//   current  gives the amplitude; |Z| stays unknown.
// Magnitudes cannot give the net charge: two phases of equal sign look like a balanced pulse. Unequal magnitudes do
// prove a net charge of at least their difference: this is reported, but balance is never claimed.
//
// Unverified on hardware: that the first sample is taken at the onset, and what the sample time means. A sample time
// shorter than the pulse is read as the step between samples, a longer one as the length of all 128 samples (as the
// vendor's example draws it).
//
// Thread-safety: pure functions; nothing allocates.
#pragma once

#include "core/devices/Stimulator.h"
#include "drivers/sciencemode/Acks.h"
#include "drivers/sciencemode/PulsePlan.h"

namespace tacto::sciencemode {

inline constexpr double kSampleUnit = 0.01;  ///< last digit of a sample, in V or mA
inline constexpr Ohms kTouching{20};         ///< below this the electrodes touch: less than any skin or bench load
inline constexpr double kAtCompliance =
    0.95;  ///< share of the compliance voltage from which on the circuit counts as open

/// The device's samples during a pulse. They are magnitudes: without a sign, both phases look alike.
struct SampledPulse {
    Measurement measurement = Measurement::Voltage;  ///< Voltage: V; Current: mA
    Micros step{0};
    std::array<float, kSamples> magnitudes{};
};

/// One pulse as the device measured it.
struct PulseReading {
    ElectrodeState electrode = ElectrodeState::NotMeasured;
    std::optional<Milliamps> amplitude;  ///< amplitude at the end of the leading phase
    std::optional<Ohms> impedance;
    std::optional<double> imbalance;             ///< a lower bound; empty if magnitudes prove none
    std::optional<double> imbalanceUncertainty;  ///< 95 %; depends on how the samples meet the edges
    std::optional<SampledPulse> samples;         ///< the samples from which all values were derived
};

/// Returns the step between samples, or nothing if the ack states none.
[[nodiscard]] std::optional<Micros> sampleStep(const ChannelConfigAck& ack, const PulsePlan& plan) noexcept;

[[nodiscard]] PulseReading readPulse(const ChannelConfigAck& ack, const PulsePlan& plan, Volts compliance) noexcept;

}  // namespace tacto::sciencemode
