#include "app/gui/scope/MeasurementSummary.h"

#include <QEvent>
#include <QGridLayout>
#include <QLabel>
#include <QVBoxLayout>
#include <cmath>

#include "app/gui/look/Look.h"
#include "app/gui/look/Text.h"
#include "app/gui/scope/CaptureStatistics.h"

namespace tacto::gui {

namespace {

constexpr std::array<Reading, 4> kShown{Reading::Amplitude, Reading::Width, Reading::Interval, Reading::Charge};

/// The value at the end of the leading phase: the plateau is the mean around 60 % of the width, and the droop is the
/// slope over the whole of it.
double endOfPhase(const ChannelMeasurement& channel) {
    const double droop = std::isfinite(channel.droop.mean) ? channel.droop.mean : 0;
    return channel.amplitude.mean * (1 - 0.4 * droop);
}

const ChannelMeasurement* measuredIn(const std::vector<ChannelMeasurement>& measured, std::string_view unit) {
    for (const auto& channel : measured) {
        if (channel.unit == unit && channel.measuredPulses > 0) return &channel;
    }
    return nullptr;
}

double valueOf(Reading reading, const ChannelMeasurement& channel) {
    const auto& statistics = reading == Reading::Amplitude  ? channel.amplitude
                             : reading == Reading::Width    ? channel.width_s
                             : reading == Reading::Interval ? channel.interval_s
                                                            : channel.charge;
    if (statistics.n == 0) return kNotMeasured;
    return reading == Reading::Charge ? std::abs(statistics.mean) : statistics.mean;
}

QString whyMissing(Reading reading, const ChannelMeasurement& channel) {
    if (reading == Reading::Charge && channel.unit != "A") return QObject::tr("Charge is read on the current channel.");
    if (channel.pulses.empty()) return QObject::tr("No pulse stands out of the baseline on this channel.");
    if (channel.measuredPulses == 0) {
        return QObject::tr("The pulses are clipped, cut off or too coarse to be measured: the oscilloscope names it.");
    }
    return QObject::tr("The record holds one train. For an interval choose a longer record in the oscilloscope.");
}

}  // namespace

double impedanceOf(const std::vector<ChannelMeasurement>& measured) {
    const auto* volts = measuredIn(measured, "V");
    const auto* amps = measuredIn(measured, "A");
    if (volts == nullptr || amps == nullptr || !(endOfPhase(*amps) > 0)) return kNotMeasured;
    return endOfPhase(*volts) / endOfPhase(*amps);
}

MeasurementSummary::MeasurementSummary(QWidget* parent)
    : QWidget(parent),
      head_(new QLabel(this)),
      grid_(new QGridLayout),
      impedanceName_(new QLabel(tr("|Z|"), this)),
      impedance_(new QLabel(this)),
      note_(new QLabel(this)) {
    setAccessibleName(tr("Measurements"));
    head_->setObjectName("summaryHead");
    head_->setWordWrap(true);
    note_->setObjectName("summaryNote");
    note_->setWordWrap(true);
    for (std::size_t r = 0; r < kRows; ++r) {
        const auto name = readingName(kShown[r]);
        names_[r] = new QLabel(name.title, this);
        names_[r]->setToolTip(name.explained);
        grid_->addWidget(names_[r], static_cast<int>(r) + 1, 0);
    }
    impedanceName_->setToolTip(
        tr("Impedance of the load: voltage over current at the end of the leading phase, at this pulse's width."));
    impedance_->setAlignment(Qt::AlignRight);
    impedance_->setFont(digits(font()));
    impedance_->setAccessibleName(tr("Impedance"));
    grid_->setColumnStretch(0, 1);
    grid_->setHorizontalSpacing(fontMetrics().averageCharWidth() * 2);
    grid_->setVerticalSpacing(3);
    auto* layout = new QVBoxLayout(this);
    layout->addWidget(head_);
    layout->addLayout(grid_);
    layout->addWidget(note_);
    layout->addStretch();
    connect(&pipe_, &CapturePipe::prepared, this, &MeasurementSummary::take);
    restyle();
    fill();
}

void MeasurementSummary::take(const ShownPtr& shown) {
    if (!shown) return;
    if (shown->capture->untriggered) {
        quietSince_ = true;
        return sayHead();
    }
    quietSince_ = false;
    shown_ = shown;
    since_.start();
    fill();
}

void MeasurementSummary::measure(std::shared_ptr<const Capture> capture) { pipe_.take(std::move(capture)); }

void MeasurementSummary::clear() {
    shown_.reset();
    quietSince_ = false;
    fill();
}

void MeasurementSummary::refresh(const Telemetry& telemetry) {
    checked_ohm_ = telemetry.impedance_ohm;
    checkAge_s_ = telemetry.impedanceAge_s;
    sayHead();
    sayImpedance();
}

void MeasurementSummary::lay(const std::vector<ChannelMeasurement>& measured) {
    const bool same =
        std::equal(columns_.begin(), columns_.end(), measured.begin(), measured.end(),
                   [](const Column& c, const ChannelMeasurement& m) {
                       return c.name == QString::fromStdString(m.name) && c.unit == QString::fromStdString(m.unit);
                   });
    if (same) return;
    for (auto& column : columns_) {
        delete column.title;
        for (auto* value : column.values) delete value;
    }
    columns_.clear();
    for (const auto& m : measured) {
        Column column{QString::fromStdString(m.name), QString::fromStdString(m.unit), new QLabel(this), {}};
        const int at = static_cast<int>(columns_.size()) + 1;
        column.title->setAlignment(Qt::AlignRight);
        grid_->addWidget(column.title, 0, at);
        for (std::size_t r = 0; r < kRows; ++r) {
            auto* value = column.values[r] = new QLabel(this);
            value->setAlignment(Qt::AlignRight);
            value->setFont(digits(font()));
            value->setAccessibleName(tr("%1 of %2").arg(readingName(kShown[r]).title, titled(column.name)));
            grid_->addWidget(value, static_cast<int>(r) + 1, at);
        }
        columns_.push_back(column);
    }
    const int last = std::max(1, static_cast<int>(columns_.size()));
    const int row = static_cast<int>(kRows) + 1;
    grid_->addWidget(impedanceName_, row, 0);
    grid_->addWidget(impedance_, row, 1, 1, last);
    restyle();
}

void MeasurementSummary::fill() {
    const bool some = shown_ != nullptr;
    if (some) lay(shown_->measurement);
    for (auto* name : names_) name->setVisible(some);
    for (auto& column : columns_) {
        column.title->setVisible(some);
        for (auto* value : column.values) value->setVisible(some);
    }
    impedanceName_->setVisible(some);
    impedance_->setVisible(some);
    QStringList why;
    for (std::size_t c = 0; some && c < columns_.size(); ++c) {
        const auto& channel = shown_->measurement[c];
        for (std::size_t r = 0; r < kRows; ++r) {
            const auto reading = kShown[r];
            auto* label = columns_[c].values[r];
            const bool charge = reading == Reading::Charge && columns_[c].unit != "A";
            const double value = charge ? kNotMeasured : valueOf(reading, channel);
            label->setText(
                quantityText(shownFactor(reading, columns_[c].unit) * value, unitOf(reading, columns_[c].unit)));
            const bool missing = std::isnan(value);
            label->setToolTip(missing ? whyMissing(reading, channel) : readingName(reading).explained);
            if (missing && reading == Reading::Amplitude) {
                why << tr("%1: %2").arg(titled(columns_[c].name), whyMissing(reading, channel));
            }
        }
    }
    note_->setText(why.join('\n'));
    note_->setVisible(!why.isEmpty());
    sayHead();
    sayImpedance();
}

void MeasurementSummary::sayHead() {
    if (!shown_) {
        head_->setText(quietSince_ ? tr("No trigger yet: nothing is measured.")
                                   : tr("Nothing is measured yet. The figures of the oscilloscope's latest capture "
                                        "appear here."));
        return;
    }
    QStringList parts;
    parts << (shown_->source.isEmpty() ? ageText(static_cast<double>(since_.elapsed()) / 1000) : shown_->source);
    if (quietSince_) parts << tr("no trigger since");
    if (shown_->capture->simulated) parts << tr("simulated");
    head_->setText(parts.join(QStringLiteral(" · ")));
}

void MeasurementSummary::sayImpedance() {
    if (!shown_) return;
    const double seen = impedanceOf(shown_->measurement);
    const bool checked = !std::isfinite(seen) && std::isfinite(checked_ohm_);
    impedanceName_->setText(checked ? tr("|Z|, check %1").arg(ageText(checkAge_s_)) : tr("|Z|"));
    impedance_->setText(quantityText(checked ? checked_ohm_ : seen, "ohm", 3));
    impedance_->setToolTip(checked ? tr("From the stimulator's last impedance check: the capture does not give it.")
                           : std::isfinite(seen)
                               ? impedanceName_->toolTip()
                               : tr("It takes a measured pulse on a voltage and on a current channel."));
}

void MeasurementSummary::changeEvent(QEvent* event) {
    QWidget::changeEvent(event);
    if (event->type() == QEvent::PaletteChange || event->type() == QEvent::FontChange) restyle();
}

void MeasurementSummary::restyle() {
    // The numbers are the data; what stands around them is quiet. Roles and rich text follow a theme: a label's own
    // palette is laid aside when the theme's style sheet comes.
    for (auto* label : {head_, note_, impedanceName_}) label->setForegroundRole(QPalette::PlaceholderText);
    for (auto* label : names_) label->setForegroundRole(QPalette::PlaceholderText);
    const auto& c = colours();
    for (auto& column : columns_) {
        column.title->setText(
            QString("<span style=\"color:%1\">%2</span>")
                .arg((column.unit == "A" ? c.current : c.voltage).name(), titled(column.name).toHtmlEscaped()));
        for (auto* value : column.values) {
            value->setFont(digits(font()));
            // As wide as what may come: figures that jump cannot be read.
            value->setMinimumWidth(value->fontMetrics().horizontalAdvance("000.0 mm"));
        }
    }
    impedance_->setFont(digits(font()));
}

}  // namespace tacto::gui
