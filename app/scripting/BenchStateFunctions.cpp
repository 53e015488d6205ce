// What a protocol can read off the bench.
#include "app/scripting/Arguments.h"
#include "app/scripting/HostFunction.h"
#include "app/scripting/ScriptSession.h"

namespace tacto {

namespace {

using Json = nlohmann::json;

Result<Json> conditions(ScriptSession& session, const Json&) {
    Json out = Json::array();
    for (const auto& condition : session.bench().profile().encoding.conditions) {
        out.push_back({{"name", condition.name}, {"roughness", condition.R}, {"pressure", condition.P}});
    }
    return out;
}

Result<Json> live(ScriptSession& session, const Json&) {
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

Result<Json> exposure(ScriptSession& session, const Json&) { return session.worstExposure(); }

Result<Json> finished(ScriptSession& session, const Json&) { return Json(session.bench().sensorFinished()); }

Result<Json> replayed(ScriptSession& session, const Json&) {
    const auto& sensor = session.bench().devices().sensor;
    return Json(sensor != nullptr && sensor->identity().uri.starts_with("recording:"));
}

Result<Json> time(ScriptSession& session, const Json&) { return Json(toSeconds(session.now())); }

Result<Json> devices(ScriptSession& session, const Json&) {
    Json out = Json::array();
    for (const auto& device : session.bench().devices().identities()) {
        out.push_back({{"role", nameOf(device.role)},
                       {"name", device.name},
                       {"serial", device.serial},
                       {"simulated", device.simulated}});
    }
    return out;
}

}  // namespace

std::vector<HostFunction> benchStateFunctions() {
    return {
        {"bench",
         "conditions",
         HostKind::Property,
         {},
         "The profile's conditions, in its order.",
         "List of { name, roughness, pressure }, roughness and pressure from 0 to 1.",
         "",
         conditions},
        {"bench",
         "time",
         HostKind::Property,
         {},
         "Seconds since the session's clock started.",
         "Number (s).",
         "",
         time},
        {"bench",
         "finished",
         HostKind::Property,
         {},
         "Whether a replayed recording has ended.",
         "true or false; a live or simulated sensor never ends.",
         "",
         finished},
        {"bench",
         "replayed",
         HostKind::Property,
         {},
         "Whether the sensor is a recording, which ends by itself.",
         "true or false.",
         "",
         replayed},
        {"bench",
         "devices",
         HostKind::Property,
         {},
         "What is connected.",
         "List of { role, name, serial, simulated }.",
         "",
         devices},
        {"bench",
         "live",
         HostKind::Function,
         {},
         "What the bench is doing now. What is absent is null.",
         "{ time_s, state, reason, roughness, pressure, h, v, pressure_pa, contact, sliding, sensor_age_s, "
         "amplitude_v, interval_s, impedance_ohm, imbalance, trains_delivered, trains_refused, trains_skipped, "
         "last_refusal, samples_lost, gaps }; amplitude_v and interval_s are the encoder's command.",
         "",
         live},
        {"bench",
         "exposure",
         HostKind::Function,
         {},
         "The largest exposure seen in this run against each limit, at the ends of wait() and capture().",
         "Rows { name, value, limit, unit, source, warning, reason } for plot.exposure(); value null: not evaluated.",
         "",
         exposure},
    };
}

}  // namespace tacto
