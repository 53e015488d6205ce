// Measuring what went into a load, judging the whole set, its tracings, and what is kept of a run that ends early.
#include <algorithm>
#include <cmath>
#include <span>

#include "app/scripting/GivenCaptures.h"
#include "app/scripting/HostFunction.h"
#include "core/analysis/LimitMatrix.h"
#include "core/analysis/LoadSafetyJson.h"
#include "core/analysis/OutputDescription.h"

namespace tacto {

namespace {

using Json = nlohmann::json;

/// What the last trains were told, one more than were captured, if all were told the same: an instrument whose time
/// stamps are too coarse to tell trains apart has seen no other. NaN if not.
double settledAt(const Telemetry& now, std::size_t captures) {
    auto told = now.told;
    std::ranges::sort(told, std::ranges::greater(), &ToldTrain::onset);
    const auto last = std::span(told).first(std::min(captures + 1, told.size()));
    const bool same = captures < told.size() && std::ranges::all_of(last, [&](const auto& train) {
                          return train.amplitude == last.front().amplitude;
                      });
    return same ? last.front().amplitude : std::nan("");
}

Result<Json> measureLoad(ScriptSession& session, const Json& list) {
    const Arguments arguments("measure.load", list);
    auto given = capturesGiven(session, arguments);
    if (!given) return failure(given);
    GivenCaptures fine;
    if (!arguments.at(1).is_null()) {
        auto more = capturesGiven(session, arguments, 1, "fine");
        if (!more) return failure(more);
        fine = std::move(*more);
    }
    const auto& train = session.bench().profile().encoding.train;
    ExpectedTrain expected{train.pulses, train.rate.value()};
    if (const auto& stimulator = session.bench().devices().stimulator) expected.drive = stimulator->traits().drive;
    if (!arguments.at(3).is_null()) {
        if (arguments.at(3) != "voltage") return arguments.wrong("by", arguments.at(3), "\"voltage\"");
        expected.drive = Drive::Voltage;
    }
    // A calibrated stimulator is told something else than what it is to deliver.
    const auto& calibration = session.bench().calibration();
    const double settled = settledAt(session.bench().telemetry(), given->captures.size());
    for (const auto& capture : given->captures) {
        const double told = std::isnan(capture.told) ? settled : capture.told;
        expected.told.push_back(calibration ? calibration->amplitude.delivered(told) : told);
    }
    GivenCaptures rhythm;
    if (!arguments.at(2).is_null()) {
        auto more = capturesGiven(session, arguments, 2, "rhythm");
        if (!more) return failure(more);
        if (more->captures.size() != 1) return arguments.wrong("rhythm", arguments.at(2), "a list of one capture");
        rhythm = std::move(*more);
    }
    expected.budget.seed = session.request().seed;
    auto reading = readLoad(given->captures, expected, fine.captures,
                            rhythm.captures.empty() ? nullptr : &rhythm.captures.front());
    if (!reading) return failure(reading);
    Json out = toJson(*reading);
    out["captures"] = given->ids;
    return out;
}

/// What the bench is and may deliver; loads and trips come from the script.
LoadSafetyInput inputFor(Bench& bench) {
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
    return input;
}

Result<void> readTolerances(const Arguments& arguments, const Json& options, LoadSafetyTolerances& into) {
    const auto given = options.value("tolerances", Json::object());
    if (!given.is_object()) return arguments.wrong("tolerances", given, "an object");
    for (const auto& [key, target] :
         {std::pair("load_pct", &into.load_pct), std::pair("amplitude_pct", &into.amplitude_pct),
          std::pair("timing_pct", &into.timing_pct), std::pair("resistor_pct", &into.resistor_pct),
          std::pair("area_pct", &into.area_pct)}) {
        auto value = arguments.number(given, key, *target, {0.01, 50});
        if (!value) return failure(value);
        *target = *value;
    }
    return {};
}

/// Loads that are empty are left out: they were not reached.
Result<Json> loadSafety(ScriptSession& session, const Json& list) {
    const Arguments arguments("analysis.loadSafety", list);
    auto loads = arguments.list(0, "loads");
    if (!loads) return failure(loads);
    auto trips = arguments.list(1, "trips");
    if (!trips) return failure(trips);
    auto options = arguments.options(2, {"reference", "tolerances", "open_circuit", "absolute"});
    if (!options) return failure(options);
    LoadSafetyInput input = inputFor(session.bench());
    if (auto read = readTolerances(arguments, *options, input.tolerances); !read) return failure(read);
    for (const auto& item : **loads) {
        auto record = loadRecordFrom(item);
        if (!record) return failure(record);
        input.loads.push_back(std::move(*record));
    }
    for (const auto& item : **trips) {
        auto trip = tripTrialFrom(item);
        if (!trip) return failure(trip);
        input.trips.push_back(std::move(*trip));
    }
    if (options->contains("reference")) {
        auto reference = loadRecordFrom((*options)["reference"]);
        if (!reference) return failure(reference);
        input.reference = judgeReference(*reference, input);
        input.time = judgeTimeReference(*reference, input);
    }
    if (options->contains("absolute")) {
        auto row = absoluteRowFrom((*options)["absolute"]);
        if (!row) return failure(row);
        input.absolute = std::move(*row);
    }
    if (options->contains("open_circuit")) {
        auto open = loadStepFrom((*options)["open_circuit"]);
        if (!open) return failure(open);
        input.openCircuit = std::move(*open);
    }
    const auto judged = judgeLoadSafety(input);
    Json out = toJson(judged);
    out["kind"] = "load-safety";
    out["matrix"] = toJson(limitMatrixOf(judged, input.limits));
    out["described"] = toJson(describeOutput(input));
    return out;
}

Result<Json> tracings(ScriptSession& session, const Json& list) {
    const Arguments arguments("plot.tracings", list);
    auto wanted = arguments.list(0, "tracings");
    if (!wanted) return failure(wanted);
    Json captures = Json::array();
    for (const auto& one : **wanted) {
        if (!one.is_object()) return arguments.wrong("a tracing", one, "an object with condition and label");
        auto condition = arguments.text(one, "condition", "");
        if (!condition) return failure(condition);
        auto label = arguments.text(one, "label", *condition);
        if (!label) return failure(label);
        for (const auto& exemplar : session.exemplars()) {
            if (exemplar.condition != *condition) continue;
            Json entry = {{"label", *label}};
            if (exemplar.row) {
                entry["capture"] = *exemplar.row;
            } else {
                const double origin = std::isfinite(exemplar.capture.trigger_s) ? exemplar.capture.trigger_s : 0;
                entry["rate_hz"] = exemplar.capture.rate_hz;
                entry["start_s"] = exemplar.capture.start_s - origin;
                for (const auto& channel : exemplar.capture.channels) {
                    if (channel.unit != "V" && channel.unit != "A") continue;
                    entry[channel.unit == "V" ? "voltage_v" : "current_a"] = channel.samples;
                }
            }
            captures.push_back(std::move(entry));
        }
    }
    Json figure = {{"type", "waveforms"}, {"captures", captures}};
    if (const auto& note = arguments.at(1); note.is_string()) figure["note"] = note;
    return figure;
}

Result<Json> partial(ScriptSession& session, const Json& list) {
    const Arguments arguments("record.partial", list);
    auto found = arguments.object(0, "found");
    if (!found) return failure(found);
    const Json tables = arguments.at(1).is_null() ? Json::array() : arguments.at(1);
    if (!tables.is_array()) return arguments.wrong("tables", tables, "a list of { caption, rows, columns, kind }");
    for (const auto& table : tables) {
        if (!table.is_object() || !table.value("caption", Json()).is_string() ||
            !table.value("rows", Json()).is_array()) {
            return arguments.wrong("a table", table, "an object with a caption and a list of rows");
        }
    }
    session.keepPartial(**found, tables);
    return Json();
}

}  // namespace

std::vector<HostFunction> loadSafetyFunctions() {
    return {
        {"measure",
         "load",
         HostKind::Function,
         {{"captures", "list", "", "from bench.capture(), one per train, all with one command"},
          {"fine", "list", "", "more of them in a current range that fits the end of a phase: a spike may clip there",
           true},
          {"rhythm", "list", "",
           "one capture that holds two of the trains, for the interval: for an oscilloscope that does not state how "
           "good "
           "the time stamps of its records are",
           true},
          {"by", "text", "",
           "\"voltage\" where the voltage shows the phases of a current source's train too: into an open circuit",
           true}},
         "Measures what trains did to a load: voltage, current, charge, energy, RMS over each window.",
         "{ delivered, amplitude_v, highest_v, amplitude_ma, width_s, interval_s, impedance_ohm, peak_v, peak_ma, "
         "charge_uc, "
         "net_charge_uc, "
         "imbalance, energy_mj, rms_train_ma, rms_1s_ma, rms_5s_ma, rms_5s_v, dc_ma, power_1s_w, each with its "
         "standard "
         "uncertainty in _u and its U (95 %) in _expanded; trains, under_10_lsb, not_stated, warnings, captures }: "
         "null "
         "what was not measured, and an uncertainty that rests on what the oscilloscope does not state (not_stated "
         "says what); "
         "delivered is the amplitude over what each train was to have, 1 as told.",
         "Throws for captures that are held no longer, or without a channel of what the source drives and of voltage.",
         measureLoad},
        {"analysis",
         "loadSafety",
         HostKind::Function,
         {{"loads", "list", "",
           "{ name, dmm_ohm, dmm_u_ohm, serial, steps: [{ command_v, interval_s, reading }], refusals: [{ "
           "command_v, interval_s, forbidden, refused, predicted, reason, what }], undriven: [{ command_v, interval_s, "
           "reason }], not_applicable, problem }"},
          {"trips", "list", "", "from bench.trip...()"},
          {"options.reference", "object", "", "the load of the known-reference check, as in loads", true},
          {"options.tolerances", "object", "%", "load_pct, amplitude_pct, timing_pct, resistor_pct, area_pct", true},
          {"options.absolute", "object", "", "from bench.readReference()", true},
          {"options.open_circuit", "object", "", "{ command_v, interval_s, reading }: a train into the open circuit",
           true}},
         "Judges everything measured against every limit set with its guard band.",
         "{ kind, verdict, reasons, loads, rows, matrix, disclosed, described, worst_case }: what is missing reads "
         "\"not "
         "evaluated\", and then the verdict is no pass. matrix is { loads, lines }, every limit once with a cell per "
         "load and the margin left, the smallest first.",
         "Throws for a load that cannot be read.",
         loadSafety},
        {"plot",
         "tracings",
         HostKind::Function,
         {{"tracings", "list", "", "{ condition, label }: the first capture recorded under that condition"},
          {"note", "text", "", "a sentence below the figure", true}},
         "Voltage and current of recorded captures against time.",
         "A figure, for report.figure().",
         "",
         tracings},
        {"record",
         "partial",
         HostKind::Function,
         {{"found", "object", "", "results so far, as verdict() takes them"},
          {"tables", "list", "", "{ caption, rows, columns }, for the report; kind is \"table\" or \"matrix\"", true}},
         "Keeps what a run has come to, in case it ends early: results and tables then say that they are partial. The "
         "last one counts; a run that ends by itself uses none.",
         "",
         "",
         partial},
    };
}

}  // namespace tacto
