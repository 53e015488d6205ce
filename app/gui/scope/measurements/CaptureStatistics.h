// CaptureStatistics.h - statistics of each channel over the captures seen so far: last value, mean, standard deviation,
// extremes and number of every reading.
//
// The readings come from core/measure: one per measured pulse (one per train for the interval, one per capture for the
// waveform), so the statistics of one capture equal those of measureChannel(). Intervals also run from the last train
// of a capture to the first train of the next if no train was left out between them. "Last" is the mean over the newest
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
/// Returns the statistic's name as shown: "mean", "s.d.", "n".
[[nodiscard]] QString nameOf(Statistic statistic);

/// NaN if there are too few readings: the deviation needs two, the others one. n is never NaN.
class RunningStatistics {
public:
    void add(double value) noexcept;
    void setLast(double value) noexcept { last_ = value; }
    /// The newest capture gives only an upper bound for the reading.
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

/// The text of a table cell. The number of readings has no unit; the last value may be an upper bound ("≤").
[[nodiscard]] QString statisticText(Reading reading, Statistic statistic, const RunningStatistics& its,
                                    const QString& channelUnit);

class CaptureStatistics {
public:
    struct Channel {
        QString name;
        QString letter;  ///< unit letter of the channel: "V"
        QString unit;
        std::array<RunningStatistics, kReadings> readings;
        double lastOnset_s = kNotMeasured;  ///< onset of the last train, from which the next interval runs
        [[nodiscard]] const RunningStatistics& of(Reading r) const { return readings[static_cast<std::size_t>(r)]; }
    };

    /// Adds a capture. Restarts the statistics if the channels changed or another drive was asked for: another
    /// amplitude or interval by hand, or a change between hand and fingertip.
    void add(const ShownCapture& shown);
    /// The next capture does not follow the last one directly: no interval is measured between them.
    void breakOff();
    void clear();
    [[nodiscard]] const std::vector<Channel>& channels() const noexcept { return channels_; }
    [[nodiscard]] std::size_t captures() const noexcept { return captures_; }
    /// "since 16:59:12": the time of the first counted capture; empty if unknown.
    [[nodiscard]] QString sinceText() const;

private:
    [[nodiscard]] bool begins(const ShownCapture& shown) const;

    std::vector<Channel> channels_;
    std::size_t captures_ = 0;
    QDateTime since_;
    std::optional<AskedDrive> asked_;   ///< the drive that was asked for when these captures were taken
    double programmed_ = kNotMeasured;  ///< programmed value of the first capture's train
};

}  // namespace tacto::gui
