#include "app/gui/scope/ScopeWorkspace.h"

#include <QButtonGroup>
#include <QFileInfo>
#include <QLabel>
#include <QPushButton>
#include <QStackedWidget>
#include <QToolButton>
#include <algorithm>
#include <cmath>

#include "app/gui/look/Look.h"
#include "app/gui/scope/AcquisitionPanel.h"
#include "app/gui/scope/MeasurementTable.h"
#include "app/gui/scope/ScopeView.h"
#include "app/gui/scope/SpectrumPanel.h"
#include "app/gui/scope/ViewPanel.h"
#include "app/report/NumberText.h"

namespace tacto::gui {

namespace {

constexpr double kLevelShare = 0.2;         ///< of the commanded amplitude, in Auto
constexpr qint64 kQuietAfter_ms = 1500;     ///< without a trigger this long it is said
constexpr qint64 kFollowEvery_ms = 300;     ///< the level is moved no more often: a request gives up the one under way
constexpr Seconds kFreeRunAfter{0.4};       ///< without a trigger, while nothing is delivered that could be one
constexpr double kFreeRunIntervals = 1.25;  ///< while something is: of the longest interval between two trains
constexpr double kTimeKnown = 0.02;         ///< of a sample's distance to the next: what a cursor reads of an edge
constexpr double kFollowFrom = 1.3;         ///< and only when it would change by more than this factor

bool sameSettings(const ScopeSettings& a, const ScopeSettings& b) {
    return a.sampleRate == b.sampleRate && a.samples == b.samples && a.preTrigger == b.preTrigger &&
           a.triggerOnCurrent == b.triggerOnCurrent && a.triggerLevel == b.triggerLevel &&
           a.voltageRange == b.voltageRange && a.currentRange == b.currentRange;
}

}  // namespace

bool ScopeWorkspace::benchCanCapture() const {
    return desk_.activity() == Activity::Live && desk_.open() && desk_.open()->scope;
}

void ScopeWorkspace::benchChanged() {
    if (benchCanCapture()) {
        acquisition_->setTraits(*desk_.open()->scope);
        if (wanted_ && !running_ && (watched_ || isVisible())) run();
    } else if (running_ || failed_) {
        if (failed_) problem_.clear();
        failed_ = running_ = false;
        wanted_ = true;  // goes on with the next bench
    }
    showState();
}

ScopeSettings ScopeWorkspace::settings() const { return acquisition_->settings(); }

void ScopeWorkspace::setWatched(bool watched) {
    watched_ = watched;
    // What runs goes on running. And a dock says that it is hidden while the window, and the desk with it, goes.
    if (watched) benchChanged();
}

void ScopeWorkspace::setMode(ScopeMode mode) {
    applyMode(mode);
    run();
}

void ScopeWorkspace::applyMode(ScopeMode mode) {
    mode_ = mode;
    if (auto* button = modes_->button(static_cast<int>(mode))) button->setChecked(true);
    view_->setRoll(mode == ScopeMode::Roll);
    acquisition_->setLevelHeld(mode == ScopeMode::Auto || mode == ScopeMode::Roll);
    followAmplitude();
}

void ScopeWorkspace::run() {
    wanted_ = true;
    failed_ = false;
    problem_.clear();
    if (benchCanCapture()) {
        running_ = true;
        taken_ = 0;
        sinceCapture_.start();
        request();
    }
    showState();
}

void ScopeWorkspace::hold() {
    wanted_ = false;
    if (running_) desk_.stopScope();
    running_ = false;
    showState();
}

void ScopeWorkspace::request() {
    requested_ = settings();
    requestedWait_ = untriggeredAfter();
    sinceRequest_.start();
    desk_.runScope(requested_, mode_ == ScopeMode::Single, requestedWait_);
}

/// In Auto (and Roll) there is a picture even without a trigger. While trains are delivered it waits for the slowest
/// of them first: a picture that jumps between triggered and not is worse than a late one.
std::optional<Seconds> ScopeWorkspace::untriggeredAfter() const {
    if (mode_ != ScopeMode::Auto && mode_ != ScopeMode::Roll) return {};
    if (!desk_.open() || !desk_.open()->untriggered) return {};
    if (telemetry_.state != InterlockState::Delivering) return kFreeRunAfter;
    return kFreeRunIntervals * desk_.profile().encoding.intervalMax;
}

/// The oscilloscope failed. The bench goes on, and so does the output: it is only no longer seen.
void ScopeWorkspace::stopped(const QString& why) {
    running_ = false;
    wanted_ = false;  // asking again is no use before the user has looked at it
    failed_ = true;
    done_.clear();
    auto what = why;
    while (what.endsWith('.')) what.chop(1);
    const auto state = desk_.telemetry().state;
    const bool on =
        state == InterlockState::Armed || state == InterlockState::Delivering || state == InterlockState::Checking;
    problem_ =
        tr("⚠ The oscilloscope stopped: %1. %2 The last capture stays. When the oscilloscope is back, press Run.")
            .arg(what, on ? tr("The output is not switched off by this and goes on unmeasured: STOP ends it.")
                          : tr("Output is off."));
    showState();
}

/// In Auto (and Roll) the level is a fifth of what is commanded: above the noise, below the pulse.
void ScopeWorkspace::followAmplitude() {
    if (mode_ != ScopeMode::Auto && mode_ != ScopeMode::Roll) return;
    double level = kLevelShare * telemetry_.amplitude_v;
    // On the current channel the commanded voltage says something only with the impedance.
    if (acquisition_->triggersOnCurrent()) level /= telemetry_.impedance_ohm;
    if (!std::isfinite(level) || !(level > 0)) return;
    const double now = requested_.triggerLevel;
    if (running_ && level < now * kFollowFrom && level > now / kFollowFrom) return;
    if (running_ && sinceRequest_.isValid() && sinceRequest_.elapsed() < kFollowEvery_ms) return;
    acquisition_->setLevel(level);
    if (running_ && !sameSettings(settings(), requested_)) request();
}

void ScopeWorkspace::refresh(const Telemetry& telemetry) {
    telemetry_ = telemetry;
    followAmplitude();
    if (running_ && untriggeredAfter() != requestedWait_) request();
    if (isVisible()) say();
}

void ScopeWorkspace::take(const ShownPtr& shown) {
    const bool ours = shown->source.isEmpty();
    const bool untriggered = shown->capture->untriggered;
    if (ours && !running_) return;  // one that was under way when the picture was held
    if (!view_->shown() || view_->shown()->source != shown->source || !ours) table_->clear();
    problem_.clear();
    done_.clear();
    if (!untriggered) {
        ++taken_;
        sinceCapture_.start();
    }
    view_->show(shown);
    if (untriggered)
        table_->passOverUntriggered();
    else
        table_->add(shown->measurement, shown->warnings);
    emit captureShown(shown);
    if (ours && mode_ == ScopeMode::Single && !untriggered) {
        running_ = false;
        wanted_ = false;
    }
    showState();
}

bool ScopeWorkspace::openCaptureFile(const QString& path) {
    const QFileInfo file(path);
    if (!file.isFile() || !file.isReadable()) {
        problem_ = tr("%1 cannot be read. What is shown stays.").arg(path);
        showState();
        return false;
    }
    hold();
    problem_.clear();
    pipe_.open(path);
    return true;
}

void ScopeWorkspace::show(std::shared_ptr<const Capture> capture, const QString& source) {
    hold();
    pipe_.take(std::move(capture), source);
}

QString ScopeWorkspace::triggerLane() const {
    const QString unit = acquisition_->triggersOnCurrent() ? "A" : "V";
    for (const auto& lane : view_->lanes()) {
        if (!lane.reference && lane.unit == unit && lane.key.startsWith("channel/")) return lane.key;
    }
    return {};
}

QString ScopeWorkspace::outputText() const {
    switch (telemetry_.state) {
        case InterlockState::Disconnected:
            return tr("No output is connected.");
        case InterlockState::Disarmed:
            return tr("Output is disarmed.");
        case InterlockState::Checking:
            return tr("Output is being checked.");
        case InterlockState::Armed:
            return tr("Output is armed.");
        case InterlockState::Delivering:
            return tr("Trains are being delivered.");
        case InterlockState::Paused:
            return tr("Output is paused.");
        case InterlockState::Faulted:
            break;
    }
    return tr("Output is off after a fault.");
}

QString ScopeWorkspace::waitingText(const QString& level) const {
    const auto& shown = view_->shown();
    if (shown && shown->source.isEmpty() && shown->capture->untriggered) {
        return tr("No trigger at %1: shown untriggered, not measured. %2").arg(level, outputText());
    }
    return tr("Waiting for a trigger at %1. %2").arg(level, outputText());
}

QString ScopeWorkspace::statusText() const {
    if (!problem_.isEmpty()) return problem_;
    if (pipe_.opening()) return tr("Reading the capture, %1 %…").arg(pipe_.percentRead());
    if (!done_.isEmpty()) return done_;
    const auto& shown = view_->shown();
    const bool file = shown && !shown->source.isEmpty();
    if (running_) {
        const auto level = quantityText(requested_.triggerLevel, requested_.triggerOnCurrent ? "A" : "V", 3);
        if (sinceCapture_.elapsed() > kQuietAfter_ms || taken_ == 0) {
            return waitingText(level);
        }
        auto text = taken_ == 1 ? tr("Trigger at %1 · 1 capture").arg(level)
                                : tr("Trigger at %1 · %2 captures").arg(level).arg(taken_);
        if (pipe_.skippedCaptures() > 0) {
            text += tr(" · %1 came too fast to be shown").arg(pipe_.skippedCaptures());
        }
        return text;
    }
    if (file) {
        return tr("%1 · %2 samples at %3")
            .arg(shown->source)
            .arg(shown->capture->samples())
            .arg(settingText(shown->capture->rate_hz, "Hz"));
    }
    if (desk_.activity() == Activity::Running)
        return tr("A protocol has the oscilloscope. Capturing goes on after it.");
    if (desk_.activity() == Activity::Live && !benchCanCapture()) return tr("The open bench has no oscilloscope.");
    if (desk_.activity() == Activity::Closed) return tr("No bench is open. The last capture stays.");
    if (desk_.activity() != Activity::Live) return tr("The bench is opening or closing.");
    if (mode_ == ScopeMode::Single && shown)
        return tr("One capture taken. S takes another. The output is not touched.");
    return tr("On hold: the picture stays. The output is not touched.");
}

void ScopeWorkspace::showState() {
    const bool can = benchCanCapture();
    run_->setText(running_ ? tr("Hold") : tr("Run"));
    run_->setEnabled(can);
    const bool empty = !view_->shown() && desk_.activity() == Activity::Closed && !pipe_.opening();
    stack_->setCurrentIndex(empty ? 0 : 1);
    cancelOpen_->setVisible(pipe_.opening());
    say();
}

void ScopeWorkspace::say() {
    status_->setText(statusText());
    const auto lane = triggerLane();
    const bool ours = !view_->shown() || view_->shown()->source.isEmpty();
    const bool held = mode_ == ScopeMode::Auto || mode_ == ScopeMode::Roll;
    view_->setTrigger(ours && !view_->roll() ? lane : QString(), settings().triggerLevel, held);
    view_->setPreTrigger(ours && running_ && view_->shown() ? std::optional(requested_.preTrigger) : std::nullopt);
    undo_->setEnabled(view_->canUndo());
}

void ScopeWorkspace::sayCursors() {
    auto r = view_->readout();
    // An edge between two samples is known to a small part of their distance, and no better.
    if (const auto& shown = view_->shown()) {
        const double grain = std::pow(10, std::floor(std::log10(kTimeKnown / shown->capture->rate_hz)));
        for (auto* t : {&r.x1_s, &r.x2_s}) *t = std::round(*t / grain) * grain;
    }
    QStringList parts;
    if (std::isfinite(r.x1_s)) {
        parts << tr("X1 %1").arg(quantityText(r.x1_s, "s")) << tr("X2 %1").arg(quantityText(r.x2_s, "s"))
              << tr("Δ %1").arg(quantityText(r.dx_s(), "s"))
              << tr("1/Δ %1").arg(r.dx_s() == 0 ? "–" : quantityText(1 / std::abs(r.dx_s()), "Hz"));
        parts << tr("there %1 and %2").arg(quantityText(r.at1, r.unit), quantityText(r.at2, r.unit));
    }
    if (std::isfinite(r.y1)) {
        parts << tr("Y1 %1").arg(quantityText(r.y1, r.unit)) << tr("Y2 %1").arg(quantityText(r.y2, r.unit))
              << tr("Δ %1").arg(quantityText(r.dy(), r.unit));
    }
    readout_->setText(parts.join(QStringLiteral("   ")));
    readout_->setVisible(!parts.isEmpty());
}

void ScopeWorkspace::showSpectrum() {
    spectrum_->setVisible(viewPanel_->wantsSpectrum());
    if (!viewPanel_->wantsSpectrum()) return;
    const auto key = spectrum_->lane();
    QColor colour = colours().text;
    for (const auto& lane : view_->lanes()) {
        if (lane.key == key) colour = lane.colour;
    }
    const double zero = view_->zero_s();
    spectrum_->show(view_->trace(key), view_->viewport().left_s + zero, view_->viewport().right_s() + zero, colour);
}

}  // namespace tacto::gui
