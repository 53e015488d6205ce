// Provokes on a bench load every fault that must end the output by itself: an open or short circuit, an intermittent
// contact, a silent control loop (hazards H2, H3).
#include <algorithm>
#include <bit>
#include <cmath>

#include "app/scripting/engine/Arming.h"
#include "app/scripting/host/bench/BenchCalls.h"
#include "app/scripting/host/load_safety/LoadCommands.h"
#include "core/analysis/statistics/StatisticsJson.h"
#include "core/bench/sensing/ScopeSession.h"

namespace tacto::host::load_safety {

namespace {

constexpr double kTripPoll_s = 0.02;

Json trial(std::string_view name, bool evaluated, bool tripped, double after_s, std::string_view reason) {
    return {{"name", name},     {"evaluated", evaluated},   {"tripped", tripped}, {"after_s", numberOrNull(after_s)},
            {"reason", reason}, {"captures", Json::array()}};
}

bool canTell(Bench& bench) {
    const auto& stimulator = bench.devices().stimulator;
    return stimulator && stimulator->traits().readsBack;
}

constexpr std::string_view kNoReadBack =
    "this stimulator does not read back, so only the operator can notice that the load changed";

/// Changes the load while the output stays on.
Result<void> change(ScriptSession& session, const std::string& to, const std::string& request) {
    return bench::changeLoad(session, to, "change-load", request);
}

/// Resets the fault that was provoked. Errors: NotArmed, also if any other cause came with it.
Result<void> leaveProvoked(Bench& bench, FaultCause provoked) {
    bench.idle(Seconds(kTripPoll_s));                 // the loop shows what has come
    const auto known = bench.telemetry().causesCame;  // read first: `fault` has all that it counts
    const auto fault = bench.unitFault();
    if (fault && fault->causes == bitOf(provoked)) return bench.resetFault(known);
    const auto others = fault ? fault->causes & ~bitOf(provoked) : 0U;
    if (others == 0) return fail(ErrorCode::NotArmed, "the fault that was provoked, {}, is gone", nameOf(provoked));
    const auto other = graveCause(others).value_or(FaultCause(std::countr_zero(others)));
    return fail(ErrorCode::NotArmed, "the fault is not reset: {} was provoked, and {} came with it", nameOf(provoked),
                nameOf(other));
}

/// Counts a fault of the bench that was provoked, and removes its cause.
Result<void> acknowledge(ScriptSession& session, FaultCause provoked, const std::string& load,
                         const std::string& request) {
    session.noteExpectedFault();
    if (auto fitted = change(session, load, request); !fitted) return fitted;
    return leaveProvoked(session.bench(), provoked);
}

std::string commandFor(std::string_view becomes, const std::string& load) {
    if (becomes == "open") return fmt::format("Output is running into {}: lift one lead off it, then confirm", load);
    if (becomes == "short") return fmt::format("Output is running into {}: bridge it with a wire, then confirm", load);
    return fmt::format("Output is running into {}: make and break one lead's contact, then confirm", load);
}

/// Lets trains run until two have been delivered, so that a trip has something to end. `strength`: amplitude from 0
/// (weakest) to 1 (strongest), at the shortest interval.
Result<void> startTrains(ScriptSession& session, const std::string& load, double strength = 0) {
    Bench& bench = session.bench();
    const auto request = confirmedArming(session, load);
    if (!request) return failure(request);
    if (auto armed = bench.arm(*request); !armed) {
        bench.disarm();
        return armed;
    }
    const auto before = bench.telemetry().trainsDelivered;
    const bool texture = bench.profile().encoding.assignment == Assignment::TextureToAmplitude;
    const double R = texture ? strength : 1, P = texture ? 1 : strength;
    if (auto driven = bench.drive(DriveSource::Manual, R, P); !driven) return driven;
    const double longest_s = 4 * bench.profile().encoding.intervalMax.count();
    for (double t = 0; t < longest_s && bench.telemetry().trainsDelivered < before + 2; t += kTripPoll_s) {
        if (auto waited = bench.wait(Seconds(kTripPoll_s)); !waited) return waited;
    }
    if (bench.telemetry().trainsDelivered >= before + 2) return {};
    return fail(ErrorCode::Timeout, "no two trains were delivered into {} within {:.1f} s", load, longest_s);
}

/// Returns the time from the onset of the last train to the control loop's last step, when the output had ended.
double sinceLastTrain(const Telemetry& seen) {
    double since = kNaN;
    for (const auto& train : seen.programmed) {
        if (std::isnan(train.amplitude) || train.onset > seen.at) continue;
        since = std::fmin(since, toSeconds(seen.at - train.onset));
    }
    return since;
}

/// Records all trains from now on, in a range for the voltage that the source can reach in an open circuit.
Result<void> watchOpenCircuit(Bench& bench) {
    const auto& source = bench.devices().stimulator->traits();
    const auto& encoding = bench.profile().encoding;
    const double reach_v = source.drive == Drive::Current ? source.compliance.value() : encoding.amplitudeMax.value();
    ScopeSettings settings =
        bench::trainRecord(bench, std::min(Hertz(2e6), bench.devices().oscilloscope->traits().maxRate));
    settings.triggerLevel = 0.2 * encoding.amplitudeMin.value();
    settings.voltageRange = Volts(1.25 * reach_v);
    return bench.requestCaptures(static_cast<int>(ScopeSession::kMaxCaptures), settings);
}

/// Returns the last record: the train that met the open circuit. Nothing if it was not captured.
Result<Json> openCircuitSeen(ScriptSession& session) {
    auto captures = session.bench().takeCaptures();
    session.bench().cancelCaptures();
    if (!captures) return failure(captures);
    if (captures->empty()) return Json::array();
    std::vector<Capture> last;
    last.push_back(std::move(captures->back()));
    return session.hold(std::move(last));
}

}  // namespace

Result<Json> tripWhenArming(ScriptSession& session, const std::string& becomes, const std::string& declared) {
    Bench& bench = session.bench();
    if (!canTell(bench)) return trial(becomes, false, false, kNaN, kNoReadBack);
    bench.disarm();
    if (auto fitted = change(session, becomes, fmt::format("Fit {} in place of the load, then confirm", becomes));
        !fitted) {
        return failure(fitted);
    }
    const auto delivered = bench.telemetry().trainsDelivered;
    const auto request = confirmedArming(session, declared);
    if (!request) return failure(request);
    const Instant begun = session.now();
    const auto armed = bench.arm(*request);
    const double after_s = toSeconds(session.now() - begun);
    bench.disarm();
    if (armed) return trial(becomes, true, false, kNaN, "the output was armed into it");
    // Expected: refused because of its load. Any other failure is a failure of the run.
    const auto code = armed.error().code;
    if (code != ErrorCode::NotArmed && code != ErrorCode::LimitExceeded) return failure(armed);
    const bool quiet = bench.telemetry().trainsDelivered == delivered;
    return trial(becomes, true, quiet, after_s, armed.error().message);
}

Result<Json> tripWhileDelivering(ScriptSession& session, const std::string& becomes, const std::string& load,
                                 double strength) {
    constexpr double kWithin_s = 20;
    const std::string name = becomes == "intermittent" ? "intermittent contact" : becomes + " while delivering";
    Bench& bench = session.bench();
    if (!canTell(bench)) return trial(name, false, false, kNaN, kNoReadBack);
    bench.disarm();
    if (auto fitted = change(session, load, fmt::format("Fit the load {}, then confirm", load)); !fitted) {
        return failure(fitted);
    }
    if (auto started = startTrains(session, load, strength); !started) return failure(started);
    const bool watched = becomes == "open" && bench.devices().oscilloscope;
    if (watched) {
        if (auto asked = watchOpenCircuit(bench); !asked) return failure(asked);
    }
    const double command_v = bench.telemetry().amplitude_v, interval_s = bench.telemetry().interval_s;

    const std::string changed = becomes == "intermittent"
                                    ? fmt::format("{}, intermittent 50 % seed {}", load, session.request().seed)
                                    : becomes;
    const Instant begun = session.now();
    const auto delivered = bench.telemetry().trainsDelivered;
    if (auto fitted = change(session, changed, commandFor(becomes, load)); !fitted) return failure(fitted);
    Result<void> waited;
    while (waited && toSeconds(session.now() - begun) < kWithin_s) waited = bench.wait(Seconds(kTripPoll_s));
    const double after_s = toSeconds(session.now() - begun);
    const auto cause = becomes == "short" ? FaultCause::ShortElectrode : FaultCause::OpenElectrode;
    const auto seen = bench.telemetry();
    const double stop_s = sinceLastTrain(seen);
    if (waited) {
        bench.disarm();
        return trial(name, true, false, after_s, fmt::format("output went on for {:.1f} s", after_s));
    }
    if (waited.error().code == ErrorCode::Stopped || !bench.faultPersists(cause)) return failure(waited);
    Json seenOpen = Json::array();
    if (watched) {
        auto shown = openCircuitSeen(session);
        if (!shown) return failure(shown);
        seenOpen = std::move(*shown);
    }
    if (auto cleared = acknowledge(session, cause, load, fmt::format("Fit {} again, then confirm", load)); !cleared) {
        return failure(cleared);
    }
    // One train detects the change; with an intermittent contact, some trains still find the contact good.
    const bool stopped = becomes == "intermittent" || seen.trainsDelivered <= delivered + 1;
    Json out = trial(name, true, stopped, after_s, seen.reason.view());
    out["command_v"] = numberOrNull(command_v);
    out["interval_s"] = numberOrNull(interval_s);
    out["stop_s"] = numberOrNull(stop_s);
    out["allowed_s"] = numberOrNull(interval_s);
    out["captures"] = std::move(seenOpen);
    return out;
}

Result<Json> tripBySilence(ScriptSession& session, const std::string& load, double seconds) {
    Bench& bench = session.bench();
    bench.disarm();
    if (auto fitted = change(session, load, fmt::format("Fit the load {}, then confirm", load)); !fitted) {
        return failure(fitted);
    }
    if (auto started = startTrains(session, load); !started) return failure(started);
    const auto delivered = bench.telemetry().trainsDelivered;
    if (auto silent = bench.withholdHeartbeat(Seconds(seconds)); !silent) return failure(silent);
    // The loop runs again and checks what happened: it must report a fault and not continue.
    const auto waited = bench.wait(Seconds(seconds));
    const auto seen = bench.telemetry();
    if (waited) {
        bench.disarm();
        return trial("dead-man", true, false, kNaN, "output went on after the silence");
    }
    if (waited.error().code == ErrorCode::Stopped || !bench.faultPersists(FaultCause::LoopSilent)) {
        return failure(waited);
    }
    session.noteExpectedFault();
    if (auto reset = leaveProvoked(bench, FaultCause::LoopSilent); !reset) return failure(reset);
    const bool quiet = seen.trainsDelivered <= delivered + 1;  // one train may already have been under way
    const auto after = bench.silencedAfter();
    return trial("dead-man", true, quiet && after.has_value(), after ? after->count() : kNaN, seen.reason.view());
}

}  // namespace tacto::host::load_safety
