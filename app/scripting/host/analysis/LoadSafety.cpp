// Judging everything that was measured on loads.

#include "app/scripting/engine/ScriptSession.h"
#include "app/scripting/host/analysis/AnalysisObject.h"
#include "core/analysis/load_safety/LimitMatrix.h"
#include "core/analysis/load_safety/LoadSafetyJson.h"
#include "core/analysis/load_safety/OutputDescription.h"

namespace tacto::host::analysis {

namespace {

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

LoadSafetyTolerances tolerancesFrom(const Arguments& arguments) {
    const auto percent = [&arguments](std::string_view name) {
        return arguments.number(fmt::format("options.tolerances.{}", name));
    };
    return {.load_pct = percent("load_pct"),
            .resistor_pct = percent("resistor_pct"),
            .amplitude_pct = percent("amplitude_pct"),
            .timing_pct = percent("timing_pct"),
            .area_pct = percent("area_pct")};
}

}  // namespace

Result<Json> loadValue(ScriptSession& session, const Arguments& arguments) {
    auto record = loadRecordFrom(arguments.object("load"));
    if (!record) return failure(record);
    LoadSafetyInput input = inputFor(session.bench());
    input.tolerances.load_pct = arguments.number("tolerances.load_pct");
    input.tolerances.resistor_pct = arguments.number("tolerances.resistor_pct");
    const auto row = judgeReference(*record, input);
    return Json(row.verdict == RowVerdict::Pass ? "" : row.reason);
}

/// Loads that are empty are left out: they were not reached.
Result<Json> loadSafety(ScriptSession& session, const Arguments& arguments) {
    const Json& loads = arguments.list("loads");
    const Json& trips = arguments.list("trips");
    LoadSafetyInput input = inputFor(session.bench());
    input.tolerances = tolerancesFrom(arguments);
    for (const auto& item : loads) {
        auto record = loadRecordFrom(item);
        if (!record) return failure(record);
        input.loads.push_back(std::move(*record));
    }
    for (const auto& item : trips) {
        auto trip = tripTrialFrom(item);
        if (!trip) return failure(trip);
        input.trips.push_back(std::move(*trip));
    }
    if (arguments.has("options.reference")) {
        auto reference = loadRecordFrom(arguments.object("options.reference"));
        if (!reference) return failure(reference);
        input.reference = judgeReference(*reference, input);
        input.time = judgeTimeReference(*reference, input);
    }
    if (arguments.has("options.absolute")) {
        auto row = absoluteRowFrom(arguments.object("options.absolute"));
        if (!row) return failure(row);
        input.absolute = std::move(*row);
    }
    if (arguments.has("options.open_circuit")) {
        auto open = loadStepFrom(arguments.object("options.open_circuit"));
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

}  // namespace tacto::host::analysis
