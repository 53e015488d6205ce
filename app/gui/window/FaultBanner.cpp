#include "app/gui/window/FaultBanner.h"

#include <QEvent>
#include <QVBoxLayout>

#include "app/gui/theme/Text.h"
#include "app/gui/theme/Theme.h"

namespace tacto::gui {

namespace {

QString nextStep(std::optional<FaultCause> cause) {
    if (!cause) return FaultBanner::tr("Fix the cause, reset the fault, then arm again.");
    switch (*cause) {
        case FaultCause::DeviceLost:
            return FaultBanner::tr("Plug it in again and wait until it is listed, then reset.");
        case FaultCause::DeviceFault:
            return FaultBanner::tr("Check the device and its cable, then reset. You arm again afterwards.");
        case FaultCause::OpenElectrode:
            return FaultBanner::tr("Check the electrode and its lead, then reset. You arm again afterwards.");
        case FaultCause::ShortElectrode:
            return FaultBanner::tr("Look for leads or electrodes that touch, then reset. You arm again afterwards.");
        case FaultCause::NetCharge:
            return FaultBanner::tr("Disconnect the electrodes and check the pulse on a resistor, then reset.");
        case FaultCause::StatusMissing:
            return FaultBanner::tr("Check the cable to the stimulator, then reset. You arm again afterwards.");
        case FaultCause::LoopSilent:
            return FaultBanner::tr(
                "Close the programs that keep this computer busy, then reset. You arm again afterwards.");
        case FaultCause::StaleSensor:
            return FaultBanner::tr("Check the fingertip sensor and its cable, then reset.");
        case FaultCause::LimitBroken:
            return FaultBanner::tr(
                "Run the safety check before you arm again: the stimulator delivered more than it may.");
        case FaultCause::Internal:
            break;
    }
    return FaultBanner::tr("Close the bench and open it again. Keep the session: it says what happened.");
}

}  // namespace

FaultBanner::FaultBanner(QWidget* parent)
    : QFrame(parent), cause_(new ElidedLabel(this)), output_(new ElidedLabel(this)), next_(new ElidedLabel(this)) {
    setObjectName("faultBanner");
    setAccessibleName(tr("Fault"));
    cause_->setObjectName("faultText");
    auto* column = new QVBoxLayout(this);
    column->setContentsMargins(scaledPx(16), 2, scaledPx(8), 2);
    column->setSpacing(0);
    column->addStretch();
    for (auto* line : {cause_, output_, next_}) {
        line->setTextFormat(Qt::PlainText);
        column->addWidget(line);
    }
    column->addStretch();
    setTextSize(*cause_, TextSize::Body, true);
    colour();
}

void FaultBanner::show(const Telemetry& telemetry) {
    const auto reason = sentence(QString::fromUtf8(telemetry.reason.c_str()));
    cause_->setText(reason.isEmpty() ? tr("The bench has faulted.") : reason);
    output_->setText(telemetry.trainsDelivered == 1
                         ? tr("Output is off and stays off. 1 train was delivered.")
                         : tr("Output is off and stays off. %1 trains were delivered.").arg(telemetry.trainsDelivered));
    next_->setText(nextStep(telemetry.fault));
    if (toolTip() == text()) return;
    setToolTip(text());
    setAccessibleDescription(text());
}

QString FaultBanner::text() const { return cause_->text() + "\n" + output_->text() + "\n" + next_->text(); }

void FaultBanner::changeEvent(QEvent* event) {
    if (event->type() == QEvent::PaletteChange) {
        QMetaObject::invokeMethod(
            this, [this] { colour(); }, Qt::QueuedConnection);
    }
    QFrame::changeEvent(event);
}

void FaultBanner::colour() {
    const auto sheet = QString(
                           "QFrame#faultBanner { background: %1; border: 2px solid %2; border-left: none; }"
                           "QFrame#faultBanner QLabel { background: transparent; color: %3; }")
                           .arg(colours().banner.name(), colours().stop.name(), colours().text.name());
    if (styleSheet() != sheet) setStyleSheet(sheet);
}

}  // namespace tacto::gui

#include "moc_FaultBanner.cpp"
