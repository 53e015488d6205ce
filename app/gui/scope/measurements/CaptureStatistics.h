// CaptureStatistics.h - what the captures seen so far say about each channel: every reading with its last value, mean,
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
#include <optional>
#include <vector>

#include "app/gui/scope/measurements/Reading.h"

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
    /// The newest capture tells only that the reading is no more than this.
    void setUpperBound(std::optional<double> bound) noexcept { bound_ = bound; }
    [[nodiscard]] const std::optional<double>& upperBound() const noexcept { return bound_; }
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
    std::optional<double> bound_;
};

/// The text in a cell; the number of readings without a unit. The last may be an upper bound.
[[nodiscard]] QString statisticText(Reading reading, Statistic statistic, const RunningStatistics& its,
                                    const QString& channelUnit);

class CaptureStatistics {
public:
    struct Channel {
        QString name;
        QString letter;  ///< "V"
        QString unit;
        std::array<RunningStatistics, kReadings> readings;
        double lastOnset_s = kNotMeasured;  ///< the last train's onset, where an interval may begin
        [[nodiscard]] const RunningStatistics& of(Reading r) const { return readings[static_cast<std::size_t>(r)]; }
    };

    /// Statistics of channels that come or go restart, and all of them where another drive was asked for: another
    /// amplitude or interval by hand, or the fingertip in place of the hand.
    void add(const ShownCapture& shown);
    /// The next capture does not follow the last one: no interval runs across.
    void breakOff();
    void clear();
    [[nodiscard]] const std::vector<Channel>& channels() const noexcept { return channels_; }
    [[nodiscard]] std::size_t captures() const noexcept { return captures_; }
    /// "since 16:59:12", of the first capture counted; empty where that is not known.
    [[nodiscard]] QString sinceText() const;

private:
    [[nodiscard]] bool begins(const ShownCapture& shown) const;

    std::vector<Channel> channels_;
    std::size_t captures_ = 0;
    QDateTime since_;
    std::optional<AskedDrive> asked_;   ///< the drive that was asked for when these were counted
    double programmed_ = kNotMeasured;  ///< the first one's, as it was programmed
};

}  // namespace tacto::gui
