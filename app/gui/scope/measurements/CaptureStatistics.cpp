#include "app/gui/scope/measurements/CaptureStatistics.h"

#include <QObject>
#include <algorithm>
#include <cmath>

namespace tacto::gui {

namespace {

/// Returns the interval from the previous capture's last train to this one's first; nothing if a pulse is not measured.
std::optional<double> intervalAcross(double lastOnset_s, const ChannelMeasurement& measured) {
    if (std::isnan(lastOnset_s) || measured.trains.empty()) return std::nullopt;
    if (!measured.pulses.front().flags.measured()) return std::nullopt;
    const double interval_s = measured.trains.front().onset_s - lastOnset_s;
    return interval_s > 0 ? std::optional(interval_s) : std::nullopt;
}

double lastOnset(const ChannelMeasurement& measured) {
    if (measured.trains.empty() || measured.trains.back().flagged > 0) return kNotMeasured;
    return measured.pulses.back().flags.measured() ? measured.trains.back().onset_s : kNotMeasured;
}

}  // namespace

QString nameOf(Statistic statistic) {
    const QString names[] = {QObject::tr("last"), QObject::tr("mean"), QObject::tr("s.d."),
                             QObject::tr("min"),  QObject::tr("max"),  QObject::tr("n")};
    return names[static_cast<std::size_t>(statistic)];
}

void RunningStatistics::add(double value) noexcept {
    min_ = n_ == 0 ? value : std::min(min_, value);
    max_ = n_ == 0 ? value : std::max(max_, value);
    ++n_;
    // Welford's method: a difference of two large sums would lose precision.
    const double off = value - mean_;
    mean_ += off / static_cast<double>(n_);
    squares_ += off * (value - mean_);
}

double RunningStatistics::sd() const noexcept {
    return n_ > 1 ? std::sqrt(squares_ / static_cast<double>(n_ - 1)) : kNotMeasured;
}

double RunningStatistics::of(Statistic statistic) const noexcept {
    const double all[] = {last_, mean(), sd(), min(), max(), static_cast<double>(n_)};
    return all[static_cast<std::size_t>(statistic)];
}

QString statisticText(Reading reading, Statistic statistic, const RunningStatistics& its, const QString& channelUnit) {
    if (statistic == Statistic::Count) return QString::number(its.n());
    if (statistic == Statistic::Last && its.upperBound()) return upperBoundText(*its.upperBound());
    // Two digits are enough: a standard deviation is not known better.
    return readingText(reading, its.of(statistic), channelUnit, statistic == Statistic::Sd ? 2 : 4);
}

void CaptureStatistics::clear() {
    channels_.clear();
    captures_ = 0;
    since_ = {};
    asked_.reset();
    programmed_ = kNotMeasured;
}

/// A train may still follow an earlier order: its programmed values show this.
bool CaptureStatistics::begins(const ShownCapture& shown) const {
    constexpr double kSameCommand = 1e-6;  // relative; smaller differences are ignored
    constexpr double kSameOutput = 0.02;   // relative; a current changes with the impedance
    const auto another = [](double a, double b, double share) { return std::abs(a - b) > share * std::abs(b); };
    if (captures_ == 0 || !shown.asked) return false;
    if (!asked_ || asked_->byHand != shown.asked->byHand) return true;
    return shown.asked->byHand && (another(shown.asked->amplitude_v, asked_->amplitude_v, kSameCommand) ||
                                   another(shown.asked->interval_s, asked_->interval_s, kSameCommand) ||
                                   another(shown.capture->programmed, programmed_, kSameOutput));
}

QString CaptureStatistics::sinceText() const {
    return since_.isValid() ? QObject::tr("since %1").arg(since_.toString("HH:mm:ss")) : QString();
}

void CaptureStatistics::breakOff() {
    for (auto& channel : channels_) channel.lastOnset_s = kNotMeasured;
}

void CaptureStatistics::add(const ShownCapture& shown) {
    const auto& measured = shown.measurement;
    if (begins(shown)) clear();
    const bool same =
        std::equal(channels_.begin(), channels_.end(), measured.begin(), measured.end(),
                   [](const Channel& c, const ChannelMeasurement& m) {
                       return c.name == QString::fromStdString(m.name) && c.unit == QString::fromStdString(m.unit);
                   });
    if (!same) {
        clear();
        for (std::size_t c = 0; c < measured.size(); ++c) {
            channels_.push_back({QString::fromStdString(measured[c].name),
                                 shown.traces[c]->letter,
                                 QString::fromStdString(measured[c].unit),
                                 {}});
        }
    }
    if (!shown.follows) breakOff();
    if (++captures_ == 1) {
        since_ = shown.taken;
        programmed_ = shown.capture->programmed;
    }
    if (shown.asked) asked_ = shown.asked;
    for (std::size_t c = 0; c < measured.size(); ++c) {
        for (const auto reading : allReadings()) {
            auto& its = channels_[c].readings[static_cast<std::size_t>(reading)];
            auto values = readingsOf(reading, shown, c);
            if (reading == Reading::Interval) {
                if (const auto across = intervalAcross(channels_[c].lastOnset_s, measured[c])) {
                    values.push_back(*across);
                }
            }
            RunningStatistics here;
            for (const double value : values) {
                its.add(value);
                here.add(value);
            }
            its.setLast(here.mean());
            its.setUpperBound(upperBound(reading, shown, c));
        }
        channels_[c].lastOnset_s = lastOnset(measured[c]);
    }
}

}  // namespace tacto::gui
