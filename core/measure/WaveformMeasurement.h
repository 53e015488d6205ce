// WaveformMeasurement.h - measures the whole waveform of a record, with or without pulses: peak to peak, RMS, mean,
// frequency and duty cycle.
//
// Terms follow IEEE Std 181. The reference level is half-way between the baseline and the state of the pulses' leading
// phase; without states, half-way between the extremes. A crossing counts once the waveform has gone a tenth of their
// difference beyond the level, so that smaller noise is never counted as another crossing.
//
//   peak to peak  largest less smallest sample
//   RMS           root mean square about zero, offset included, over the whole record: silence counts too
//   mean          over the whole record
//   frequency     whole periods between the first and the last crossing away from the baseline, per second
//   duty          share of these periods that the waveform is beyond the reference level
//
// The first three ignore missing samples. If a sample is missing between the first and the last crossing, frequency and
// duty cycle are not measured. If a sample is clipped, peak to peak, RMS and mean are not measured.
//
// Levels are in the channel's unit, a bare double because the unit is data.
#pragma once

#include <cstddef>

#include "core/measure/PulseMeasurement.h"

namespace tacto {

/// NaN if not measured.
struct WaveformMeasurement {
    double peakToPeak = kNotMeasured;
    double rms = kNotMeasured;
    double mean = kNotMeasured;
    double frequency_hz = kNotMeasured;
    double duty = kNotMeasured;  ///< share, 0 to 1
    std::size_t periods = 0;     ///< number of whole periods for frequency and duty
    std::size_t missing = 0;     ///< number of missing samples
    bool clipped = false;
};

/// `channel` must be below capture.channels.size(). `measured` is the result of measureChannel() for the same channel.
[[nodiscard]] WaveformMeasurement measureWaveform(const Capture& capture, std::size_t channel,
                                                  const ChannelMeasurement& measured);

}  // namespace tacto
