#include "app/gui/scope/measurements/Reading.h"

#include <QKeyEvent>
#include <QMenu>
#include <QMouseEvent>
#include <QObject>
#include <QSettings>
#include <algorithm>
#include <cmath>
#include <variant>

#include "app/gui/theme/Text.h"
#include "app/report/NumberText.h"

namespace tacto::gui {

namespace {

// Where a reading is stored: in a phase, in the pulse, in the waveform or in the load.
struct OfLeading {
    double PhaseMeasurement::*its;
    bool magnitude = false;
};
struct OfSecond {
    double PhaseMeasurement::*its;  ///< read as a magnitude
};
using ReadFrom = std::variant<std::monostate, OfLeading, OfSecond, double PulseMeasurement::*,
                              double WaveformMeasurement::*, double PulseLoad::*>;

struct ReadingRow {
    const char* key;
    const char* title;
    const char* explained;
    const char* unit;
    ReadFrom source{};
};

#define WORDS(text) QT_TRANSLATE_NOOP("QObject", text)

/// The rows, in the order of Reading.
const std::array<ReadingRow, kReadings> kDescribed{{
    {"amplitude", WORDS("Amplitude"),
     WORDS("Mean height of the leading phase above the baseline, from 30 to 90 % of its width."), "",
     OfLeading{&PhaseMeasurement::plateau, true}},
    {"peak-to-peak", WORDS("Pk-pk"), WORDS("Largest minus smallest sample of the record, noise included."), "",
     &WaveformMeasurement::peakToPeak},
    {"width", WORDS("Width"), WORDS("Leading phase, from half height to half height."), "s",
     OfLeading{&PhaseMeasurement::width_s}},
    {"gap", WORDS("Gap"), WORDS("Between the two phases of a biphasic pulse, at half height."), "s",
     &PulseMeasurement::gap_s},
    {"interval", WORDS("Interval"),
     WORDS("Onset to onset of trains, in a record and from one capture to the next. A train that the oscilloscope "
           "missed makes it a multiple."),
     "s"},
    {"rise", WORDS("Rise"), WORDS("Leading edge of the leading phase, from 10 to 90 % of the height."), "s",
     OfLeading{&PhaseMeasurement::rise_s}},
    {"fall", WORDS("Fall"), WORDS("Trailing edge of the leading phase, from 90 to 10 % of the height."), "s",
     OfLeading{&PhaseMeasurement::fall_s}},
    {"charge", WORDS("Charge"), WORDS("Area under the leading phase of a current."), "C",
     OfLeading{&PhaseMeasurement::charge, true}},
    {"imbalance", WORDS("Imbalance"),
     WORDS("Charge that the second phase does not bring back, as a share of the larger phase."), "%",
     &PulseMeasurement::imbalance},
    {"overshoot", WORDS("Overshoot"), WORDS("Largest excess over the plateau, as a share of it."), "%",
     OfLeading{&PhaseMeasurement::overshoot}},
    {"droop", WORDS("Droop"), WORDS("What the plateau loses over the width, as a share of it."), "%",
     OfLeading{&PhaseMeasurement::droop}},
    {"frequency", WORDS("Frequency"),
     WORDS("Periods a second between the first and the last time that the waveform leaves its baseline, at half "
           "height."),
     "Hz", &WaveformMeasurement::frequency_hz},
    {"duty", WORDS("Duty cycle"), WORDS("Share of whole periods that the waveform is beyond half the height."), "%",
     &WaveformMeasurement::duty},
    {"rms", WORDS("RMS"), WORDS("Root mean square about zero over the whole record: silence counts too."), "",
     &WaveformMeasurement::rms},
    {"mean", WORDS("Mean"), WORDS("Over the whole record."), "", &WaveformMeasurement::mean},
    {"second-amplitude", WORDS("2nd amplitude"), WORDS("Mean height of the second phase, as of the leading one."), "",
     OfSecond{&PhaseMeasurement::plateau}},
    {"second-width", WORDS("2nd width"), WORDS("Second phase, from half height to half height."), "s",
     OfSecond{&PhaseMeasurement::width_s}},
    {"second-charge", WORDS("2nd charge"), WORDS("Area under the second phase of a current."), "C",
     OfSecond{&PhaseMeasurement::charge}},
    {"net-charge", WORDS("Net charge"),
     WORDS("Charge of both phases of a pulse with their signs, gap included: what is left behind."), "C",
     &PulseLoad::netCharge_c},
    {"energy", WORDS("Energy"),
     WORDS("Voltage times current over a pulse, both phases and the gap: what stays in the load."), "J",
     &PulseLoad::energy_j},
    {"pulses", WORDS("Pulses"), WORDS("Pulses measured in a capture. Those that were not are named on the screen."),
     ""},
}};

#undef WORDS

const ReadingRow& described(Reading reading) { return kDescribed[static_cast<std::size_t>(reading)]; }

double ofPulse(Reading reading, const PulseMeasurement& pulse) {
    const auto& source = described(reading).source;
    if (const auto* leading = std::get_if<OfLeading>(&source)) {
        const double value = pulse.leading.*leading->its;
        return leading->magnitude ? std::abs(value) : value;
    }
    if (const auto* second = std::get_if<OfSecond>(&source))
        return pulse.second ? std::abs((*pulse.second).*second->its) : kNotMeasured;
    const auto* its = std::get_if<double PulseMeasurement::*>(&source);
    return its != nullptr ? pulse.**its : kNotMeasured;
}

/// Returns null if the reading does not come from the waveform.
const double* ofWaveform(Reading reading, const WaveformMeasurement& waveform) {
    const auto* its = std::get_if<double WaveformMeasurement::*>(&described(reading).source);
    return its != nullptr ? &(waveform.**its) : nullptr;
}

/// True if the reading needs voltage and current together.
bool isOfLoad(Reading reading) { return std::holds_alternative<double PulseLoad::*>(described(reading).source); }

bool isCharge(Reading reading) { return std::string_view(described(reading).unit) == "C"; }

/// Shows at most thousandths of a per cent, because smaller digits are noise.
QString percentText(double value) {
    const double size = std::abs(value);
    const int decimals = size >= 10 ? 1 : size >= 1 ? 2 : 3;
    return decimalText(value, decimals, "%");
}

bool isEdge(Reading reading) { return reading == Reading::Rise || reading == Reading::Fall; }

/// Returns the time between two measured values. A measured value is the mean of several samples of a noisy record.
double sampleInterval_s(const ChannelMeasurement& measured) {
    return static_cast<double>(std::max<std::size_t>(1, measured.quality.mean)) / measured.rate_hz;
}

/// The shortest edge that can be measured: it needs a sample on the edge and one on each side.
double leastEdge_s(const ChannelMeasurement& measured) { return 2 * sampleInterval_s(measured); }

}  // namespace

std::array<Reading, kReadings> allReadings() {
    std::array<Reading, kReadings> all{};
    for (std::size_t i = 0; i < kReadings; ++i) all[i] = static_cast<Reading>(i);
    return all;
}

ReadingName nameOf(Reading reading) {
    const auto& its = described(reading);
    return {its.key, QObject::tr(its.title), QObject::tr(its.explained), its.unit};
}

std::optional<Reading> readingOfKey(const QString& key) {
    for (const auto reading : allReadings()) {
        if (nameOf(reading).key == key) return reading;
    }
    return std::nullopt;
}

std::vector<double> readingsOf(Reading reading, const ShownCapture& shown, std::size_t channel) {
    const auto& measured = shown.measurement[channel];
    std::vector<double> values;
    if (isCharge(reading) && measured.unit != "A") return {};
    if (reading == Reading::Pulses) return {static_cast<double>(measured.measuredPulses)};
    if (const auto* whole = ofWaveform(reading, shown.waveforms[channel])) {
        values.push_back(*whole);
    } else if (isOfLoad(reading)) {
        if (shown.loadCurrent != channel) return {};
        for (const auto& pulse : shown.loads)
            values.push_back(pulse.*std::get<double PulseLoad::*>(described(reading).source));
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

namespace {

const std::vector<Reading> kStandard{Reading::Amplitude, Reading::PeakToPeak, Reading::Width,  Reading::Gap,
                                     Reading::Interval,  Reading::Rise,       Reading::Charge, Reading::Imbalance};

/// A menu that stays open when the user chooses an entry.
class StayingMenu final : public QMenu {
public:
    using QMenu::QMenu;

protected:
    void mouseReleaseEvent(QMouseEvent* event) override {
        if (!toggled(actionAt(event->position().toPoint()))) QMenu::mouseReleaseEvent(event);
    }
    void keyPressEvent(QKeyEvent* event) override {
        const bool chooses = event->key() == Qt::Key_Return || event->key() == Qt::Key_Enter;
        if (!chooses || !toggled(activeAction())) QMenu::keyPressEvent(event);
    }

private:
    static bool toggled(QAction* action) {
        if (action == nullptr || !action->isCheckable()) return false;
        action->trigger();
        return true;
    }
};

}  // namespace

ChosenReadings::ChosenReadings() : chosen_(kStandard) {}

bool ChosenReadings::has(Reading reading) const {
    return std::find(chosen_.begin(), chosen_.end(), reading) != chosen_.end();
}

void ChosenReadings::choose(Reading reading, bool on) {
    if (has(reading) == on) return;
    if (on) {
        chosen_.insert(std::upper_bound(chosen_.begin(), chosen_.end(), reading), reading);
    } else {
        std::erase(chosen_, reading);
    }
    emit changed();
}

void ChosenReadings::chooseStandard() {
    if (chosen_ == kStandard) return;
    chosen_ = kStandard;
    emit changed();
}

void ChosenReadings::save(QSettings& settings) const {
    QStringList keys;
    for (const auto reading : chosen_) keys << nameOf(reading).key;
    settings.setValue("readings", keys);
}

void ChosenReadings::restore(const QSettings& settings) {
    std::vector<Reading> restored;
    for (const auto& key : settings.value("readings").toStringList()) {
        const auto reading = readingOfKey(key);
        if (reading && std::find(restored.begin(), restored.end(), *reading) == restored.end()) {
            restored.push_back(*reading);
        }
    }
    std::sort(restored.begin(), restored.end());
    if (restored.empty() || restored == chosen_) return;
    chosen_ = restored;
    emit changed();
}

QMenu* makeReadingsMenu(ChosenReadings& chosen, QWidget* parent) {
    auto* menu = new StayingMenu(parent);
    menu->setToolTipsVisible(true);
    std::vector<QAction*> actions;
    for (const auto reading : allReadings()) {
        const auto name = nameOf(reading);
        auto* action = menu->addAction(name.title);
        action->setToolTip(name.explained);
        action->setCheckable(true);
        action->setChecked(chosen.has(reading));
        QObject::connect(action, &QAction::toggled, &chosen,
                         [&chosen, reading](bool on) { chosen.choose(reading, on); });
        actions.push_back(action);
    }
    QObject::connect(&chosen, &ChosenReadings::changed, menu, [&chosen, actions] {
        for (std::size_t i = 0; i < actions.size(); ++i) actions[i]->setChecked(chosen.has(allReadings()[i]));
    });
    menu->addSeparator();
    menu->addAction(QObject::tr("As at first"), &chosen, &ChosenReadings::chooseStandard);
    menu->addSeparator();
    menu->addAction(QObject::tr("Close"))->setToolTip(QObject::tr("Closes this list. Esc stops the output as well."));
    return menu;
}

}  // namespace tacto::gui

#include "moc_Reading.cpp"
