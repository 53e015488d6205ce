#include "core/bench/Bench.h"

#include <algorithm>
#include <condition_variable>
#include <mutex>
#include <thread>
#include <utility>

#include "core/bench/DeviceThread.h"
#include "core/bench/MassagerSession.h"
#include "core/bench/ReportRecord.h"
#include "core/bench/ScopeSession.h"
#include "core/session/SessionWriter.h"

namespace tacto {

namespace {

constexpr Seconds kArmWithin{2};
constexpr Instant kCaptureGrace = std::chrono::seconds(1);

SourceTraits traitsOf(const DeviceSet& devices) {
    if (devices.stimulator) return devices.stimulator->traits();
    SourceTraits none;  // encodes for display; nothing is delivered without a stimulator
    none.amplitudeMax = 1000;
    none.compliance = Volts(1000);
    return none;
}

}  // namespace

struct Bench::State {
    BenchConfig config;
    VirtualClock* virtualClock = nullptr;  // null on the steady clock
    SourceTraits source;
    std::optional<AmplitudeCalibration> applied;  // config.calibration, or nothing while it is left aside
    SafetyGate gate;
    Interlock interlock;
    Heartbeat heartbeat;
    std::unique_ptr<SessionRecorder> recorder;
    std::unique_ptr<StimulatorSession> stimulator;
    std::unique_ptr<MassagerSession> massager;  // only without a stimulator: one output at a time
    std::unique_ptr<SensorSession> sensor;
    std::unique_ptr<ScopeSession> scope;
    std::unique_ptr<ControlLoop> loop;

    std::atomic<bool> stopped{false};
    std::atomic<bool> paused{false};
    std::mutex waitMutex;
    std::condition_variable waitChanged;  // a stop, a pause or its end
    void (*progress)(void*) = nullptr;
    void* progressContext = nullptr;
    std::atomic<DriveSource> driving{DriveSource::Off};
    std::atomic<bool> heartbeatWithheld{false};  // steady clock: the loop's thread does nothing
    std::uint64_t refusalsSeen = 0;              // by the caller of drive(), wait() and capture()

    // Virtual clock only:
    Instant nextTick{0};
    Instant outputDue{0};

    // Steady clock only. Last: they end first.
    std::unique_ptr<DeviceThread> outputThread, sensorThread, scopeThread, loopThread;

    explicit State(BenchConfig given)
        : config(std::move(given)),
          virtualClock(dynamic_cast<VirtualClock*>(config.clock.get())),
          source(traitsOf(config.devices)),
          applied(config.calibrationHolds ? config.calibration : std::nullopt),
          gate(*config.clock) {}

    ~State() {
        off("the bench closes");
        loopThread.reset();
        heartbeat.end();
        off("the bench closes");  // whatever the loop's last step may have handed over
        scopeThread.reset();
        sensorThread.reset();
        outputThread.reset();
        outputsOff();
        if (loop) loop->noteState(config.clock->now());
        if (recorder && stimulator && stimulator->longestKeepAliveGap() > Instant(0)) {
            recorder->event(config.clock->now(), "keep-alive",
                            {{"longest_gap_s", toSeconds(stimulator->longestKeepAliveGap())}},
                            "the longest time between two keep-alives of the stimulator's dead-man switch");
        }
        if (const auto* reporting = recorder ? reportingDevice(Role::Sensor) : nullptr) {
            recordReport(*recorder, config.clock->now(), reporting->deviceReport(),
                         "what the fingertip sensor and its line were like, when the bench closed");
        }
        recorder.reset();
    }

    [[nodiscard]] const ReportingDevice* reportingDevice(Role role) const noexcept {
        const auto& devices = config.devices;
        const Device* device = role == Role::Sensor         ? static_cast<const Device*>(devices.sensor.get())
                               : role == Role::Stimulator   ? static_cast<const Device*>(devices.stimulator.get())
                               : role == Role::Oscilloscope ? static_cast<const Device*>(devices.oscilloscope.get())
                                                            : static_cast<const Device*>(devices.massager.get());
        return dynamic_cast<const ReportingDevice*>(device);
    }

    void outputsOff() noexcept {
        if (stimulator) stimulator->forceOff();
        if (massager)
            massager->forceOff();
        else if (config.devices.massager)
            config.devices.massager->forceOff();
    }
    /// Virtual clock: whichever output there is.
    Instant serveOutput(Instant now) noexcept { return stimulator ? stimulator->serve(now) : massager->serve(now); }
    [[nodiscard]] bool hasOutput() const noexcept { return stimulator || massager; }
    [[nodiscard]] bool outputBusy() const noexcept {
        return (stimulator && !stimulator->idle()) || (massager && !massager->idle());
    }

    /// Disarmed first: see ControlLoop::mayPost().
    void off(const char* why) noexcept {
        interlock.disarm(why);
        gate.latchStop();
        outputsOff();
        if (loop) loop->drive({});
        driving.store(DriveSource::Off, std::memory_order_release);
    }

    [[nodiscard]] Result<std::unique_ptr<FingerInput>> makeFinger(const Profile& profile) {
        if (!sensor) return std::unique_ptr<FingerInput>();
        return FingerInput::create(*sensor, profile.roughness);
    }
    [[nodiscard]] std::unique_ptr<TrainPlanner> makePlanner(const Profile& profile) {
        return std::make_unique<TrainPlanner>(profile.encoding, source, gate, applied);
    }

    [[nodiscard]] Result<void> open();
    void startThreads();
    void turn(Instant until) noexcept;
    void letReportsBeJudged() noexcept;
    template <class Done>
    [[nodiscard]] Result<bool> advance(Instant until, Done done);
    [[nodiscard]] Result<void> health() const;
    template <class Session>
    [[nodiscard]] Result<void> askAgain(Session& session, DeviceThread* thread, Instant within, const char* who);
    /// A train driven by hand was refused since the caller last heard of one.
    [[nodiscard]] bool refusedByHand() const noexcept {
        return driving.load(std::memory_order_acquire) == DriveSource::Manual && loop->refusals() != refusalsSeen;
    }
    [[nodiscard]] Result<void> refusal() {
        refusalsSeen = loop->refusals();
        return fail(ErrorCode::LimitExceeded, "{}", loop->telemetry().lastRefusal.view());
    }
    void noteCalibration();
    [[nodiscard]] GateSetup setupFor(const Load& load) const;
    [[nodiscard]] ArmCommand armCommandFor(const ArmRequest& request, const Load& load) const;
};

Result<void> Bench::State::open() {
    if (const auto valid = validate(config.profile.encoding); !valid) return valid;
    if (config.devices.sensor) {
        auto made = SensorSession::create(*config.devices.sensor);
        if (!made) return failure(made);
        sensor = std::move(*made);
    }
    auto finger = makeFinger(config.profile);
    if (!finger) return failure(finger);

    ControlLoop::Parts parts{*config.clock, gate,    interlock, heartbeat, config.mode,
                             nullptr,       nullptr, 0,         {},        config.tap};
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
    if (config.devices.oscilloscope) scope = std::make_unique<ScopeSession>(*config.devices.oscilloscope);
    parts.sensorReport = reportingDevice(Role::Sensor);
    loop = std::make_unique<ControlLoop>(std::move(parts), std::move(*finger), makePlanner(config.profile));
    if (const auto connected = interlock.connect(); !connected) return connected;
    nextTick = outputDue = config.clock->now();
    noteCalibration();
    if (virtualClock == nullptr) startThreads();
    return {};
}

void Bench::State::noteCalibration() {
    if (!recorder || config.calibrationText.empty()) return;
    const AmplitudeCalibration told = applied.value_or(AmplitudeCalibration{});
    recorder->event(config.clock->now(), "calibration", {{"gain", told.gain}, {"offset", told.offset}},
                    config.calibration && config.calibrationHolds && !applied
                        ? "left aside: the stimulator is told the commands as they are"
                        : std::string_view(config.calibrationText));
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
    if (stopped.load(std::memory_order_acquire)) return fail(ErrorCode::Stopped, "stopped. Output is off.");
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

/// Lets time pass until `done()` or `until`; the value says whether it was done. Errors: as health().
template <class Done>
Result<bool> Bench::State::advance(Instant until, Done done) {
    constexpr Instant kLook = std::chrono::milliseconds(2);
    for (std::uint64_t turns = 0;; ++turns) {
        if (const auto well = health(); !well) return failure(well);
        if (done()) return true;
        if (config.clock->now() >= until) return false;
        if (progress != nullptr && turns % 64 == 0) progress(progressContext);
        if (virtualClock != nullptr) {
            std::unique_lock lock(waitMutex);
            waitChanged.wait(lock, [this] { return !paused || stopped; });
            lock.unlock();
            turn(until);
        } else {
            std::unique_lock lock(waitMutex);
            waitChanged.wait_for(lock, std::min(kLook, until - config.clock->now()), [this] { return stopped.load(); });
        }
    }
}

GateSetup Bench::State::setupFor(const Load& load) const {
    GateSetup setup;
    setup.mode = config.mode;
    setup.source = source;
    setup.load = config.mode == OutputMode::BenchLoad
                     ? LoadRange::declared(load)
                     : LoadRange::between(config.profile.loadLow, config.profile.loadHigh);
    setup.limits = config.limits;
    setup.ceilings = config.profile.ceilings;
    setup.electrodeArea = config.profile.electrodeArea;
    setup.check = config.profile.encoding.train;
    setup.check.pulses = 1;
    setup.person = config.person;
    setup.calibration = config.calibration;
    setup.calibrated = applied.has_value();
    return setup;
}

ArmCommand Bench::State::armCommandFor(const ArmRequest& request, const Load& load) const {
    ArmCommand command;
    command.setup = setupFor(load);
    // |Z| depends on the pulse: the range is that of the check pulse on the two ends of the load range.
    PulseTrain check = command.setup.check;
    if (source.drive == Drive::Current)
        check.amplitude = source.checkCurrent;
    else
        check.amplitude = source.checkVoltage;
    const auto leading = segmentsOf(check, source.gap).items[0];
    auto& evidence = command.evidence;
    evidence.limitsLoaded = !config.limits.empty();
    const Device* output = config.devices.stimulator.get();
    if (output == nullptr) output = config.devices.massager.get();
    evidence.deviceIdentified = output != nullptr && !output->identity().name.empty();
    evidence.operatorConfirmed = request.operatorConfirmed;
    evidence.needsImpedance = config.devices.stimulator != nullptr;
    evidence.readsBack = source.readsBack;
    evidence.impedanceLow = effectiveImpedance(command.setup.load.min, leading);
    evidence.impedanceHigh = effectiveImpedance(command.setup.load.max, leading);
    evidence.declaredLoadConfirmed = request.declaredLoadConfirmed && config.mode == OutputMode::BenchLoad;
    return command;
}

Result<std::unique_ptr<Bench>> Bench::create(BenchConfig config) {
    auto state = std::make_unique<State>(std::move(config));
    if (const auto opened = state->open(); !opened) return failure(opened);
    return std::unique_ptr<Bench>(new Bench(std::move(state)));
}

Bench::Bench(std::unique_ptr<State> state) : state_(std::move(state)) {}
Bench::~Bench() = default;

Result<void> Bench::arm(const ArmRequest& request) {
    auto& s = *state_;
    if (!s.hasOutput()) return fail(ErrorCode::Unsupported, "not armed: no stimulator and no massager is open");
    const auto load = parseLoad(request.load);
    if (!load) return failure(load);
    if (const auto well = s.health(); !well) return well;
    const auto ticket = s.interlock.requestArming(s.config.clock->now());
    if (!ticket) return failure(ticket);
    if (const auto confirmed = s.interlock.confirmArming(*ticket, s.config.clock->now()); !confirmed) return confirmed;
    s.loop->arm(s.armCommandFor(request, *load));
    std::optional<Result<void>> outcome;
    const auto finished = s.advance(s.config.clock->now() + toInstant(kArmWithin), [&] {
        outcome = s.loop->armed();
        return outcome.has_value();
    });
    if (outcome) return *outcome;
    // A fault ends arming and health() sees it first: say why in arming's own words if it has any.
    if (auto late = s.loop->armed()) return *late;
    disarm();
    if (!finished) return failure(finished);
    return fail(ErrorCode::Timeout, "not armed: the impedance check did not end within {} s", kArmWithin.count());
}

void Bench::disarm() noexcept {
    state_->off("disarmed");
    if (state_->virtualClock != nullptr) state_->loop->noteState(state_->config.clock->now());
}

void Bench::stop(const char* by) noexcept {
    state_->stopped.store(true, std::memory_order_release);
    state_->off(by);
    { const std::scoped_lock lock(state_->waitMutex); }
    state_->waitChanged.notify_all();
}

void Bench::clearStop() noexcept {
    resume();  // a pause from before the stop is over too
    state_->stopped.store(false, std::memory_order_release);
}

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

/// Asks one device's session how its device is, and waits for the answer.
template <class Session>
Result<void> Bench::State::askAgain(Session& session, DeviceThread* thread, Instant within, const char* who) {
    static_cast<void>(session.health());  // an old answer
    session.askHealth();
    std::optional<Result<void>> answer;
    const Instant until = config.clock->now() + within;
    while (!(answer = session.health()) && config.clock->now() < until) {
        if (virtualClock != nullptr) {
            session.serve(config.clock->now());
        } else {
            thread->wake();
            std::this_thread::sleep_for(std::chrono::milliseconds(1));
        }
    }
    if (!answer) return fail(ErrorCode::NotArmed, "the fault is still there: the {} does not answer", who);
    if (!*answer) return fail(ErrorCode::NotArmed, "the fault is still there: {}", answer->error().message);
    return {};
}

/// What a device's session reported while the device was gone (a keep-alive that failed) belongs to the fault that is
/// being left; judged after the reset it would be the next one.
void Bench::State::letReportsBeJudged() noexcept {
    constexpr std::uint64_t kSteps = 2;  // one may be under way
    constexpr Instant kWithin = std::chrono::milliseconds(500);
    const auto begin = loop->telemetry().steps;
    const Instant until = config.clock->now() + kWithin;
    while (loop->telemetry().steps < begin + kSteps && config.clock->now() < until) {
        if (virtualClock != nullptr)
            turn(until);
        else
            std::this_thread::sleep_for(std::chrono::milliseconds(1));
    }
}

Result<void> Bench::resetFault() {
    auto& s = *state_;
    if (s.interlock.state() != InterlockState::Faulted) return {};
    // Looked at again: a device that answers and delivers nothing is well; what its load is, the next check tells.
    if (s.stimulator) {
        constexpr Instant kAnswerWithin = std::chrono::milliseconds(500);
        const auto well = s.askAgain(*s.stimulator, s.outputThread.get(), kAnswerWithin, "stimulator");
        if (!well) return well;
    }
    if (s.sensor) {
        constexpr Instant kOpenWithin = std::chrono::seconds(3);
        if (const auto well = s.askAgain(*s.sensor, s.sensorThread.get(), kOpenWithin, "fingertip sensor"); !well)
            return well;
    }
    s.letReportsBeJudged();
    for (int cause = 0; cause < kFaultCauseCount; ++cause) s.interlock.causeGone(static_cast<FaultCause>(cause));
    return s.interlock.reset();
}

bool Bench::faultPersists(FaultCause cause) const noexcept { return state_->interlock.causePersists(cause); }

Result<void> Bench::withholdHeartbeat(Seconds duration) {
    auto& s = *state_;
    if (s.config.mode != OutputMode::BenchLoad) {
        return fail(ErrorCode::Unsupported, "the heartbeat is withheld on bench loads only, never in {} mode",
                    nameOf(s.config.mode));
    }
    if (!(duration.count() > 0 && duration.count() <= 10)) {
        return fail(ErrorCode::InvalidArgument, "a silence of {} s; above 0 to 10 s is expected", duration.count());
    }
    const Instant until = s.config.clock->now() + toInstant(duration);
    if (s.virtualClock != nullptr) {
        while (!s.stopped && s.config.clock->now() < until) {
            // The output alone is served, as its own thread would do while the loop hangs.
            s.virtualClock->advanceTo(s.hasOutput() ? std::min(until, s.outputDue) : until);
            const Instant now = s.config.clock->now();
            if (s.hasOutput() && now >= s.outputDue) s.outputDue = s.serveOutput(now);
            if (s.scope && s.scope->active()) s.scope->serve(now);
        }
        s.nextTick = s.config.clock->now();
    } else {
        s.heartbeatWithheld.store(true, std::memory_order_release);
        {
            std::unique_lock lock(s.waitMutex);
            s.waitChanged.wait_for(lock, until - s.config.clock->now(), [&s] { return s.stopped.load(); });
        }
        s.heartbeatWithheld.store(false, std::memory_order_release);
    }
    if (s.stopped) return fail(ErrorCode::Stopped, "stopped. Output is off.");
    return {};
}

std::optional<Seconds> Bench::silencedAfter() const noexcept {
    const auto& stimulator = state_->stimulator;
    if (!stimulator || stimulator->silencedAfter() == Instant(0)) return std::nullopt;
    return Seconds(stimulator->silencedAfter());
}

Result<void> Bench::drive(DriveSource source, double roughness, double pressure) {
    auto& s = *state_;
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
    s.driving.store(source, std::memory_order_release);
    s.refusalsSeen = s.loop->refusals();
    s.loop->drive({source, roughness, pressure});
    return {};
}

Result<void> Bench::setProfile(const Profile& profile) {
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
    s.config.profile = profile;
    if (*finger) s.loop->replaceFinger(std::move(*finger));
    if (!armed) s.loop->replacePlanner(s.makePlanner(profile));
    return {};
}

const std::optional<AmplitudeCalibration>& Bench::calibration() const noexcept { return state_->applied; }

Result<void> Bench::useCalibration(bool use) {
    auto& s = *state_;
    const auto state = s.interlock.state();
    if (state != InterlockState::Disarmed && state != InterlockState::Disconnected) {
        return fail(ErrorCode::NotArmed, "the calibration cannot change while {}: disarm first", nameOf(state));
    }
    const auto wanted = use && s.config.calibrationHolds ? s.config.calibration : std::nullopt;
    if (wanted == s.applied) return {};
    s.applied = wanted;
    s.loop->replacePlanner(s.makePlanner(s.config.profile));
    s.noteCalibration();
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
    while (s.config.clock->now() < until) {
        if (s.virtualClock != nullptr)
            s.turn(until);
        else
            std::this_thread::sleep_for(until - s.config.clock->now());
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
        return fail(ErrorCode::Timeout, "the oscilloscope was triggered {} times in {:.1f} s; {} were expected",
                    taken->size(), toSeconds(longest), trains);
    }
    taken->resize(wanted);
    return taken;
}

void Bench::listen(BenchTap* tap) { state_->loop->listen(tap); }
bool Bench::sensorFinished() const noexcept { return state_->sensor && state_->sensor->finished(); }

Telemetry Bench::telemetry() const {
    auto seen = state_->loop->telemetry();
    seen.state = state_->interlock.state();  // a stop shows before the loop's next step
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
