// What a protocol can read off the bench.
#include "app/scripting/engine/ScriptSession.h"
#include "app/scripting/host/bench/BenchObject.h"

namespace tacto::host::bench {

Result<Json> conditions(ScriptSession& session, const Arguments&) {
    Json out = Json::array();
    for (const auto& condition : session.bench().profile().encoding.conditions) {
        out.push_back({{"name", condition.name}, {"roughness", condition.R}, {"pressure", condition.P}});
    }
    return out;
}

Result<Json> live(ScriptSession& session, const Arguments&) {
    const Telemetry now = session.bench().telemetry();
    return Json{{"time_s", toSeconds(now.at)},
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

Result<Json> exposure(ScriptSession& session, const Arguments&) { return session.worstExposure(); }

Result<Json> finished(ScriptSession& session, const Arguments&) { return Json(session.bench().sensorFinished()); }

Result<Json> replayed(ScriptSession& session, const Arguments&) {
    const auto& sensor = session.bench().devices().sensor;
    return Json(sensor != nullptr && sensor->identity().uri.starts_with("recording:"));
}

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
