#include "app/run/LoadSafetyRecord.h"

#include <algorithm>
#include <cmath>

#include "app/scripting/ShippedResources.h"
#include "core/analysis/load_safety/LoadSafety.h"
#include "core/base/JsonText.h"
#include "core/devices/DeviceUri.h"
#include "core/session/Digest.h"
#include "core/session/Origin.h"

namespace tacto {

namespace {
constexpr std::string_view kLoadSafety = "load-safety";

std::optional<double> given(const nlohmann::json& parameters, const char* name) {
    const double value = numberOr(parameters, name);
    return std::isfinite(value) ? std::optional(value) : std::nullopt;
}

}  // namespace

std::string shippedLoadSafetySha256() {
    const auto shipped = shippedProtocols();
    const auto found = std::ranges::find(shipped, kLoadSafety, &ShippedProtocol::name);
    return found == shipped.end() ? std::string() : std::string(found->sha256);
}

TrainReach reachOf(const Profile& profile) {
    const auto& encoding = profile.encoding;
    return {.amplitude_v = encoding.amplitudeMax.value(),
            .interval_s = encoding.intervalMin.count(),
            .phase_us = encoding.train.phaseWidth.count() * encoding.train.pulses,
            .lowest_ohm = profile.loadLow.value(),
            .highest_ohm = profile.loadHigh.value()};
}

CheckTolerances ownTolerances() {
    const LoadSafetyTolerances ours;
    return {.load_pct = ours.load_pct, .amplitude_pct = ours.amplitude_pct};
}

std::optional<LoadSafetyCheck> loadSafetyCheckOf(const ProtocolSource& script, const SessionAbout& about,
                                                 const Profile& profile, const std::string& session) {
    if (script.name != kLoadSafety || sha256Hex(script.text) != shippedLoadSafetySha256()) return std::nullopt;
    const auto stimulator = std::ranges::find(about.devices, nameOf(Role::Stimulator), &SessionDevice::role);
    if (stimulator == about.devices.end()) return std::nullopt;
    LoadSafetyCheck check;
    check.serial = calibratedOutput(stimulator->serial, stimulator->uri);
    if (check.serial.empty()) return std::nullopt;
    check.device = stimulator->name;
    check.made = utcToday();
    check.simulated = std::ranges::any_of(
        about.devices, [](const SessionDevice& each) { return originOf(each) != origin::kHardware; });
    check.area = profile.electrodeArea;
    check.reach = reachOf(profile);
    check.tolerances = {.load_pct = given(about.parameters, "load_tolerance"),
                        .amplitude_pct = given(about.parameters, "amplitude_tolerance")};
    for (const auto& set : about.limitSets) check.limits.push_back({set.id, set.sha256});
    check.scriptSha256 = shippedLoadSafetySha256();
    check.session = session;
    return check;
}

Result<void> keepCheck(const LoadSafetyCheck& check) {
    auto store = LoadSafetyStore::open(loadSafetyFile());
    const auto kept = store ? store->add(check) : Result<void>(failure(store));
    if (kept || check.simulated) return {};
    return fail(kept.error().code, "the load-safety check of stimulator {} cannot be kept: {}", check.serial,
                kept.error().message);
}

}  // namespace tacto
