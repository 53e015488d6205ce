// What a sensor calibration is made from and becomes: a profilometer's file in, a profile out.
#include <cerrno>
#include <chrono>
#include <cstdio>
#include <cstring>

#include "app/scripting/Arguments.h"
#include "app/scripting/HostFunction.h"
#include "app/scripting/ScriptSession.h"
#include "core/analysis/ProfilometerFile.h"
#include "core/analysis/ResultJson.h"
#include "core/calibration/CalibrationStore.h"

namespace tacto {

namespace {

using Json = nlohmann::json;

Result<Json> profilometer(ScriptSession& session, const Json& list) {
    const Arguments arguments("bench.profilometer", list);
    auto path = arguments.text(0, "path");
    if (!path) return failure(path);
    // The same answer whether there is such a file or not: a script cannot look around (hazard H10).
    if (!session.isOperatorsText(*path)) {
        return fail(ErrorCode::InvalidArgument,
                    "bench.profilometer: the operator did not choose {}; a path that the operator gave as a parameter "
                    "or entered is expected",
                    shown(*path));
    }
    std::error_code error;
    if (!std::filesystem::is_regular_file(*path, error)) {
        return fail(ErrorCode::InvalidArgument, "bench.profilometer: {} is no file that can be read", shown(*path));
    }
    auto found = readProfilometer(*path);
    if (!found) return failure(found);
    return Json{{"ra_um", numberOrNull(found->ra_um)},
                {"rz_um", numberOrNull(found->rz_um)},
                {"ra_values", found->raValues},
                {"rz_values", found->rzValues}};
}

/// Letters, digits, '-' and '_': a serial may hold anything.
std::string fileWord(std::string_view text) {
    std::string out;
    for (const char c : text) {
        const bool plain = (c >= '0' && c <= '9') || (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || c == '_';
        out += plain ? c : '-';
    }
    return out.empty() ? "unnamed" : out;
}

/// Writes a file that is not there yet: an older calibration is superseded, never overwritten.
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
        const bool closed = std::fclose(file) == 0;
        if (written && closed) return path;
        std::filesystem::remove(path, problem);
        return fail(ErrorCode::Io, "{} cannot be written to its end; room on the disk is expected", path.string());
    }
    return fail(ErrorCode::Io, "{}: {} profiles of one day; fewer are expected", (folder / stem).string(), kMaxADay);
}

Result<Json> keepProfile(ScriptSession& session, const Json& list) {
    const Arguments arguments("record.sensorProfile", list);
    auto found = arguments.object(0, "found");
    if (!found) return failure(found);
    auto options = arguments.options(1, {"store", "contact_area_cm2"});
    if (!options) return failure(options);
    if ((*found)->value("accepted", Json()) != Json(true) || !(*found)->value("roughness", Json()).is_object()) {
        return arguments.wrong("found", **found, "an accepted result of analysis.sensorCalibration()");
    }
    if (!session.own().noted(**found)) {
        return fail(ErrorCode::InvalidArgument,
                    "record.sensorProfile: this result does not come from this run's own slides; what "
                    "analysis.sensorCalibration() returned is expected, unchanged, made from what bench.measureRest() "
                    "and bench.measureSlide() returned, each slide once and under its own surface");
    }
    auto roughness = roughnessSettingsFromJson((**found)["roughness"]);
    if (!roughness) return failure(roughness);
    auto area = arguments.number(*options, "contact_area_cm2", roughness->contactArea.value(), {0.01, 100});
    if (!area) return failure(area);
    roughness->contactArea = SquareCentimetres(*area);
    const auto& sensor = session.bench().devices().sensor;
    if (!sensor) return fail(ErrorCode::Unsupported, "record.sensorProfile: no sensor is connected");
    const auto& identity = sensor->identity();
    // Scales of another fingertip, from the profile that was in force before, are not this one's.
    if (!roughness->sensor || roughness->sensor->fingertip != identity.serial) {
        roughness->sensor.emplace();
        roughness->sensor->fingertip = identity.serial;
    }
    const auto today = dateText(std::chrono::floor<std::chrono::days>(std::chrono::system_clock::now()));

    Profile inForce = session.bench().profile();
    inForce.roughness = *roughness;
    // What is kept is the operator's profile with other scales: encoding, area, loads and ceilings are not a script's
    // to write (hazard H1).
    Profile profile = session.chosenProfile();
    profile.roughness = *roughness;
    profile.name = fmt::format("{} {}, calibrated on {}{}", identity.name, identity.serial, today,
                               identity.simulated ? " (simulated)" : "");
    inForce.name = profile.name;
    if (auto replaced = session.bench().setProfile(inForce, RBefore::Measuring); !replaced) return failure(replaced);
    Json out = {{"name", profile.name}, {"file", nullptr}, {"profile", toJson(profile)}};
    auto store = arguments.flag(*options, "store", false);
    if (!store) return failure(store);
    if (!*store) return out;
    const auto stem = "fingertip-" + fileWord(identity.serial.empty() ? identity.name : identity.serial) + "-" + today;
    auto path = writeNew(calibrationFile().parent_path() / "profiles", stem, out["profile"].dump(2) + "\n");
    if (!path) return failure(path);
    out["file"] = path->string();
    return out;
}

}  // namespace

std::vector<HostFunction> sensorProfileFunctions() {
    return {
        {"bench",
         "profilometer",
         HostKind::Function,
         {{"path", "text", "",
           "of a CSV that a profilometer exported: a parameter that the operator gave, or entered"}},
         "Finds Ra and Rz in it, by name and unit.",
         "{ ra_um, rz_um, ra_values, rz_values }: means over that many values; rz_um is null where it is not stated.",
         "Throws for a path that the operator did not give; with the line and the reason where no Ra with a unit is "
         "found.",
         profilometer},
        {"record",
         "sensorProfile",
         HostKind::Function,
         {{"found", "object", "", "accepted, from analysis.sensorCalibration()"},
          {"options.store", "boolean", "", "keep it as a file, in the folder profiles beside the calibrations", true},
          {"options.contact_area_cm2", "number", "cm2", "0.01 to 100; the profile's where left out", true}},
         "The profile that the operator chose, with the scales of R, force and taxels, the fingertip's serial number, "
         "the "
         "surfaces and the rest that were found; these are in force "
         "for the rest of the run. What the script changed besides is not kept. A file is never overwritten: a later "
         "one gets a number.",
         "{ name, file, profile }: file is null where it was not stored; what --profile takes.",
         "Throws for a refused calibration, while armed with another encoding, or where the file cannot be written.",
         keepProfile},
    };
}

}  // namespace tacto
