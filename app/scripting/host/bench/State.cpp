// The state of the bench for a protocol, and the loads of the bench set.
#include <algorithm>
#include <limits>

#include "app/scripting/host/bench/BenchCalls.h"
#include "core/kinds/RecordingTotals.h"

namespace tacto::host::bench {

Json devicesOf(ScriptSession& session) {
    Json out = Json::array();
    for (const auto& device : session.bench().devices().identities()) out.push_back(toJson(instrumentOf(device)));
    return out;
}

namespace {

Json stateOf(ScriptSession& session) {
    const Telemetry now = session.bench().telemetry();
    return {{"time_s", toSeconds(now.at)},
            {"state", nameOf(now.state)},
            {"reason", now.reason.view()},
            {"roughness", now.roughness},
            {"pressure", now.pressure},
            {"h", now.h},
            {"v", now.v},
            {"pressure_pa", now.pressure_pa},
            {"contact", now.contact},
            {"sliding", now.sliding},
            {"sensor_age_s", now.sensorAge_s},
            {"amplitude_v", now.amplitude_v},
            {"interval_s", now.interval_s},
            {"impedance_ohm", now.impedance_ohm},
            {"imbalance", now.imbalance},
            {"trains_delivered", now.trainsDelivered},
            {"trains_refused", now.trainsRefused},
            {"trains_skipped", now.trainsSkipped},
            {"last_refusal", now.lastRefusal.view()},
            {"samples_lost", now.samplesLost},
            {"gaps", now.gaps}};
}

bool isReplayed(ScriptSession& session) {
    const auto& sensor = session.bench().devices().sensor;
    return sensor != nullptr && sensor->identity().uri.starts_with("recording:");
}

Result<Json> conditions(ScriptSession& session, const Arguments&) {
    Json out = Json::array();
    for (const auto& condition : session.bench().profile().encoding.conditions) {
        out.push_back({{"name", condition.name}, {"roughness", condition.R}, {"pressure", condition.P}});
    }
    return out;
}

Result<Json> live(ScriptSession& session, const Arguments&) { return stateOf(session); }

/// A long run is sampled more coarsely, so that its figure stays readable and memory use bounded.
Result<Json> watch(ScriptSession& session, const Arguments& arguments) {
    constexpr std::size_t kMaxStates = 2000;
    constexpr Seconds kShortestWait{0.001};
    const auto begin = session.now();
    const Seconds duration(isReplayed(session) ? std::numeric_limits<double>::infinity() : arguments.number("seconds"));
    Json states = Json::array();
    for (Seconds step(0.05); !session.bench().sensorFinished();) {
        const Seconds left = duration - Seconds(session.now() - begin);
        if (left <= Seconds(0)) break;
        if (auto passed = session.bench().wait(std::min(step, std::max(kShortestWait, left))); !passed)
            return failure(passed);
        states.push_back(stateOf(session));
        if (states.size() < kMaxStates) continue;
        Json fewer = Json::array();
        for (std::size_t i = 1; i < states.size(); i += 2) fewer.push_back(std::move(states[i]));
        states = std::move(fewer);
        step *= 2;
    }
    return states;
}

Result<Json> totals(ScriptSession& session, const Arguments& arguments) {
    const Telemetry now = session.bench().telemetry();
    return toJson(RecordingTotals{toSeconds(session.now()) - arguments.number("begin"), now.trainsDelivered,
                                  now.trainsRefused, now.trainsSkipped, now.samplesLost, now.gaps},
                  session.bench().devices().massager ? ResultKind::Massager : ResultKind::Live);
}

Result<Json> exposure(ScriptSession& session, const Arguments&) { return session.worstExposure(); }

Result<Json> time(ScriptSession& session, const Arguments&) { return Json(toSeconds(session.now())); }

Result<Json> devices(ScriptSession& session, const Arguments&) { return devicesOf(session); }

/// Returns the loads of the bench set.
Result<Json> loads(ScriptSession&, const Arguments&) {
    Json out = Json::array();
    for (const auto& named : benchLoads()) {
        const char* kind = named.load.kind == LoadKind::Resistor         ? "resistor"
                           : named.load.kind == LoadKind::SkinEquivalent ? "skin"
                           : named.load.kind == LoadKind::Open           ? "open"
                                                                         : "short";
        out.push_back({{"name", named.name}, {"kind", kind}});
    }
    return out;
}

}  // namespace

}  // namespace tacto::host::bench

namespace tacto {

std::vector<HostFunction> stateFunctions() {
    using namespace takes;
    return {
        {.name = "conditions",
         .kind = HostKind::Property,
         .text = "The profile's conditions, in its order.",
         .returns = "List of { name, roughness, pressure }, roughness and pressure from 0 to 1.",
         .call = host::bench::conditions},
        {.name = "time",
         .kind = HostKind::Property,
         .text = "Seconds since the session's clock started.",
         .returns = "Number (s).",
         .call = host::bench::time},
        {.name = "devices",
         .kind = HostKind::Property,
         .text = "What is connected.",
         .returns = "List of { role, name, serial, simulated }.",
         .call = host::bench::devices},
        {.name = "loads",
         .kind = HostKind::Property,
         .text = "The loads of the bench set: six resistors, a skin equivalent, open, short.",
         .returns = "List of { name, kind }, kind \"resistor\", \"skin\", \"open\" or \"short\"; the name serves "
                    "fitLoad() and arm().",
         .call = host::bench::loads},
        {.name = "live",
         .text = "What the bench is doing now. What is absent is null.",
         .returns =
             "{ time_s, state, reason, roughness, pressure, h, v, pressure_pa, contact, sliding, sensor_age_s, "
             "amplitude_v, interval_s, impedance_ohm, imbalance, trains_delivered, trains_refused, trains_skipped, "
             "last_refusal, samples_lost, gaps }; amplitude_v and interval_s are the encoder's command.",
         .call = host::bench::live},
        {.name = "watch",
         .parameters = {number("seconds", "s", "how long; a recording ends by itself").range(0.1, 86'400)},
         .text = "Lets time pass and reads live() meanwhile: every 50 ms, and less often the longer it takes.",
         .returns = "List of what live() returns, for plot.timeline(); 2000 at most.",
         .errors = "Throws when the run is stopped or a device fails.",
         .call = host::bench::watch},
        {.name = "totals",
         .parameters = {number("begin", "s", "bench.time when the recording began").atLeast(0)},
         .text = "What was delivered and lost in the whole run.",
         .members = recordingKind(ResultKind::Live).members,
         .returns = ", for verdict(); with a massager bursts_delivered in place of trains_delivered and "
                    "trains_refused.",
         .call = host::bench::totals},
        {.name = "exposure",
         .text = "The largest exposure seen in this run against each limit, at the ends of wait() and capture().",
         .returns =
             "Rows { name, value, limit, unit, source, warning, reason, measured, measured_beyond } for "
             "plot.exposure(); "
             "value null: not evaluated; measured null: not measured; measured_beyond: the stimulator's accuracy "
             "does not explain it.",
         .call = host::bench::exposure},
    };
}

}  // namespace tacto
