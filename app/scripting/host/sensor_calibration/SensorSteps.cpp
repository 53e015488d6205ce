// The object "bench.sensorCalibration", the steps of a fingertip's calibration and of reading a fingertip: the
// functions for scripts and what each does.
#include <algorithm>
#include <cmath>

#include "app/scripting/host/plot/PlotFigures.h"
#include "app/scripting/host/report/Cells.h"
#include "app/scripting/host/sensor_calibration/FingertipCalibration.h"
#include "core/analysis/sensor_calibration/SensorCalibrationJson.h"
#include "core/analysis/statistics/StatisticsJson.h"
#include "core/analysis/statistics/Verdict.h"
#include "core/base/JsonText.h"
#include "core/base/QuantityText.h"

namespace tacto {

namespace host::sensor_calibration {

namespace {

using report::digitsOf;

constexpr std::size_t kMaxWeighings = 10'000;  // in one direction
constexpr double kStandsOut = 5;               // in standard deviations of the readings at rest

std::string toldApart(const Json& results) {
    const Json& surfaces = results.at("surfaces");
    const Json& distance = results.at("d_prime").at("R");
    // With a single repeat the spread is unknown, not 0.
    return fmt::format("{} and {} are told apart: d′ of R is {} (95 %: {} to {}), at least 1 is wanted",
                       surfaces.at(0).at("name").get<std::string>(), surfaces.at(1).at("name").get<std::string>(),
                       digitsOf(numberOr(distance, "value"), 3), digitsOf(numberOr(distance, "low"), 3),
                       digitsOf(numberOr(distance, "high"), 3));
}

std::string whyNot(const KnownWeight& check) {
    const auto unit = check.unit ? symbolOf(*check.unit) : std::string_view();
    if (std::isnan(check.measured))
        return fmt::format(
            "the known-reference check was not evaluated: nothing was read under {} N; nothing was calibrated",
            digitsOf(check.reference_n, 4));
    const bool inNewtons = check.unit == StreamUnit::Newton;
    if (inNewtons && std::isnan(check.expanded))
        return fmt::format(
            "the known-reference check was not evaluated: {} N was read under {} N, and how well the "
            "weight, local gravity or the reading is known was not stated; nothing was calibrated",
            digitsOf(check.measured, 4), digitsOf(check.reference_n, 4));
    return fmt::format(
        "the known-reference check {}: {} was read under {} N{}; nothing was calibrated",
        check.verdict == "fail" ? "failed" : "is indeterminate",
        inNewtons ? measuredText(check.measured, check.expanded, std::string(unit))
                  : fmt::format("{} {}", digitsOf(check.measured, 4), unit),
        digitsOf(check.reference_n, 4),
        inNewtons ? fmt::format("; {:.4g} % are allowed, uncertainty included", check.allowed_pct) : std::string());
}

}  // namespace

KnownWeight judgeWeight(const std::optional<WeightReading>& reading, const FingertipRest& rest,
                        const WeighingTolerances& known, double tolerance_pct) {
    KnownWeight check;
    check.allowed_pct = tolerance_pct;
    if (!reading) return check;
    check.weighed = true;
    check.mass_g = reading->mass_g;
    check.reference_n = reading->reference_n;
    if (reading->inUse) {
        check.unit = reading->inUse->unit;
        check.measured = reading->inUse->mean - (rest.inUse ? rest.inUse->mean : kNaN);
    }
    if (check.unit != StreamUnit::Newton) {
        if (std::isfinite(check.measured))
            check.verdict =
                nameOf(std::abs(check.measured) > kStandsOut * rest.force.sd ? Verdict::Pass : Verdict::Fail);
    } else if (std::isfinite(check.measured)) {
        const double percent = 100 / check.reference_n, ofWeight = known.weights > 0 ? known.weights : kNaN;
        check.expanded = weightError(*reading, *rest.inUse, ofWeight, known.gravity).expanded;
        check.deviation_pct = percent * (check.measured - check.reference_n);
        check.expanded_pct = percent * check.expanded;
        check.verdict = guardBandedName(check.deviation_pct, check.expanded_pct, tolerance_pct);
    }
    if (!check.passed()) check.reason = whyNot(check);
    return check;
}

namespace {

/// The state of a calibration.
struct SensorRun {
    std::vector<GivenSurface> given;
    std::vector<double> masses;
    int repeats = 0;  ///< how often each weight is put on and taken off
    bench::Sliding sliding;
    double duration_s = 0, gravity_m_s2 = 0, area_cm2 = 0, reference_pct = 0;
    WeighingTolerances known;
    bool store = false;
    FingertipRest rest;
    std::vector<Weighed> weighed;
    std::vector<SlidSurface> surfaces;
    std::vector<Json> slides;  ///< the slides over each surface, in display order
    FingertipScales scales;
    Json results = Json::object();
    std::string notKnown;  ///< why the known weight does not read correctly
};

Result<void> record(ScriptSession& session, std::string_view name, const Json& values, const Json& results) {
    if (auto kept = session.keepMeasurement(name, values); !kept) return kept;
    session.keepPartial(results, Json::array());
    return {};
}

Result<void> readRestInto(ScriptSession& session, SensorRun& run, std::string_view name) {
    auto rest = readFingertipRest(session, 3);
    if (!rest) return failure(rest);
    run.rest = std::move(*rest);
    run.results["rest"] = toJson(run.rest);
    return record(session, name, run.results["rest"], run.results);
}

Result<void> setUp(ScriptSession& session, const std::vector<GivenSurface>& surfaces) {
    if (session.isSimulated()) return session.reportText("Set-up: the simulated fingertip on the simulated surfaces.");
    std::vector<std::string> names;
    for (const auto& surface : surfaces) names.push_back(surface.name);
    return session.askTo("setup",
                         fmt::format("The fingertip is mounted as in use, the surfaces ({}) are clean, and the Ra "
                                     "and Rz given are of these very specimens",
                                     fmt::join(names, ", ")));
}

Result<void> lift(ScriptSession& session) {
    auto& surface = session.bench().devices().surface;
    return surface ? surface->present("", MillimetresPerSecond(0), Newtons(0)) : Result<void>();
}

Result<Json> begin(ScriptSession& session, const Arguments& arguments) {
    const auto percent = [&arguments](const char* name) {
        const double given = arguments.number(name);
        return given > 0 ? given / 100 : kNaN;
    };
    SensorRun first;
    auto given = surfacesGiven(session, arguments);
    if (!given) return failure(given);
    first.given = std::move(*given);
    auto masses = massesGiven(arguments.text("settings.weights_g"));
    if (!masses) return failure(masses);
    first.masses = std::move(*masses);
    first.repeats = arguments.whole("settings.weight_repeats");
    if (first.masses.size() > kMaxWeighings / static_cast<std::size_t>(first.repeats))
        return arguments.wrong("weights_g", first.masses.size(),
                               fmt::format("weights times the repeats at most {}", kMaxWeighings));
    first.sliding = {{}, arguments.number("settings.speed_mm_s"), arguments.number("settings.force_n")};
    first.duration_s = arguments.number("settings.duration_s");
    first.gravity_m_s2 = arguments.number("settings.gravity_m_s2");
    first.area_cm2 = arguments.number("settings.contact_area_cm2");
    first.reference_pct = arguments.number("settings.reference_tolerance_pct");
    first.known = {arguments.number("settings.weight_tolerance_pct") / 100, percent("settings.gravity_tolerance_pct"),
                   percent("settings.contact_area_tolerance_pct")};
    first.store = arguments.flag("settings.store");
    const auto begun = session.begin(arguments.object(), std::move(first));
    if (!begun) return failure(begun);
    SensorRun& run = **begun;

    if (auto ready = setUp(session, run.given); !ready) return failure(ready);
    run.results = {{"sensor", streamsOf(session)}, {"instruments", bench::devicesOf(session)}};
    Json names = Json::array();
    for (const auto& surface : run.given) {
        run.surfaces.push_back({surface.name, surface.ra_um, surface.rz_um, {}, surface.source});
        run.slides.push_back(Json::array());
        names.push_back(surface.name);
        run.results["surfaces"].push_back(toJson(run.surfaces.back()));
    }
    session.keepPartial(run.results, Json::array());
    if (auto read = readRestInto(session, run, "fingertip at rest"); !read) return failure(read);
    return names;
}

Result<Json> knownWeight(ScriptSession& session, const Arguments& arguments) {
    const auto begun = session.begun<SensorRun>(arguments.object());
    if (!begun) return failure(begun);
    SensorRun& run = **begun;
    std::optional<WeightReading> reading;
    if (!run.masses.empty() && run.rest.force.n > 0) {
        auto read = readWeight(session, run.masses.back(), run.gravity_m_s2, 2);
        if (!read) return failure(read);
        reading = std::move(*read);
    }
    const auto known = judgeWeight(reading, run.rest, run.known, run.reference_pct);
    run.results["reference"] = toJson(known);
    run.notKnown = known.reason;
    if (reading) {
        if (auto kept = session.keepMeasurement("known-reference check", run.results["reference"]); !kept)
            return failure(kept);
    }
    session.keepPartial(run.results, Json::array());
    return Json(run.notKnown.empty());
}

Result<Json> weighings(ScriptSession& session, const Arguments& arguments) {
    const auto run = session.begun<SensorRun>(arguments.object());
    if (!run) return failure(run);
    Json steps = Json::array();
    const auto& masses = (*run)->masses;
    for (int repeat = 1; repeat <= (*run)->repeats; ++repeat) {
        const auto add = [&](double mass_g, const char* direction) {
            steps.push_back({{"mass_g", mass_g}, {"direction", direction}, {"repeat", repeat}});
        };
        for (const double mass_g : masses) add(mass_g, "up");
        std::for_each(masses.rbegin(), masses.rend(), [&](double mass_g) { add(mass_g, "down"); });
    }
    return steps;
}

Result<Json> weigh(ScriptSession& session, const Arguments& arguments) {
    const auto begun = session.begun<SensorRun>(arguments.object());
    if (!begun) return failure(begun);
    SensorRun& run = **begun;
    const double mass_g = arguments.number("step.mass_g");
    if (std::ranges::find(run.masses, mass_g) == run.masses.end())
        return arguments.wrong("mass_g", mass_g, "one of the weights");
    auto reading = readWeight(session, mass_g, run.gravity_m_s2, 2);
    if (!reading) return failure(reading);
    const auto direction = arguments.text("step.direction") == "up" ? SweepDirection::Up : SweepDirection::Down;
    run.weighed.push_back({std::move(*reading), direction, arguments.whole("step.repeat")});
    const Json row = toJson(run.weighed.back());
    run.results["weights"].push_back(row);
    auto added = session.addTrial(fmt::format("weight {} g", mass_g), row);
    session.keepPartial(run.results, Json::array());
    return done(added);
}

/// Applies the scales before the surfaces are read, so that the surfaces are read as in later use.
Result<Json> scale(ScriptSession& session, const Arguments& arguments) {
    const auto begun = session.begun<SensorRun>(arguments.object());
    if (!begun) return failure(begun);
    SensorRun& run = **begun;
    if (!run.weighed.empty()) {
        if (auto lifted = lift(session); !lifted) return failure(lifted);
    }
    run.scales = fingertipScales(run.weighed, run.area_cm2, run.known);
    const Json scales = toJson(run.scales);
    run.results.update(scales);
    run.results["scaled"] = {{"force", false}, {"taxels", false}};
    if (auto kept = record(session, "force and taxels", scales, run.results); !kept) return failure(kept);
    if (!run.weighed.empty()) {
        auto used = useScales(session, run.scales);
        if (!used) return used;
        run.results["scaled"] = std::move(*used);
        if (auto read = readRestInto(session, run, "fingertip at rest, scaled"); !read) return failure(read);
    }
    Json force = scales["force"];
    if (run.scales.force.unit != StreamUnit::Newton || !run.scales.force.found) return Json();
    force["quantity"] = "force";
    force["offset"] = force["offset_reading"];
    return done(session.reportItem({{"kind", "figure"},
                                    {"caption", "Force against weights"},
                                    {"figure", plot::calibrationFigure(force, "measured")}}));
}

Result<Json> slide(ScriptSession& session, const Arguments& arguments) {
    const auto begun = session.begun<SensorRun>(arguments.object());
    if (!begun) return failure(begun);
    SensorRun& run = **begun;
    const auto name = arguments.text("surface");
    const auto surface = std::ranges::find(run.surfaces, name, &SlidSurface::name);
    if (surface == run.surfaces.end()) return arguments.wrong("surface", name, "one of the surfaces");
    run.sliding.material = name;
    auto reading = readSliding(session, run.sliding, run.duration_s, run.rest.levels);
    if (!reading) return failure(reading);
    const Json row = toJson(Slid{*reading, name});
    surface->slides.push_back(*reading);
    run.slides[static_cast<std::size_t>(surface - run.surfaces.begin())].push_back(row);
    auto added = session.addTrial(name, row);
    Json all = Json::array();
    for (const auto& rows : run.slides) all.insert(all.end(), rows.begin(), rows.end());
    run.results["slides"] = std::move(all);
    session.keepPartial(run.results, Json::array());
    if (!added) return failure(added);
    return done(lift(session));
}

/// Makes a profile from the findings, unless the references cannot be told apart.
Result<void> keepFound(ScriptSession& session, const SensorCalibration& found, SensorRun& run) {
    run.results["profile"] = nullptr;
    if (!found.accepted)
        return session.reportText(
            fmt::format("Refused: {}. The profile stays as it was.", fmt::join(found.reasons, "; ")));
    auto kept = keepProfile(session, found, run.area_cm2, run.store);
    if (!kept) return failure(kept);
    const auto name = kept->at("name").get<std::string>(), file = textOr(*kept, "file");
    run.results["profile"] = std::move(*kept);
    if (auto noted = session.keepEvent("sensor calibrated", {{"name", name}, {"file", run.results["profile"]["file"]}});
        !noted)
        return noted;
    return session.reportText(
        fmt::format("The profile \"{}\" holds the scales{}.", name,
                    file.empty() ? "; it is in the session and was not kept as a file" : " and is kept as " + file));
}

Result<void> sayRanking(ScriptSession& session, const SensorCalibration& found) {
    if (!found.ranking)
        return session.reportText(
            "Spearman's rank correlation of R against Ra: not evaluated; five or more surfaces of known Ra are "
            "wanted.");
    if (!session.isSimulated()) return {};
    return session.reportText(
        "On the simulated fingertip the ranking holds by construction: the relief of its surfaces follows their Ra.");
}

/// The verdict covers the references, and force and taxels if weights were used. A fingertip that does not follow the
/// weights is faulty.
void addVerdict(Json& results, const FingertipScales& found) {
    Json verdict = results.at("verdict");
    Json reasons = results.at("accepted") == true ? Json::array({toldApart(results)}) : results.at("reasons");
    const auto putFirst = [&reasons](const std::string& reason) { reasons.insert(reasons.begin(), reason); };
    if (found.force.asked && verdict == "pass") {
        verdict = "indeterminate";
        putFirst(found.force.reason);
    }
    std::vector<FingertipScale> scales{found.force};
    scales.insert(scales.end(), found.taxels.begin(), found.taxels.end());
    for (const auto& scale : scales) {
        if (scale.follows) continue;
        verdict = "fail";
        putFirst(scale.reason);
    }
    results["verdict"] = verdict;
    results["reasons"] = reasons;
}

Result<Json> conclude(ScriptSession& session, const Arguments& arguments) {
    const auto begun = session.begun<SensorRun>(arguments.object());
    if (!begun) return failure(begun);
    SensorRun& run = **begun;
    if (!run.notKnown.empty()) {
        run.results["verdict"] = "indeterminate";
        run.results["reasons"] = Json::array({run.notKnown});
        return run.results;
    }
    for (const char* step : {"reference", "force"}) {
        if (run.results.contains(step)) continue;
        return fail(ErrorCode::InvalidArgument, "{0}.conclude: {0}.knownWeight() and {0}.scale() are expected first",
                    arguments.object());
    }
    const auto found = calibrateSensor(run.surfaces, session.bench().profile().roughness, run.rest.levels);
    if (!found) return failure(found);
    const Json shown = toJson(*found);
    if (auto kept = session.keepMeasurement("sensor calibration", shown); !kept) return failure(kept);
    run.results.update(shown);
    session.keepPartial(run.results, Json::array());
    if (auto said = sayRanking(session, *found); !said) return failure(said);
    if (auto kept = keepFound(session, *found, run); !kept) return failure(kept);
    addVerdict(run.results, run.scales);
    return run.results;
}

Result<Json> measureRest(ScriptSession& session, const Arguments& arguments) {
    const auto rest = readFingertipRest(session, arguments.number("options.duration_s"));
    if (!rest) return failure(rest);
    return toJson(*rest);
}

Result<Json> measureWeight(ScriptSession& session, const Arguments& arguments) {
    const auto reading = readWeight(session, arguments.number("mass_g"), arguments.number("options.gravity_m_s2"),
                                    arguments.number("options.duration_s"));
    if (!reading) return failure(reading);
    return toJson(*reading);
}

}  // namespace

}  // namespace host::sensor_calibration

std::vector<HostFunction> sensorCalibrationFunctions() {
    using namespace takes;
    constexpr std::string_view kErrors =
        "Throws without an answer, when too few samples came, or when the run is stopped.";
    std::vector<HostParameter> settings{object("settings", "the parameters of the run")};
    for (auto& one : host::sensor_calibration::surfaceSettings()) settings.push_back(std::move(one));
    for (auto& one : std::vector<HostParameter>{
             text("settings.weights_g", "in g, separated by ;; empty for none").orEmpty(),
             whole("settings.weight_repeats", "of each weight, each way").range(1, 1000),
             number("settings.weight_tolerance_pct", "%", "half-width that all weights share; 0: not known")
                 .range(0, 50),
             number("settings.gravity_m_s2", "m/s2", "local gravity").range(9.7, 9.9),
             number("settings.gravity_tolerance_pct", "%", "half-width of it; 0: not known").range(0, 50),
             number("settings.contact_area_cm2", "cm2", "area under a weight; 0: not known").range(0, 100),
             number("settings.contact_area_tolerance_pct", "%", "half-width of it; 0: not known").range(0, 90),
             number("settings.reference_tolerance_pct", "%", "within which the known weight must read").range(0, 100),
             number("settings.speed_mm_s", "mm/s", "sliding speed").range(0, 1000),
             number("settings.force_n", "N", "normal force").range(0, 50),
             number("settings.duration_s", "s", "of a slide").range(1, 600),
             flag("settings.store", "the profile is kept as a file")})
        settings.push_back(std::move(one));
    return {
        {.name = "begin",
         .parameters = std::move(settings),
         .text =
             "Reads what the operator says of surfaces and weights, has the set-up confirmed, and reads the fingertip "
             "at rest. What was found is kept from now on, in case the run ends early.",
         .returns = "The names of the surfaces: the two references first.",
         .errors = "Throws for a text that cannot be read, a surface that is named twice, an Rz below its Ra, a rough "
                   "reference that is not the rougher, one weight alone or twice, and a file that the operator did not "
                   "give; as bench.measureRest().",
         .asks = {"setup"},
         .needs = Role::Sensor,
         .failsDisarmed = true,
         .call = host::sensor_calibration::begin},
        {.name = "knownWeight",
         .text = "Before anything is believed: the largest weight must read as what it is.",
         .returns = "false where it does not; true also where there is no weight or no force sensor.",
         .errors = kErrors,
         .needs = Role::Sensor,
         .failsDisarmed = true,
         .call = host::sensor_calibration::knownWeight},
        {.name = "weighings",
         .kind = HostKind::Property,
         .text = "The order in which weights are laid on, up and down, again and again: what stays behind when weight "
                 "is taken off shows as hysteresis.",
         .returns = "List of { mass_g, direction, repeat }.",
         .call = host::sensor_calibration::weighings},
        {.name = "weigh",
         .parameters = {object("step", "of bench.sensorCalibration.weighings"),
                        number("step.mass_g", "g", "of the weight").range(0, 5000),
                        text("step.direction", "of the sweep").oneOf({"up", "down"}),
                        whole("step.repeat", "of the sweep").range(1, 1000)},
         .text = "Puts a weight on the resting fingertip (question weight-MASSg on a rig that cannot), reads force and "
                 "taxels, and records it as a trial.",
         .errors = kErrors,
         .needs = Role::Sensor,
         .failsDisarmed = true,
         .call = host::sensor_calibration::weigh},
        {.name = "scale",
         .text =
             "Lifts the finger. Weights become the scales of force and taxels, which are in use for the rest of the "
             "run; rest is read again under them.",
         .errors = kErrors,
         .needs = Role::Sensor,
         .failsDisarmed = true,
         .call = host::sensor_calibration::scale},
        {.name = "slide",
         .parameters = {text("surface", "one of those that begin() returned")},
         .text = "Slides over a surface, reads every feature of it, records it as a trial, and lifts the finger.",
         .errors = kErrors,
         .asks = {"surface-*"},
         .needs = Role::Sensor,
         .failsDisarmed = true,
         .call = host::sensor_calibration::slide},
        {.name = "conclude",
         .text =
             "Finds the scale of R from the two references, how far apart they are in d′, and Spearman's rank "
             "correlation of R against Ra where five or more surfaces have one. Accepted, it becomes a profile: the "
             "one that the operator chose with these scales, in force for the rest of the run.",
         .returns = "What verdict() takes.",
         .errors = "Throws for fewer than three slides of a reference, and where the profile cannot be written.",
         .needs = Role::Sensor,
         .call = host::sensor_calibration::conclude},
    };
}

std::vector<HostFunction> fingertipFunctions() {
    using namespace takes;
    constexpr std::string_view kErrors =
        "Throws without an answer, when something touched the resting fingertip, when too few samples came, or when "
        "the "
        "run is stopped.";
    return {
        {.name = "profilometer",
         .parameters = {text(
             "path", "path of a CSV that a profilometer exported: a parameter that the operator gave, or entered")},
         .text = "Finds Ra and Rz in it, by name and unit.",
         .returns = "{ ra_um, rz_um, ra_values, rz_values }: means over that many values; rz_um is null where it is "
                    "not stated.",
         .errors = "Throws for a path that the operator did not give; with the line and the reason where no Ra with a "
                   "unit is found.",
         .call = host::sensor_calibration::profilometer},
        {.name = "measureRest",
         .parameters = {number("options.duration_s", "s", "of reading").range(0.5, 600).otherwise(3)},
         .text =
             "Disarms, lifts the finger (question rest on a rig that cannot) and reads the fingertip without contact.",
         .members = restMembers(),
         .returns =
             ": mean_square is the power of the acceleration at rest, in unit squared, rms its root in unit; both are "
             "null without acceleration; "
             "force is a statistic in the sensor's unit, force_in_use { mean, unit, u } as the profile scales it, u "
             "the standard uncertainty of the mean.",
         .errors = kErrors,
         .needs = Role::Sensor,
         .failsDisarmed = true,
         .call = host::sensor_calibration::measureRest},
        {.name = "measureWeight",
         .parameters = {number("mass_g", "g", "of the weight").range(0, 5000),
                        number("options.gravity_m_s2", "m/s2", "local gravity").range(9.7, 9.9).otherwise(9.80665),
                        number("options.duration_s", "s", "of reading").range(0.5, 600).otherwise(2)},
         .text =
             "Disarms, puts a weight on the resting fingertip (question weight-MASSg on a rig that cannot) and reads "
             "force and taxels.",
         .members = weightMembers(),
         .returns = ": means, in the sensor's own units; a unit is left out without such a sensor, and force_in_use is "
                    "as bench.measureRest() has it.",
         .errors = kErrors,
         .needs = Role::Sensor,
         .failsDisarmed = true,
         .call = host::sensor_calibration::measureWeight},
    };
}

}  // namespace tacto
