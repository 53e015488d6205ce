// WaveformMeasurement.h - what a record's waveform is as a whole, pulses or not: peak to peak, RMS, mean, frequency and
// duty cycle.
//
// Terms follow IEEE Std 181. The reference level is half-way between the baseline and the state that the pulses'
// leading phase goes to (from the state levels of the record); without states, half-way between the extremes. The
// waveform crosses it when it has gone a tenth of their difference beyond: noise that is smaller counts no crossing
// twice.
//
//   peak to peak  largest less smallest sample
//   RMS           root mean square about zero, offset included, over the whole record: silence counts too
//   mean          over the whole record
//   frequency     whole periods between the first and the last crossing away from the baseline, per second
//   duty          share of these periods that the waveform is beyond the reference level
//
// Missing samples are left out of the first three; where one is missing between the first and the last crossing, there
// is neither a frequency nor a duty cycle. A record with a clipped sample has neither peak to peak, RMS nor mean.
//
// Levels are in the channel's unit, a bare double because the unit is data.
#pragma once

#include <cstddef>

#include "core/measure/PulseMeasurement.h"

namespace tacto {

/// NaN where not measured.
struct WaveformMeasurement {
    double peakToPeak = kNotMeasured;
    double rms = kNotMeasured;
    double mean = kNotMeasured;
    double frequency_hz = kNotMeasured;
    double duty = kNotMeasured;  ///< 0..1
    std::size_t periods = 0;     ///< the periods that frequency and duty are taken from
    std::size_t missing = 0;     ///< samples
    bool clipped = false;
};

/// `channel` must be below capture.channels.size(); `measured` is measureChannel()'s of the same channel.
[[nodiscard]] WaveformMeasurement measureWaveform(const Capture& capture, std::size_t channel,
                                                  const ChannelMeasurement& measured);

}  // namespace tacto
