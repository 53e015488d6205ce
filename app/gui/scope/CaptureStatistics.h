// CaptureStatistics.h - what the captures seen so far say of each channel: every reading with its last value, mean,
// standard deviation, extremes and number.
//
// Readings are those of core/measure: one per measured pulse (one per train for the interval, one per capture for the
// waveform), so that the statistics of one capture are measureChannel()'s own. Intervals also run from the last train
// of a capture to the first of the next, where none was left out between them. "Last" is the mean over the newest
// capture.
//
// Thread-safety: one owner.
#pragma once

#include <QString>
#include <array>
#include <cstddef>
#include <vector>

#include "app/gui/scope/Reading.h"

namespace tacto::gui {

enum class Statistic { Last, Mean, Sd, Min, Max, Count };
inline constexpr std::array kStatistics{Statistic::Last, Statistic::Mean, Statistic::Sd,
                                        Statistic::Min,  Statistic::Max,  Statistic::Count};
/// "mean", "s.d.", "n".
[[nodiscard]] QString nameOf(Statistic statistic);

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
    [[nodiscard]] double of(Statistic statistic) const noexcept;

private:
    double last_ = kNotMeasured, mean_ = 0, squares_ = 0, min_ = 0, max_ = 0;
    std::size_t n_ = 0;
};

/// As it stands in a cell; the number of readings without a unit.
[[nodiscard]] QString statisticText(Reading reading, Statistic statistic, const RunningStatistics& its,
                                    const QString& channelUnit, int digits = 4);

class CaptureStatistics {
public:
    struct Channel {
        QString name;
        QString letter;  ///< "V"
        QString unit;
        std::array<RunningStatistics, kReadings> readings;
        double lastOnset_s = kNotMeasured;  ///< of the last train, where an interval may begin
        [[nodiscard]] const RunningStatistics& of(Reading r) const { return readings[static_cast<std::size_t>(r)]; }
    };

    /// Statistics of channels that come or go restart.
    void add(const ShownCapture& shown);
    /// What comes next does not follow on what came last: no interval runs across.
    void breakOff();
    void clear();
    [[nodiscard]] const std::vector<Channel>& channels() const noexcept { return channels_; }
    [[nodiscard]] std::size_t captures() const noexcept { return captures_; }

private:
    std::vector<Channel> channels_;
    std::size_t captures_ = 0;
};

}  // namespace tacto::gui
