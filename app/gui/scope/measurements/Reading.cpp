#include "app/gui/scope/measurements/Reading.h"

#include <QObject>
#include <algorithm>
#include <cmath>

#include "app/gui/theme/Text.h"
#include "app/report/NumberText.h"

namespace tacto::gui {

namespace {

double ofPulse(Reading reading, const PulseMeasurement& pulse) {
    const auto second = [&](auto member) { return pulse.second ? std::abs((*pulse.second).*member) : kNotMeasured; };
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
        case Reading::SecondAmplitude:
            return second(&PhaseMeasurement::plateau);
        case Reading::SecondWidth:
            return second(&PhaseMeasurement::width_s);
        case Reading::SecondCharge:
            return second(&PhaseMeasurement::charge);
        default:
            return kNotMeasured;
    }
}

std::optional<double> ofWaveform(Reading reading, const WaveformMeasurement& waveform) {
    switch (reading) {
        case Reading::PeakToPeak:
            return waveform.peakToPeak;
        case Reading::Rms:
            return waveform.rms;
        case Reading::Mean:
            return waveform.mean;
        case Reading::Frequency:
            return waveform.frequency_hz;
        case Reading::Duty:
            return waveform.duty;
        default:
            return std::nullopt;
    }
}

/// A share to a thousandth of a per cent: what is below that is noise.
QString percentText(double value) {
    const double size = std::abs(value);
    const int decimals = size >= 10 ? 1 : size >= 1 ? 2 : 3;
    return decimalText(value, decimals, "%");
}

bool isCharge(Reading reading) {
    return reading == Reading::Charge || reading == Reading::SecondCharge || reading == Reading::NetCharge;
}

bool isEdge(Reading reading) { return reading == Reading::Rise || reading == Reading::Fall; }

/// The time between two measured values, which are means of samples in a noisy record.
double sampleInterval_s(const ChannelMeasurement& measured) {
    return static_cast<double>(std::max<std::size_t>(1, measured.quality.mean)) / measured.rate_hz;
}

/// An edge needs a sample on it and one beside it either way.
double leastEdge_s(const ChannelMeasurement& measured) { return 2 * sampleInterval_s(measured); }

/// What takes the voltage and the current together.
bool isOfLoad(Reading reading) { return reading == Reading::NetCharge || reading == Reading::Energy; }

double ofLoad(Reading reading, const PulseLoad& pulse) {
    return reading == Reading::NetCharge ? pulse.netCharge_c : pulse.energy_j;
}

}  // namespace

std::array<Reading, kReadings> allReadings() {
    std::array<Reading, kReadings> all{};
    for (std::size_t i = 0; i < kReadings; ++i) all[i] = static_cast<Reading>(i);
    return all;
}

ReadingName nameOf(Reading reading) {
    switch (reading) {
        case Reading::Amplitude:
            return {"amplitude", QObject::tr("Amplitude"),
                    QObject::tr("Mean height of the leading phase above the baseline, from 30 to 90 % of its width."),
                    ""};
        case Reading::PeakToPeak:
            return {"peak-to-peak", QObject::tr("Pk-pk"),
                    QObject::tr("Largest minus smallest sample of the record, noise included."), ""};
        case Reading::Width:
            return {"width", QObject::tr("Width"), QObject::tr("Leading phase, from half height to half height."), "s"};
        case Reading::Gap:
            return {"gap", QObject::tr("Gap"),
                    QObject::tr("Between the two phases of a biphasic pulse, at half height."), "s"};
        case Reading::Interval:
            return {"interval", QObject::tr("Interval"),
                    QObject::tr("Onset to onset of trains, in a record and from one capture to the next. A train that "
                                "the oscilloscope missed makes it a multiple."),
                    "s"};
        case Reading::Rise:
            return {"rise", QObject::tr("Rise"),
                    QObject::tr("Leading edge of the leading phase, from 10 to 90 % of the height."), "s"};
        case Reading::Fall:
            return {"fall", QObject::tr("Fall"),
                    QObject::tr("Trailing edge of the leading phase, from 90 to 10 % of the height."), "s"};
        case Reading::Charge:
            return {"charge", QObject::tr("Charge"), QObject::tr("Area under the leading phase of a current."), "C"};
        case Reading::Imbalance:
            return {"imbalance", QObject::tr("Imbalance"),
                    QObject::tr("Charge that the second phase does not bring back, as a share of the larger phase."),
                    "%"};
        case Reading::Overshoot:
            return {"overshoot", QObject::tr("Overshoot"),
                    QObject::tr("Largest excess over the plateau, as a share of it."), "%"};
        case Reading::Droop:
            return {"droop", QObject::tr("Droop"),
                    QObject::tr("What the plateau loses over the width, as a share of it."), "%"};
        case Reading::Frequency:
            return {"frequency", QObject::tr("Frequency"),
                    QObject::tr("Periods a second between the first and the last time that the waveform leaves its "
                                "baseline, at half height."),
                    "Hz"};
        case Reading::Duty:
            return {"duty", QObject::tr("Duty cycle"),
                    QObject::tr("Share of whole periods that the waveform is beyond half the height."), "%"};
        case Reading::Rms:
            return {"rms", QObject::tr("RMS"),
                    QObject::tr("Root mean square about zero over the whole record: silence counts too."), ""};
        case Reading::Mean:
            return {"mean", QObject::tr("Mean"), QObject::tr("Over the whole record."), ""};
        case Reading::SecondAmplitude:
            return {"second-amplitude", QObject::tr("2nd amplitude"),
                    QObject::tr("Mean height of the second phase, as of the leading one."), ""};
        case Reading::SecondWidth:
            return {"second-width", QObject::tr("2nd width"),
                    QObject::tr("Second phase, from half height to half height."), "s"};
        case Reading::SecondCharge:
            return {"second-charge", QObject::tr("2nd charge"),
                    QObject::tr("Area under the second phase of a current."), "C"};
        case Reading::NetCharge:
            return {
                "net-charge", QObject::tr("Net charge"),
                QObject::tr("Charge of both phases of a pulse with their signs, gap included: what is left behind."),
                "C"};
        case Reading::Energy:
            return {"energy", QObject::tr("Energy"),
                    QObject::tr("Voltage times current over a pulse, both phases and the gap: what stays in the load."),
                    "J"};
        case Reading::Pulses:
            break;
    }
    return {"pulses", QObject::tr("Pulses"),
            QObject::tr("Pulses measured in a capture. Those that were not are named on the screen."), ""};
}

std::optional<Reading> readingOfKey(const QString& key) {
    for (const auto reading : allReadings()) {
        if (nameOf(reading).key == key) return reading;
    }
    return std::nullopt;
}

std::vector<double> readingsOf(Reading reading, const ShownCapture& shown, std::size_t channel) {
    const auto& measured = shown.measurement[channel];
    const auto& waveform = shown.waveforms[channel];
    std::vector<double> values;
    if (isCharge(reading) && measured.unit != "A") return {};
    if (reading == Reading::Pulses) return {static_cast<double>(measured.measuredPulses)};
    if (const auto whole = ofWaveform(reading, waveform)) {
        values.push_back(*whole);
    } else if (isOfLoad(reading)) {
        if (shown.loadCurrent != channel) return {};
        for (const auto& pulse : shown.loads) values.push_back(ofLoad(reading, pulse));
    } else if (reading == Reading::Interval) {
        for (const auto& train : measured.trains) values.push_back(train.interval_s);
    } else {
        for (const auto& pulse : measured.pulses) values.push_back(ofPulse(reading, pulse));
    }
    std::erase_if(values, [](double v) { return std::isnan(v); });
    if (isEdge(reading)) std::erase_if(values, [&](double v) { return v < leastEdge_s(measured); });
    return values;
}

std::optional<double> upperBound(Reading reading, const ShownCapture& shown, std::size_t channel) {
    if (!isEdge(reading)) return std::nullopt;
    const auto& measured = shown.measurement[channel];
    const double least_s = leastEdge_s(measured);
    bool any = false;
    for (const auto& pulse : measured.pulses) {
        const double edge_s = ofPulse(reading, pulse);
        if (edge_s >= least_s) return std::nullopt;
        any = any || edge_s < least_s;
    }
    return any ? std::optional(least_s) : std::nullopt;
}

QString upperBoundText(double bound_s) {
    const auto exact = settingText(bound_s, "s"), rounded = quantityText(bound_s, "s", 2);
    return QStringLiteral("≤\u202f") + (exact.size() <= rounded.size() ? exact : rounded);
}

QString readingText(Reading reading, double value, const QString& channelUnit, int digits) {
    if (!std::isfinite(value) || (isCharge(reading) && channelUnit != "A")) return QStringLiteral("–");
    if (reading == Reading::Pulses) return QString::number(value, 'g', digits);
    const auto unit = nameOf(reading).unit;
    if (unit == "%") return percentText(100 * value);
    return quantityText(value, unit.isEmpty() ? channelUnit : unit, digits);
}

QString whyMissing(Reading reading, const ShownCapture& shown, std::size_t channel) {
    const auto& measured = shown.measurement[channel];
    const auto& waveform = shown.waveforms[channel];
    if (reading == Reading::Energy && measured.unit != "A")
        return QObject::tr("Energy is shown on the current channel.");
    if (isCharge(reading) && measured.unit != "A") return QObject::tr("Charge is read on the current channel.");
    if (isOfLoad(reading) && shown.loadCurrent != channel) {
        return QObject::tr("This needs one channel in V and one in A: which of several belong together is not known.");
    }
    if (reading == Reading::Frequency || reading == Reading::Duty) {
        return waveform.missing > 0 ? QObject::tr("Samples are missing: a period may hide in the gap.")
                                    : QObject::tr("The record holds no whole period. Choose a longer record.");
    }
    if (ofWaveform(reading, waveform)) {
        return waveform.clipped ? QObject::tr("The record is clipped: choose a larger range.")
                                : QObject::tr("The record holds no sample.");
    }
    if (measured.pulses.empty()) return QObject::tr("No pulse differs from the baseline on this channel.");
    if (measured.measuredPulses == 0) {
        return QObject::tr(
            "The pulses are clipped, cut off or too coarse to be measured: the oscilloscope says which.");
    }
    if (isEdge(reading)) {
        return QObject::tr(
                   "The samples are %1 apart: an edge shorter than two of them is not resolved, and the statistics do "
                   "not count it. Choose a higher rate.")
            .arg(quantityText(sampleInterval_s(measured), "s", 3));
    }
    if (reading == Reading::Interval) {
        return QObject::tr(
            "This needs two trains: in one record, or in captures that follow one another. For a single "
            "capture choose a longer record.");
    }
    if (isOfLoad(reading)) return QObject::tr("The voltage of the pulses is clipped, or samples of it are missing.");
    return QObject::tr("The pulses have no second phase.");
}

QString channelLetter(const std::vector<ChannelMeasurement>& channels, std::size_t channel) {
    int number = 0, alike = 0;
    for (std::size_t c = 0; c < channels.size(); ++c) {
        if (channels[c].unit != channels[channel].unit) continue;
        ++alike;
        if (c == channel) number = alike;
    }
    const auto& unit = channels[channel].unit;
    const QString letter = unit == "V" ? "V" : unit == "A" ? "I" : "D";
    return alike > 1 ? letter + QString::number(number) : letter;
}

}  // namespace tacto::gui
