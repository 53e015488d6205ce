// Reading.h - the quantities that are measured of every capture (science.md section 8 and
// core/measure/WaveformMeasurement.h), each described once: name, explanation, unit, and how it is stored as a choice.
//
// Thread-safety: pure functions.
#pragma once

#include <QString>
#include <array>
#include <cstddef>
#include <optional>
#include <vector>

#include "app/gui/scope/model/Trace.h"

namespace tacto::gui {

/// In the order of the tables: what is looked at first stands first.
enum class Reading {
    Amplitude,
    PeakToPeak,
    Width,
    Gap,
    Interval,
    Rise,
    Fall,
    Charge,
    Imbalance,
    Overshoot,
    Droop,
    Frequency,
    Duty,
    Rms,
    Mean,
    SecondAmplitude,
    SecondWidth,
    SecondCharge,
    NetCharge,
    Energy,
    Pulses,
};
inline constexpr std::size_t kReadings = 21;
[[nodiscard]] std::array<Reading, kReadings> allReadings();

struct ReadingName {
    QString key;        ///< "amplitude": as it is stored
    QString title;      ///< "Amplitude"
    QString explained;  ///< one or two sentences for a tool tip
    QString unit;       ///< "s", "%", "Hz", "C", "J"; empty: the channel's own
};
[[nodiscard]] ReadingName nameOf(Reading reading);
[[nodiscard]] std::optional<Reading> readingOfKey(const QString& key);

/// All of the channel's in one capture: one per measured pulse, per train for the interval, one of the waveform. Net
/// charge and energy are the current channel's, where the capture has one voltage and one current. Edges that the
/// samples do not resolve are left out.
[[nodiscard]] std::vector<double> readingsOf(Reading reading, const ShownCapture& shown, std::size_t channel);
/// Two sample intervals, where the rise or the fall of every pulse is shorter than that: the samples do not resolve it,
/// and it lies below.
[[nodiscard]] std::optional<double> upperBound(Reading reading, const ShownCapture& shown, std::size_t channel);
/// "≤ 1 µs".
[[nodiscard]] QString upperBoundText(double bound_s);
/// "40.02 V", "0.05 %"; "–" for NaN, and for the charge of a channel that is not a current.
[[nodiscard]] QString readingText(Reading reading, double value, const QString& channelUnit, int digits = 4);
/// Why there is none, or only an upper bound, in a sentence or two.
[[nodiscard]] QString whyMissing(Reading reading, const ShownCapture& shown, std::size_t channel);
/// "V", or "V2" where several channels have the unit; so on plots and above columns.
[[nodiscard]] QString channelLetter(const std::vector<ChannelMeasurement>& channels, std::size_t channel);

}  // namespace tacto::gui
