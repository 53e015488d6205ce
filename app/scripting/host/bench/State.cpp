// What a protocol can read off the bench.
#include <algorithm>
#include <limits>

#include "app/scripting/engine/ScriptSession.h"
#include "app/scripting/host/bench/BenchObject.h"

namespace tacto::host::bench {

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

}  // namespace

Result<Json> conditions(ScriptSession& session, const Arguments&) {
    Json out = Json::array();
    for (const auto& condition : session.bench().profile().encoding.conditions) {
        out.push_back({{"name", condition.name}, {"roughness", condition.R}, {"pressure", condition.P}});
    }
    return out;
}

Result<Json> live(ScriptSession& session, const Arguments&) { return stateOf(session); }

/// A long run is seen more coarsely, so that its figure stays readable and the memory flat.
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

Result<Json> exposure(ScriptSession& session, const Arguments&) { return session.worstExposure(); }

Result<Json> finished(ScriptSession& session, const Arguments&) { return Json(session.bench().sensorFinished()); }

Result<Json> replayed(ScriptSession& session, const Arguments&) { return Json(isReplayed(session)); }

Result<Json> time(ScriptSession& session, const Arguments&) { return Json(toSeconds(session.now())); }

Result<Json> devices(ScriptSession& session, const Arguments&) {
    Json out = Json::array();
    for (const auto& device : session.bench().devices().identities()) {
        out.push_back({{"role", nameOf(device.role)},
                       {"name", device.name},
                       {"serial", device.serial},
                       {"simulated", device.simulated}});
    }
    return out;
}

}  // namespace tacto::host::bench
