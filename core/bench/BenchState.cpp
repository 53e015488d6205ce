#include "core/bench/BenchState.h"

#include <algorithm>
#include <cmath>
#include <span>
#include <utility>
#include <vector>

#include "core/bench/LoopJournal.h"
#include "core/bench/arming/ArmingTerms.h"
#include "core/measure/LoadMeasurement.h"

namespace tacto {

namespace {

/// If the time of a record allows several commands, returns the only command whose size all pulses match within 20 %.
/// This guess causes no fault.
std::optional<ProgrammedTrain> commandOfItsSize(const Capture& capture, const SourceTraits& source,
                                                std::span<const ProgrammedTrain> programmed) {
    constexpr double kOff = 0.2;
    const auto channels = loadChannels(capture);
    if (!channels) return std::nullopt;
    const bool current = source.drive == Drive::Current;
    const auto measured = measureChannel(capture, current ? channels->second : channels->first);
    if (measured.pulses.empty() || measured.measuredPulses != measured.pulses.size()) return std::nullopt;
    std::vector<ProgrammedTrain> fitting;
    for (const auto& command : programmed) {
        const double expected = command.expected / (current ? 1e3 : 1);
        if (measured.amplitude.min >= (1 - kOff) * expected && measured.amplitude.max <= (1 + kOff) * expected)
            fitting.push_back(command);
    }
    fitting.emplace_back();  // commands may be missing between these
    return commandShownIn(capture, fitting);
}

/// Asks the session of one device for the device's health, and waits for the answer.
template <class Session>
Result<void> ask(BenchTime& time, Session& session, Role role, Instant within, const char* who) {
    static_cast<void>(session.health());  // discards an old answer
    session.askHealth();
    std::optional<Result<void>> answer;
    const Instant until = time.now() + within;
    while (!(answer = session.health()) && time.now() < until) time.prompt(role);
    if (!answer) return fail(ErrorCode::NotArmed, "not reset: the {} does not answer", who);
    if (!*answer) return fail(ErrorCode::NotArmed, "not reset: {}", answer->error().message);
    return {};
}

}  // namespace

Bench::State::State(BenchConfig given)
    : config(withStatedCalibration(std::move(given))),
      notes(config.session, *config.clock),
      gate(*config.clock),
      order(config.stops, config.asked) {}

Bench::State::~State() {
    off("the bench closes");
    time.endLoop();
    heartbeat.end();
    off("the bench closes");  // also withdraws what the loop's last step may have handed over
    time.endDevices();
    output.off();
    if (loop) loop->noteState(config.clock->now());
    const auto* stimulator = output.stimulator();
    if (recorder && stimulator != nullptr && stimulator->longestKeepAliveGap() > Instant(0)) {
        recorder->event(config.clock->now(), "keep-alive",
                        {{"longest_gap_s", toSeconds(stimulator->longestKeepAliveGap())}},
                        "the longest time between two keep-alives of the stimulator's dead-man switch");
    }
    if (const auto* reporting = recorder ? reportingDevice(Role::Sensor) : nullptr) {
        recordReport(*recorder, config.clock->now(), reporting->deviceReport(),
                     "what the fingertip sensor and its line were like, when the bench closed");
    }
    recorder.reset();
    if (loop) {
        notes.marks(loop->flags(), stimulator != nullptr ? std::optional(calibration.held()) : std::nullopt,
                    config.profile);
    }
}

Result<void> Bench::State::open() {
    if (const auto fits = checkWhere(config); !fits) return fits;
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
    parts.stops = &order.stops();
    if (const auto opened = openRecorder(parts); !opened) return opened;
    output.open(gate, heartbeat, *config.clock, [this] { time.wakeOutput(); });
    parts.stimulator = output.stimulator();
    parts.massager = output.massager();
    openScope();
    parts.sensorReport = reportingDevice(Role::Sensor);
    loop = std::make_unique<ControlLoop>(std::move(parts), std::move(*finger), makePlanner(config.profile));
    const bool rests = record && !record->whyQuiet().empty();
    const auto* note = rests ? "arming waits until 8 s after opening: what this unit delivered last is not known" : "";
    if (const auto connected = interlock.connect(note); !connected) return connected;
    if (record) interlock.keepFaultsIn(*record);
    calibration.note(notes);
    time.start(*loop, sensor.get(), scope.get(), recorder.get(), [this]() -> Result<void> {
        if (const auto well = health(); !well) return well;
        attend(kAttended);
        return {};
    });
    return {};
}

/// Continues the exposure from the stimulator's record, and keeps other processes from driving the stimulator.
Result<void> Bench::State::takeUpRecord() {
    const auto& stimulating = config.devices.stimulator;
    if (!stimulating || stimulating->identity().simulated || config.units.records.empty()) return {};
    auto opened = takeUpUnit(stimulating->identity(), config.units, *config.clock,
                             config.systemTime != nullptr ? *config.systemTime : SystemTime::real(), gate);
    if (!opened) return failure(opened);
    record = std::move(*opened);
    return {};
}

Result<void> Bench::State::openRecorder(ControlLoop::Parts& parts) {
    if (config.session == nullptr) return {};
    if (sensor) {
        for (const auto& stream : sensor->device().streams()) {
            const auto id = config.session->addStream(stream);
            if (!id) return failure(id);
            parts.sensorStreams.push_back(*id);
        }
        const std::vector<std::string> columns{"contact", "sliding", "h", "v", "R", "pressure_pa", "P"};
        const auto id = config.session->addStream(SessionStream{"roughness frames", "frames", "", columns, 0});
        if (!id) return failure(id);
        parts.frameStream = *id;
        if (sensor->boardEncodes()) {
            const auto board =
                config.session->addStream(SessionStream{"board's frames", "board_frames", "", columns, 0});
            if (!board) return failure(board);
            parts.boardStream = *board;
            if (const auto noted = noteBoard(); !noted) return noted;
        }
    }
    recorder =
        std::make_unique<SessionRecorder>(*config.session, SessionRecorder::Settings{.ownThread = !time.isVirtual()});
    parts.recorder = recorder.get();
    return {};
}

/// Records by which profile the board encodes.
Result<void> Bench::State::noteBoard() {
    const auto encoder = terms.boardEncoder();
    if (config.session == nullptr || !encoder) return {};
    const auto noted =
        config.session->event(config.clock->now(), "board encodes",
                              {{"hash", fmt::format("{:08x}", encoder->hash)}, {"drives", encoder->drives}});
    return noted ? Result<void>{} : failure(noted);
}

void Bench::State::openScope() {
    if (!config.devices.oscilloscope) return;
    scope = std::make_unique<ScopeSession>(*config.devices.oscilloscope,
                                           [this](Capture& capture) { noteCapture(capture); });
}

/// Adds the programmed values to the capture, and lets the loop judge the captured output.
void Bench::State::noteCapture(Capture& capture) {
    applyStatement(capture, config.devices.scopeStatement);
    const auto programmed = loop->telemetry().programmed;
    auto command = commandShownIn(capture, programmed);
    if (!command) command = commandOfItsSize(capture, output.source(), programmed);
    capture.programmed = command ? command->amplitude : kNaN;
    if (output.stimulator() == nullptr) return;
    const auto shown = command.value_or(ProgrammedTrain{});
    if (const auto seen = amplitudeSeenIn(capture, output.source(), shown)) loop->noteAmplitude(*seen);
    if (output.source().readsBack) return;
    if (const auto seen = loadSeenIn(capture)) loop->noteLoad(*seen);
}

void Bench::State::off(const char* why) noexcept {
    interlock.disarm(why);
    gate.latchStop();
    output.off();
    if (loop) loop->drive({});
    driving.store(DriveSource::Off, std::memory_order_release);
}

Result<void> Bench::State::health() const {
    if (order.stopped()) {
        const auto why = loop->endedBecause();
        if (why.empty()) return fail(ErrorCode::Stopped, "stopped. Output is off.");
        return fail(ErrorCode::Stopped, "stopped: {}. Output is off.", why.view());
    }
    if (interlock.state() == InterlockState::Faulted) {
        return fail(interlock.faultCode(), "fault: {}. {}", interlock.reason().view(), outputAfter(interlock.cause()));
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

/// A check pulse is not counted. What a real device delivered before this bench was opened is not known.
bool Bench::State::hasRested() const noexcept {
    constexpr Instant kRest = std::chrono::seconds(8);
    const Instant since = time.now() - kRest;
    if (!config.devices.stimulator->identity().simulated && opening > since) return false;
    return std::ranges::none_of(loop->telemetry().programmed, [since](const ProgrammedTrain& train) {
        return !train.isCheck && std::isfinite(train.amplitude) && train.until > since;
    });
}

Result<void> Bench::State::fitBoard(const Load& load) {
    if (!sensor || !sensor->takesProfile() || !config.devices.stimulator) return terms.checkEncoder(load);
    const auto wanted = terms.boardProfile(load);
    if (!wanted || wanted->hash == terms.boardEncoder()->hash) return terms.checkEncoder(load);
    if (isArmed()) {
        return fail(ErrorCode::NotArmed,
                    "the fingertip's board encodes for another load, and its profile is written only while the output "
                    "is disarmed, not while {}: disarm first",
                    nameOf(interlock.state()));
    }
    if (const auto written = sensor->load(*wanted, hasRested()); !written) {
        return fail(ErrorCode::NotArmed, "the profile \"{}\" was not written into the fingertip's board: {}",
                    config.profile.name, written.error().message);
    }
    if (const auto noted = noteBoard(); !noted) return noted;
    return terms.checkEncoder(load);
}

Result<void> Bench::State::rest() {
    if (!record) return {};
    const auto rested = time.advance(record->quietUntil(), [] { return false; });
    return rested ? Result<void>{} : failure(rested);
}

/// Waits until old reports are judged. A report from the time when the device was gone (such as a failed keep-alive)
/// belongs to the fault that is being left; judged after the reset, it would cause a new fault.
Result<void> Bench::State::letReportsBeJudged() {
    constexpr std::uint64_t kSteps = 2;  // two, because one step may be under way
    constexpr Instant kStepsTimeout = std::chrono::milliseconds(500);
    constexpr Instant kPollInterval = std::chrono::milliseconds(1);
    const auto begin = loop->telemetry().steps;
    const Instant until = time.now() + kStepsTimeout;
    while (loop->telemetry().steps < begin + kSteps && time.now() < until) time.pass(until, kPollInterval);
    if (loop->telemetry().steps >= begin + kSteps) return {};
    return fail(ErrorCode::NotArmed, "not reset: the control loop does not run");
}

Result<void> Bench::State::leaveFault(std::optional<std::uint64_t> known, ResetBy by) {
    if (interlock.state() != InterlockState::Faulted) return {};
    CausesCame seen = interlock.causesCame();
    if (interlock.causePersists(FaultCause::Internal)) {
        return fail(ErrorCode::NotArmed, "a fault of the program itself is not reset: {}. Restart the program",
                    interlock.reason().view());
    }
    // A bench without a stimulator has no safety check: there the operator leaves a grave fault too, of a massager.
    if (output.stimulator() == nullptr) by = ResetBy::SafetyCheck;
    if (by == ResetBy::Operator) {
        if (auto may = interlock.mayReset(); !may) return may;
    }
    constexpr int kLooks = 3;
    if (known) seen.news = *known;
    for (int looks = 1;; ++looks) {
        if (looks > 1) seen.all = interlock.causesCame().all;
        if (const auto gone = lookIntoFault(); !gone) return gone;
        // A cause that came again meanwhile may be newer than what the devices answered.
        const auto left = interlock.reset(seen, by);
        if (left || looks == kLooks || interlock.causesCame().news != seen.news) return left;
    }
}

Result<void> Bench::State::lookIntoFault() {
    // A massager cannot be asked for its health: the next burst shows whether it is there.
    if (auto* massager = output.massager()) massager->forceOff();
    if (auto* stimulator = output.stimulator()) {
        constexpr Instant kStimulatorTimeout = std::chrono::milliseconds(500);
        if (const auto well = ask(time, *stimulator, Role::Stimulator, kStimulatorTimeout, "stimulator"); !well)
            return well;
    }
    if (sensor) {
        constexpr Instant kSensorTimeout = std::chrono::seconds(3);
        if (const auto well = ask(time, *sensor, Role::Sensor, kSensorTimeout, "fingertip sensor"); !well) return well;
    }
    return letReportsBeJudged();
}

Result<void> Bench::State::refusal() {
    refusalsSeen = loop->refusals();
    return fail(ErrorCode::LimitExceeded, "{}", loop->telemetry().lastRefusal.view());
}

Result<void> Bench::State::readyToPresent() const {
    if (const auto well = health(); !well) return well;
    if (driving != DriveSource::Off)
        return fail(ErrorCode::NotArmed, "nothing is presented while the output is driven; drive it off first");
    const auto state = interlock.state();
    if (state == InterlockState::Armed || state == InterlockState::Delivering) return {};
    return fail(ErrorCode::NotArmed, "nothing is presented while {}; arm first", nameOf(state));
}

Result<std::unique_ptr<FingerInput>> Bench::State::makeFinger(const Profile& profile) {
    if (!sensor) return std::unique_ptr<FingerInput>();
    return FingerInput::create(*sensor, profile.roughness);
}

std::unique_ptr<TrainPlanner> Bench::State::makePlanner(const Profile& profile) {
    return std::make_unique<TrainPlanner>(profile.encoding, output.source(), gate, calibration.applied());
}

const ReportingDevice* Bench::State::reportingDevice(Role role) const noexcept {
    const auto& devices = config.devices;
    const Device* device = role == Role::Sensor         ? static_cast<const Device*>(devices.sensor.get())
                           : role == Role::Stimulator   ? static_cast<const Device*>(devices.stimulator.get())
                           : role == Role::Oscilloscope ? static_cast<const Device*>(devices.oscilloscope.get())
                                                        : static_cast<const Device*>(devices.massager.get());
    return dynamic_cast<const ReportingDevice*>(device);
}

}  // namespace tacto
