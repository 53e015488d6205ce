#include "app/run/MachineGate.h"

#include <algorithm>

#include "app/run/KnownCalibration.h"
#include "app/run/LoadSafetyRecord.h"
#include "core/calibration/LoadSafetyStore.h"
#include "core/devices/DeviceUri.h"
#include "core/pilot/PilotCare.h"

namespace tacto {

namespace {

/// Checks the limit sets of the approval; sets that this program adds can only tighten the limits.
Result<void> limitsGate(const StudySettings& study, const ShippedLimits& limits) {
    if (study.limits.empty()) {
        return fail(kGateRefused,
                    "the study names no limit sets, so what its approval permits is not known; an amendment names "
                    "those of this program");
    }
    for (const auto& approved : study.limits) {
        const auto at = std::ranges::find(limits.sets, approved.id, &LimitSet::id);
        if (at == limits.sets.end()) {
            return fail(kGateRefused,
                        "the limit set {} of approval {} is not in force in this program; it, or an amendment, is "
                        "needed",
                        approved.id, study.approval.reference);
        }
        const auto& now = limits.sha256[static_cast<std::size_t>(at - limits.sets.begin())];
        if (now == approved.sha256) continue;
        return fail(kGateRefused,
                    "the limit set {} hashes to {:.12}…, and approval {} is for {:.12}…; changed limits need an "
                    "amendment",
                    approved.id, now, study.approval.reference, approved.sha256);
    }
    return {};
}

Result<void> loadSafetyGate(const StudySettings& study, const Profile& profile, const DeviceIdentity& device,
                            CalibrationDate today) {
    const auto store = LoadSafetyStore::open(loadSafetyFile());
    if (!store) {
        return fail(kGateRefused, "no load-safety check counts, because their records are damaged: {}",
                    store.error().message);
    }
    LoadSafetyNeed need;
    need.serial = calibratedOutput(device.serial, device.uri);
    need.day = today;
    need.scriptSha256 = shippedLoadSafetySha256();
    need.area = study.electrode.area;
    need.reach = reachOf(profile);
    need.tolerances = ownTolerances();
    for (const auto& set : study.limits) need.limits.push_back({set.id, set.sha256});
    if (const auto passed = store->passed(need); !passed) return fail(kGateRefused, "{}", passed.error().message);
    return {};
}

}  // namespace

Result<void> machineGate(const StudySettings& study, const Profile& profile, const ShippedLimits& limits,
                         const DeviceSet& devices, CalibrationDate today) {
    if (study.modality == Modality::Massager) {
        const auto lacks = machineLacks(devices, profile, LevelUnit::Intensity);
        return lacks.empty() ? Result<void>() : fail(kGateRefused, "{}", lacks);
    }
    if (devices.stimulator && devices.stimulator->identity().simulated) return {};
    if (const auto lacks = machineLacks(devices, profile, LevelUnit::Current); !lacks.empty())
        return fail(kGateRefused, "{}", lacks);
    const auto known = knownCalibration(devices);
    if (!known.holds) return fail(kGateRefused, "the stimulator is {}", known.text);
    if (auto holds = limitsGate(study, limits); !holds) return holds;
    return loadSafetyGate(study, profile, devices.stimulator->identity(), today);
}

}  // namespace tacto
