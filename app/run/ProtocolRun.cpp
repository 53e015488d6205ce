#include "app/run/ProtocolRun.h"

#include <algorithm>
#include <utility>

#include "app/run/KnownCalibration.h"
#include "app/run/OpenDevices.h"
#include "app/run/ScopeStatement.h"
#include "core/bench/ProfileReach.h"
#include "core/devices/ReplayedDevice.h"
#include "core/safety/UnitFolders.h"
#include "core/session/Marks.h"
#include "core/session/Origin.h"
#include "core/session/SessionReader.h"
#include "core/session/SessionVerify.h"

namespace tacto {

namespace {

/// Whatever ended output: safety's doing or a person's, not a mistake in a script.
bool endedBySafety(const ScriptOutcome& outcome, const Bench& bench) {
    if (bench.faults() > outcome.expectedFaults) return true;
    if (!outcome.error) return outcome.verdict == ScriptVerdict::Stopped;
    const auto code = outcome.error->code;
    return code == ErrorCode::LimitExceeded || code == ErrorCode::NotArmed || code == ErrorCode::Stopped;
}

}  // namespace

namespace {

std::string originOf(const DeviceSet& devices, const DeviceIdentity& identity) {
    const Device* all[] = {devices.sensor.get(), devices.stimulator.get(), devices.oscilloscope.get(),
                           devices.massager.get()};
    for (const auto* device : all) {
        const auto* replayed = dynamic_cast<const ReplayedDevice*>(device);
        if (replayed == nullptr || !(device->identity() == identity)) continue;
        switch (replayed->statedOrigin()) {
            case StatedOrigin::Measured:
                return origin::kReplayedMeasured;
            case StatedOrigin::Simulated:
                return origin::kReplayedSimulated;
            case StatedOrigin::NotStated:
                return origin::kReplayedUnknown;
        }
    }
    return identity.simulated ? origin::kSimulated : origin::kHardware;
}

}  // namespace

std::string declaredLoad(const nlohmann::json& parameters) {
    const auto load = parameters.find("load");
    if (load == parameters.end()) return kDefaultLoad;
    if (load->is_number()) return fmt::format("{} ohm", load->get<double>());
    return load->is_string() ? load->get<std::string>() : kDefaultLoad;
}

SessionAbout aboutSession(const DeviceSet& devices, const Profile& profile, const ShippedLimits& limits,
                          const RunOrder* protocol) {
    SessionAbout about;
    about.programVersion = TACTOSCOPE_VERSION;
    if (protocol != nullptr) {
        about.protocol = protocol->script.name;
        about.protocolSha256 = protocol->script.sha256;
        about.protocolFrom = originOf(protocol->script);
        about.parameters = protocol->settings.parameters;
        about.seed = protocol->seed;
    }
    for (const auto& device : devices.identities()) {
        about.devices.push_back({device.uri, std::string(nameOf(device.role)), device.name, device.serial,
                                 device.firmware, device.simulated, originOf(devices, device)});
        about.simulated = about.simulated || device.simulated;
    }
    // Without a device nothing is measured: what such a protocol says is predicted.
    about.simulated = about.simulated || (protocol != nullptr && devices.identities().empty());
    about.profileJson = toJson(profile).dump();
    for (std::size_t i = 0; i < limits.sets.size(); ++i)
        about.limitSets.push_back({limits.sets[i].id, limits.sha256[i], limits.from[i]});
    about.mode = nameOf(OutputMode::BenchLoad);
    about.wallStart = wallTimeUtc();
    return about;
}

std::string RunResult::verdict() const {
    return stoppedBySafety ? std::string(nameOf(ScriptVerdict::Stopped)) : std::string(nameOf(outcome.verdict));
}

Result<std::unique_ptr<ProtocolRun>> ProtocolRun::prepare(RunOrder given, Registry& registry, BenchTap* tap) {
    std::unique_ptr<ProtocolRun> run(new ProtocolRun(std::move(given)));
    const RunOrder& order = run->order_;
    if (auto checked = checkNotes(order.notes); !checked) return failure(checked);
    const auto allVirtual = registry.allVirtual(order.uris);
    if (!allVirtual) return failure(allVirtual);
    if (*allVirtual && !order.realtime)
        run->clock_ = std::make_shared<VirtualClock>();
    else
        run->clock_ = std::make_shared<SteadyClock>();
    const OpenContext context{.clock = *run->clock_,
                              .seed = order.seed,
                              .declaredLoad = declaredLoad(order.settings.parameters),
                              .stops = order.stops.get(),
                              .asked = order.asked};
    auto devices = openDevices(registry, order.uris, order.declaration.needs, context);
    if (!devices) return failure(devices);
    const auto certificate = stateOscilloscope(*devices);
    run->about_ = aboutSession(*devices, order.profile, order.limits, &order);
    auto session = makeRunSession(order.out, order.script.name, run->about_, *run->clock_);
    if (!session) return failure(session);
    run->files_ = std::move(session->files);
    run->session_ = std::move(session->writer);
    if (devices->stimulator) {
        const auto& stimulator = *devices->stimulator;
        if (auto beyond = beyondReach(order.profile, stimulator.traits(), stimulator.identity().name)) {
            const auto kept = run->session_->event(run->clock_->now(), "profile beyond reach", {{"text", *beyond}});
            if (!kept) return failure(kept);
            run->warning_ = std::move(*beyond);
        }
    }
    if (devices->sensor) {
        if (auto another = madeWithAnother(order.profile, devices->sensor->identity().serial)) {
            const auto kept =
                run->session_->event(run->clock_->now(), "profile of another fingertip", {{"text", *another}});
            if (!kept) return failure(kept);
            run->warning_ += (run->warning_.empty() ? "" : "\n") + *another;
        }
    }
    if (auto kept = keepCertificate(certificate, *run->session_, run->clock_->now()); !kept) return failure(kept);
    if (!certificate.used && !certificate.text.empty())
        run->warning_ += (run->warning_.empty() ? "" : "\n") + certificate.text;
    if (auto kept = keepNotes(order.notes, *run->session_, run->clock_->now()); !kept) return failure(kept);
    BenchConfig config;
    config.devices = std::move(*devices);
    config.clock = run->clock_;
    config.profile = order.profile;
    config.limits = order.limits.sets;
    config.session = run->session_.get();
    config.tap = tap;
    config.stops = order.stops;
    config.asked = order.asked;
    config.watched = order.watched;
    applyKnown(knownCalibration(config.devices), config);
    config.units = unitFolders();
    auto bench = Bench::create(std::move(config));
    if (!bench) return failure(bench);
    run->bench_ = std::move(*bench);
    if (!order.stops) run->order_.asked = run->bench_->stops().mark();
    if (auto left = run->leaveFault(); !left) return failure(left);
    return run;
}

/// A fault that an earlier run left the stimulator in is reset when the operator asks for it, and then looked at again.
Result<void> ProtocolRun::leaveFault() {
    const auto seen = bench_->telemetry();
    if (seen.state != InterlockState::Faulted) return {};
    if (order_.resetFault) return bench_->resetFault();
    return fail(ErrorCode::NotArmed,
                "the stimulator is in a fault, {}. Output is off. See to its cause, then run again with --reset-fault, "
                "or reset it in the window (Bench > Reset fault)",
                seen.reason.view());
}

ProtocolRun::~ProtocolRun() {
    if (script_) static_cast<void>(finish());
}

Result<void> ProtocolRun::start(RunRequest hooks) {
    if (!warning_.empty() && hooks.onLog) hooks.onLog(warning_);
    hooks.script = order_.script;
    if (!order_.declaration.title.empty()) hooks.declaration = order_.declaration;
    hooks.parameters = order_.settings.parameters;
    hooks.operatorGave = order_.settings.given;
    hooks.seed = order_.seed;
    hooks.bench = bench_.get();
    hooks.asked = order_.asked;
    hooks.session = session_.get();
    hooks.captureFolder = files_.captures;
    auto started = ScriptRun::start(std::move(hooks));
    if (!started) {
        notStarted_ = started.error();
        return failure(started);
    }
    script_ = std::move(*started);
    return {};
}

RunResult ProtocolRun::finish() {
    RunResult result;
    result.simulated = about_.simulated;
    result.session = files_.session;
    if (script_) result.outcome = script_->wait();
    script_.reset();
    if (notStarted_) {
        result.outcome.error = notStarted_;
        result.outcome.reasons = {notStarted_->message};
        if (notStarted_->code == ErrorCode::Stopped) result.outcome.verdict = ScriptVerdict::Stopped;
        if (session_)
            static_cast<void>(session_->event(clock_->now(), "script not started", {{"why", notStarted_->message}}));
    }
    if (bench_) result.stoppedBySafety = endedBySafety(result.outcome, *bench_);
    const bool abandoned = result.outcome.abandoned;
    // The script's thread still runs and may never end: what it could touch is left as it is.
    if (abandoned) static_cast<void>(bench_.release());
    bench_.reset();
    if (session_) {
        if (auto closed = session_->close(result.outcome.error ? "ended by an error" : "finished"); !closed)
            result.troubles.push_back(closed.error());
    }
    if (abandoned) {
        static_cast<void>(session_.release());
        static_cast<void>(new std::shared_ptr<Clock>(clock_));
    }
    session_.reset();
    if (!abandoned) {
        // What is not on disk was not shown (hazard H8).
        const auto kept = verifySession(files_.session);
        if (!kept)
            result.troubles.push_back(kept.error());
        else if (kept->status != SessionStatus::Intact)
            result.troubles.push_back(
                {ErrorCode::Io, fmt::format("the session {} is {}: {}", files_.session.string(), nameOf(kept->status),
                                            kept->problems.empty() ? "" : kept->problems.front())});
    }
    if (!result.troubles.empty() && !result.outcome.error) {
        result.outcome.verdict = ScriptVerdict::None;
        result.outcome.error = result.troubles.front();
        result.outcome.reasons = {result.troubles.front().message};
        result.troubles.erase(result.troubles.begin());
    }
    result.devices = about_.devices;
    // Of what is on disk, as everything else (hazard H8). A script that was given up still holds its bench, whose marks
    // are missing then.
    const auto reader = SessionReader::open(files_.session);
    auto marks = reader ? sessionMarks(*reader) : failure(reader);
    result.marks = marks ? std::move(*marks) : originMarks(about_, {});
    if (!marks) result.marks.push_back("The other marks cannot be read: " + marks.error().message);
    return result;
}

}  // namespace tacto
