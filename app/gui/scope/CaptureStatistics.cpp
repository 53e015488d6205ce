#include "app/gui/scope/CaptureStatistics.h"

#include <QObject>
#include <algorithm>
#include <cmath>

namespace tacto::gui {

namespace {

double readingOf(Reading reading, const PulseMeasurement& pulse) {
    switch (reading) {
        case Reading::Amplitude:
            return std::abs(pulse.leading.plateau);
        case Reading::Width:
            return pulse.leading.width_s;
        case Reading::Rise:
            return pulse.leading.rise_s;
        case Reading::Fall:
            return pulse.leading.fall_s;
        case Reading::Overshoot:
            return pulse.leading.overshoot;
        case Reading::Droop:
            return pulse.leading.droop;
        case Reading::Charge:
            return std::abs(pulse.leading.charge);
        case Reading::Gap:
            return pulse.gap_s;
        case Reading::Imbalance:
            return pulse.imbalance;
        case Reading::Interval:
        case Reading::Pulses:
            break;
    }
    return kNotMeasured;
}

std::vector<double> readingsOf(Reading reading, const ChannelMeasurement& measured) {
    std::vector<double> values;
    if (reading == Reading::Pulses) return {static_cast<double>(measured.measuredPulses)};
    if (reading == Reading::Interval) {
        for (const auto& train : measured.trains) values.push_back(train.interval_s);
    } else {
        for (const auto& pulse : measured.pulses) values.push_back(readingOf(reading, pulse));
    }
    std::erase_if(values, [](double v) { return std::isnan(v); });
    return values;
}

}  // namespace

ReadingName readingName(Reading reading) {
    switch (reading) {
        case Reading::Amplitude:
            return {QObject::tr("Amplitude"),
                    QObject::tr("Mean height of the leading phase above the baseline, from 30 to 90 % of its width."),
                    ""};
        case Reading::Width:
            return {QObject::tr("Width"), QObject::tr("Leading phase, from half height to half height."), "s"};
        case Reading::Interval:
            return {QObject::tr("Interval"),
                    QObject::tr("From the onset of a train to the onset of the next, within one record. A record that "
                                "holds one train has none: choose a longer record."),
                    "s"};
        case Reading::Rise:
            return {QObject::tr("Rise"), QObject::tr("Leading edge, from 10 to 90 % of the height."), "s"};
        case Reading::Fall:
            return {QObject::tr("Fall"), QObject::tr("Trailing edge, from 90 to 10 % of the height."), "s"};
        case Reading::Overshoot:
            return {QObject::tr("Overshoot"), QObject::tr("Largest excess over the plateau, as a share of it."), "%"};
        case Reading::Droop:
            return {QObject::tr("Droop"), QObject::tr("What the plateau loses over the width, as a share of it."), "%"};
        case Reading::Charge:
            return {QObject::tr("Charge"), QObject::tr("Area under the leading phase. Coulombs on a current channel."),
                    ""};
        case Reading::Gap:
            return {QObject::tr("Gap"), QObject::tr("Between the two phases of a biphasic pulse, at half height."),
                    "s"};
        case Reading::Imbalance:
            return {QObject::tr("Imbalance"),
                    QObject::tr("Charge that the second phase does not bring back, as a share of the larger phase."),
                    "%"};
        case Reading::Pulses:
            break;
    }
    return {QObject::tr("Pulses"), QObject::tr("Pulses measured in a capture. Those that were not are named below."),
            ""};
}

QString unitOf(Reading reading, const QString& channelUnit) {
    if (reading == Reading::Amplitude) return channelUnit;
    if (reading == Reading::Charge) return channelUnit == "A" ? "C" : channelUnit == "V" ? "µV·s" : "s";
    return readingName(reading).unit;
}

double shownFactor(Reading reading, const QString& channelUnit) {
    if (reading == Reading::Charge && channelUnit == "V") return 1e6;
    return readingName(reading).unit == "%" ? 100 : 1;
}

void RunningStatistics::add(double value) noexcept {
    min_ = n_ == 0 ? value : std::min(min_, value);
    max_ = n_ == 0 ? value : std::max(max_, value);
    ++n_;
    // Welford: the difference of two large sums would lose the deviation.
    const double off = value - mean_;
    mean_ += off / static_cast<double>(n_);
    squares_ += off * (value - mean_);
}

double RunningStatistics::sd() const noexcept {
    return n_ > 1 ? std::sqrt(squares_ / static_cast<double>(n_ - 1)) : kNotMeasured;
}

void CaptureStatistics::clear() {
    channels_.clear();
    captures_ = 0;
}

void CaptureStatistics::add(const std::vector<ChannelMeasurement>& measured) {
    const bool same =
        std::equal(channels_.begin(), channels_.end(), measured.begin(), measured.end(),
                   [](const Channel& c, const ChannelMeasurement& m) {
                       return c.name == QString::fromStdString(m.name) && c.unit == QString::fromStdString(m.unit);
                   });
    if (!same) {
        clear();
        for (const auto& m : measured) {
            channels_.push_back({QString::fromStdString(m.name), QString::fromStdString(m.unit), {}});
        }
    }
    ++captures_;
    for (std::size_t c = 0; c < measured.size(); ++c) {
        for (std::size_t r = 0; r < kReadings; ++r) {
            auto& its = channels_[c].readings[r];
            RunningStatistics here;
            for (const double value : readingsOf(static_cast<Reading>(r), measured[c])) {
                its.add(value);
                here.add(value);
            }
            its.setLast(here.mean());
        }
    }
}

}  // namespace tacto::gui
