// Makes a profile from a sensor calibration.
#include <cerrno>
#include <cstdio>
#include <cstring>

#include "app/scripting/host/sensor_calibration/FingertipCalibration.h"
#include "core/base/JsonText.h"
#include "core/calibration/CalibrationStore.h"

namespace tacto::host::sensor_calibration {

namespace {

/// Keeps letters, digits, '-' and '_', because a serial number may contain anything.
std::string fileWord(std::string_view text) {
    std::string out;
    for (const char c : text) {
        const bool plain = (c >= '0' && c <= '9') || (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || c == '_';
        out += plain ? c : '-';
    }
    return out.empty() ? "unnamed" : out;
}

/// Writes a new file: an older calibration is superseded, never overwritten.
Result<std::filesystem::path> writeNew(const std::filesystem::path& folder, const std::string& stem,
                                       const std::string& text) {
    std::error_code problem;
    std::filesystem::create_directories(folder, problem);
    constexpr int kMaxADay = 1000;
    for (int i = 1; i < kMaxADay; ++i) {
        const auto path = folder / (stem + (i == 1 ? "" : fmt::format("-{}", i)) + ".json");
        std::FILE* file = std::fopen(path.c_str(), "wxe");
        if (file == nullptr && errno == EEXIST) continue;
        if (file == nullptr) {
            return fail(ErrorCode::Io, "{} cannot be written: {}", path.string(), std::strerror(errno));
        }
        const bool written = std::fwrite(text.data(), 1, text.size(), file) == text.size();
        int reason = written ? 0 : errno;
        const bool closed = std::fclose(file) == 0;
        if (written && closed) return path;
        if (reason == 0) reason = errno;
        std::filesystem::remove(path, problem);
        return fail(ErrorCode::Io, "{} could not be written: {}", path.string(), std::strerror(reason));
    }
    return fail(ErrorCode::Io, "{}: {} profiles of one day; fewer are expected", (folder / stem).string(), kMaxADay);
}

}  // namespace

Result<Json> keepProfile(ScriptSession& session, const SensorCalibration& found, double area_cm2, bool store) {
    RoughnessSettings roughness = found.settings;
    if (area_cm2 > 0) roughness.contactArea = SquareCentimetres(area_cm2);
    const auto& identity = session.bench().devices().sensor->identity();
    // Scales in the previous profile that belong to another fingertip are dropped.
    if (!roughness.sensor || roughness.sensor->fingertip != identity.serial) {
        roughness.sensor.emplace();
        roughness.sensor->fingertip = identity.serial;
    }
    const auto day = dateText(utcToday());

    Profile inForce = session.bench().profile();
    inForce.roughness = roughness;
    // Keeps the operator's profile and changes only the scales: a script must not write encoding, area, loads and
    // ceilings (hazard H1).
    Profile profile = session.chosenProfile();
    profile.roughness = roughness;
    profile.name = fmt::format("{} {}, calibrated on {}{}", identity.name, identity.serial, day,
                               identity.simulated ? " (simulated)" : "");
    inForce.name = profile.name;
    if (auto replaced = session.bench().setProfile(inForce, RBefore::Measuring); !replaced) return failure(replaced);
    Json out = {{"name", profile.name}, {"file", nullptr}, {"profile", toJson(profile)}};
    if (!store) return out;
    const auto stem = "fingertip-" + fileWord(identity.serial.empty() ? identity.name : identity.serial) + "-" + day;
    auto path = writeNew(calibrationFile().parent_path() / "profiles", stem, dumpJson(out["profile"], 2) + "\n");
    if (!path) return failure(path);
    out["file"] = path->string();
    return out;
}

}  // namespace tacto::host::sensor_calibration
