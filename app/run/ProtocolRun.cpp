#include "app/run/ProtocolRun.h"

#include <algorithm>
#include <utility>

#include "core/calibration/CertificateDetails.h"
#include "core/kinds/ResultKinds.h"
#include "core/session/Digest.h"
#include "core/session/Origin.h"
#include "core/session/SessionReader.h"
#include "core/session/SessionVerify.h"

namespace tacto {

namespace {

/// True if safety or a person ended the output, false for a mistake in a script.
bool endedBySafety(const ScriptOutcome& outcome, const Bench& bench) {
    if (bench.faults() > outcome.expectedFaults) return true;
    if (!outcome.error) return outcome.verdict == ScriptVerdict::Stopped;
    const auto code = outcome.error->code;
    return code == ErrorCode::LimitExceeded || code == ErrorCode::NotArmed || code == ErrorCode::Stopped;
}

/// Clears the grave fault that a unit's record holds, after the safety check that passed. No bench has the unit open.
Result<void> clearChecked(const LeftFault& fault, const Clock& clock) {
    auto record = UnitRecord::open(unitFolders(), fault.unit, clock);
    if (!record) return failure(record);
    const auto now = (*record)->fault();
    if (!now || now->causes != fault.causes || now->reason.view() != fault.reason)
        return fail(ErrorCode::NotArmed, "the check passed, but {} was left in another fault since ({})", fault.unit,
                    now ? now->reason.view() : "reset");
    (*record)->clearFault();
    return {};
}

/// True for the shipped safety check alone: another script, whatever it calls itself, has checked nothing.
bool isSafetyCheck(const RunOrder& order) {
    return resultTraits(order.declaration.kind).kind == ResultKind::LoadSafety &&
           sha256Hex(order.script.text) == shippedLoadSafetySha256();
}

}  // namespace

std::string declaredLoad(const nlohmann::json& parameters) {
    const auto load = parameters.find("load");
    if (load == parameters.end()) return kDefaultLoad;
    if (load->is_number()) return fmt::format("{} ohm", load->get<double>());
    return load->is_string() ? load->get<std::string>() : kDefaultLoad;
}

SessionAbout aboutScript(const RunOrder& order) {
    SessionAbout about;
    about.protocol = order.script.name;
    about.protocolSha256 = order.script.sha256;
    about.protocolFrom = originOf(order.script);
    about.parameters = order.settings.parameters;
    return about;
}

std::string RunResult::verdict() const {
    return stoppedBySafety ? std::string(nameOf(ScriptVerdict::Stopped)) : std::string(nameOf(outcome.verdict));
}

Result<std::unique_ptr<ProtocolRun>> ProtocolRun::prepare(RunOrder given, Registry& registry,
                                                          std::shared_ptr<BenchTap> tap,
                                                          std::optional<LeftFault>* found) {
    std::unique_ptr<ProtocolRun> run(new ProtocolRun(std::move(given)));
    RunOrder& order = run->order_;
    order.needed = order.ownNeeds.empty() ? order.declaration.needs : order.ownNeeds;
    order.declaredLoad = order.ownLoad.empty() ? declaredLoad(order.settings.parameters) : order.ownLoad;
    order.about = aboutScript(order);
    const bool isCalibration = resultTraits(order.declaration.kind).kind == ResultKind::StimulatorCalibration;
    const auto details =
        isCalibration ? certificateDetails(order.certificateDetails, utcToday()) : CertificateDetails{};
    if (!details) return failure(details);
    auto opened = openBench(order, registry, std::move(tap));
    if (!opened) return failure(opened);
    run->opened_ = std::move(*opened);
    if (auto item = toJson(*details); !item.empty()) {
        item["kind"] = "certificate details";
        if (auto kept = run->opened_->session->reportItem(run->opened_->clock->now(), item); !kept)
            return failure(kept);
    }
    if (!order.stops) order.asked = run->bench().stops().mark();
    if (const auto fault = run->presentFault()) {
        if (found != nullptr) *found = fault;
        if (auto left = run->leaveFault(*fault); !left) return failure(left);
        if (fault->grave()) run->checked_ = fault;
    }
    return run;
}

std::optional<LeftFault> ProtocolRun::presentFault() const {
    const auto fault = opened_->bench->unitFault();
    if (!fault) return std::nullopt;
    const auto& devices = opened_->bench->devices();
    const Device* unit = devices.stimulator ? static_cast<const Device*>(devices.stimulator.get())
                         : devices.massager ? static_cast<const Device*>(devices.massager.get())
                                            : static_cast<const Device*>(devices.sensor.get());
    return LeftFault{unit != nullptr ? unitOf(unit->identity().serial, unit->identity().uri) : "the bench",
                     std::string(fault->reason.view()), fault->causes};
}

/// Resets a fault that an earlier run left in the stimulator, if the operator asks for it, and then checks again. After
/// a grave cause the unit's record holds the fault until the safety check has passed.
Result<void> ProtocolRun::leaveFault(const LeftFault& fault) {
    const auto kind = resultTraits(order_.declaration.kind).kind;
    if (order_.resetFault) {
        if (const auto& seen = order_.faultSeen; seen && !seen->is(fault))
            return fail(ErrorCode::NotArmed,
                        "nothing was reset: the fault that was acknowledged is of {} ({}), and {} is in another ({})",
                        seen->unit, seen->reason, fault.unit, fault.reason);
        if (!fault.grave()) return bench().resetFault();
        if (isSafetyCheck(order_)) return bench().resetFault({}, ResetBy::SafetyCheck);
        return tl::unexpected(safetyCheckFirst(fault.unit, *fault.grave(), fault.reason));
    }
    const auto seen = bench().telemetry();
    const bool session = kind == ResultKind::PilotIdentification || kind == ResultKind::PilotThresholds;
    return fail(ErrorCode::NotArmed,
                "the stimulator is in a fault, {}. {} Fix the cause, then reset the fault: run again with "
                "--reset-fault, or {} in the window",
                seen.reason.view(), outputAfter(seen.fault),
                session ? "open the bench under “Live” and press “Reset”" : "press “Reset fault and run again…”");
}

ProtocolRun::~ProtocolRun() {
    if (script_) static_cast<void>(finish());
}

Result<void> ProtocolRun::start(RunRequest hooks) {
    if (hooks.onLog) std::ranges::for_each(opened_->warnings, hooks.onLog);
    hooks.script = order_.script;
    if (!order_.declaration.title.empty()) hooks.declaration = order_.declaration;
    hooks.parameters = order_.settings.parameters;
    hooks.operatorGave = order_.settings.given;
    hooks.seed = order_.seed;
    hooks.bench = opened_->bench.get();
    hooks.session = opened_->session.get();
    hooks.asked = order_.asked;
    hooks.captureFolder = opened_->files.captures;
    auto begun = beginCheck();
    if (check_ && hooks.onLog) {
        if (const auto wide = widerThan(check_->tolerances, ownTolerances()); !wide.empty())
            hooks.onLog("A pass of this check counts for no session with a person: it " + wide + ".");
    }
    auto started = begun ? ScriptRun::start(std::move(hooks)) : failure(begun);
    if (!started) {
        notStarted_ = started.error();
        return failure(started);
    }
    script_ = std::move(*started);
    return {};
}

/// Recorded before the first train: like a failed check, a check that is killed must replace an earlier pass.
Result<void> ProtocolRun::beginCheck() {
    auto check =
        loadSafetyCheckOf(order_.script, opened_->about, bench().profile(), opened_->files.session.filename().string());
    if (!check) return {};
    if (auto kept = keepCheck(*check); !kept) return kept;
    check_ = std::move(check);
    return {};
}

void ProtocolRun::endCheck(RunResult& result) {
    if (!check_) return;
    check_->verdict = result.troubles.empty() ? checkVerdictFrom(result.verdict()) : CheckVerdict::None;
    check_->made = utcToday();
    if (const auto reader = SessionReader::open(result.session)) check_->sessionHead = reader->chainHead();
    if (auto kept = keepCheck(*check_); !kept) result.troubles.push_back(kept.error());
    check_.reset();
}

void RunResult::weighTroubles() {
    if (!troubles.empty() && !outcome.error) {
        outcome.verdict = ScriptVerdict::None;
        outcome.error = troubles.front();
        outcome.reasons = {troubles.front().message};
    }
    std::erase_if(troubles, [this](const Error& trouble) {
        return outcome.error->message.find(trouble.message) != std::string::npos;
    });
}

RunResult ProtocolRun::finish() {
    RunResult result;
    const auto& about = opened_->about;
    auto& session = *opened_->session;
    result.simulated = about.simulated;
    result.devices = about.devices;
    result.session = opened_->files.session;
    if (script_) result.outcome = script_->wait();
    script_.reset();
    if (notStarted_) {
        result.outcome.error = notStarted_;
        result.outcome.reasons = {notStarted_->message};
        if (notStarted_->code == ErrorCode::Stopped) result.outcome.verdict = ScriptVerdict::Stopped;
        static_cast<void>(session.event(opened_->clock->now(), "script not started", {{"why", notStarted_->message}}));
    }
    result.leftIn = presentFault();  // asked first, so that a fault that comes meanwhile is counted below
    result.stoppedBySafety = endedBySafety(result.outcome, bench());
    if (check_) check_->area = bench().profile().electrodeArea;  // as used in the run
    opened_->bench.reset();
    result.lsl = opened_->endLsl();
    if (auto closed = session.close(result.outcome.error ? "ended by an error" : "finished"); !closed)
        result.troubles.push_back(closed.error());
    opened_->session.reset();
    // Data that are not on disk do not count (hazard H8).
    const auto kept = verifySession(result.session);
    if (!kept)
        result.troubles.push_back(kept.error());
    else if (kept->status != SessionStatus::Intact)
        result.troubles.push_back(
            {ErrorCode::Io, fmt::format("the session {} is {}: {}", result.session.string(), nameOf(kept->status),
                                        kept->problems.empty() ? "" : kept->problems.front())});
    // A check with wider tolerances than the laboratory's own leaves no fault.
    const bool counts = check_ && widerThan(check_->tolerances, ownTolerances()).empty();
    endCheck(result);
    result.weighTroubles();
    if (checked_) {
        Result<void> cleared = fail(ErrorCode::NotArmed, "the safety check did not pass");
        const bool calm = !result.leftIn && !result.stoppedBySafety;
        if (counts && calm && result.verdict() == nameOf(ScriptVerdict::Pass)) {
            cleared = clearChecked(*checked_, *opened_->clock);
            if (!cleared) result.troubles.push_back(cleared.error());
        }
        if (!cleared) {
            const auto more = result.leftIn ? result.leftIn->causes : 0;
            result.leftIn = checked_;
            result.leftIn->causes |= more;
        }
    }
    // Read from disk, like everything else (hazard H8).
    const auto reader = SessionReader::open(result.session, opened_->seal);
    auto marks = reader ? sessionMarks(*reader) : failure(reader);
    result.marks = marks ? std::move(*marks) : originMarks(about, {});
    if (!marks) result.marks.push_back("The other marks cannot be read: " + marks.error().message);
    return result;
}

}  // namespace tacto
