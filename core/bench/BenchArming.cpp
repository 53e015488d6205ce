// Arming, and the ways out of a fault.
#include <algorithm>
#include <cmath>
#include <fmt/chrono.h>
#include <nlohmann/json.hpp>
#include <thread>
#include <utility>

#include "core/bench/ArmingText.h"
#include "core/bench/BenchState.h"
#include "core/devices/ReplayedDevice.h"

namespace tacto {

namespace {

constexpr Seconds kArmWithin{2};
constexpr Seconds kConfirmedWithin{5};  // by an oscilloscope, which may be slow to arm and to read
constexpr double kCheckRecord = 4;      // lengths of the pulse in the record of it

}  // namespace

Result<void> Bench::State::calibrationToday() const {
    if (config.mode != OutputMode::Person || !config.calibratedUntil) return {};
    const auto today = config.today != nullptr
                           ? config.today()
                           : std::chrono::floor<std::chrono::days>(std::chrono::system_clock::now());
    if (today <= *config.calibratedUntil) return {};
    return fail(ErrorCode::NotArmed,
                "the stimulator's calibration ended on {:%Y-%m-%d} and today is {:%Y-%m-%d}; calibrate it again before "
                "a person",
                *config.calibratedUntil, today);
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

GateSetup Bench::setupFor(const Load& load) const { return state_->setupFor(load); }

ArmCommand Bench::State::armCommandFor(const ArmRequest& request, const Load& load) const {
    ArmCommand command;
    command.asked = order.load(std::memory_order_acquire);
    command.setup = setupFor(load);
    // |Z| depends on the pulse: the range is that of the check pulse on the two ends of the load range.
    const auto leading = segmentsOf(checkTrainOf(command.setup), source.gap).items[0];
    auto& evidence = command.evidence;
    evidence.limitsLoaded = !config.limits.empty();
    const Device* output = outputDevice();
    evidence.deviceIdentified = output != nullptr && !output->identity().name.empty();
    evidence.operatorConfirmed = request.operatorConfirmed;
    evidence.needsImpedance = config.devices.stimulator != nullptr;
    evidence.readsBack = source.readsBack;
    evidence.impedanceLow = effectiveImpedance(command.setup.load.min, leading);
    evidence.impedanceHigh = effectiveImpedance(command.setup.load.max, leading);
    // Files show what they always showed: they confirm no pulse.
    const bool sees = scope && dynamic_cast<const ReplayedDevice*>(config.devices.oscilloscope.get()) == nullptr;
    command.confirmByCapture = sees && config.devices.stimulator && !source.readsBack;
    if (sees && !source.readsBack) command.declared = effectiveImpedance(command.setup.load.nominal, leading);
    evidence.declaredLoadConfirmed = request.declaredLoadConfirmed && config.mode == OutputMode::BenchLoad;
    return command;
}

/// Load range, area, limits and calibration that every train of this arming is judged by.
Result<void> Bench::State::noteArming(const ArmRequest& request, const GateSetup& setup) const {
    if (config.session == nullptr) return {};
    auto limits = nlohmann::json::array();
    for (const auto& set : setup.limits) limits.push_back(set.id);
    const auto area = setup.electrodeArea;
    const auto noted =
        config.session->event(config.clock->now(), "arming",
                              {{"load", request.load},
                               {"load_least", setup.load.min.text()},
                               {"load_most", setup.load.max.text()},
                               {"electrode_area_cm2", area ? nlohmann::json(area->value()) : nlohmann::json()},
                               {"limits", limits},
                               {"ceilings", toJson(config.profile).at("safety").at("ceilings")},
                               {"calibrated", setup.calibrated},
                               {"mode", nameOf(setup.mode)},
                               {"confirmed", request.confirmed}});
    if (!noted) return failure(noted);
    return {};
}

std::string Bench::State::armingText(const Load& load) const {
    const Device* output = outputDevice();
    if (output == nullptr) return {};
    const auto* stimulated = config.devices.stimulator ? &source : nullptr;
    return tacto::armingText(output->identity(), stimulated, config.profile, config.mode, load);
}

std::string Bench::armingText(const Load& load) const { return state_->armingText(load); }

bool Bench::outputIsReal() const noexcept {
    const Device* output = state_->outputDevice();
    return output != nullptr && !output->identity().simulated;
}

/// A confirmation of another text is none: a device, profile or area may have changed since it was shown.
Result<void> Bench::State::confirmedAsShown(const ArmRequest& request, const Load& load) const {
    const Device* output = outputDevice();
    const bool mayBeEmpty = output == nullptr || output->identity().simulated;
    if (request.confirmed.empty() && mayBeEmpty) return {};
    const auto text = armingText(load);
    if (request.confirmed == text) return {};
    if (request.confirmed.empty())
        return fail(ErrorCode::NotArmed, "not armed: the operator has not confirmed \"{}\"", text);
    return fail(ErrorCode::NotArmed, "not armed: the operator confirmed \"{}\", and what would be armed is \"{}\"",
                request.confirmed, text);
}

Result<std::optional<Ohms>> Bench::checkImpedance(const ArmRequest& request) {
    static_cast<void>(drive(DriveSource::Off));  // never fails for Off
    const auto armed = arm(request);
    const double ohms = telemetry().impedance_ohm;
    disarm();
    if (!armed) return failure(armed);
    return std::isfinite(ohms) ? std::optional(Ohms(ohms)) : std::nullopt;
}

/// Arms the oscilloscope for the check pulse of a source that does not read back, and waits until it takes a trigger.
Result<void> Bench::State::lookAtCheck(const ArmCommand& command) {
    const PulseTrain check = checkTrainOf(command.setup);
    const double ohm = command.declared.value_or(Ohms(1000)).value();
    const double volts = siValue(check.amplitude) * (isCurrent(check.amplitude) ? ohm : 1);
    const auto& traits = config.devices.oscilloscope->traits();
    ScopeSettings settings;
    settings.sampleRate = std::min(settings.sampleRate, traits.maxRate);
    const double wanted = std::ceil(kCheckRecord * check.pulseDuration().count() * settings.sampleRate.value());
    settings.samples = std::clamp<std::size_t>(static_cast<std::size_t>(wanted), 1, traits.memoryDepth);
    settings.preTrigger = 0.3;
    settings.triggerLevel = 0.3 * volts;
    settings.voltageRange = Volts(2 * volts);
    settings.currentRange = Milliamps(4e3 * volts / ohm);  // a load far below the declared one is shown too
    scope->request(settings, config.clock->now(), 1);
    const auto waiting = advance(config.clock->now() + toInstant(kConfirmedWithin),
                                 [this] { return scope->waiting() || scope->failed(); });
    if (!waiting) return failure(waiting);
    if (const auto taken = scope->take(); !taken) {
        return fail(ErrorCode::NotArmed, "not armed: the oscilloscope that confirms the check pulse failed: {}",
                    taken.error().message);
    }
    if (*waiting) return {};
    return fail(ErrorCode::NotArmed, "not armed: the oscilloscope that confirms the check pulse is not ready");
}

bool Bench::State::passOnCheck(const PulseTrain& check) {
    if (scope->ready() == 0 && !scope->failed()) return false;
    const auto taken = scope->take();
    loop->confirmCheck(taken ? loadConfirmedBy(taken->front(), check) : Result<Ohms>(failure(taken)));
    return true;
}

/// Waits until the unit has rested, where what it delivered before is not known. Errors: Stopped.
Result<void> Bench::State::rest() {
    if (!record) return {};
    const auto rested = advance(record->quietUntil(), [] { return false; });
    return rested ? Result<void>{} : failure(rested);
}

Result<void> Bench::arm(const ArmRequest& request) {
    auto& s = *state_;
    if (!s.hasOutput()) return fail(ErrorCode::Unsupported, "not armed: no stimulator and no massager is open");
    const auto load = parseLoad(request.load);
    if (!load) return failure(load);
    if (const auto confirmed = s.confirmedAsShown(request, *load); !confirmed) return confirmed;
    if (const auto well = s.health(); !well) return well;
    if (const auto holds = s.calibrationToday(); !holds) return holds;
    const auto command = s.armCommandFor(request, *load);
    const PulseTrain check = checkTrainOf(command.setup);
    // Without the operator's word for the load arming is refused, and no pulse is sent.
    const bool looks = command.confirmByCapture && command.evidence.declaredLoadConfirmed;
    if (const auto rested = s.rest(); !rested) return rested;
    const auto ticket = s.interlock.requestArming(s.config.clock->now());
    if (!ticket) return failure(ticket);
    if (looks) {
        if (const auto looking = s.lookAtCheck(command); !looking) {
            cancelCaptures();
            return looking;
        }
    }
    if (const auto confirmed = s.interlock.confirmArming(*ticket, s.config.clock->now()); !confirmed) return confirmed;
    if (const auto noted = s.noteArming(request, command.setup); !noted) {
        cancelCaptures();
        disarm();
        return noted;
    }
    s.loop->arm(command);
    const Seconds within = looks ? kConfirmedWithin : kArmWithin;
    std::optional<Result<void>> outcome;
    bool passedOn = !looks;
    const auto finished = s.advance(s.config.clock->now() + toInstant(within), [&] {
        if (!passedOn) passedOn = s.passOnCheck(check);
        outcome = s.loop->armed();
        return outcome.has_value();
    });
    if (looks) cancelCaptures();
    if (outcome) return *outcome;
    // A fault ends arming and health() sees it first: say why in arming's own words if it has any.
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
    if (!answer) return fail(ErrorCode::NotArmed, "not reset: the {} does not answer", who);
    if (!*answer) return fail(ErrorCode::NotArmed, "not reset: {}", answer->error().message);
    return {};
}

/// What a device's session reported while the device was gone (a keep-alive that failed) belongs to the fault that is
/// being left; judged after the reset it would be the next one.
Result<void> Bench::State::letReportsBeJudged() {
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
    if (loop->telemetry().steps >= begin + kSteps) return {};
    return fail(ErrorCode::NotArmed, "not reset: the control loop does not run");
}

/// Each cause is looked at again, here or before anything else can be delivered:
///   device lost, device fault, status missing   the device is asked, and must answer and deliver nothing
///   stale sensor, a failed sensor               the sensor is asked
///   loop silent                                 the loop must take its steps again
///   open, short, net charge, limit broken       the check pulse with which arming begins: see judgeCheck(). A source
///                                               that does not read back arms on the operator's word for the load
///   internal error                              is never gone: the program is restarted
Result<void> Bench::resetFault() {
    auto& s = *state_;
    if (s.interlock.state() != InterlockState::Faulted) return {};
    if (s.interlock.causePersists(FaultCause::Internal)) {
        return fail(ErrorCode::NotArmed, "a fault of the program itself is not reset: {}. Restart the program",
                    s.interlock.reason().view());
    }
    if (s.massager) s.massager->forceOff();  // a massager is asked nothing: whether it is there, the next burst tells
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
    if (const auto judged = s.letReportsBeJudged(); !judged) return judged;
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
        while (!s.stopped() && s.config.clock->now() < until) {
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
            s.waitChanged.wait_for(lock, until - s.config.clock->now(), [&s] { return s.stopped(); });
        }
        s.heartbeatWithheld.store(false, std::memory_order_release);
    }
    if (s.stopped()) return fail(ErrorCode::Stopped, "stopped. Output is off.");
    return {};
}

std::optional<Seconds> Bench::silencedAfter() const noexcept {
    const auto& stimulator = state_->stimulator;
    if (!stimulator || stimulator->silencedAfter() == Instant(0)) return std::nullopt;
    return Seconds(stimulator->silencedAfter());
}

const KnownLines& Bench::calibration() const noexcept { return state_->applied; }

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

}  // namespace tacto
