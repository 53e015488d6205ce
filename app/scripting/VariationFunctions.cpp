// Predictions without a device: virtual participants, the spread of benches, and their figures.
#include <algorithm>
#include <cmath>
#include <stop_token>

#include "app/scripting/Arguments.h"
#include "app/scripting/HostFunction.h"
#include "app/scripting/ScriptSession.h"
#include "app/scripting/VariationArguments.h"
#include "core/analysis/VariationJson.h"

namespace tacto {

namespace {

using Json = nlohmann::json;

constexpr const char* kMarked = "Simulated: predicted, not measured.";

Result<Json> variation(ScriptSession& session, const Json& list) {
    const Arguments arguments("analysis.variation", list);
    auto given = arguments.options(0, {"participants",
                                       "trials",
                                       "levels",
                                       "source",
                                       "guess",
                                       "width",
                                       "assurance",
                                       "pilot",
                                       "area_cm2",
                                       "series_ohm",
                                       "parallel_ohm",
                                       "capacitance_nf",
                                       "detection_ma",
                                       "attention_ma",
                                       "discomfort_ma",
                                       "intolerance_ma",
                                       "threshold_correlation",
                                       "above_detection",
                                       "below_discomfort",
                                       "skin_spread",
                                       "threshold_spread",
                                       "weber_spread",
                                       "weber_amplitude",
                                       "weber_interval",
                                       "lapse_most",
                                       "noise_jnd",
                                       "label"});
    if (!given) return failure(given);
    auto label = arguments.text(*given, "label", "Virtual participants");
    if (!label) return failure(label);
    const auto options = variationOptionsFrom(session, arguments, *given);
    if (!options) return failure(options);

    // The bench's stop is asked for while the threads work: a wait of no time fails once it came.
    std::stop_source stop;
    std::optional<Error> stopped;
    const auto found = predictVariation(*options, stop.get_token(), [&](std::size_t done, std::size_t total) {
        session.progress({*label, done, total});
        if (stopped) return;
        if (auto waited = session.bench().wait(Seconds(0)); !waited) {
            stopped = waited.error();
            stop.request_stop();
        }
    });
    if (!found && found.error().code != ErrorCode::Stopped) return failure(found);
    if (stopped) {
        // What is done by then stands as a partial result, in the run's outcome and its report.
        if (found) session.keepPartial(toJson(*found, *options), Json::array());
        return tl::unexpected<Error>(*stopped);
    }
    if (!found) return failure(found);
    return toJson(*found, *options);
}

Result<Json> uncertainBench(ScriptSession& session, const Json& list) {
    const Arguments arguments("analysis.uncertainBench", list);
    auto given = arguments.options(0, {"draws", "source", "gain_pct", "offset_v", "load_pct", "scope_gain_pct",
                                       "scope_offset_pct", "clock_ppm", "jitter_us"});
    if (!given) return failure(given);
    const auto drive = variationSourceFrom(arguments, *given);
    if (!drive) return failure(drive);
    BenchTolerances tolerances;
    double draws = 4000, gain = 100 * tolerances.stimulatorGain, offset = tolerances.stimulatorOffset.value();
    double load = 100 * tolerances.load, scopeGain = 100 * tolerances.scopeGain;
    double scopeOffset = 100 * tolerances.scopeOffset, clock = 1e6 * tolerances.clock;
    double jitter = tolerances.jitter.count();
    auto read = readNumbers(arguments, *given,
                            {{"draws", &draws, {100, 1e6, true}},
                             {"gain_pct", &gain, {0, 50}},
                             {"offset_v", &offset, {0, 1000}},
                             {"load_pct", &load, {0, 50}},
                             {"scope_gain_pct", &scopeGain, {0, 50}},
                             {"scope_offset_pct", &scopeOffset, {0, 50}},
                             {"clock_ppm", &clock, {0, 5e5}},
                             {"jitter_us", &jitter, {0, 1e6}}});
    if (!read) return failure(read);
    tolerances = {gain / 100,        Volts(offset), load / 100,    scopeGain / 100,
                  scopeOffset / 100, clock / 1e6,   Micros(jitter)};
    const auto found = predictBench(session.bench().profile().encoding, *drive, tolerances,
                                    static_cast<std::size_t>(draws), session.request().seed);
    if (!found) return failure(found);
    return toJson(*found);
}

/// Share of participants at or below each accuracy.
Json accuracyCurve(const Json& found) {
    Json x = Json::array(), y = Json::array();
    const Json& values = found["accuracies"];
    const double n = static_cast<double>(values.size());
    // More points than a page can show would only make the report large; the last one is always there.
    constexpr std::size_t kPoints = 400;
    const std::size_t step = 1 + values.size() / kPoints;
    const std::size_t first = values.empty() ? 0 : (values.size() - 1) % step;
    for (std::size_t i = first; i < values.size(); i += step) {
        x.push_back(100 * values[i].get<double>());
        y.push_back(100 * static_cast<double>(i + 1) / n);
    }
    return {{"type", "curves"},
            {"x", {{"label", "Expected accuracy"}, {"unit", "%"}}},
            {"y", {{"label", "Participants at or below"}, {"unit", "%"}}},
            {"curves", {{{"label", "virtual participants"}, {"x", x}, {"y", y}, {"steps", true}}}},
            {"note", kMarked}};
}

Json widthCurve(const Json& found) {
    const Json trials = found.value("trials_needed", Json());
    Json curves = Json::array();
    Json lines = Json::array();
    if (trials.is_object()) {
        Json x = Json::array(), y = Json::array(), low = Json::array(), high = Json::array();
        for (const auto& point : trials["curve"]) {
            x.push_back(point["trials"]);
            y.push_back(100 * point["width"]["value"].get<double>());
            low.push_back(100 * point["width"]["low"].get<double>());
            high.push_back(100 * point["width"]["high"].get<double>());
        }
        curves.push_back(
            {{"label", "one participant, median and 5 to 95 %"}, {"x", x}, {"y", y}, {"low", low}, {"high", high}});
        lines.push_back({{"label", "wanted"}, {"y", 100 * trials["width"].get<double>()}});
    }
    return {{"type", "curves"},
            {"x", {{"label", "Trials of a participant"}, {"unit", ""}}},
            {"y", {{"label", "Width of the 95 % interval"}, {"unit", "%"}}},
            {"curves", curves},
            {"lines", lines},
            {"note", kMarked}};
}

/// Share of participants at or below each value.
Json shareCurve(std::string label, std::vector<double> values) {
    std::ranges::sort(values);
    Json x = Json::array(), y = Json::array();
    const double n = static_cast<double>(values.size());
    for (std::size_t i = 0; i < values.size(); ++i) {
        x.push_back(values[i]);
        y.push_back(100 * static_cast<double>(i + 1) / n);
    }
    return {{"label", std::move(label)}, {"x", std::move(x)}, {"y", std::move(y)}, {"steps", true}};
}

/// The thresholds, and the currents that the profile's smallest and largest amplitude give: those of a current source,
/// A / |Z|, whether or not they would be withheld.
Json thresholdCurves(const Json& found) {
    const Json& people = found.at("people");
    Json curves = Json::array();
    const std::pair<const char*, const char*> thresholds[] = {
        {"felt from", "detection_ma"}, {"too strong from", "discomfort_ma"}, {"not tolerated from", "intolerance_ma"}};
    for (const auto& [label, key] : thresholds) curves.push_back(shareCurve(label, people.at(key)));
    const std::vector<double> impedance = people.at("impedance_ohm");
    for (const double volts : found.at("range_v")) {
        std::vector<double> currents;
        for (const double ohms : impedance) currents.push_back(1e3 * volts / ohms);
        curves.push_back(shareCurve(fmt::format("current at {:g} V", volts), std::move(currents)));
    }
    return {{"type", "curves"},
            {"x", {{"label", "Current"}, {"unit", "mA"}}},
            {"y", {{"label", "Participants at or below"}, {"unit", "%"}}},
            {"curves", curves},
            {"note", kMarked}};
}

Result<Json> predicted(ScriptSession&, const Json& list) {
    const Arguments arguments("plot.predicted", list);
    auto found = arguments.object(0, "found");
    if (!found) return failure(found);
    if (!(*found)->value("accuracies", Json()).is_array() || !(*found)->value("people", Json()).is_object()) {
        return arguments.wrong("found", **found, "what analysis.variation() returned");
    }
    auto view = arguments.text(1, "view");
    if (!view) return failure(view);
    if (*view == "accuracy") return accuracyCurve(**found);
    if (*view == "width") return widthCurve(**found);
    if (*view == "thresholds") return thresholdCurves(**found);
    if (*view != "confusion") {
        return arguments.wrong("view", *view, "\"confusion\", \"accuracy\", \"width\" or \"thresholds\"");
    }
    return Json{{"type", "confusion"},
                {"labels", (**found)["labels"]},
                {"columns", (**found)["columns"]},
                {"confusion", (**found)["confusion"]},
                {"note", kMarked}};
}

}  // namespace

std::vector<HostFunction> variationFunctions() {
    return {
        {"analysis",
         "variation",
         HostKind::Function,
         {{"options.participants", "number", "", "virtual people, 1 to 100000; 200 where left out", true},
          {"options.trials", "number", "", "per condition and participant; 25", true},
          {"options.levels", "text", "",
           "personal: from what the participant feels to what is too strong, as far as the profile allows; profile: "
           "the profile's for everybody; personal",
           true},
          {"options.source", "text", "", "current: A / |Z|; voltage: as on the bench, refused for people; current",
           true},
          {"options.guess", "text", "", "what is said when nothing is felt: none or uniform; none", true},
          {"options.width", "number", "", "wanted width of the 95 % interval of accuracy; 0.1", true},
          {"options.assurance", "number", "", "with which a pilot is to reach it; 0.8", true},
          {"options.pilot", "number", "", "participants of the pilot; 5", true},
          {"options.area_cm2", "number", "cm2",
           "electrode area: R_p falls with it and C grows; the profile's, 1 where it has none", true},
          {"options.series_ohm", "number", "ohm", "median R_s of the skin; 200", true},
          {"options.parallel_ohm", "number", "ohm", "median R_p of the skin under 1 cm2; 10000", true},
          {"options.capacitance_nf", "number", "nF", "median C of the skin under 1 cm2; 50", true},
          {"options.detection_ma", "number", "mA", "median perception threshold at 150 us per phase; 3.5", true},
          {"options.attention_ma", "number", "mA", "median attention threshold; 6.9", true},
          {"options.discomfort_ma", "number", "mA", "too strong from, for the median participant; 9.8", true},
          {"options.intolerance_ma", "number", "mA", "median intolerance threshold; 13.8", true},
          {"options.threshold_correlation", "number", "", "of the logarithms of a participant's thresholds; 0.8", true},
          {"options.above_detection", "number", "",
           "a personal range begins at this times the perception threshold; 1.5", true},
          {"options.below_discomfort", "number", "", "and ends at this times what is too strong; 0.8", true},
          {"options.skin_spread", "number", "", "geometric standard deviation between people, 1 for none; 1.5 (C 1.3)",
           true},
          {"options.threshold_spread", "number", "", "the same of the three thresholds; 1.4", true},
          {"options.weber_spread", "number", "", "the same of the Weber fractions; 1.25", true},
          {"options.weber_amplitude", "number", "", "median Weber fraction of amplitude; 0.10", true},
          {"options.weber_interval", "number", "", "median Weber fraction of interval; 0.16", true},
          {"options.lapse_most", "number", "", "lapse rates lie between 0 and this; 0.06", true},
          {"options.noise_jnd", "number", "JND", "standard deviation of what is felt; 1", true},
          {"options.label", "text", "", "what the progress bar says", true}},
         "Predicts how virtual participants tell the conditions apart, drawn with the run's seed: no person and no "
         "device takes part. Works on all cores, with the same result whatever their number.",
         "{ simulated, participants, seed, partial, range_v, served, participants_refused, participants_not_feeling, "
         "participants_without_range, conditions, separability: [{ a, b, jnd, amplitude_jnd, interval_jnd }], labels, "
         "columns, confusion, complete, accuracy: { median, low, high }, presented_accuracy, information_bits, "
         "refused, "
         "not_felt, withheld, trials_needed: { per_participant, pooled, curve, assumptions }, pilots, premises, model, "
         "people }: low and high are 5 and 95 % of the participants. A condition counts where it is presented, felt "
         "and "
         "not too strong; served are those for whom every one counts, and accuracy, confusion and pilots are theirs. "
         "people holds the first 1000, a list per column.",
         "Throws for an option that makes no sense, and when the run is stopped; what was predicted until then is kept "
         "as partial.",
         variation},
        {"analysis",
         "uncertainBench",
         HostKind::Function,
         {{"options.draws", "number", "", "benches, 100 to 1000000; 4000 where left out", true},
          {"options.source", "text", "", "current or voltage; current", true},
          {"options.gain_pct", "number", "%", "stimulator's gain, half-width; 2", true},
          {"options.offset_v", "number", "V", "stimulator's offset, half-width; 0.1", true},
          {"options.load_pct", "number", "%", "load's tolerance, half-width; 5; a current source's alone", true},
          {"options.scope_gain_pct", "number", "%", "oscilloscope's gain, half-width; 0.5", true},
          {"options.scope_offset_pct", "number", "%", "oscilloscope's offset, of the range, half-width; 0.1", true},
          {"options.clock_ppm", "number", "ppm", "clocks against each other, half-width; 100", true},
          {"options.jitter_us", "number", "us", "of one interval, half-width; 10", true}},
         "Predicts what different benches within their tolerances would read of the same conditions (Monte Carlo).",
         "{ draws, conditions: [{ name, amplitude_v, interval_s }], pairs: [{ a, b, amplitude_jnd, interval_jnd }] }, "
         "each { value, low, high }: median, 5 and 95 % of the benches.",
         "",
         uncertainBench},
        {"plot",
         "predicted",
         HostKind::Function,
         {{"found", "object", "", "from analysis.variation()"},
          {"view", "text", "",
           "confusion; accuracy: its distribution over participants; width: of the interval against trials; "
           "thresholds: "
           "of the participants, beside the currents that the lowest and the highest command give them"}},
         "A prediction's figures, marked as predicted.",
         "A figure, for report.figure().",
         "",
         predicted},
    };
}

}  // namespace tacto
