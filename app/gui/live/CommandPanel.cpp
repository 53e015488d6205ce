#include "app/gui/live/CommandPanel.h"

#include <QGridLayout>
#include <cmath>

#include "app/gui/look/Look.h"
#include "core/acquisition/StreamHealth.h"

namespace tacto::gui {

namespace {

QString part(double value, const QString& low, const QString& middle, const QString& high, const QString& absent) {
    if (!std::isfinite(value)) return absent;
    return value < 1.0 / 3 ? low : value > 2.0 / 3 ? high : middle;
}

QString number(double value) { return std::isfinite(value) ? QString::number(value, 'f', 2) : QString("–"); }

}  // namespace

CommandPanel::CommandPanel(QWidget* parent) : QWidget(parent) {
    setAccessibleName(tr("Command"));
    auto* grid = new QGridLayout(this);
    grid->setContentsMargins(0, 0, 0, 0);
    grid->setVerticalSpacing(1);
    words_ = new QLabel(this);
    words_->setObjectName("commandWords");
    auto bold = words_->font();
    bold.setBold(true);
    words_->setFont(bold);
    words_->setWordWrap(true);
    words_->setToolTip(tr("Roughness R from smooth to rough, pressure P from light to firm, both 0 to 1."));
    grid->addWidget(words_, 0, 0, 1, 2);
    const auto row = [&](int at, const QString& name, const QString& object, const QString& tip) {
        auto* label = new QLabel(name, this);
        label->setForegroundRole(QPalette::PlaceholderText);
        label->setToolTip(tip);
        auto* value = new QLabel("–", this);
        value->setObjectName(object);
        value->setToolTip(tip);
        value->setWordWrap(true);
        grid->addWidget(label, at, 0, Qt::AlignTop);
        grid->addWidget(value, at, 1);
        return value;
    };
    amplitude_ = row(1, tr("Amplitude"), "commandAmplitude",
                     tr("What the encoder asks for, in volts. \"–\": it asks for no train."));
    interval_ = row(2, tr("Interval"), "commandInterval", tr("From one train's onset to the next."));
    current_ = row(3, tr("Current"), "commandCurrent",
                   tr("The amplitude through the impedance that was measured last. \"–\": none was measured."));
    trains_ =
        row(4, tr("Trains"), "commandTrains",
            tr("Since the bench was opened. Refused: beyond a limit. Skipped: the fingertip's samples were old."));
    grid->setColumnStretch(1, 1);
    refusal_ = new QLabel(this);
    refusal_->setObjectName("commandRefusal");
    refusal_->setWordWrap(true);
    grid->addWidget(refusal_, 5, 0, 1, 2);
    refusal_->hide();
}

void CommandPanel::setSimulated(bool simulated) { simulated_ = simulated; }

void CommandPanel::show(const Telemetry& t, bool stale) {
    const auto feel = tr("%1 (R %2), %3 (P %4)")
                          .arg(part(t.roughness, tr("Smooth"), tr("Half rough"), tr("Rough"), tr("Roughness unknown")),
                               number(t.roughness),
                               part(t.pressure, tr("light"), tr("half firm"), tr("firm"), tr("pressure unknown")),
                               number(t.pressure));
    const bool byHand = t.driving == DriveSource::Manual;
    const bool felt = std::isfinite(t.roughness) || std::isfinite(t.pressure);
    words_->setText(stale && !byHand ? tr("Not known: the samples are old") : felt ? feel : tr("Nothing is felt"));
    const auto origin = simulated_ ? tr(" · simulated") : QString();
    const bool asks = std::isfinite(t.amplitude_v);
    amplitude_->setText(quantityText(t.amplitude_v, "V", 3) + (asks ? origin : QString()));
    interval_->setText(quantityText(t.interval_s, "s", 3) +
                       (asks ? tr(" (%1 a minute)").arg(QString::number(60 / t.interval_s, 'f', 0)) : QString()));
    if (std::isfinite(t.intensity) && asks)
        amplitude_->setText(tr("%1 % strong%2").arg(QString::number(100 * t.intensity, 'f', 0), origin));
    const double amps = t.amplitude_v / t.impedance_ohm;
    current_->setText(
        std::isfinite(amps)
            ? tr("%1 at %2, measured").arg(quantityText(amps, "A", 3), quantityText(t.impedance_ohm, "ohm", 3))
            : QString("–"));
    trains_->setText(
        tr("%1 delivered, %2 refused, %3 skipped").arg(t.trainsDelivered).arg(t.trainsRefused).arg(t.trainsSkipped));
    refusal_->setVisible(t.trainsRefused > 0);
    if (t.trainsRefused > 0) refusal_->setText(tr("Last refused: %1").arg(QString::fromUtf8(t.lastRefusal.c_str())));
}

HealthWords healthWords(const Telemetry& telemetry, bool hasSensor, std::uint64_t missedByPicture) {
    HealthWords health;
    QStringList words;
    const double age = telemetry.sensorAge_s;
    if (!hasSensor) {
        words << QObject::tr("No fingertip is open: drive by hand.");
        if (telemetry.uncalibratedStimulator) words << QObject::tr("The stimulator is not calibrated.");
        return {words.join(" "), false};
    }
    if (telemetry.sensorFinished) {
        words << QObject::tr("The recording has ended");
        health.stale = true;
    } else if (!std::isfinite(age)) {
        words << QObject::tr("No sample has come yet.");
    } else if (age > StreamHealth::kStale_s) {
        words << QObject::tr("⚠ Old: the newest sample is %1 old and drives no train").arg(quantityText(age, "s", 2));
        health.stale = true;
    } else {
        words << (age < 1e-3 ? QObject::tr("Samples are fresh")
                             : QObject::tr("Samples are fresh: %1 old").arg(quantityText(age, "s", 2)));
    }
    words << (telemetry.gaps == 0   ? QObject::tr("no gaps")
              : telemetry.gaps == 1 ? QObject::tr("⚠ 1 gap")
                                    : QObject::tr("⚠ %1 gaps").arg(telemetry.gaps));
    words << (telemetry.samplesLost > 0 ? QObject::tr("⚠ %1 samples lost").arg(telemetry.samplesLost)
                                        : QObject::tr("none lost"));
    if (missedByPicture > 0) words << QObject::tr("%1 not drawn, but recorded").arg(missedByPicture);
    for (const auto& flag : telemetry.flags.texts()) words << QString::fromStdString(flag);
    if (telemetry.uncalibratedStimulator) words << QObject::tr("stimulator not calibrated");
    health.text = words.join(" · ");
    return health;
}

}  // namespace tacto::gui
