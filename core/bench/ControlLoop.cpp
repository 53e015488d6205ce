#include "core/bench/ControlLoop.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "core/bench/ReportRecord.h"

namespace tacto {

namespace {

constexpr Instant kExposureEvery = std::chrono::milliseconds(100);
constexpr Instant kReportLook = std::chrono::milliseconds(100);
constexpr Instant kUnrecorded = std::chrono::seconds(2);
constexpr Instant kSlept = std::chrono::seconds(1);         // shorter is a silence as any other
constexpr Instant kReportEvery = std::chrono::seconds(10);  // of a line that goes on losing

}  // namespace

ControlLoop::ControlLoop(Parts parts, std::unique_ptr<FingerInput> finger, std::unique_ptr<TrainPlanner> planner)
    : parts_(std::move(parts)), finger_(std::move(finger)), planner_(std::move(planner)) {
    exposure_.reserve(2 * Telemetry::kMaxExposureRows);
}

void ControlLoop::arm(ArmCommand command) {
    {
        const std::scoped_lock lock(armedMutex_);
        armedResult_.reset();
    }
    const std::scoped_lock lock(inboxMutex_);
    inbox_.arm = std::move(command);
    inboxFull_.store(true, std::memory_order_release);
}

std::optional<Result<void>> ControlLoop::armed() {
    const std::scoped_lock lock(armedMutex_);
    return std::exchange(armedResult_, std::nullopt);
}

void ControlLoop::drive(const DriveCommand& command) {
    const std::scoped_lock lock(inboxMutex_);
    inbox_.drive = command;
    inboxFull_.store(true, std::memory_order_release);
}

void ControlLoop::replaceFinger(std::unique_ptr<FingerInput> finger, RBefore before) {
    const std::scoped_lock lock(inboxMutex_);
    // Of two in one step the first was never used.
    if (!inbox_.finger) inbox_.before = before;
    inbox_.finger = std::move(finger);
    inboxFull_.store(true, std::memory_order_release);
}

void ControlLoop::replacePlanner(std::unique_ptr<TrainPlanner> planner) {
    const std::scoped_lock lock(inboxMutex_);
    inbox_.planner = std::move(planner);
    inboxFull_.store(true, std::memory_order_release);
}

void ControlLoop::confirmCheck(const Result<Ohms>& seen) {
    const std::scoped_lock lock(inboxMutex_);
    inbox_.confirmed = seen;
    inboxFull_.store(true, std::memory_order_release);
}

void ControlLoop::noteLoad(const SeenLoad& seen) {
    const std::scoped_lock lock(inboxMutex_);
    inbox_.load = seen;
    inboxFull_.store(true, std::memory_order_release);
}

void ControlLoop::noteAmplitude(const SeenAmplitude& seen) {
    const std::scoped_lock lock(inboxMutex_);
    // Of several in one step the one that is furthest off.
    const auto off = [](const SeenAmplitude& one) { return std::abs(one.amplitude / one.expected - 1); };
    if (!inbox_.amplitude || off(seen) > off(*inbox_.amplitude)) inbox_.amplitude = seen;
    inboxFull_.store(true, std::memory_order_release);
}

/// Before anything else: what was approved before a silence must not be written after it, whichever thread wakes first.
void ControlLoop::beat(Instant now) noexcept {
    const bool inTime = parts_.heartbeat.beat(parts_.clock.elapsed());
    const Instant asleep = parts_.clock.asleep();
    const Instant slept = asleep - asleepSeen_;
    if (slept > kSlept)
        wakeFromSleep(now, slept);
    else if (!inTime)
        wakeFromSilence(now);
    else
        return;
    asleepSeen_ = asleep;
    parts_.heartbeat.revive(parts_.clock.elapsed());
}

void ControlLoop::wakeFromSilence(Instant now) noexcept {
    const auto state = parts_.interlock.state();
    const bool wasOn = state == InterlockState::Checking || state == InterlockState::Armed ||
                       state == InterlockState::Delivering || state == InterlockState::Paused;
    if (wasOn) return trip(FaultCause::LoopSilent, "the control loop was silent for more than 100 ms", now);
    parts_.gate.latchStop();
    outputsOff();
}

void ControlLoop::wakeFromSleep(Instant now, Instant slept) noexcept {
    std::array<char, 80> why{};
    fmt::format_to_n(why.data(), why.size() - 1, "the computer slept for {:.0f} s", toSeconds(slept));
    endOrder(now, "sleep", why.data());
}

/// Output goes on only while its owner waits for it and what it does is recorded.
void ControlLoop::watchOwner(Instant now) noexcept {
    const auto state = parts_.interlock.state();
    const bool on = state == InterlockState::Checking || state == InterlockState::Armed ||
                    state == InterlockState::Delivering || state == InterlockState::Paused;
    if (!on) return;
    if (drive_.source != DriveSource::Off && now.count() > attendedUntil_.load(std::memory_order_acquire))
        return endOrder(now, "unattended", "the program that ordered the output did not look after it for 2 s");
    if (parts_.recorder != nullptr && parts_.recorder->standsStillFor() > kUnrecorded)
        endOrder(now, "unrecorded", "the disk stood still for 2 s, and nothing is put out that is not recorded");
}

/// An order from before is over, as by a stop.
void ControlLoop::endOrder(Instant now, const char* kind, std::string_view why) noexcept {
    {
        const std::scoped_lock lock(armedMutex_);
        endedBecause_ = why;
    }
    if (parts_.stops != nullptr) parts_.stops->raise();
    parts_.interlock.disarm(FixedText<159>(why).c_str());
    parts_.gate.latchStop();
    outputsOff();
    drive_ = {};
    if (parts_.recorder != nullptr) parts_.recorder->event(now, kind, {}, why);
}

FixedText<159> ControlLoop::endedBecause() const noexcept {
    const std::scoped_lock lock(armedMutex_);
    return endedBecause_;
}

void ControlLoop::beginOrder() noexcept {
    anotherOrder_.store(true, std::memory_order_release);
    const std::scoped_lock lock(armedMutex_);
    endedBecause_ = {};
}

void ControlLoop::step(Instant now) noexcept {
    beat(now);
    takeCommands(now);
    watchOwner(now);
    noteState(now);
    readFinger(now);
    watchSensor(now);
    judgeReports();
    if (arming_ && !checkPosted_) beginCheck(now);
    if (arming_ && checkRead_ && confirmed_) armOnCapture(now);
    watchForSilence(now);
    updateWish(now);
    if (parts_.massager != nullptr)
        sendBurst(now);
    else
        sendTrain(now);
    publish(now);
}

void ControlLoop::takeCommands(Instant now) noexcept {
    if (!inboxFull_.load(std::memory_order_acquire)) return;
    Inbox taken;
    {
        const std::unique_lock lock(inboxMutex_, std::try_to_lock);
        if (!lock) return;  // next step: the loop never waits
        taken = std::exchange(inbox_, {});
        inboxFull_.store(false, std::memory_order_release);
    }
    if (taken.finger) takeFinger(std::move(taken.finger), taken.before);
    if (taken.planner) planner_ = std::move(taken.planner);
    if (taken.drive) {
        drive_ = *taken.drive;
        if (parts_.recorder != nullptr) {
            parts_.recorder->command(now, "drive", {{"roughness", drive_.roughness}, {"pressure", drive_.pressure}},
                                     drive_.source == DriveSource::Manual   ? "manual"
                                     : drive_.source == DriveSource::Sensor ? "sensor"
                                                                            : "off");
        }
    }
    if (taken.arm) {
        arming_ = std::move(taken.arm);
        order_ = arming_->asked;
        checkPosted_ = checkRead_ = false;
        confirmed_.reset();
        impedance_.reset();
        planner_->wantNothing();
    }
    if (taken.confirmed && arming_) confirmed_ = std::move(taken.confirmed);
    if (taken.load) judgeLoad(*taken.load, now);
    if (taken.amplitude) judgeAmplitude(*taken.amplitude, now);
}

void ControlLoop::noteState(Instant now) noexcept {
    const auto state = parts_.interlock.state();
    if (state == seenState_) return;
    const auto before = std::exchange(seenState_, state);
    const bool wasConnected = before != InterlockState::Disconnected;
    const auto reason = parts_.interlock.reason();
    shown_.reason = FixedText<200>(reason.view());
    if (parts_.recorder != nullptr && (state != InterlockState::Delivering || before == InterlockState::Paused)) {
        parts_.recorder->event(now, "interlock", {},
                               fmt::format("{}{}{}", nameOf(state), reason.empty() ? "" : ": ", reason.view()));
    }
    if (wasConnected && (state == InterlockState::Disarmed || state == InterlockState::Faulted)) {
        if (arming_) {
            finishArming(fail(state == InterlockState::Faulted ? ErrorCode::Device : ErrorCode::Stopped,
                              "arming ended: {}", reason.empty() ? nameOf(state) : reason.view()));
        }
        impedance_.reset();
        drive_ = {};
        planner_->wantNothing();
    }
}

void ControlLoop::beginCheck(Instant now) noexcept {
    if (parts_.interlock.state() != InterlockState::Checking) {
        return finishArming(fail(ErrorCode::Stopped, "arming ended: {}", nameOf(parts_.interlock.state())));
    }
    if (stopped()) return endArmingForStop();
    if (parts_.stimulator != nullptr && !parts_.stimulator->idle()) return;  // an earlier train is still being read
    checkPosted_ = true;
    if (const auto configured = parts_.gate.configure(arming_->setup); !configured) {
        parts_.interlock.disarm("arming was refused");
        return finishArming(failure(configured));
    }
    const bool looksAtCapture = arming_->confirmByCapture && arming_->evidence.declaredLoadConfirmed;
    if (parts_.stimulator == nullptr || !(arming_->evidence.readsBack || looksAtCapture)) return armWithoutCheck(now);
    auto check = parts_.gate.approveCheck(now);
    if (!check) {
        parts_.interlock.disarm("the impedance check was refused");
        return finishArming(failure(check));
    }
    if (!mayPost(true)) return endArmingForStop();
    postCheck(std::move(*check), now);
}

/// On the operator's word alone, and for a massager: nothing measures the load.
void ControlLoop::armWithoutCheck(Instant now) noexcept {
    arming_->evidence.impedanceAt = now;
    const auto permitted = parts_.interlock.arm(arming_->evidence, now);
    if (!permitted) parts_.interlock.disarm("arming was refused");
    planner_->armedOn(arming_->declared);
    impedanceHigh_ = arming_->evidence.impedanceHigh;
    armedAt_ = now;
    finishArming(permitted);
}

bool ControlLoop::stopped() const noexcept { return parts_.stops != nullptr && parts_.stops->movedSince(order_); }

void ControlLoop::endArmingForStop() noexcept {
    parts_.interlock.disarm("stopped");  // the stop itself may have come before Checking was entered
    finishArming(fail(ErrorCode::Stopped, "arming ended: stopped. Output is off."));
}

/// Asked after an approval was granted and before it is posted. A stop raises its counter and disarms before it voids
/// approvals, so an approval made after the voiding is held back here, and one made before it is void. The counter
/// counts where the stop came before the interlock had anything to disarm.
bool ControlLoop::mayPost(bool isCheck) const noexcept {
    if (stopped()) return false;
    const auto state = parts_.interlock.state();
    if (isCheck && arming_) return state == InterlockState::Checking;
    return (state == InterlockState::Armed || state == InterlockState::Delivering) &&
           !paused_.load(std::memory_order_acquire);
}

void ControlLoop::finishArming(Result<void> result) noexcept {
    arming_.reset();
    const std::scoped_lock lock(armedMutex_);
    armedResult_ = std::move(result);
}

void ControlLoop::readFinger(Instant now) noexcept {
    if (!finger_) return;
    finger_->update();
    if (parts_.recorder != nullptr) {
        const auto blocks = finger_->blocks();
        const auto streams = finger_->session().device().streams();
        for (std::size_t s = 0; s < blocks.size(); ++s) {
            if (blocks[s].samples() == 0) continue;
            parts_.recorder->samples(parts_.sensorStreams[s], streams[s].channels, blocks[s]);
        }
    }
    if (parts_.tap != nullptr) tapSamples(*parts_.tap);
    serveListener();
    for (const auto& frame : finger_->frames()) {
        if (parts_.tap != nullptr) parts_.tap->frames.push(frame);
        if (frame.contact && !std::isnan(frame.h) && frame.sliding) {
            ++shown_.slidingFrames;
            shown_.sumH += frame.h;
        }
        if (frame.contact && !std::isnan(frame.v)) {
            ++shown_.contactFrames;
            shown_.sumV += frame.v;
        }
        if (parts_.recorder != nullptr) {
            const double columns[] = {frame.contact ? 1.0 : 0.0,
                                      frame.sliding ? 1.0 : 0.0,
                                      frame.h,
                                      frame.v,
                                      frame.R,
                                      frame.pressure_pa,
                                      frame.P};
            parts_.recorder->frame(parts_.frameStream, frame.t_s, columns);
        }
    }
    const auto& newest = finger_->latest();
    shown_.roughness = newest.R;
    shown_.pressure = newest.P;
    shown_.h = newest.h;
    shown_.v = newest.v;
    shown_.pressure_pa = newest.pressure_pa;
    shown_.contact = newest.contact;
    shown_.sliding = newest.sliding;
    shown_.sensorAge_s = finger_->age_s(toSeconds(now));
    shown_.samplesLost = finger_->session().samplesLost();
    shown_.sensorFinished = finger_->session().finished();
    shown_.gaps = finger_->gaps();
    shown_.flags = flagsKept_;
    shown_.flags.include(finger_->flags());
}

/// A sensor that is gone ends the output, whatever drives it: a plug was pulled at the finger.
void ControlLoop::watchSensor(Instant now) noexcept {
    if (!finger_) return;
    const auto& session = finger_->session();
    if (const auto failures = session.failures(); std::exchange(sensorFailuresSeen_, failures) != failures) {
        trip(FaultCause::DeviceFault, fmt::format("the fingertip sensor failed: {}", session.error().view()), now);
    }
    noteLosses(now);
}

void ControlLoop::noteLosses(Instant now) noexcept {
    if (parts_.sensorReport == nullptr || parts_.recorder == nullptr || now < lossesDue_) return;
    const auto report = parts_.sensorReport->deviceReport();
    lossesDue_ = now + kReportLook;
    if (report.losses <= lossesNoted_) return;
    lossesNoted_ = report.losses;
    lossesDue_ = now + kReportEvery;
    recordReport(*parts_.recorder, now, report, "something was lost between the fingertip sensor and this program");
}

void ControlLoop::listen(BenchTap* tap) {
    const std::scoped_lock lock(listenMutex_);
    listener_ = tap;
    listening_.store(tap != nullptr, std::memory_order_release);
}

void ControlLoop::serveListener() noexcept {
    if (!listening_.load(std::memory_order_acquire)) return;
    const std::scoped_lock lock(listenMutex_);
    if (listener_ != nullptr) tapSamples(*listener_);
}

void ControlLoop::tapSamples(BenchTap& tap) noexcept {
    const auto blocks = finger_->blocks();
    const auto streams = finger_->session().device().streams();
    for (std::size_t s = 0; s < blocks.size(); ++s) {
        TapSample sample;
        sample.stream = static_cast<std::uint32_t>(s);
        const auto all = streams[s].channels;
        const auto shown = std::min(all, TapSample::kMaxChannels);
        sample.channels = static_cast<std::uint32_t>(shown);
        for (std::size_t i = 0; i < blocks[s].samples(); ++i) {
            sample.t_s = blocks[s].t_s[i];
            for (std::size_t c = 0; c < shown; ++c)
                sample.values[c] = static_cast<float>(blocks[s].values[i * all + c]);
            tap.samples.push(sample);
        }
    }
}

void ControlLoop::updateWish(Instant now) noexcept {
    const auto state = parts_.interlock.state();
    const bool permitted = state == InterlockState::Armed || state == InterlockState::Delivering;
    if (!permitted || paused_.load(std::memory_order_acquire) || drive_.source == DriveSource::Off) {
        planner_->wantNothing();
        return;
    }
    if (drive_.source == DriveSource::Manual) {
        shown_.roughness = drive_.roughness;
        shown_.pressure = drive_.pressure;
        if (const auto wanted = planner_->want(drive_.roughness, drive_.pressure, now); !wanted) {
            refused(now, wanted.error().message);
        }
        return;
    }
    const bool fresh = finger_ && finger_->fresh(toSeconds(now));
    if (!fresh) {
        if (!staleSeen_ && planner_->command()) {
            ++shown_.trainsSkipped;
            if (parts_.recorder != nullptr) {
                parts_.recorder->event(now, "stale", {{"age_s", shown_.sensorAge_s}},
                                       "sensor data are older than 100 ms: no new trains");
            }
        }
        staleSeen_ = true;
        planner_->wantNothing();
        return;
    }
    staleSeen_ = false;
    const auto& frame = finger_->latest();
    if (!frame.contact || std::isnan(frame.R)) {
        planner_->wantNothing();
        return;
    }
    noteFlags(now);
    const auto pressure = std::isnan(frame.P) ? std::nullopt : std::optional(frame.P);
    if (const auto wanted = planner_->want(frame.R, pressure, now); !wanted) {
        refused(now, wanted.error().message);
    }
}

void ControlLoop::takeFinger(std::unique_ptr<FingerInput> finger, RBefore before) noexcept {
    if (finger_) {
        auto flags = finger_->flags();
        if (before == RBefore::Measuring) flags.dropCalibration();
        flagsKept_.include(flags);
    }
    finger_ = std::move(finger);
}

RoughnessFlags ControlLoop::flags() noexcept {
    const std::scoped_lock lock(inboxMutex_);
    if (inbox_.finger) takeFinger(std::move(inbox_.finger), inbox_.before);
    auto all = flagsKept_;
    if (finger_) all.include(finger_->flags());
    return all;
}

/// Every flag under which R drives the output is in the session before the bench closes: it may never close.
void ControlLoop::noteFlags(Instant now) noexcept {
    const auto flags = finger_->flags();
    for (std::size_t i = 0; i < flags.times.size(); ++i) {
        if (flags.times[i] == 0 || flagsKept_.times[i] != 0 || parts_.recorder == nullptr) continue;
        parts_.recorder->event(now, kMarkEvent, {}, nameOf(static_cast<RoughnessFlag>(i)));
    }
    flagsKept_.include(flags);
}

void ControlLoop::sendTrain(Instant now) noexcept {
    if (parts_.stimulator == nullptr || !parts_.stimulator->idle()) return;
    const auto due = planner_->due();
    if (!due || *due >= now + kPeriod || !mayPost(false)) return;
    const bool readsBack = parts_.stimulator->device().traits().readsBack;
    if (readsBack && now - impedanceAt_ > Interlock::kImpedanceAge) {
        // The reading is old: one check pulse first; the train follows when it was judged.
        auto check = parts_.gate.approveCheck(now);
        if (!check) return trip(FaultCause::LimitBroken, check.error().message, now);
        if (!mayPost(true)) return;
        return postCheck(std::move(*check), now);
    }
    auto planned = planner_->plan(now, impedance_);
    if (!planned) return refused(now, planned.error().message);
    if (!beginDelivery()) return;
    if (parts_.recorder != nullptr) {
        parts_.recorder->command(planned->onset, "train",
                                 {{"amplitude_v", planned->command.amplitude.value()},
                                  {"held_v", planned->held.value()},
                                  {"interval_s", planned->command.interval.count()},
                                  {"roughness", shown_.roughness},
                                  {"pressure", shown_.pressure},
                                  {"amplitude", siValue(planned->rounding.train.amplitude)},
                                  {"rounded_by", planned->rounding.amplitude}});
    }
    expected_ = planned->expected;
    post(std::move(planned->approved), planned->onset, planned->expected);
}

void ControlLoop::sendBurst(Instant now) noexcept {
    if (!parts_.massager->idle()) return;
    const auto due = planner_->due();
    if (!due || *due >= now + kPeriod || !mayPost(false)) return;
    auto planned = planner_->planBurst(now);
    if (!planned) return refused(now, planned.error().message);
    if (!beginDelivery()) return;
    if (parts_.recorder != nullptr) {
        parts_.recorder->command(planned->onset, "burst",
                                 {{"amplitude_v", planned->command.amplitude.value()},
                                  {"interval_s", planned->command.interval.count()},
                                  {"roughness", shown_.roughness},
                                  {"pressure", shown_.pressure},
                                  {"intensity", planned->approved.burst().intensity}});
    }
    parts_.massager->post(std::move(planned->approved), planned->onset, planned->command.interval);
}

/// False when a stop came in between.
bool ControlLoop::beginDelivery() noexcept {
    if (parts_.interlock.state() == InterlockState::Armed) {
        if (const auto begun = parts_.interlock.beginDelivery(); !begun) return false;
        seenState_ = InterlockState::Delivering;
    }
    return mayPost(false);
}

void ControlLoop::post(ApprovedTrain&& train, Instant onset, std::optional<double> expected) noexcept {
    const auto& amplitude = train.train().amplitude;
    const double told = siValue(amplitude) * (isCurrent(amplitude) ? 1e3 : 1);
    // Check pulses too: a capture of one belongs to no train that was delivered shortly before.
    shown_.told[told_++ % shown_.told.size()] = {onset, told, expected.value_or(told)};
    parts_.stimulator->post(std::move(train), onset, !expected);
    exposureAt_ = Instant(0);
}

void ControlLoop::refused(Instant now, std::string_view why) noexcept {
    ++shown_.trainsRefused;
    shown_.lastRefusal = why;
    latest_.write(shown_);  // before anybody who saw the count asks for the reason
    refusals_.store(shown_.trainsRefused, std::memory_order_release);
    if (parts_.recorder != nullptr) parts_.recorder->event(now, "refused", {}, why);
}

void ControlLoop::outputsOff() noexcept {
    if (parts_.stimulator != nullptr) parts_.stimulator->forceOff();
    if (parts_.massager != nullptr) parts_.massager->forceOff();
}

void ControlLoop::trip(FaultCause cause, std::string_view reason, Instant now) noexcept {
    parts_.gate.latchStop();
    outputsOff();
    parts_.interlock.fault(cause, reason);  // keeps it in a file, whose disk may be slow
    faults_.fetch_add(1, std::memory_order_acq_rel);
    if (parts_.recorder != nullptr) parts_.recorder->event(now, "fault", {}, reason);
    noteState(now);
}

void ControlLoop::publish(Instant now) noexcept {
    shown_.at = now;
    shown_.state = parts_.interlock.state();
    shown_.paused = paused_.load(std::memory_order_relaxed);
    shown_.driving = drive_.source;
    const auto& command = planner_->command();
    shown_.amplitude_v = command ? command->amplitude.value() : NAN;
    shown_.interval_s = command ? command->interval.count() : NAN;
    const auto due = planner_->due();
    shown_.nextTrain_s = due ? toSeconds(*due) : NAN;
    shown_.impedance_ohm = impedance_ ? impedance_->value() : NAN;
    shown_.impedanceAge_s = impedance_ ? toSeconds(now - impedanceAt_) : NAN;
    ++shown_.steps;
    const bool isAnother = anotherOrder_.exchange(false, std::memory_order_acq_rel);
    if (isAnother || now - exposureAt_ >= kExposureEvery || exposureAt_ == Instant(0)) {
        exposureAt_ = now;
        parts_.gate.exposure(exposure_);
        shown_.exposureCount = std::min(exposure_.size(), shown_.exposureRows.size());
        std::copy_n(exposure_.begin(), shown_.exposureCount, shown_.exposureRows.begin());
        // A window is fullest when a train has just been booked, and post() asks for a look.
        if (isAnother) worst_ = {};
        worst_.take(exposure_);
        latestWorst_.write(worst_);
    }
    latest_.write(shown_);
}

}  // namespace tacto
