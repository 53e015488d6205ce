#include "app/gui/scope/panels/ScopeAcquisition.h"

#include <cmath>
#include <utility>

#include "app/gui/theme/Text.h"
#include "app/report/NumberText.h"

namespace tacto::gui {

namespace {

constexpr double kLevelShare = 0.2;          ///< trigger level in Auto, as a share of the commanded amplitude
constexpr double kFollowFrom = 1.3;          ///< the level follows only changes by more than this factor
constexpr qint64 kFollowEvery_ms = 300;      ///< least time between two requests, because each cancels the one before
constexpr qint64 kNoTriggerAfter_ms = 1500;  ///< time without a trigger until the user is told
constexpr Seconds kFreeRunAfter{0.4};        ///< time without a trigger, while no train can come
constexpr double kFreeRunIntervals = 1.25;   ///< the same while trains come, as a multiple of the longest interval

bool sameSettings(const ScopeSettings& a, const ScopeSettings& b) {
    return a.sampleRate == b.sampleRate && a.samples == b.samples && a.preTrigger == b.preTrigger &&
           a.triggerOnCurrent == b.triggerOnCurrent && a.triggerLevel == b.triggerLevel &&
           a.voltageRange == b.voltageRange && a.currentRange == b.currentRange;
}

/// The record in which a trigger is searched for: twice as long where the memory allows, so that what surrounds the
/// trigger has room wherever it comes soon after the oscilloscope's own, which takes whatever is beyond the nearer
/// level.
ScopeSettings recordFor(const ScopeSettings& wanted, const SampleTrigger& trigger, std::size_t memoryDepth) {
    constexpr double kRoomBefore = 0.25;     // share of the additional samples
    constexpr double kLowestOfRange = 0.01;  // a lower level is in the noise of 8 bits
    if (!searched(trigger.kind)) return wanted;
    auto record = wanted;
    record.samples = std::max(wanted.samples, std::min(2 * wanted.samples, memoryDepth));
    const auto asked = static_cast<double>(wanted.samples), all = static_cast<double>(record.samples);
    record.preTrigger = (wanted.preTrigger * asked + kRoomBefore * (all - asked)) / all;
    double level = std::abs(trigger.level);
    if (trigger.kind == TriggerKind::Runt) level = std::min(level, std::abs(trigger.upper));
    const double range = wanted.triggerOnCurrent ? wanted.currentRange.value() * 1e-3 : wanted.voltageRange.value();
    record.triggerLevel = std::clamp(level, kLowestOfRange * range, range);
    return record;
}

}  // namespace

ScopeAcquisition::ScopeAcquisition(BenchController& controller, AcquisitionPanel& panel)
    : controller_(controller), panel_(panel) {
    panel_.setLevelHeld(levelFollows());
    connect(&controller_, &BenchController::scopeStopped, this, &ScopeAcquisition::fail);
    connect(&controller_, &QObject::destroyed, this, [this] { running_ = false; });
}

bool ScopeAcquisition::possible() const {
    return controller_.activity() == Activity::Live && controller_.open() && controller_.open()->scope;
}

bool ScopeAcquisition::benchChanged(bool seen) {
    if (possible()) {
        panel_.setTraits(*controller_.open()->scope);
        if (!wanted_ || running_ || !seen) return false;
        run();
        return true;
    }
    const bool over = failed_;
    if (running_ || failed_) wanted_ = true;  // run again when the next bench opens
    failed_ = running_ = false;
    return over;
}

void ScopeAcquisition::setMode(ScopeMode mode) {
    mode_ = mode;
    panel_.setLevelHeld(levelFollows());
    followAmplitude();
}

void ScopeAcquisition::run() {
    wanted_ = true;
    failed_ = false;
    if (!possible()) return;
    running_ = true;
    taken_ = 0;
    sinceCapture_.start();
    request();
}

void ScopeAcquisition::hold() {
    wanted_ = false;
    if (running_) controller_.stopScope();
    running_ = false;
}

void ScopeAcquisition::setSeen(bool seen) {
    if (std::exchange(seen_, seen) != seen && running_ && untriggeredAfter() != requestedWait_) request();
}

void ScopeAcquisition::settingsChanged() {
    panel_.setLevelHeld(levelFollows());
    if (running_) request();
}

void ScopeAcquisition::request() {
    requested_ = panel_.settings();
    trigger_ = panel_.trigger();
    requestedWait_ = untriggeredAfter();
    sinceRequest_.start();
    // A searched trigger, or one that is held off, may need many records.
    const bool first = mode_ == ScopeMode::Single && !searched(trigger_.kind) && trigger_.holdOff_s == 0;
    controller_.runScope(recordFor(requested_, trigger_, controller_.open()->scope->memoryDepth), first,
                         requestedWait_);
    emit requested();
}

/// In Auto (and Roll) there is a picture, if anything shows it, even without a trigger, and a trigger may hide where
/// the oscilloscope's own does not see it. While trains come, waits long enough for the slowest ones: a late picture is
/// better than a picture that jumps between triggered and untriggered.
std::optional<Seconds> ScopeAcquisition::untriggeredAfter() const {
    const bool wanted = freeRuns() || searched(panel_.trigger().kind);
    if (!wanted || !seen_ || !controller_.open() || !controller_.open()->untriggered) return {};
    if (telemetry_.state != InterlockState::Delivering) return kFreeRunAfter;
    return kFreeRunIntervals * controller_.profile().encoding.intervalMax;
}

/// Only the oscilloscope has stopped: bench and output continue unseen.
void ScopeAcquisition::fail(const QString& why) {
    running_ = false;
    wanted_ = false;  // no new attempt before the user has seen the error
    failed_ = true;
    auto what = why;
    while (what.endsWith('.')) what.chop(1);
    const auto state = controller_.telemetry().state;
    const bool on =
        state == InterlockState::Armed || state == InterlockState::Delivering || state == InterlockState::Checking;
    emit stopped(
        tr("⚠ The oscilloscope stopped: %1. %2 The last capture stays. When the oscilloscope is back, press Run.")
            .arg(what, on ? tr("This does not switch the output off; it continues unmeasured. STOP ends it.")
                          : tr("The output was off.")));
}

/// In Auto (and Roll) the level is a fifth of the commanded amplitude: above the noise, below the top of the pulse.
void ScopeAcquisition::followAmplitude() {
    if (!levelFollows()) return;
    double level = kLevelShare * telemetry_.amplitude_v;
    // For the current channel the commanded voltage must be divided by the impedance.
    if (panel_.triggersOnCurrent()) level /= telemetry_.impedance_ohm;
    if (!std::isfinite(level) || !(level > 0)) return;
    const double now = requested_.triggerLevel;
    if (running_ && level < now * kFollowFrom && level > now / kFollowFrom) return;
    if (running_ && sinceRequest_.isValid() && sinceRequest_.elapsed() < kFollowEvery_ms) return;
    panel_.setLevel(level);
    if (running_ && !sameSettings(panel_.settings(), requested_)) request();
}

void ScopeAcquisition::refresh(const Telemetry& telemetry) {
    telemetry_ = telemetry;
    followAmplitude();
    if (running_ && untriggeredAfter() != requestedWait_) request();
}

bool ScopeAcquisition::take(const ShownCapture& shown) {
    if (!running_) return false;
    if (shown.capture->untriggered) return freeRuns() && !awaitsTrigger();
    ++taken_;
    sinceCapture_.start();
    if (mode_ == ScopeMode::Single) hold();
    return true;
}

/// True while the last triggered capture stays although the records since then did not trigger.
bool ScopeAcquisition::awaitsTrigger() const {
    if (taken_ == 0 || (!searched(trigger_.kind) && trigger_.holdOff_s == 0)) return false;
    const Seconds wait = requestedWait_.value_or(kFreeRunAfter) + Seconds(trigger_.holdOff_s);
    return double(sinceCapture_.elapsed()) < 1e3 * wait.count();
}

QString ScopeAcquisition::triggerText() const {
    const auto unit = requested_.triggerOnCurrent ? QStringLiteral("A") : QStringLiteral("V");
    const auto text = [&](double value) { return quantityText(value, unit, 3); };
    const auto& its = trigger_;
    const auto kind = tr(infoOf(its.kind).title.data()).toLower();
    QString words;
    switch (its.kind) {
        case TriggerKind::Magnitude:
            words = tr("at %1").arg(text(requested_.triggerLevel));
            break;
        case TriggerKind::Slope:
            words = tr("on %1 through %2").arg(kind, text(its.level));
            break;
        case TriggerKind::Width: {
            const auto shorter = quantityText(its.shortest_s, "s", 3), longer = quantityText(its.longest_s, "s", 3);
            const auto widths = its.widths == WidthRule::Less      ? tr("up to %1").arg(longer)
                                : its.widths == WidthRule::Greater ? tr("from %1 on").arg(shorter)
                                : its.widths == WidthRule::Outside ? tr("outside %1 to %2").arg(shorter, longer)
                                                                   : tr("%1 to %2").arg(shorter, longer);
            words = tr("on %1 %2 at %3").arg(kind, widths, text(its.level));
            break;
        }
        case TriggerKind::Runt:
            words = tr("on %1 beyond %2, not reaching %3").arg(kind, text(its.level), text(its.upper));
            break;
    }
    return its.holdOff_s > 0 ? tr("%1, held off %2").arg(words, quantityText(its.holdOff_s, "s", 3)) : words;
}

QString ScopeAcquisition::outputText() const {
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
    return tr("The stimulator is in a fault.");
}

QString ScopeAcquisition::runningText(const ShownCapture* shown, std::uint64_t skipped) const {
    const auto trigger = triggerText();
    if (taken_ == 0 || sinceCapture_.elapsed() > kNoTriggerAfter_ms) {
        if (shown != nullptr && shown->source.isEmpty() && shown->capture->untriggered) {
            return tr("No trigger %1. Showing an untriggered record; no measurements. %2").arg(trigger, outputText());
        }
        return tr("Waiting for a trigger %1. %2").arg(trigger, outputText());
    }
    auto text = taken_ == 1 ? tr("Trigger %1 · 1 capture").arg(trigger)
                            : tr("Trigger %1 · %2 captures").arg(trigger).arg(taken_);
    if (skipped > 0) text += tr(" · %1 came too fast to be shown").arg(skipped);
    return text;
}

QString ScopeAcquisition::statusText(const ShownCapture* shown, std::uint64_t skipped) const {
    if (running_) return runningText(shown, skipped);
    if (shown != nullptr && !shown->source.isEmpty()) {
        return tr("%1 · %2 samples at %3")
            .arg(shown->source)
            .arg(countText(shown->capture->samples()))
            .arg(settingText(shown->capture->rate_hz, "S/s"));
    }
    switch (controller_.activity()) {
        case Activity::Running:
            return tr("A protocol is using the oscilloscope. Capturing continues after it.");
        case Activity::Closed:
            return tr("No bench is open. The last capture stays.");
        case Activity::Opening:
        case Activity::Closing:
            return tr("The bench is opening or closing.");
        case Activity::Live:
            break;
    }
    if (!possible()) return tr("The open bench has no oscilloscope.");
    if (mode_ == ScopeMode::Single && shown != nullptr)
        return tr("One capture taken. S takes another. The output is not touched.");
    return tr("On hold: the picture stays. The output is not touched.");
}

bool ScopeFeed::begin(const std::filesystem::path& session) {
    if (!acquisition_.possible() || std::exchange(session_, session) == session) return false;
    framed_ = false;
    model_.clearMarks();
    // The new bench replaces a file that was shown before.
    if (model_.shown() && !model_.shown()->source.isEmpty()) {
        model_.clear();
        acquisition_.wantAgain();
    }
    return true;
}

ScopeFeed::Taken ScopeFeed::take(const ShownPtr& shown) {
    const bool ours = shown->source.isEmpty();
    if (ours && !acquisition_.take(*shown)) return Taken::Nothing;
    if (ours && staysBefore(*shown)) {
        model_.setHeld(true);
        return Taken::Held;
    }
    const bool anew = !ours || !model_.shown() || model_.shown()->source != shown->source;
    model_.show(shown);
    // The first record is shown whole. The first triggered record is zoomed to its first train.
    if (ours && !shown->capture->untriggered && !std::exchange(framed_, true)) model_.frameFirstPulse();
    return anew ? Taken::ShownAnew : Taken::Shown;
}

/// If the output is off, the last train stays on the screen, as a record of noise would be of no use.
bool ScopeFeed::staysBefore(const ShownCapture& next) const {
    const auto& last = model_.shown();
    return next.capture->untriggered && !model_.roll() && !acquisition_.delivering() && last &&
           last->source.isEmpty() && !last->capture->untriggered;
}

}  // namespace tacto::gui

#include "moc_ScopeAcquisition.cpp"
