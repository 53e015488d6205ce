// Changes that a protocol makes to the profile and the stimulator for its run: encoding, electrode area and
// calibration.
#include <algorithm>
#include <optional>

#include "app/scripting/host/bench/BenchCalls.h"
#include "core/calibration/CalibrationStore.h"
#include "core/session/SessionWriter.h"

namespace tacto::host::bench {

namespace {

Json lineJson(const StoredLine& line, std::string_view unit) {
    return {{"unit", unit},          {"gain", line.gain},
            {"offset", line.offset}, {"uncertainty_pct", line.uncertainty_pct},
            {"lowest", line.lowest}, {"highest", line.highest}};
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

Result<Json> storedCalibration(ScriptSession& session) {
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

namespace {

Result<Json> setEncoding(ScriptSession& session, const Arguments& arguments) {
    return done(changeEncoding(session.bench(), arguments.object("changes")));
}

/// A script may use a smaller electrode than the operator's profile states. A larger one would raise what the density
/// limits allow (hazard H1). If the profile states no area, the operator must have given the same number.
Result<Json> setElectrodeArea(ScriptSession& session, const Arguments& arguments) {
    const auto area = arguments.number("area");
    const auto& stated = session.chosenProfile().electrodeArea;
    if (stated && !(area <= stated->value())) {
        return fail(ErrorCode::InvalidArgument,
                    "bench.setElectrodeArea: {:g} cm² is larger than the {:g} cm² of the profile; use at most "
                    "that, or another profile",
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

Result<Json> useCalibration(ScriptSession& session, const Arguments& arguments) {
    return done(session.bench().useCalibration(arguments.flag("use")));
}

Result<Json> calibration(ScriptSession& session, const Arguments&) { return storedCalibration(session); }

}  // namespace

}  // namespace tacto::host::bench

namespace tacto {

std::vector<HostFunction> settingFunctions() {
    using namespace takes;
    return {
        {.name = "setEncoding",
         .parameters = {object(
             "changes", "keys of a profile's encoding section (amplitude_min_v, interval_max_s, phase_width_us, ...)")},
         .text = "Changes how R and P become a train, for the rest of the run. The output must be disarmed.",
         .errors = "Throws while armed; for an unknown key, a wrong type, or a range that does not fit.",
         .call = host::bench::setEncoding},
        {.name = "setElectrodeArea",
         .parameters = {number("area", "cm2",
                               "of the smallest electrode: at most the profile's; where the profile states none, what "
                               "the operator gave as the parameter area")
                            .range(1e-3, 1e3)},
         .text = "Sets the area that densities are judged with, for this run. The session and its report say so.",
         .errors = "Throws while armed; for an area that is larger than the profile's, or that only the script states.",
         .call = host::bench::setElectrodeArea},
        {.name = "calibration",
         .kind = HostKind::Property,
         .text = "The stored calibration that holds today for the stimulator that is connected.",
         .returns = "{ calibrated, text }, and where calibrated: { made, valid_until, amplitude, interval, width, gap "
                    "}, each of these { unit, gain, offset, uncertainty_pct, lowest, highest }.",
         .errors = "Throws without a stimulator, or when the store is damaged.",
         .needs = Role::Stimulator,
         .call = host::bench::calibration},
        {.name = "useCalibration",
         .parameters = {flag("use", "false: the commands are programmed as they are; true: as at the start")},
         .text = "Ignores the stored calibration for the rest of the run, as a new calibration must, or applies it "
                 "again. The output must be disarmed.",
         .errors = "Throws while armed.",
         .call = host::bench::useCalibration},
    };
}

}  // namespace tacto
