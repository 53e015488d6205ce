#include "core/bench/Bench.h"

#include <cmath>
#include <nlohmann/json.hpp>
#include <utility>

#include "core/bench/BenchState.h"
#include "core/bench/arming/CheckCapture.h"

namespace tacto {

namespace {

constexpr Seconds kArmTimeout{2};
constexpr Instant kCaptureGrace = std::chrono::seconds(1);
constexpr Instant kPresentedGrace = std::chrono::seconds(1);
constexpr Instant kPresentedPoll = std::chrono::milliseconds(1);

}  // namespace

Result<std::unique_ptr<Bench>> Bench::create(BenchConfig config) {
    auto state = std::make_unique<State>(std::move(config));
    if (const auto opened = state->open(); !opened) return failure(opened);
    return std::unique_ptr<Bench>(new Bench(std::move(state)));
}

Bench::Bench(std::unique_ptr<State> state) : state_(std::move(state)) {}
Bench::~Bench() = default;

void Bench::disarm() noexcept {
    state_->off("disarmed");
    if (state_->time.isVirtual()) state_->loop->noteState(state_->time.now());
}

void Bench::stop(const char* by) noexcept {
    state_->order.stops().raise();  // first: see TrainDispatch::mayPost()
    state_->off(by);
    state_->order.wakeWaiting();
}

Result<void> Bench::begin(StopMark asked) {
    auto& s = *state_;
    if (s.order.stops().movedSince(asked)) {
        return fail(ErrorCode::Stopped, "stopped before this was begun. Output is off.");
    }
    s.loop->beginOrder();
    attend();
    s.order.begin(asked);
    return {};
}

void Bench::attend(Seconds within) noexcept { state_->attend(within); }

std::uint64_t Bench::recordsLost() const noexcept { return state_->recorder ? state_->recorder->dropped() : 0; }

StopCounter& Bench::stops() noexcept { return state_->order.stops(); }

void Bench::pause() noexcept {
    state_->order.pause();
    state_->loop->pauseOutput(true);
    // The interlock refuses a pause unless it is Delivering. The error is ignored: the pause flags above hold anyway.
    static_cast<void>(state_->interlock.pause());
    state_->gate.latchStop();  // a train already handed over is not put out after the pause
}

void Bench::resume() noexcept {
    static_cast<void>(state_->interlock.resume());  // refused unless Paused; then there is no pause to end
    state_->loop->pauseOutput(false);
    state_->order.resume();
}

GateSetup Bench::setupFor(const Load& load) const { return state_->terms.setupFor(load); }
std::string Bench::armingText(const Load& load) const { return state_->terms.text(load); }
bool Bench::outputIsReal() const noexcept { return state_->output.isReal(); }

Result<void> Bench::arm(const ArmRequest& request) {
    auto& s = *state_;
    if (!s.output.isOpen()) return fail(ErrorCode::Unsupported, "not armed: no stimulator and no massager is open");
    const auto load = parseLoad(request.load);
    if (!load) return failure(load);
    if (const auto confirmed = s.terms.checkConfirmed(request, *load); !confirmed) return confirmed;
    if (const auto well = s.health(); !well) return well;
    if (const auto holds = s.calibration.checkDate(); !holds) return holds;
    auto fits = s.fitBoard(*load);
    if (!fits && (s.driving == DriveSource::Sensor || s.config.mode == OutputMode::Person))
        return fail(fits.error().code, "not armed: {}", fits.error().message);
    const auto command = s.terms.commandFor(request, *load, s.order.asked());
    // If the operator has not confirmed the load, arming is refused and no pulse is sent, so no capture is needed.
    std::optional<CheckCapture> look;
    if (command.confirmByCapture && command.evidence.declaredLoadConfirmed) {
        look.emplace(*s.scope, s.time, *s.loop, command);
    }
    if (const auto rested = s.rest(); !rested) return rested;
    const auto ticket = s.interlock.requestArming(s.time.now());
    if (!ticket) return failure(ticket);
    s.boardFits = std::move(fits);
    if (look) {
        if (const auto looking = look->begin(); !looking) {
            cancelCaptures();
            return looking;
        }
    }
    if (const auto confirmed = s.interlock.confirmArming(*ticket, s.time.now()); !confirmed) {
        if (look) cancelCaptures();
        return confirmed;
    }
    if (const auto noted = s.notes.arming(request, command.setup, s.config.profile); !noted) {
        cancelCaptures();
        disarm();
        return noted;
    }
    s.loop->arm(command);
    const Seconds within = look ? CheckCapture::kTimeout : kArmTimeout;
    std::optional<Result<void>> outcome;
    bool passedOn = !look;
    const auto finished = s.time.advance(s.time.now() + toInstant(within), [&] {
        if (!passedOn) passedOn = look->passOn();
        outcome = s.loop->armed();
        return outcome.has_value();
    });
    if (look) cancelCaptures();
    if (outcome) return *outcome;
    // A fault ends arming, and health() sees the fault first. If arming gave its own reason, return that reason.
    if (auto late = s.loop->armed()) return *late;
    disarm();
    if (!finished) return failure(finished);
    if (!passedOn) {
        return fail(ErrorCode::NotArmed,
                    "not armed: the check pulse is not confirmed: the oscilloscope showed nothing within {} s",
                    within.count());
    }
    return fail(ErrorCode::Timeout, "not armed: the impedance check did not end within {} s", within.count());
}

Result<std::optional<Ohms>> Bench::checkImpedance(const ArmRequest& request) {
    static_cast<void>(drive(DriveSource::Off));  // driving with Off never fails
    const auto armed = arm(request);
    const double ohms = telemetry().impedance_ohm;
    disarm();
    if (!armed) return failure(armed);
    return std::isfinite(ohms) ? std::optional(Ohms(ohms)) : std::nullopt;
}

Result<void> Bench::resetFault(std::optional<std::uint64_t> known, ResetBy by) { return state_->leaveFault(known, by); }
std::optional<UnitFault> Bench::unitFault() const noexcept { return state_->interlock.unitFault(); }

bool Bench::faultPersists(FaultCause cause) const noexcept { return state_->interlock.causePersists(cause); }
ErrorCode Bench::faultCode() const noexcept { return state_->interlock.faultCode(); }

Result<void> Bench::withholdHeartbeat(Seconds duration) {
    auto& s = *state_;
    if (s.config.mode != OutputMode::BenchLoad) {
        return fail(ErrorCode::Unsupported, "the heartbeat is withheld on bench loads only, never in {} mode",
                    nameOf(s.config.mode));
    }
    if (!(duration.count() > 0 && duration.count() <= 10)) {
        return invalid("a silence of {} s; above 0 to 10 s is expected", duration.count());
    }
    s.time.withholdLoop(s.time.now() + toInstant(duration));
    if (s.order.stopped()) return fail(ErrorCode::Stopped, "stopped. Output is off.");
    return {};
}

std::optional<Seconds> Bench::silencedAfter() const noexcept {
    const auto* stimulator = state_->output.stimulator();
    if (stimulator == nullptr || stimulator->silencedAfter() == Instant(0)) return std::nullopt;
    return Seconds(stimulator->silencedAfter());
}

bool Bench::markMoment(Instant at, std::string word) {
    if (!state_->recorder || state_->recorder->failed()) return false;
    state_->recorder->mark(at, std::move(word));
    return true;
}

Result<void> Bench::drive(DriveSource source, double roughness, double pressure) {
    auto& s = *state_;
    if (source != DriveSource::Off && s.order.stopped()) return fail(ErrorCode::Stopped, "stopped. Output is off.");
    if (source == DriveSource::Sensor && !s.sensor) {
        return fail(ErrorCode::Unsupported, "no fingertip sensor is open to drive the output");
    }
    if (source == DriveSource::Sensor && s.isArmed() && !s.boardFits)
        return fail(s.boardFits.error().code, "the fingertip does not drive: {}", s.boardFits.error().message);
    if (source == DriveSource::Manual) {
        for (const auto& [name, value] : {std::pair("R", roughness), std::pair("P", pressure)}) {
            if (!(value >= 0 && value <= 1)) {
                return invalid("{} is {}; 0 to 1 is expected", name, value);
            }
        }
    }
    attend();
    s.driving.store(source, std::memory_order_release);
    s.refusalsSeen = s.loop->refusals();
    s.loop->drive({source, roughness, pressure});
    // After a stop in between, the loop drives nothing: drop the new command, so that no later arming uses it.
    if (source != DriveSource::Off && s.order.stopped()) {
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
    const bool armed = s.isArmed();
    auto withSameRoughness = profile;
    withSameRoughness.roughness = s.config.profile.roughness;
    if (armed && toJson(withSameRoughness) != toJson(s.config.profile)) {
        return fail(ErrorCode::NotArmed,
                    "the encoding and the limits of the profile cannot change while {}: disarm first", nameOf(state));
    }
    if (armed && s.terms.boardDrives() && toJson(profile) != toJson(s.config.profile)) {
        return fail(ErrorCode::NotArmed,
                    "the profile cannot change while {} and the fingertip's board encodes: disarm first",
                    nameOf(state));
    }
    auto finger = s.makeFinger(profile);
    if (!finger) return failure(finger);
    if (const auto noted = s.notes.profile(s.config.profile, profile); !noted) return noted;
    if (s.config.profile.roughness == profile.roughness) before = RBefore::Measuring;  // nothing new to flag
    s.config.profile = profile;
    if (*finger) s.loop->replaceFinger(std::move(*finger), before);
    if (!armed) s.loop->replacePlanner(s.makePlanner(profile));
    return {};
}

const KnownLines& Bench::calibration() const noexcept { return state_->calibration.applied(); }

Result<void> Bench::useCalibration(bool use) {
    auto& s = *state_;
    const auto state = s.interlock.state();
    if (state != InterlockState::Disarmed && state != InterlockState::Disconnected) {
        return fail(ErrorCode::NotArmed, "the calibration cannot change while {}: disarm first", nameOf(state));
    }
    if (!s.calibration.apply(use)) return {};
    s.loop->replacePlanner(s.makePlanner(s.config.profile));
    s.calibration.note(s.notes);
    return {};
}

const Profile& Bench::profile() const noexcept { return state_->config.profile; }
const std::vector<LimitSet>& Bench::limits() const noexcept { return state_->config.limits; }

Result<void> Bench::wait(Seconds duration) {
    auto& s = *state_;
    if (!(duration.count() >= 0 && duration.count() <= 1e7)) {
        return invalid("a wait of {} s; 0 to 10000000 s is expected", duration.count());
    }
    const auto passed = s.time.advance(s.time.now() + toInstant(duration), [&s] { return s.refusedByHand(); });
    if (!passed) return failure(passed);
    if (*passed) return s.refusal();
    return {};
}

Result<Presented> Bench::present(const Presentation& presentation,
                                 const std::function<void(Seconds since, Instant began)>& passing) {
    auto& s = *state_;
    if (const auto valid = validate(presentation); !valid) return failure(valid);
    for (std::size_t train = 0; train < presentation.onsets.size(); ++train) {
        const auto settable = s.levels.checkSettable(presentation.levelOf(train));
        if (!settable) return failure(settable);
    }
    const Instant now = s.time.now();
    if (!(presentation.notBefore <= now + toInstant(Presentation::kLongest))) {
        return invalid("a presentation that begins in {:.3g} s; at most {} s is accepted",
                       toSeconds(presentation.notBefore - now), Presentation::kLongest.count());
    }
    if (const auto ready = s.readyToPresent(); !ready) return failure(ready);
    s.loop->present(presentation);
    std::optional<Presented> ended;
    const auto isOver = [&] {
        ended = s.loop->presented();
        if (ended) return true;
        const auto began = passing ? s.loop->presentationBegan() : std::nullopt;
        if (const Instant at = s.time.now(); began && at >= *began) passing(Seconds(at - *began), *began);
        return false;
    };
    const Instant until = std::max(now, presentation.notBefore) + toInstant(presentation.duration);
    const auto passed = s.time.advance(until + kPresentedGrace, isOver);
    // A stop or a fault ends the wait early: the loop then still reports what was delivered until then.
    for (const Instant last = s.time.now() + kPresentedGrace; !ended && !isOver() && s.time.now() < last;)
        s.time.pass(last, kPresentedPoll);
    if (!ended) {
        disarm();
        if (!passed) return failure(passed);
        return fail(ErrorCode::Timeout, "the presentation did not end within {:.3g} s", toSeconds(s.time.now() - now));
    }
    s.levels.presented(presentation.level, *ended);
    if (const double ohm = telemetry().impedance_ohm; !ended->impedance && ohm > 0) ended->impedance = Ohms(ohm);
    if (!passed && passed.error().code == ErrorCode::Io) return failure(passed);
    return std::move(*ended);
}

Result<void> Bench::accept(const StimulusLevel& level) { return state_->levels.accept(level); }
Result<void> Bench::reportDiscomfort(const StimulusLevel& level) { return state_->levels.reportDiscomfort(level); }
Result<void> Bench::beginAscending() { return state_->levels.ascend(true); }
Result<void> Bench::endAscending() { return state_->levels.ascend(false); }
Result<StimulusLevel> Bench::levelCeiling() { return state_->levels.ceiling(); }
Result<PermittedLevel> Bench::levelLimit(Seconds interval) const { return state_->levels.limit(interval); }

void Bench::idle(Seconds duration) noexcept {
    auto& s = *state_;
    if (!(duration.count() > 0 && duration.count() <= 3600)) return;
    const Instant until = s.time.now() + toInstant(duration);
    constexpr Instant kPollInterval = std::chrono::milliseconds(100);
    while (s.time.now() < until) {
        attend();  // a caller that lets time pass is looking after the output
        s.time.pass(until, kPollInterval);
    }
}

bool Bench::canCaptureUntriggered() const noexcept { return state_->scope && state_->scope->canForce(); }

Result<void> Bench::requestCaptures(int trains, const ScopeSettings& settings,
                                    std::optional<Seconds> untriggeredAfter) {
    auto& s = *state_;
    if (!s.scope) return fail(ErrorCode::Unsupported, "no oscilloscope is open to capture with");
    if (trains < 1 || trains > static_cast<int>(ScopeSession::kMaxCaptures)) {
        return invalid("{} captures; 1 to {} are expected", trains, ScopeSession::kMaxCaptures);
    }
    std::optional<Instant> forceAfter;
    if (untriggeredAfter) {
        if (!s.scope->canForce()) {
            return fail(ErrorCode::Unsupported, "this oscilloscope takes no record without a trigger");
        }
        if (!(untriggeredAfter->count() > 0 && untriggeredAfter->count() <= 3600)) {
            return invalid("an untriggered record after {} s; above 0 to 3600 s is expected",
                           untriggeredAfter->count());
        }
        forceAfter = toInstant(*untriggeredAfter);
    }
    s.scope->request(settings, s.time.now(), static_cast<std::size_t>(trains), forceAfter);
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
    if (s.time.isVirtual()) s.scope->serve(s.time.now());
}

Result<std::vector<Capture>> Bench::capture(int trains, const ScopeSettings& settings) {
    auto& s = *state_;
    if (const auto requested = requestCaptures(trains, settings); !requested) return failure(requested);
    const auto wanted = static_cast<std::size_t>(trains);
    const Instant longest = toInstant(s.config.profile.encoding.intervalMax) * (trains + 1) + kCaptureGrace;
    const auto refusalsBefore = s.loop->refusals();
    bool refused = false;
    const auto passed = s.time.advance(s.time.now() + longest, [&] {
        refused = s.refusedByHand();
        return refused || s.scope->failed() || s.scope->ready() >= wanted;
    });
    auto taken = takeCaptures();
    cancelCaptures();
    if (!passed) return failure(passed);
    if (!taken) return taken;
    if (refused) return failure(s.refusal());
    if (taken->size() < wanted) {
        // Report the cause, not the effect: a train that a limit refuses triggers nothing.
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
    seen.state = state_->interlock.state();  // so that a stop shows before the loop's next step
    seen.uncalibratedStimulator = state_->output.stimulator() != nullptr && !state_->calibration.held();
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
    state_->time.onProgress(callback, context);
}

}  // namespace tacto
