#include "core/bench/Bench.h"

#include <cmath>
#include <nlohmann/json.hpp>
#include <thread>
#include <utility>

#include "core/bench/BenchState.h"
#include "core/devices/DeviceUri.h"

namespace tacto {

namespace {

constexpr Instant kCaptureGrace = std::chrono::seconds(1);

/// What the stimulator was told for the train that begins at the trigger; NaN where none does.
ToldTrain toldFor(const Capture& capture, const Telemetry& now) {
    constexpr double kNear_s = 0.05;
    double nearest_s = kNear_s;
    ToldTrain told;
    for (const auto& train : now.told) {
        const double off_s = std::abs(capture.trigger_s - toSeconds(train.onset));
        if (std::isnan(train.amplitude) || !(off_s < nearest_s)) continue;
        nearest_s = off_s;
        told = train;
    }
    return told;
}

}  // namespace

SourceTraits traitsOf(const DeviceSet& devices) {
    if (devices.stimulator) return devices.stimulator->traits();
    SourceTraits none;  // encodes for display; nothing is delivered without a stimulator
    none.amplitudeMax = 1000;
    none.compliance = Volts(1000);
    return none;
}

/// The stimulator goes on from what it delivered before, and no other process drives it meanwhile.
Result<void> Bench::State::takeUpRecord() {
    const auto& stimulating = config.devices.stimulator;
    if (!stimulating || stimulating->identity().simulated || config.units.records.empty()) return {};
    const auto& identity = stimulating->identity();
    auto opened = UnitRecord::open(config.units, unitOf(identity.serial, identity.uri), *config.clock,
                                   config.systemTime != nullptr ? *config.systemTime : SystemTime::real());
    if (!opened) return failure(opened);
    record = std::move(*opened);
    gate.continueFrom(*record);
    return {};
}

Result<void> Bench::State::open() {
    if (const auto valid = validate(config.profile.encoding); !valid) return valid;
    if (const auto taken = takeUpRecord(); !taken) return taken;
    if (config.devices.sensor) {
        auto made = SensorSession::create(*config.devices.sensor);
        if (!made) return failure(made);
        sensor = std::move(*made);
    }
    auto finger = makeFinger(config.profile);
    if (!finger) return failure(finger);

    ControlLoop::Parts parts{*config.clock, gate,    interlock, heartbeat, config.mode,
                             nullptr,       nullptr, 0,         {},        config.tap};
    parts.stops = stops.get();
    const auto wake = [this] {
        if (outputThread) outputThread->wake();
    };
    if (config.session != nullptr) {
        if (sensor) {
            for (const auto& stream : sensor->device().streams()) {
                const auto id = config.session->addStream(stream);
                if (!id) return failure(id);
                parts.sensorStreams.push_back(*id);
            }
            const auto id = config.session->addStream(SessionStream{
                "roughness frames", "frames", "", {"contact", "sliding", "h", "v", "R", "pressure_pa", "P"}, 0});
            if (!id) return failure(id);
            parts.frameStream = *id;
        }
        recorder = std::make_unique<SessionRecorder>(*config.session,
                                                     SessionRecorder::Settings{.ownThread = virtualClock == nullptr});
        parts.recorder = recorder.get();
    }
    if (config.devices.stimulator) {
        stimulator =
            std::make_unique<StimulatorSession>(*config.devices.stimulator, gate, heartbeat, *config.clock, wake);
        parts.stimulator = stimulator.get();
    } else if (config.devices.massager) {
        massager = std::make_unique<MassagerSession>(*config.devices.massager, gate, heartbeat, *config.clock, wake);
        parts.massager = massager.get();
    }
    if (config.devices.oscilloscope) {
        scope = std::make_unique<ScopeSession>(*config.devices.oscilloscope, [this](Capture& capture) {
            applyStatement(capture, config.devices.scopeStatement);
            const auto told = toldFor(capture, loop->telemetry());
            capture.told = told.amplitude;
            if (!stimulator) return;
            if (auto seen = amplitudeSeenIn(capture, source.drive); seen && !std::isnan(told.expected)) {
                seen->expected = told.expected;
                seen->onset = told.onset;
                loop->noteAmplitude(*seen);
            }
            if (source.readsBack) return;
            if (const auto seen = loadSeenIn(capture)) loop->noteLoad(*seen);
        });
    }
    parts.sensorReport = reportingDevice(Role::Sensor);
    loop = std::make_unique<ControlLoop>(std::move(parts), std::move(*finger), makePlanner(config.profile));
    const bool rests = record && !record->whyQuiet().empty();
    const auto* note = rests ? "arming waits until 8 s after opening: what this unit delivered last is not known" : "";
    if (const auto connected = interlock.connect(note); !connected) return connected;
    if (record) interlock.keepFaultsIn(*record);
    nextTick = outputDue = config.clock->now();
    noteCalibration();
    if (virtualClock == nullptr) startThreads();
    return {};
}

void Bench::State::noteCalibration() {
    if (!recorder || config.calibrationText.empty()) return;
    const StimulatorCalibration told = applied.value_or(StimulatorCalibration{});
    const auto interval = told.interval.value_or(CalibrationLine{}),
               width = told.phaseWidth.value_or(CalibrationLine{}), gap = told.gap.value_or(CalibrationLine{});
    const std::string text = config.calibration && config.calibrationHolds && !applied
                                 ? "left aside: the stimulator is told the commands as they are"
                                 : config.calibrationText;
    // Past the recorder, whose only caller is the control loop.
    static_cast<void>(config.session->event(config.clock->now(), "calibration",
                                            {{"gain", told.amplitude.gain},
                                             {"offset", told.amplitude.offset},
                                             {"interval_gain", interval.gain},
                                             {"interval_offset_s", interval.offset},
                                             {"width_gain", width.gain},
                                             {"width_offset_s", width.offset},
                                             {"gap_gain", gap.gain},
                                             {"gap_offset_s", gap.offset},
                                             {"text", text}}));
}

/// Last of all, since counts grow until the end. Without this event the marks of a session are not known.
void Bench::State::noteMarks() const noexcept {
    auto calibrated = nlohmann::json();
    if (stimulator) calibrated = hasCalibration();
    const auto& u = config.profile.roughness.uncertainty;
    const auto ofR = u ? nlohmann::json{u->expanded(0), u->expanded(0.5), u->expanded(1)} : nlohmann::json();
    const nlohmann::json marks{{"flags", loop->flags().texts()},
                               {"stimulator_calibrated", std::move(calibrated)},
                               {"R_expanded_uncertainty", ofR}};
    static_cast<void>(config.session->event(config.clock->now(), kMarksEvent, marks));
}

/// What the gate and the encoder are told anew is an event: by the file alone it must be known what a train was made of
/// and judged by.
Result<void> Bench::State::noteProfile(const Profile& next) const {
    if (config.session == nullptr) return {};
    const auto before = toJson(config.profile), after = toJson(next);
    auto changed = nlohmann::json::array();
    for (const auto& [section, value] : after.items()) {
        if (before.value(section, nlohmann::json()) == value) continue;
        if (!value.is_object()) changed.push_back(section);
        for (const auto& [key, part] : value.items()) {
            if (value.is_object() && before.at(section).value(key, nlohmann::json()) != part)
                changed.push_back(section + "." + key);
        }
    }
    if (changed.empty()) return {};
    const auto noted =
        config.session->event(config.clock->now(), "settings", {{"changed", changed}, {"profile", after}});
    if (!noted) return failure(noted);
    return {};
}

void Bench::State::startThreads() {
    const auto& clock = *config.clock;
    if (hasOutput())
        outputThread = std::make_unique<DeviceThread>(clock, [this](Instant now) { return serveOutput(now); });
    if (sensor)
        sensorThread = std::make_unique<DeviceThread>(clock, [this](Instant now) { return sensor->serve(now); });
    if (scope) scopeThread = std::make_unique<DeviceThread>(clock, [this](Instant now) { return scope->serve(now); });
    loopThread = std::make_unique<DeviceThread>(clock, [this, due = clock.now()](Instant now) mutable {
        if (heartbeatWithheld.load(std::memory_order_acquire)) return now + ControlLoop::kPeriod;
        loop->step(now);
        // Behind by more than a step (a stall): go on from now rather than catch up in a burst.
        due = std::max(due + ControlLoop::kPeriod, now);
        return due;
    });
}

/// Virtual clock: moves time to the next thing that happens, at most to `until`, and does it.
void Bench::State::turn(Instant until) noexcept {
    const Instant next = std::min(until, hasOutput() ? std::min(nextTick, outputDue) : nextTick);
    virtualClock->advanceTo(next);
    const Instant now = virtualClock->now();
    if (hasOutput() && now >= outputDue) outputDue = serveOutput(now);
    if (now < nextTick) return;
    nextTick = now + ControlLoop::kPeriod;
    if (sensor) sensor->serve(now);
    loop->step(now);
    if (outputBusy()) outputDue = serveOutput(now);
    if (scope && scope->active()) scope->serve(now);
}

Result<void> Bench::State::health() const {
    if (stopped()) {
        const auto why = loop->endedBecause();
        if (why.empty()) return fail(ErrorCode::Stopped, "stopped. Output is off.");
        return fail(ErrorCode::Stopped, "stopped: {}. Output is off.", why.view());
    }
    if (interlock.state() == InterlockState::Faulted) {
        return fail(ErrorCode::Device, "fault: {}. Output is off.", interlock.reason().view());
    }
    if (driving == DriveSource::Sensor && sensor && sensor->failed()) {
        return fail(ErrorCode::Device, "the fingertip sensor failed: {}. No trains are sent.", sensor->error().view());
    }
    if (recorder && recorder->failed()) {
        const auto why = recorder->error();
        return fail(ErrorCode::Io, "recording failed: {}", why ? why->message : "the session file cannot be written");
    }
    return {};
}

Result<std::unique_ptr<Bench>> Bench::create(BenchConfig config) {
    auto state = std::make_unique<State>(std::move(config));
    if (const auto opened = state->open(); !opened) return failure(opened);
    return std::unique_ptr<Bench>(new Bench(std::move(state)));
}

Bench::Bench(std::unique_ptr<State> state) : state_(std::move(state)) {}
Bench::~Bench() = default;

void Bench::disarm() noexcept {
    state_->off("disarmed");
    if (state_->virtualClock != nullptr) state_->loop->noteState(state_->config.clock->now());
}

void Bench::stop(const char* by) noexcept {
    state_->stops->raise();  // first: see ControlLoop::mayPost()
    state_->off(by);
    { const std::scoped_lock lock(state_->waitMutex); }
    state_->waitChanged.notify_all();
}

Result<void> Bench::begin(StopMark asked) {
    auto& s = *state_;
    if (s.stops->movedSince(asked)) {
        return fail(ErrorCode::Stopped, "stopped before this was begun. Output is off.");
    }
    s.loop->beginOrder();
    attend();
    s.order.store(asked, std::memory_order_release);
    return {};
}

void Bench::attend(Seconds within) noexcept { state_->attend(within); }

std::uint64_t Bench::recordsLost() const noexcept { return state_->recorder ? state_->recorder->dropped() : 0; }

StopCounter& Bench::stops() noexcept { return *state_->stops; }

void Bench::pause() noexcept {
    state_->paused.store(true, std::memory_order_release);
    state_->loop->pauseOutput(true);
    // Refused unless Delivering: a bench that delivers nothing has nothing to pause, and the wish is kept anyway.
    static_cast<void>(state_->interlock.pause());
    state_->gate.latchStop();  // a train already handed over does not come after the pause
}

void Bench::resume() noexcept {
    static_cast<void>(state_->interlock.resume());  // refused when it was not Paused: nothing to leave
    state_->loop->pauseOutput(false);
    {
        const std::scoped_lock lock(state_->waitMutex);
        state_->paused.store(false, std::memory_order_release);
    }
    state_->waitChanged.notify_all();
}

Result<void> Bench::drive(DriveSource source, double roughness, double pressure) {
    auto& s = *state_;
    if (source != DriveSource::Off && s.stopped()) return fail(ErrorCode::Stopped, "stopped. Output is off.");
    if (source == DriveSource::Sensor && !s.sensor) {
        return fail(ErrorCode::Unsupported, "no fingertip sensor is open to drive the output");
    }
    if (source == DriveSource::Manual) {
        for (const auto& [name, value] : {std::pair("R", roughness), std::pair("P", pressure)}) {
            if (!(value >= 0 && value <= 1)) {
                return fail(ErrorCode::InvalidArgument, "{} is {}; 0 to 1 is expected", name, value);
            }
        }
    }
    attend();
    s.driving.store(source, std::memory_order_release);
    s.refusalsSeen = s.loop->refusals();
    s.loop->drive({source, roughness, pressure});
    // A stop in between has told the loop to drive nothing; what was wished before it is not kept for the next arming.
    if (source != DriveSource::Off && s.stopped()) {
        s.driving.store(DriveSource::Off, std::memory_order_release);
        s.loop->drive({});
        return fail(ErrorCode::Stopped, "stopped. Output is off.");
    }
    return {};
}

Result<void> Bench::setProfile(const Profile& profile, RBefore before) {
    auto& s = *state_;
    if (const auto valid = validate(profile.encoding); !valid) return valid;
    const auto state = s.interlock.state();
    const bool armed = state != InterlockState::Disarmed && state != InterlockState::Disconnected;
    auto withSameRoughness = profile;
    withSameRoughness.roughness = s.config.profile.roughness;
    if (armed && toJson(withSameRoughness) != toJson(s.config.profile)) {
        return fail(ErrorCode::NotArmed,
                    "the encoding and the limits of the profile cannot change while {}: disarm first", nameOf(state));
    }
    auto finger = s.makeFinger(profile);
    if (!finger) return failure(finger);
    if (const auto noted = s.noteProfile(profile); !noted) return noted;
    if (s.config.profile.roughness == profile.roughness) before = RBefore::Measuring;  // the next one has its flags
    s.config.profile = profile;
    if (*finger) s.loop->replaceFinger(std::move(*finger), before);
    if (!armed) s.loop->replacePlanner(s.makePlanner(profile));
    return {};
}

const Profile& Bench::profile() const noexcept { return state_->config.profile; }
const std::vector<LimitSet>& Bench::limits() const noexcept { return state_->config.limits; }

Result<void> Bench::wait(Seconds duration) {
    auto& s = *state_;
    if (!(duration.count() >= 0 && duration.count() <= 1e7)) {
        return fail(ErrorCode::InvalidArgument, "a wait of {} s; 0 to 10000000 s is expected", duration.count());
    }
    const auto passed = s.advance(s.config.clock->now() + toInstant(duration), [&s] { return s.refusedByHand(); });
    if (!passed) return failure(passed);
    if (*passed) return s.refusal();
    return {};
}

void Bench::idle(Seconds duration) noexcept {
    auto& s = *state_;
    if (!(duration.count() > 0 && duration.count() <= 3600)) return;
    const Instant until = s.config.clock->now() + toInstant(duration);
    constexpr Instant kLook = std::chrono::milliseconds(100);
    while (s.config.clock->now() < until) {
        attend();  // who lets time pass is there
        if (s.virtualClock != nullptr)
            s.turn(until);
        else
            std::this_thread::sleep_for(std::min(kLook, until - s.config.clock->now()));
    }
}

bool Bench::canCaptureUntriggered() const noexcept { return state_->scope && state_->scope->canForce(); }

Result<void> Bench::requestCaptures(int trains, const ScopeSettings& settings,
                                    std::optional<Seconds> untriggeredAfter) {
    auto& s = *state_;
    if (!s.scope) return fail(ErrorCode::Unsupported, "no oscilloscope is open to capture with");
    if (trains < 1 || trains > static_cast<int>(ScopeSession::kMaxCaptures)) {
        return fail(ErrorCode::InvalidArgument, "{} captures; 1 to {} are expected", trains,
                    ScopeSession::kMaxCaptures);
    }
    std::optional<Instant> forceAfter;
    if (untriggeredAfter) {
        if (!s.scope->canForce()) {
            return fail(ErrorCode::Unsupported, "this oscilloscope takes no record without a trigger");
        }
        if (!(untriggeredAfter->count() > 0 && untriggeredAfter->count() <= 3600)) {
            return fail(ErrorCode::InvalidArgument, "an untriggered record after {} s; above 0 to 3600 s is expected",
                        untriggeredAfter->count());
        }
        forceAfter = toInstant(*untriggeredAfter);
    }
    s.scope->request(settings, s.config.clock->now(), static_cast<std::size_t>(trains), forceAfter);
    return {};
}

Result<std::vector<Capture>> Bench::takeCaptures() {
    if (!state_->scope) return std::vector<Capture>{};
    return state_->scope->take();
}

void Bench::cancelCaptures() noexcept {
    auto& s = *state_;
    if (!s.scope) return;
    s.scope->cancel();
    if (s.virtualClock != nullptr) s.scope->serve(s.config.clock->now());
}

Result<std::vector<Capture>> Bench::capture(int trains, const ScopeSettings& settings) {
    auto& s = *state_;
    if (const auto requested = requestCaptures(trains, settings); !requested) return failure(requested);
    const auto wanted = static_cast<std::size_t>(trains);
    const Instant longest = toInstant(s.config.profile.encoding.intervalMax) * (trains + 1) + kCaptureGrace;
    const auto refusalsBefore = s.loop->refusals();
    bool refused = false;
    const auto passed = s.advance(s.config.clock->now() + longest, [&] {
        refused = s.refusedByHand();
        return refused || s.scope->failed() || s.scope->ready() >= wanted;
    });
    auto taken = takeCaptures();
    cancelCaptures();
    if (!passed) return failure(passed);
    if (!taken) return taken;
    if (refused) return failure(s.refusal());
    if (taken->size() < wanted) {
        // The cause, not its consequence: a train that a limit refuses triggers nothing.
        if (s.loop->refusals() != refusalsBefore) return failure(s.refusal());
        return fail(ErrorCode::Timeout, "the oscilloscope was triggered {} times in {:.1f} s; {} were expected",
                    taken->size(), toSeconds(longest), trains);
    }
    taken->resize(wanted);
    return taken;
}

void Bench::listen(BenchTap* tap) { state_->loop->listen(tap); }
bool Bench::sensorFinished() const noexcept { return state_->sensor && state_->sensor->finished(); }

WorstExposure Bench::worstExposure() const noexcept { return state_->loop->worstExposure(); }

Telemetry Bench::telemetry() const {
    auto seen = state_->loop->telemetry();
    seen.state = state_->interlock.state();  // a stop shows before the loop's next step
    seen.uncalibratedStimulator = state_->stimulator && !state_->hasCalibration();
    if (seen.state == InterlockState::Faulted) seen.reason = FixedText<200>(state_->interlock.reason().view());
    return seen;
}
std::optional<DeviceReport> Bench::deviceReport(Role role) const noexcept {
    const auto* reporting = state_->reportingDevice(role);
    return reporting != nullptr ? std::optional(reporting->deviceReport()) : std::nullopt;
}
DeviceSet& Bench::devices() noexcept { return state_->config.devices; }
std::uint64_t Bench::faults() const noexcept { return state_->loop->faults(); }
OutputMode Bench::mode() const noexcept { return state_->config.mode; }
const Clock& Bench::clock() const noexcept { return *state_->config.clock; }

void Bench::onProgress(void (*callback)(void* context), void* context) noexcept {
    state_->progress = callback;
    state_->progressContext = context;
}

}  // namespace tacto
