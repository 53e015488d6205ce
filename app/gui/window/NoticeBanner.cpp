#include "app/gui/window/NoticeBanner.h"

#include <QEvent>
#include <QLabel>
#include <QPushButton>
#include <cmath>
#include <utility>

#include "app/gui/theme/Building.h"
#include "app/gui/theme/ScriptPlace.h"
#include "app/gui/theme/Text.h"
#include "app/gui/theme/Theme.h"
#include "app/gui/window/RecordingLine.h"
#include "app/gui/window/StateWords.h"
#include "app/report/NumberText.h"

namespace tacto::gui {

namespace {

constexpr int kFramesForReason = 10;  // a third of a second, in frames

}  // namespace

NoticeBanner::NoticeBanner(BenchController& controller, RecordingLine& line, QWidget& over)
    : QFrame(&over),
      controller_(controller),
      line_(line),
      over_(over),
      text_(makeLabel({}, {.name = "bannerText", .wraps = true, .selectable = true}, this)) {
    setObjectName("banner");
    setFrameShape(QFrame::StyledPanel);
    setAutoFillBackground(true);
    auto* row = new QHBoxLayout(this);
    row->addWidget(text_, 1);
    auto* dismiss = new QPushButton(tr("Dismiss"), this);
    dismiss->setAutoDefault(false);
    connect(dismiss, &QPushButton::clicked, this, &QWidget::hide);
    row->addWidget(dismiss);
    over_.installEventFilter(this);
    hide();
    connect(&controller_, &BenchController::failed, this, &NoticeBanner::complain);
    connect(&controller_, &BenchController::changed, this, [this] {
        const auto open = controller_.open();
        if (controller_.activity() != Activity::Live || !open) return;
        line_.say(tr("Open. Recording to %1").arg(QString::fromStdString(open->session.filename().string())));
        hide();
    });
    connect(&controller_, &BenchController::armed, this, [this] {
        saidArmed_ = true;
        line_.say(tr("Armed."));
    });
    connect(&controller_, &BenchController::finished, this, &NoticeBanner::sayEnd);
    connect(&controller_, &BenchController::checked, this, [this](double ohms) {
        line_.say(std::isnan(ohms) ? tr("This stimulator does not measure the impedance. Disarmed.")
                                   : tr("Impedance %1. Disarmed.").arg(quantityText(ohms, "ohm", 4)));
    });
}

/// A safety check provokes faults, so the last fault is not its result.
void NoticeBanner::sayEnd(const std::shared_ptr<const FinishedRun>& run) {
    saidArmed_ = false;
    const auto name = procedureText(run->order.script.name);
    const auto verdict = qtext(run->result.verdict());
    const auto& error = run->result.outcome.error;
    const auto why = error ? sentence(withoutScriptPlace(qtext(error->message))) : QString();
    if (error && verdict.isEmpty())
        return line_.say(withOutput(tr("%1 ended by an error: %2").arg(name, why), tr("Output is off.")), true);
    const auto output = qtext(outputAfter(saysMayBeOn(why) ? std::optional(FaultCause::StuckOn) : std::nullopt));
    line_.say(verdict.isEmpty() ? tr("%1 finished. %2").arg(name, output)
                                : tr("%1 finished: %2. %3").arg(name, verdict, output));
}

void NoticeBanner::refresh(const Telemetry& telemetry) {
    sayState(telemetry);
    sayFault(telemetry);
    sayOn(telemetry.state);
    if (holds_ && std::exchange(held_, holds_(telemetry)) && !held_) hide();
    if (isVisible()) lieDown();
}

/// Replaces the message "Armed." when the bench is no longer armed. The new state is known at once, but its reason only
/// after the control loop's next step: waits some frames for the reason.
void NoticeBanner::sayState(const Telemetry& telemetry) {
    const auto state = telemetry.state;
    if (isOn(state) || !saidArmed_) {
        framesWithoutReason_ = 0;
        return;
    }
    const auto reason = reasonWords(QString::fromUtf8(telemetry.reason.c_str()));
    if (state == InterlockState::Disarmed && reason.isEmpty() && ++framesWithoutReason_ < kFramesForReason) return;
    saidArmed_ = false;
    framesWithoutReason_ = 0;
    if (state == InterlockState::Disconnected)
        line_.say(tr("No stimulator is open. Output is off."));
    else if (state == InterlockState::Disarmed)
        line_.say(reason.isEmpty() ? tr("Disarmed. Output is off.") : tr("Disarmed: %1. Output is off.").arg(reason));
}

/// While output is on, removes a message from the line that says it is off; the log keeps the message with its time.
void NoticeBanner::sayOn(InterlockState state) {
    if (outputIsOff(state) || !line_.saysOff()) return;
    if (state == InterlockState::Checking) return line_.say(tr("Checking the impedance."));
    line_.say(controller_.activity() == Activity::Running ? tr("Armed by the run.") : tr("Armed."));
}

/// Reports in the second frame: the state is known at once, but its reason only after the control loop's next step. The
/// safety bar shows the fault as long as it lasts.
void NoticeBanner::sayFault(const Telemetry& telemetry) {
    if (telemetry.state != InterlockState::Faulted) {
        faultedFrames_ = 0;
        return;
    }
    if (++faultedFrames_ != 2) return;
    const auto why = sentence(QString::fromUtf8(telemetry.reason.c_str()));
    line_.say(tr("Fault: %1 %2").arg(why, qtext(outputAfter(telemetry.fault))), true);
}

void NoticeBanner::complain(const QString& what) {
    const auto telemetry = controller_.telemetry();
    auto text = sentence(what);
    if (outputIsOff(telemetry.state) && telemetry.fault != FaultCause::StuckOn && !text.contains(tr("Output is off")))
        text = withOutput(text, tr("Output is off."));
    if (text.contains(tr("Output is off")))
        sayWhile(text, [](const Telemetry& now) { return outputIsOff(now.state); });
    else
        sayWhile(text, {});
}

void NoticeBanner::sayWhile(const QString& text, std::function<bool(const Telemetry&)> holds) {
    holds_ = std::move(holds);
    held_ = false;
    text_->setText("⚠  " + line_.shown(text));
    show();
    raise();
    lieDown();
    line_.say(text, true);
}

QRect NoticeBanner::room() const {
    auto room = over_.rect();
    for (const auto* each : over_.findChildren<QWidget*>()) {
        if (!each->isVisible()) continue;
        const QRect at(each->mapTo(&over_, QPoint()), each->size());
        const bool isColumn = at.width() < over_.width() / 2;  // otherwise the path is at the top
        if (each->objectName() == "path" && isColumn) room.setLeft(std::max(room.left(), at.right() + 1));
        const bool isBelow = at.top() > over_.height() / 2;
        if (isActionBar(*each) && isBelow) room.setBottom(std::min(room.bottom(), at.top() - 1));
    }
    return room;
}

void NoticeBanner::lieDown() {
    auto place = room();
    place.setTop(std::max(place.top(), place.bottom() + 1 - layout()->totalHeightForWidth(place.width())));
    setGeometry(place);
}

bool NoticeBanner::eventFilter(QObject* watched, QEvent* event) {
    if (watched == &over_ && event->type() == QEvent::Resize && !isHidden()) lieDown();
    return QFrame::eventFilter(watched, event);
}

/// Another text size needs another height.
bool NoticeBanner::event(QEvent* event) {
    const bool done = QFrame::event(event);
    if (event->type() == QEvent::LayoutRequest && !isHidden()) lieDown();
    return done;
}

}  // namespace tacto::gui

#include "moc_NoticeBanner.cpp"
