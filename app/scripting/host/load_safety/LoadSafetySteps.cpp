// The object "bench.loadSafety", the steps of the resistor-load safety check: the functions for scripts and what each
// does.
#include <algorithm>

#include "app/scripting/engine/Arguments.h"
#include "app/scripting/engine/Arming.h"
#include "app/scripting/host/bench/BenchCalls.h"
#include "app/scripting/host/load_safety/LoadCommands.h"
#include "app/scripting/host/measure/Readings.h"
#include "app/scripting/host/report/LoadTracings.h"
#include "core/analysis/load_safety/LimitMatrix.h"
#include "core/analysis/load_safety/LoadSafetyJson.h"
#include "core/analysis/load_safety/OutputDescription.h"
#include "core/results/ResultRecord.h"

namespace tacto {

namespace host::load_safety {

namespace {

constexpr const char* kUsualLoad = "1 kohm";
constexpr const char* kBurstLoad = "500 ohm";

/// The state of a check, in the formats of LoadSafetyJson.h.
struct LoadCheck {
    LoadSafetyTolerances tolerances;
    std::string knownLoad;
    int trains = 0, commands = 0;  ///< trains read per command; commands per load
    bool multimeter = false;       ///< asks for multimeter readings
    double silence_s = 0;
    Json loads = Json::array(), trips = Json::array();
    Json reference, absolute, openCircuit;
};

LoadSafetyTolerances tolerancesFrom(const Arguments& arguments) {
    LoadSafetyTolerances out;
    out.load_pct = arguments.number("settings.load_tolerance");
    out.resistor_pct = arguments.number("settings.resistor_tolerance");
    out.amplitude_pct = arguments.number("settings.amplitude_tolerance");
    out.area_pct = arguments.number("settings.area_tolerance");
    return out;
}

/// Returns the bench and its limits; the check adds loads and trips.
LoadSafetyInput inputFor(Bench& bench, const LoadSafetyTolerances& tolerances) {
    LoadSafetyInput input;
    const auto& profile = bench.profile();
    input.limits = bench.limits();
    if (bench.devices().stimulator) input.source = bench.devices().stimulator->traits();
    input.train = profile.encoding.train;
    input.command_v = profile.encoding.amplitudeMax.value();
    input.interval_s = profile.encoding.intervalMin.count();
    if (profile.electrodeArea) input.area_cm2 = profile.electrodeArea->value();
    input.loadLow = profile.loadLow;
    input.loadHigh = profile.loadHigh;
    input.tolerances = tolerances;
    return input;
}

/// Judges everything measured so far against every limit set, without loads that were not reached.
Result<Json> judged(ScriptSession& session, const LoadCheck& check) {
    LoadSafetyInput input = inputFor(session.bench(), check.tolerances);
    for (const auto& item : check.loads) {
        auto record = loadRecordFrom(item);
        if (!record) return failure(record);
        input.loads.push_back(std::move(*record));
    }
    for (const auto& item : check.trips) {
        auto trip = tripTrialFrom(item);
        if (!trip) return failure(trip);
        input.trips.push_back(std::move(*trip));
    }
    if (!check.reference.is_null()) {
        const auto reference = loadRecordFrom(check.reference);
        if (!reference) return failure(reference);
        input.reference = judgeReference(*reference, input);
        input.time = judgeTimeReference(*reference, input);
    }
    if (!check.absolute.is_null()) {
        auto row = absoluteRowFrom(check.absolute);
        if (!row) return failure(row);
        input.absolute = std::move(*row);
    }
    if (!check.openCircuit.is_null()) {
        auto open = loadStepFrom(check.openCircuit);
        if (!open) return failure(open);
        input.openCircuit = std::move(*open);
    }
    const auto found = judgeLoadSafety(input);
    Json out = toJson(found);
    out["kind"] = "load-safety";
    out["matrix"] = toJson(limitMatrixOf(found, input.limits));
    out["described"] = resultJson(describeOutput(input));
    return out;
}

/// Keeps the record in case the run ends early.
Result<Json> keep(ScriptSession& session, const LoadCheck& check) {
    auto found = judged(session, check);
    if (found) session.keepPartial(*found, Json::array());
    return found;
}

Json newLoad(const std::string& name) {
    return {{"name", name}, {"steps", Json::array()}, {"refusals", Json::array()}, {"undriven", Json::array()}};
}

/// Records a multimeter reading if the technician has a multimeter.
Result<void> enterValue(ScriptSession& session, Json& load) {
    const auto name = load["name"].get<std::string>();
    std::string key;
    for (const char c : name) {
        const bool plain = (c >= '0' && c <= '9') || (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z');
        if (plain) key += c;
        if (!plain && (key.empty() || key.back() != '-')) key += '-';
    }
    const auto enter = [&](const std::string& what, std::string text, double least, double most) {
        OperatorQuestion question;
        question.kind = OperatorQuestion::Kind::Enter;
        question.name = what + key;
        question.text = std::move(text);
        question.unit = "ohm";
        question.min = least;
        question.max = most;
        return session.ask(question);
    };
    const auto value = enter("dmm-", "Multimeter reading of " + name, 0.1, 1e7);
    if (!value) return failure(value);
    const auto uncertainty = enter("dmm-u-", "Its uncertainty (95 %)", 0, 1e6);
    if (!uncertainty) return failure(uncertainty);
    OperatorQuestion mark;
    mark.kind = OperatorQuestion::Kind::Enter;
    mark.name = "serial-" + key;
    mark.text = "Serial number or mark of " + name;
    mark.number = false;
    const auto serial = session.ask(mark);
    if (!serial) return failure(serial);
    load["dmm_ohm"] = *value;
    load["dmm_u_ohm"] = uncertainty->get<double>() / 2;
    load["serial"] = *serial;
    return {};
}

Result<void> fit(ScriptSession& session, const std::string& load) {
    session.bench().disarm();
    return bench::changeLoad(session, load, "fit-load", fmt::format("Fit the load {}", load));
}

/// Gives a command, adds the outcome to the load's list, and records the readings as a trial.
Result<void> giveInto(ScriptSession& session, Json& load, const LoadCommand& command, int trains, bool isReference) {
    auto given = give(session, command, trains);
    if (!given) return failure(given);
    load[given->list].push_back(given->entry);
    if (std::string_view(given->list) != "steps") return {};
    Json trial = isReference ? Json::object({{"type", "reference"}})
                             : Json::object({{"type", "command"}, {"load", load["name"]}});
    trial["command_v"] = command.command_v;
    trial.update(given->entry["reading"]);
    const auto condition = (isReference ? "reference " : "") + given->entry["condition"].get<std::string>();
    if (auto added = session.addTrial(condition, trial); !added) return failure(added);
    return {};
}

/// Asks to arm if the impedance check alone breaks a limit. A limit must refuse the arming: a failure for another
/// reason says nothing about the limits and is a problem of this load.
Result<void> askToArm(ScriptSession& session, Json& load, const std::string& forbids) {
    const auto problem = tryToArm(session, load["name"]);
    if (!problem) return failure(problem);
    session.bench().disarm();
    if (*problem && (*problem)->code != ErrorCode::LimitExceeded) {
        load["problem"] = (*problem)->message;
        return {};
    }
    load["refusals"].push_back({{"what", "arming"},
                                {"forbidden", true},
                                {"refused", problem->has_value()},
                                {"predicted", forbids},
                                {"reason", *problem ? (*problem)->message : ""}});
    return {};
}

/// Judges the load by its first command; a wrong load gets no other. Returns the reason, or an empty text if right.
Result<std::string> wrongValue(ScriptSession& session, const Json& load, const LoadSafetyTolerances& tolerances) {
    const auto record = loadRecordFrom(load);
    if (!record) return failure(record);
    const auto row = judgeReference(*record, inputFor(session.bench(), tolerances));
    return row.verdict == RowVerdict::Pass ? std::string() : row.reason;
}

/// Verifies the load's value first: a load with a wrong value gets no further commands.
Result<void> measureInto(ScriptSession& session, Json& load, const LoadCheck& check) {
    const auto name = load["name"].get<std::string>();
    const auto commands = commandsFor(session, name, check.commands);
    if (!commands) return failure(commands);
    if (std::ranges::none_of(*commands, &std::string::empty, &LoadCommand::notApplicable)) {
        load["not_applicable"] = commands->back().notApplicable;
        return {};
    }
    if (check.multimeter) {
        if (auto entered = enterValue(session, load); !entered) return entered;
    }
    if (auto fitted = fit(session, name); !fitted) return fitted;
    const auto& forbids = commands->front().checkForbidden;
    if (!forbids.empty()) return askToArm(session, load, forbids);
    const auto problem = tryToArm(session, name);
    if (!problem) return failure(problem);
    load["problem"] = *problem ? (*problem)->message : "";
    if (*problem) return {};
    for (const auto& command : *commands) {
        if (auto given = giveInto(session, load, command, check.trains, false); !given) return given;
        if (load["steps"].size() == 1) {
            const auto wrong = wrongValue(session, load, check.tolerances);
            if (!wrong) return failure(wrong);
            load["problem"] = *wrong;
        }
        if (load["problem"] != "") break;
    }
    session.bench().disarm();
    return {};
}

Result<Json> begin(ScriptSession& session, const Arguments& arguments) {
    LoadCheck first;
    first.tolerances = tolerancesFrom(arguments);
    first.knownLoad = arguments.text("settings.reference");
    first.trains = arguments.whole("settings.trains");
    first.commands = arguments.whole("settings.steps");
    first.multimeter = arguments.flag("settings.dmm");
    first.silence_s = arguments.number("settings.silence");
    auto absolute = bench::absoluteReading(session, arguments, first.tolerances.amplitude_pct);
    if (!absolute) return failure(absolute);
    first.absolute = std::move(*absolute);
    const auto check = session.begin(arguments.object(), std::move(first));
    if (!check) return failure(check);
    return done(keep(session, **check));
}

Result<Json> knownLoad(ScriptSession& session, const Arguments& arguments) {
    const auto check = session.begun<LoadCheck>(arguments.object());
    if (!check) return failure(check);
    const auto& name = (*check)->knownLoad;
    Json load = newLoad(name);
    if ((*check)->multimeter) {
        if (auto entered = enterValue(session, load); !entered) return failure(entered);
    }
    if (auto fitted = fit(session, name); !fitted) return failure(fitted);
    const auto problem = tryToArm(session, name);
    if (!problem) return failure(problem);
    load["problem"] = *problem ? (*problem)->message : "";
    if (!*problem) {
        const auto commands = commandsFor(session, name, (*check)->commands);
        if (!commands) return failure(commands);
        if (auto given = giveInto(session, load, commands->front(), (*check)->trains, true); !given)
            return failure(given);
    }
    session.bench().disarm();
    (*check)->reference = std::move(load);
    const auto found = keep(session, **check);
    if (!found) return found;
    const auto passed = [](const Json& row) {
        return (row["item"] != "reference" && row["item"] != "time_reference") || row["verdict"] == "pass";
    };
    const auto& absolute = (*check)->absolute;
    return Json(std::ranges::all_of((*found)["rows"], passed) && (absolute.is_null() || absolute["passed"] == true));
}

/// The result of each load goes at once into the session and to the window.
Result<Json> load(ScriptSession& session, const Arguments& arguments) {
    const auto check = session.begun<LoadCheck>(arguments.object());
    if (!check) return failure(check);
    const auto name = arguments.text("name");
    const auto& set = benchLoads();
    const auto named = std::ranges::find(set, name, &NamedLoad::name);
    if (named == set.end()) return arguments.wrong("name", name, "the name of one of bench.loads");
    const auto isOfIt = [&name](const Json& row) { return row["name"] == name; };
    if (std::ranges::any_of((*check)->loads, isOfIt)) return arguments.wrong("name", name, "a load that is new");
    Json made = newLoad(name);
    if (named->load.kind == LoadKind::Open || named->load.kind == LoadKind::Short) {
        auto trip = tripWhenArming(session, name, kUsualLoad);
        if (!trip) return trip;
        (*check)->trips.push_back(std::move(*trip));
    } else if (auto measured = measureInto(session, made, **check); !measured) {
        return failure(measured);
    }
    (*check)->loads.push_back(std::move(made));
    const auto found = keep(session, **check);
    if (!found) return found;
    const auto& rows = (*found)["loads"];
    Json trial = *std::ranges::find_if(rows, isOfIt);
    trial["type"] = "load";
    trial["load"] = name;
    return done(session.addTrial(name, trial));
}

/// Delivers the strongest trains into an open circuit and measures their voltage.
Result<Json> trip(ScriptSession& session, const Arguments& arguments) {
    const auto check = session.begun<LoadCheck>(arguments.object());
    if (!check) return failure(check);
    const auto becomes = arguments.text("becomes");
    const auto commands = commandsFor(session, kUsualLoad, (*check)->commands);
    if (!commands) return failure(commands);
    const auto strongest = becomes == "open" ? strongestOf(*commands).value_or(0) : 0;
    auto found =
        tripWhileDelivering(session, becomes, kUsualLoad, static_cast<double>(strongest) / ((*check)->commands - 1));
    if (!found) return found;
    (*check)->trips.push_back(*found);
    if (becomes == "open" && !(*found)["captures"].empty()) {
        auto reading = measure::loadReading(session, {.trains = (*found)["captures"], .byVoltage = true});
        if (!reading) return reading;
        const double command_v = (*found)["command_v"].get<double>();
        Json trial = {{"command_v", command_v}};
        trial.update(*reading);
        (*check)->openCircuit = {
            {"command_v", command_v}, {"interval_s", (*found)["interval_s"]}, {"reading", std::move(*reading)}};
        if (auto added = session.addTrial(fmt::format("open circuit, {:.1f} V", command_v), trial); !added)
            return failure(added);
    }
    return done(keep(session, **check));
}

Result<Json> silence(ScriptSession& session, const Arguments& arguments) {
    const auto check = session.begun<LoadCheck>(arguments.object());
    if (!check) return failure(check);
    auto found = tripBySilence(session, kUsualLoad, (*check)->silence_s);
    if (!found) return found;
    (*check)->trips.push_back(std::move(*found));
    return done(keep(session, **check));
}

Result<Json> judge(ScriptSession& session, const Arguments& arguments) {
    const auto check = session.begun<LoadCheck>(arguments.object());
    if (!check) return failure(check);
    return keep(session, **check);
}

/// Captures the strongest trains that the limits allow; null if there are none.
Result<Json> burstOf(ScriptSession& session, int count) {
    const auto commands = commandsFor(session, kBurstLoad, count);
    if (!commands) return failure(commands);
    const auto strongest = strongestOf(*commands);
    if (!strongest) return Json();
    if (auto fitted = fit(session, kBurstLoad); !fitted) return failure(fitted);
    const auto problem = tryToArm(session, kBurstLoad);
    if (!problem) return failure(problem);
    if (*problem) return Json();
    auto burst = captureBurst(session, (*commands)[*strongest]);
    if (!burst) return burst;
    (*burst)["load"] = kBurstLoad;
    (*burst)["condition"] = fmt::format("{}, burst", kBurstLoad);
    session.bench().disarm();
    Json ids = Json::array();
    for (const auto& capture : (*burst)["captures"]) ids.push_back(capture["capture"]);
    if (auto added = session.addTrial((*burst)["condition"], {{"captures", ids}}); !added) return failure(added);
    return burst;
}

Result<Json> tracings(ScriptSession& session, const Arguments& arguments) {
    const auto check = session.begun<LoadCheck>(arguments.object());
    if (!check) return failure(check);
    const auto burst = burstOf(session, (*check)->commands);
    if (!burst) return burst;
    if (session.writer() == nullptr) return Json();  // tens of thousands of samples are not needed without a report
    for (const auto& item : report::loadTracings(session, (*check)->loads, *burst)) {
        if (auto written = session.reportItem(item); !written) return failure(written);
    }
    return Json();
}

}  // namespace

}  // namespace host::load_safety

std::vector<HostFunction> loadSafetyFunctions() {
    using namespace takes;
    constexpr std::string_view kErrors =
        "Throws for a fault that was not provoked, when fewer trains came, when the bench cannot change the load, "
        "without the operator's confirmation, and when the run is stopped.";
    std::vector<HostParameter> settings{
        object("settings", "the parameters of the run"),
        whole("settings.trains", "read of a command; more are delivered, one of them to reach the level").range(1, 20),
        whole("settings.steps", "commands on a load, from the weakest amplitude to the strongest").range(2, 101),
        flag("settings.dmm", "readings of a multimeter are asked for"),
        text("settings.reference", "the known load"),
        number("settings.load_tolerance", "%", "of a load").range(0.01, 50),
        number("settings.resistor_tolerance", "%", "of a resistor where no multimeter read it").range(0.01, 50),
        number("settings.amplitude_tolerance", "%", "of the amplitude").range(0.01, 50),
        number("settings.area_tolerance", "%", "of the electrode area").range(0.01, 50),
        number("settings.silence", "s", "for which the heartbeat is withheld").range(0.2, 10)};
    for (auto& one : host::bench::absoluteSettings()) settings.push_back(std::move(one));
    return {
        {.name = "begin",
         .parameters = std::move(settings),
         .text =
             "Begins the check, and reads the reference source where the settings have one. What the check has come "
             "to is kept from now on, in case the run ends early.",
         .errors = "As bench.readReference().",
         .needs = Role::Stimulator,
         .failsDisarmed = true,
         .call = host::load_safety::begin},
        {.name = "knownLoad",
         .text = "Before anything is believed: fits the known load and reads its weakest command. Instruments that "
                 "cannot read it can judge nothing.",
         .returns = "Whether load, time base and reference source read as what they are.",
         .errors = kErrors,
         .asks = {"dmm-*", "dmm-u-*", "serial-*", kConfirmArming, "fit-load"},
         .needs = Role::Oscilloscope,
         .failsDisarmed = true,
         .call = host::load_safety::knownLoad},
        {.name = "load",
         .parameters = {text("name", "one of bench.loads")},
         .text = "Fits a load, verifies its value, gives the commands from the weakest up and reads each. What the "
                 "limits forbid is asked for once and must be refused; arming into an open or short circuit too.",
         .errors = kErrors,
         .asks = {"dmm-*", "dmm-u-*", "serial-*", kConfirmArming, "fit-load"},
         .needs = Role::Oscilloscope,
         .failsDisarmed = true,
         .call = host::load_safety::load},
        {.name = "trip",
         .parameters = {text("becomes", "what the load becomes").oneOf({"open", "short", "intermittent"})},
         .text = "Delivers trains at the shortest interval into 1 kohm and changes the load under way. Output must end "
                 "before the next train. The fault that was provoked is reset and does not end the run.",
         .errors = kErrors,
         .asks = {kConfirmArming},
         .needs = Role::Stimulator,
         .failsDisarmed = true,
         .call = host::load_safety::trip},
        {.name = "silence",
         .text =
             "Delivers the weakest trains into 1 kohm and withholds the heartbeat. Output must end 100 ms later and "
             "stay off.",
         .errors = kErrors,
         .asks = {kConfirmArming},
         .needs = Role::Stimulator,
         .failsDisarmed = true,
         .call = host::load_safety::silence},
        {.name = "judge",
         .text = "Judges everything measured so far against every limit set with its guard band.",
         .members = loadSafetyKind().members,
         .returns =
             " with kind, matrix and described, for verdict(): what is missing reads \"not evaluated\", and then the "
             "verdict is not a pass. matrix is { loads, lines }, every limit once with a cell per load and the margin "
             "left, "
             "the smallest first.",
         .call = host::load_safety::judge},
        {.name = "tracings",
         .text = "Adds the strongest trains into 500 ohm, 2 kohm and 10 kohm to the report on one time axis, and a "
                 "burst into 500 ohm on another, which it captures.",
         .errors = kErrors,
         .asks = {kConfirmArming, "fit-load"},
         .needs = Role::Oscilloscope,
         .failsDisarmed = true,
         .call = host::load_safety::tracings},
    };
}

}  // namespace tacto
