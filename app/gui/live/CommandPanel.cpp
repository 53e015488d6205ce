#include "app/gui/live/CommandPanel.h"

#include <cmath>

#include "app/gui/theme/Building.h"
#include "app/gui/theme/Text.h"
#include "app/gui/theme/Theme.h"
#include "core/acquisition/StreamHealth.h"

namespace tacto::gui {

namespace {

QString part(double value, const QString& low, const QString& middle, const QString& high, const QString& absent) {
    if (!std::isfinite(value)) return absent;
    return value < 1.0 / 3 ? low : value > 2.0 / 3 ? high : middle;
}

constexpr double kNear = 0.25;  // largest distance, as a share of the plane's sides

/// Returns "near rough-high · " for the nearest condition; empty if none is near.
QString nearText(const std::vector<Condition>& conditions, double roughness, double pressure) {
    const Condition* nearest = nullptr;
    double least = kNear;
    for (const auto& condition : conditions) {
        const double away = std::hypot(condition.R - roughness, condition.P - pressure);
        if (!(away <= least)) continue;
        nearest = &condition;
        least = away;
    }
    return nearest == nullptr ? QString() : QObject::tr("near %1 · ").arg(QString::fromStdString(nearest->name));
}

}  // namespace

CommandPanel::CommandPanel(QWidget* parent)
    : QWidget(parent),
      words_(new QLabel(this)),
      near_(makeLabel({}, {.name = "commandIndices", .tone = Tone::Quiet}, this)),
      trains_(makeLabel({}, {.name = "commandTrains", .tone = Tone::Quiet}, this)),
      refusal_(new QLabel(this)) {
    setAccessibleName(tr("What the fingertip feels"));
    auto* column = columnIn(*this, 0);
    words_->setObjectName("commandWords");
    words_->setToolTip(tr("Roughness R from smooth to rough, pressure P from light to firm, both 0 to 1."));
    setTextSize(*words_, TextSize::Large);
    trains_->setToolTip(
        tr("Since the bench was opened. Refused: beyond a limit. Skipped: the fingertip's samples were old."));
    refusal_->setObjectName("commandRefusal");
    for (auto* line : {words_, near_, trains_, refusal_}) {
        line->setWordWrap(true);
        column->addWidget(line);
    }
    refusal_->hide();
}

void CommandPanel::show(const Telemetry& t, bool stale, const std::vector<Condition>& conditions) {
    const auto feel =
        tr("%1, %2").arg(part(t.roughness, tr("Smooth"), tr("Half rough"), tr("Rough"), tr("Roughness unknown")),
                         part(t.pressure, tr("light"), tr("half firm"), tr("firm"), tr("pressure unknown")));
    const bool byHand = t.driving == DriveSource::Manual;
    const bool felt = std::isfinite(t.roughness) || std::isfinite(t.pressure);
    const bool known = (!stale || byHand) && felt;
    words_->setText(known              ? feel
                    : stale && !byHand ? tr("Not known: the samples drive no train")
                                       : tr("Nothing is felt"));
    near_->setText(known ? nearText(conditions, t.roughness, t.pressure) +
                               tr("R %1, P %2").arg(decimalText(t.roughness, 2), decimalText(t.pressure, 2))
                         : QString());
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
    } else if (telemetry.finger == FingerStanding::Implausible) {
        words << QObject::tr("⚠ No readings: the samples are not numbers, or beyond a fingertip, and drive no train");
        health.stale = true;
    } else if (age > StreamHealth::kStale_s) {
        words << QObject::tr("⚠ Old: the newest sample is %1 old and drives no train").arg(quantityText(age, "s", 2));
        health.stale = true;
    } else if (telemetry.finger == FingerStanding::Stale) {
        // At the start no frame has arrived; a time stamp in the future does not tell the age of the samples.
        health.stale = age < 0;
        words << (health.stale ? QObject::tr("⚠ Ahead of time: the samples drive no train")
                               : QObject::tr("Samples come, and none is judged yet"));
    } else {
        words << (age < 1e-3 ? QObject::tr("Samples are fresh")
                             : QObject::tr("Samples are fresh: %1 old").arg(quantityText(age, "s", 2)));
    }
    words << (telemetry.gaps == 0   ? QObject::tr("no gaps")
              : telemetry.gaps == 1 ? QObject::tr("⚠ 1 gap")
                                    : QObject::tr("⚠ %1 gaps").arg(telemetry.gaps));
    words << (telemetry.samplesLost > 0 ? QObject::tr("⚠ %1 samples lost").arg(countText(telemetry.samplesLost))
                                        : QObject::tr("none lost"));
    if (missedByPicture > 0) words << QObject::tr("%1 not drawn, but recorded").arg(countText(missedByPicture));
    for (const auto& flag : telemetry.flags.texts()) words << QString::fromStdString(flag);
    health.text = words.join(" · ");
    return health;
}

}  // namespace tacto::gui

#include "moc_CommandPanel.cpp"
