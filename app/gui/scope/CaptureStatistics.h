// CaptureStatistics.h - what the captures seen so far say of each channel: science.md section 8's values, each with its
// last reading, mean, standard deviation, extremes and number.
//
// Readings are those of core/measure: one per measured pulse (one per train for the interval), so that the statistics
// of one capture are measureChannel()'s own. "Last" is the mean over the newest capture.
//
// Thread-safety: one owner.
#pragma once

#include <QString>
#include <array>
#include <cstddef>
#include <vector>

#include "core/measure/PulseMeasurement.h"

namespace tacto::gui {

/// In the order of the table: what is looked at first stands where it is seen without scrolling.
enum class Reading {
    Amplitude,
    Width,
    Interval,
    Rise,
    Fall,
    Charge,
    Overshoot,
    Droop,
    Gap,
    Imbalance,
    Pulses,
};
inline constexpr std::size_t kReadings = 11;

struct ReadingName {
    QString title;
    QString explained;  ///< one or two sentences for a tool tip
    QString unit;       ///< "s", "%"; empty: the channel's own, or a plain number
};
[[nodiscard]] ReadingName readingName(Reading reading);
/// Unit in which a reading on a channel of this unit is shown: amplitude V, charge C or µV·s.
[[nodiscard]] QString unitOf(Reading reading, const QString& channelUnit);
/// What a value of core/measure is shown times: 100 for fractions, a million for µV·s.
[[nodiscard]] double shownFactor(Reading reading, const QString& channelUnit);

/// NaN where there is nothing: all but n without a reading, the deviation with one.
class RunningStatistics {
public:
    void add(double value) noexcept;
    void setLast(double value) noexcept { last_ = value; }
    [[nodiscard]] double last() const noexcept { return last_; }
    [[nodiscard]] double mean() const noexcept { return n_ > 0 ? mean_ : kNotMeasured; }
    [[nodiscard]] double sd() const noexcept;
    [[nodiscard]] double min() const noexcept { return n_ > 0 ? min_ : kNotMeasured; }
    [[nodiscard]] double max() const noexcept { return n_ > 0 ? max_ : kNotMeasured; }
    [[nodiscard]] std::size_t n() const noexcept { return n_; }

private:
    double last_ = kNotMeasured, mean_ = 0, squares_ = 0, min_ = 0, max_ = 0;
    std::size_t n_ = 0;
};

class CaptureStatistics {
public:
    struct Channel {
        QString name;
        QString unit;
        std::array<RunningStatistics, kReadings> readings;
        [[nodiscard]] const RunningStatistics& of(Reading r) const { return readings[static_cast<std::size_t>(r)]; }
    };

    /// Channels that come or go begin anew.
    void add(const std::vector<ChannelMeasurement>& measured);
    void clear();
    [[nodiscard]] const std::vector<Channel>& channels() const noexcept { return channels_; }
    [[nodiscard]] std::size_t captures() const noexcept { return captures_; }

private:
    std::vector<Channel> channels_;
    std::size_t captures_ = 0;
};

}  // namespace tacto::gui
