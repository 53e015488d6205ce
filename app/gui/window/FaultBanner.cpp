#include "app/gui/window/FaultBanner.h"

#include <cmath>

#include "app/gui/theme/Building.h"
#include "app/gui/theme/Text.h"
#include "app/gui/theme/Theme.h"

namespace tacto::gui {

namespace {

QString nextAfter(std::optional<FaultCause> cause, bool grave) {
    if (grave && !(cause && graveCause(bitOf(*cause))))
        return FaultBanner::tr("Run the safety check: nothing else resets what was left in this unit.");
    if (!cause) return FaultBanner::tr("Fix the cause, reset the fault, then arm again.");
    switch (*cause) {
        case FaultCause::DeviceLost:
            return FaultBanner::tr("Plug it in again and wait until it is listed, then reset.");
        case FaultCause::DeviceFault:
            return FaultBanner::tr("Check the device and its cable, then reset.");
        case FaultCause::OpenElectrode:
            return FaultBanner::tr("Check the electrode and its lead, then reset.");
        case FaultCause::ShortElectrode:
            return FaultBanner::tr("Look for leads or electrodes that touch, then reset.");
        case FaultCause::NetCharge:
            return FaultBanner::tr("Disconnect the electrodes and run the safety check on resistors.");
        case FaultCause::StatusMissing:
            return FaultBanner::tr("Check the cable to the stimulator, then reset.");
        case FaultCause::LoopSilent:
            return FaultBanner::tr("Close the programs that keep this computer busy, then reset.");
        case FaultCause::StaleSensor:
            return FaultBanner::tr("Check the fingertip sensor and its cable, then reset.");
        case FaultCause::LimitBroken:
            return FaultBanner::tr(
                "Run the safety check, which alone resets it: the stimulator delivered more than it may.");
        case FaultCause::StuckOn:
            return grave ? FaultBanner::tr(
                               "Switch it off at its own switch and take the load off, then run the safety check.")
                         : FaultBanner::tr("Switch it off at its own switch, then reset.");  // a massager
        case FaultCause::Internal:
            break;
    }
    return FaultBanner::tr("Close the bench and open it again. Keep the session: it says what happened.");
}

/// The gate's table holds the trains of its last 5 s.
constexpr double kKeptInTable_s = 4.5;

/// True if earlier trains may have been delivered just as the gate judged them.
bool saysNothingOfTrains(std::optional<FaultCause> cause) {
    return cause == FaultCause::OpenElectrode || cause == FaultCause::DeviceLost || cause == FaultCause::LoopSilent ||
           cause == FaultCause::StaleSensor;
}

}  // namespace

FaultBanner::FaultBanner(QWidget* parent)
    : QFrame(parent), cause_(new ElidedLabel(this)), output_(new ElidedLabel(this)), next_(new ElidedLabel(this)) {
    nameWidget(*this, "faultBanner", tr("Fault"));
    cause_->setObjectName("faultText");
    auto* column = columnIn(*this, 0, {scaledPx(16), 0, scaledPx(8), 0});
    column->addStretch();
    for (auto* line : {cause_, output_, next_}) {
        line->setTextFormat(Qt::PlainText);
        column->addWidget(line);
    }
    column->addStretch();
    setTextSize(*cause_, TextSize::Body, true);
    colour();
    afterLookChange(*this, [this] { colour(); });
}

void FaultBanner::refresh(const Telemetry& telemetry, QTime now) {
    note(telemetry, now);
    const bool faulted = telemetry.state == InterlockState::Faulted;
    setVisible(faulted);
    if (!faulted) return;
    const auto reason = sentence(QString::fromUtf8(telemetry.reason.c_str()));
    const auto cause = reason.isEmpty() ? tr("The bench has faulted.") : reason;
    cause_->setText(faultedAt_.isValid() ? QString("%1 · %2").arg(faultedAt_.toString("HH:mm:ss"), cause) : cause);
    output_->setText(outputWords(telemetry));
    const auto next = nextAfter(telemetry.fault, telemetry.grave.has_value());
    next_->setText(mayArm_ ? tr("%1 Arming is asked for next.").arg(next) : next);
    if (toolTip() == text()) return;
    setToolTip(text());
    setAccessibleDescription(text());
}

void FaultBanner::note(const Telemetry& telemetry, QTime now) {
    const bool another =
        telemetry.state == InterlockState::Disconnected || telemetry.trainsDelivered < trains_ || telemetry.at < at_;
    if (another) unseen_ = broken_ = notEvaluated_ = false;
    if (!another && telemetry.trainsDelivered > trains_ && toSeconds(telemetry.at - at_) > kKeptInTable_s)
        unseen_ = true;
    for (const auto& row : telemetry.exposure()) {
        if (std::isnan(row.limit) || row.action == LimitAction::Disclose) continue;
        if (!row.evaluated)
            notEvaluated_ = true;
        else if (!row.within)
            broken_ = true;
    }
    if (telemetry.state == InterlockState::Faulted) {
        const bool before = state_ == InterlockState::Disconnected;  // it was there when the bench was opened
        if (state_ != InterlockState::Faulted) faultedAt_ = before ? QTime() : now;
        const bool allowed = state_ == InterlockState::Faulted ? mayArm_ : !before;
        mayArm_ = allowed && !another && telemetry.fault && !telemetry.grave;
        asJudged_ = (asJudged_ || state_ != InterlockState::Faulted) && saysNothingOfTrains(telemetry.fault);
    }
    at_ = telemetry.at;
    state_ = telemetry.state;
    trains_ = telemetry.trainsDelivered;
}

/// Says that the limits were kept only if the gate judged every train and the fault does not contradict this.
QString FaultBanner::outputWords(const Telemetry& telemetry) const {
    const auto off = telemetry.fault == FaultCause::StuckOn
                         ? tr("The program has switched off; the device may still deliver.")
                         : tr("Output is off and stays off.");
    if (blind_) return tr("%1 What was delivered is hidden until the session ends.").arg(off);
    const auto trains = telemetry.trainsDelivered;
    if (trains == 0) return tr("%1 No train was delivered.").arg(off);
    const auto delivered = trains == 1 ? tr("1 train was delivered") : tr("%1 trains were delivered").arg(trains);
    if (unseen_ || broken_ || telemetry.exposure().empty() || !asJudged_) return QString("%1 %2.").arg(off, delivered);
    return (notEvaluated_ ? tr("%1 %2, within every limit that was evaluated.") : tr("%1 %2, within all limits."))
        .arg(off, delivered);
}

QString FaultBanner::text() const { return cause_->text() + "\n" + output_->text() + "\n" + next_->text(); }

void FaultBanner::colour() {
    const auto sheet = QString(
                           "QFrame#faultBanner { background: %1; border: 2px solid %2; border-left: none; }"
                           "QFrame#faultBanner QLabel { background: transparent; color: %3; }")
                           .arg(colours().banner.name(), colours().stop.name(), colours().text.name());
    if (styleSheet() != sheet) setStyleSheet(sheet);
}

}  // namespace tacto::gui

#include "moc_FaultBanner.cpp"
