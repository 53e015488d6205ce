#include "core/session/AboutJson.h"

#include "core/base/JsonFields.h"

namespace tacto {

nlohmann::json toJson(const SessionAbout& about) {
    auto devices = nlohmann::json::array();
    for (const auto& device : about.devices) {
        devices.push_back({{"uri", device.uri},
                           {"role", device.role},
                           {"name", device.name},
                           {"serial", device.serial},
                           {"firmware", device.firmware},
                           {"simulated", device.simulated},
                           {"origin", device.origin}});
    }
    auto limits = nlohmann::json::array();
    for (const auto& set : about.limitSets) {
        limits.push_back({{"id", set.id}, {"sha256", set.sha256}, {"from", set.from}});
    }
    return {{"program_version", about.programVersion},
            {"protocol", about.protocol},
            {"protocol_sha256", about.protocolSha256},
            {"protocol_from", about.protocolFrom},
            {"parameters", about.parameters},
            {"seed", about.seed},
            {"devices", std::move(devices)},
            {"profile", about.profileJson},
            {"profile_sha256", about.profileSha256},
            {"limit_sets", std::move(limits)},
            {"simulated", about.simulated},
            {"mode", about.mode},
            {"wall_start", about.wallStart},
            {"wall_start_at_s", toSeconds(about.wallStartAt)},
            {"virtual_clock", about.virtualClock}};
}

SessionAbout aboutFrom(const nlohmann::json& json) {
    SessionAbout about;
    about.programVersion = textOr(json, "program_version");
    about.protocol = textOr(json, "protocol");
    about.protocolSha256 = textOr(json, "protocol_sha256");
    about.protocolFrom = textOr(json, "protocol_from");
    about.parameters = valueOr(json, "parameters");
    about.seed = countOr(json, "seed");
    for (const auto& each : valueOr(json, "devices")) {
        about.devices.push_back({textOr(each, "uri"), textOr(each, "role"), textOr(each, "name"),
                                 textOr(each, "serial"), textOr(each, "firmware"), flagOr(each, "simulated"),
                                 textOr(each, "origin")});
    }
    about.profileJson = textOr(json, "profile");
    about.profileSha256 = textOr(json, "profile_sha256");
    for (const auto& each : valueOr(json, "limit_sets")) {
        about.limitSets.push_back({textOr(each, "id"), textOr(each, "sha256"), textOr(each, "from")});
    }
    about.simulated = flagOr(json, "simulated");
    about.mode = textOr(json, "mode");
    about.wallStart = textOr(json, "wall_start");
    const double at = numberOr(json, "wall_start_at_s");
    about.wallStartAt = at >= 0 && at < 1e9 ? toInstant(at) : Instant(0);
    about.virtualClock = flagOr(json, "virtual_clock");
    return about;
}

nlohmann::json reproducible(const SessionAbout& about) {
    auto json = toJson(about);
    for (const char* key : {"program_version", "wall_start", "wall_start_at_s"}) json.erase(key);
    json.erase("protocol_from");  // a path
    for (auto& set : json["limit_sets"]) set.erase("from");
    for (auto& device : json["devices"]) {
        device.erase("uri");  // a recording's is a path
        device.erase("firmware");
    }
    return json;
}

nlohmann::json toJson(const SessionStream& stream) {
    return {{"name", stream.name},
            {"kind", stream.kind},
            {"unit", stream.unit},
            {"columns", stream.columns},
            {"rate_hz", stream.rate_hz}};
}

SessionStream streamFrom(const nlohmann::json& json) {
    return {textOr(json, "name"), textOr(json, "kind"), textOr(json, "unit"), textsOr(json, "columns"),
            numberOr(json, "rate_hz")};
}

}  // namespace tacto
