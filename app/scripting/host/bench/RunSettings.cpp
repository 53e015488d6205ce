// What a protocol changes of the profile and the stimulator for its run: encoding, electrode area, calibration, scales.
#include <algorithm>
#include <optional>

#include "app/scripting/engine/ScriptSession.h"
#include "app/scripting/host/bench/BenchObject.h"
#include "app/scripting/host/bench/EncodingChange.h"
#include "core/calibration/CalibrationStore.h"
#include "core/session/SessionWriter.h"

namespace tacto::host::bench {

namespace {

Json lineJson(const StoredLine& line, std::string_view unit) {
    return {{"unit", unit},          {"gain", line.gain},
            {"offset", line.offset}, {"uncertainty_pct", line.uncertainty_pct},
            {"lowest", line.lowest}, {"highest", line.highest}};
}

std::optional<double> numberOf(const Json& value) {
    return value.is_number() ? std::optional(value.get<double>()) : std::nullopt;
}

}  // namespace

Result<void> changeEncoding(Bench& bench, const Json& changes) {
    Profile profile = bench.profile();
    Json section = toJson(profile.encoding);
    section.update(changes);  // an unknown key is refused below, by name
    auto encoding = encodingProfileFrom(section);
    if (!encoding) return failure(encoding);
    profile.encoding = *encoding;
    return bench.setProfile(profile);
}

Result<Json> setEncoding(ScriptSession& session, const Arguments& arguments) {
    return done(changeEncoding(session.bench(), arguments.object("changes")));
}

/// A script may take a smaller electrode than the operator's profile states; a larger one would move the floor of the
/// density limits (hazard H1). Where the profile states none, the operator must have given the same number.
Result<Json> setElectrodeArea(ScriptSession& session, const Arguments& arguments) {
    const auto area = arguments.number("area");
    const auto& stated = session.chosenProfile().electrodeArea;
    if (stated && !(area <= stated->value())) {
        return fail(ErrorCode::InvalidArgument,
                    "bench.setElectrodeArea: {:g} cm² is larger than the {:g} cm² of the profile; at most that is "
                    "accepted, or another profile",
                    area, stated->value());
    }
    if (!stated && session.operatorsNumber("area") != area) {
        return fail(ErrorCode::InvalidArgument,
                    "bench.setElectrodeArea: the profile states no electrode area and the operator did not give {:g} "
                    "cm²; --set area={:g}, or electrode_area_cm2 in the profile, is expected",
                    area, area);
    }
    auto profile = session.bench().profile();
    profile.electrodeArea = SquareCentimetres(area);
    if (auto set = session.bench().setProfile(profile); !set) return failure(set);
    if (session.writer() == nullptr) return Json();
    const auto said = stated ? fmt::format("Electrode area: {:g} cm² for this run; the profile states {:g} cm².", area,
                                           stated->value())
                             : fmt::format("Electrode area: {:g} cm², declared by the operator.", area);
    auto written = session.writer()->event(
        session.now(), "electrode area",
        {{"area_cm2", area}, {"declared_by", stated ? "the protocol" : "the operator"}, {"text", said}});
    if (!written) return failure(written);
    return done(session.writer()->reportItem(session.now(), {{"kind", "text"}, {"text", said}}));
}

Result<Json> electrodeArea(ScriptSession& session, const Arguments&) {
    const auto& area = session.bench().profile().electrodeArea;
    return area ? Json(area->value()) : Json();
}

Result<Json> storedCalibration(ScriptSession& session, const Arguments&) {
    const Stimulator& stimulator = *session.bench().devices().stimulator;
    const auto& device = stimulator.identity();
    auto store = CalibrationStore::open(calibrationFile());
    if (!store) return failure(store);
    const auto found = store->valid(calibratedOutput(device.serial, device.uri),
                                    amplitudeUnit(stimulator.traits().drive), utcToday(), device.simulated);
    const auto noted = [&session](Json told) {
        if (!session.own().noted(told)) session.own().note(told);
        return told;
    };
    if (!found) return noted({{"calibrated", false}, {"text", found.error().message}});
    Json out = {{"calibrated", true},
                {"text", fmt::format("stimulator {} was calibrated on {} and that holds until {}", found->serial,
                                     dateText(found->made), dateText(found->validUntil))},
                {"amplitude", lineJson(found->amplitude, found->unit)},
                {"made", dateText(found->made)},
                {"valid_until", dateText(found->validUntil)}};
    for (const auto& time : kStoredTimes) out[std::string(time.id)] = lineJson(*((*found).*time.line), "s");
    return noted(std::move(out));
}

Result<Json> useCalibration(ScriptSession& session, const Arguments& arguments) {
    return done(session.bench().useCalibration(arguments.flag("use")));
}

Result<Json> useFingertipScales(ScriptSession& session, const Arguments& arguments) {
    const Json& found = arguments.object("found");
    // What turns readings into pressure, and so into trains, is measured and not made up (hazard H7).
    if (!session.own().noted(found)) {
        return fail(ErrorCode::InvalidArgument,
                    "bench.useFingertipScales: these scales do not come from this run's own weights; what "
                    "analysis.fingertipScales() returned is expected, unchanged");
    }
    SensorScales scales;
    scales.fingertip = session.bench().devices().sensor->identity().serial;
    const auto streamUnitOf = [](const Json& row, StreamUnit calibrated) {
        return row["unit"] == symbolOf(calibrated) ? calibrated : StreamUnit::Count;
    };
    const auto& force = found["force"];
    if (force["scale"].is_number()) {
        scales.forceUnit = streamUnitOf(force, StreamUnit::Newton);
        scales.force = SensorLine{force["scale"], force["offset"], numberOf(force["scale_expanded_uncertainty"])};
    }
    const auto& taxels = found["taxels"];
    const bool all =
        std::all_of(taxels.begin(), taxels.end(), [](const Json& row) { return row["scale"].is_number(); });
    for (const auto& row : taxels) {
        if (!all) break;  // one that is dead has no pressure, and a mean over the others would be of others
        scales.taxelUnit = streamUnitOf(row, StreamUnit::Pascal);
        scales.taxels.push_back({row["scale"], row["offset_pa"], numberOf(row["scale_expanded_uncertainty"])});
    }
    Profile profile = session.bench().profile();
    profile.roughness.sensor = scales;
    // References that were read under other scales do not hold under these.
    profile.roughness.calibrated = false;
    profile.roughness.uncertainty.reset();
    if (auto used = session.bench().setProfile(profile, RBefore::Measuring); !used) return failure(used);
    return Json{{"force", scales.force.has_value()}, {"taxels", !scales.taxels.empty()}};
}

}  // namespace tacto::host::bench
