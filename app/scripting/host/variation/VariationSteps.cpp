// The object "bench.variation", the steps of a prediction on virtual participants: the functions for scripts and what
// each does.
#include <algorithm>
#include <cmath>

#include "app/scripting/host/analysis/RunAnalysis.h"
#include "app/scripting/host/variation/PredictedFigures.h"
#include "core/analysis/variation/VariationJson.h"
#include "core/base/JsonText.h"

namespace tacto {

namespace host::variation {

namespace {

/// The same participants with the amplitudes that the run chose, and with the alternative.
struct Prediction {
    VariationOptions options = {};
    Json found = {}, other = {};
    Json readings = Json::array();
};

constexpr std::size_t kBenches = 4000;  // number of benches drawn to find their spread

constexpr AmplitudeLevels otherThan(AmplitudeLevels levels) {
    return levels == AmplitudeLevels::Personal ? AmplitudeLevels::Profile : AmplitudeLevels::Personal;
}

Result<Json> predict(ScriptSession& session, VariationOptions options, AmplitudeLevels levels,
                     const std::string& label) {
    options.stimulation.levels = levels;
    const auto found = analysis::predicted(session, options, label);
    if (!found) return failure(found);
    return toJson(*found, options);
}

const Json& with(const Prediction& run, AmplitudeLevels levels) {
    return run.options.stimulation.levels == levels ? run.found : run.other;
}

double number(const Json& found, const char* key) { return numberOr(found, key); }

/// Returns "94.8 (66.7 to 99.2)" in %: the median, 5 % and 95 %. One participant gets no range, none gets no number.
std::string percent(const Json& estimate) {
    const double middle = numberOr(estimate, estimate.contains("median") ? "median" : "value");
    const double low = numberOr(estimate, "low"), high = numberOr(estimate, "high");
    if (std::isnan(middle)) return "–";
    if (low == high) return fmt::format("{:.1f}", 100 * middle);
    return fmt::format("{:.1f} ({:.1f} to {:.1f})", 100 * middle, 100 * low, 100 * high);
}

std::string fixedRange(const Json& found) {
    const double low = found["range_v"][0], high = found["range_v"][1];
    const bool papers = low == 10 && high == 40;
    return fmt::format("{} {} to {} V", papers ? "The design paper's" : "The profile's", low, high);
}

/// States the number of participants served before all other findings.
std::vector<std::string> headline(const VariationOptions& options, const Json& fixed, const Json& personal) {
    std::vector<std::string> why;
    if (number(fixed, "participants_refused") > 0) {
        const bool strong = std::ranges::all_of(
            fixed["withheld"], [](const Json& each) { return each["reason"] == "too strong for the participant"; });
        why.push_back(
            fmt::format("{} would be refused {}", number(fixed, "participants_refused"),
                        strong ? fmt::format("{} V as too strong", fixed["range_v"][1].get<double>()) : "part of it"));
    }
    if (number(fixed, "participants_not_feeling") > 0)
        why.push_back(fmt::format("{} are given all of it and do not feel {} V",
                                  number(fixed, "participants_not_feeling"), fixed["range_v"][0].get<double>()));
    if (number(fixed, "participants_without_range") > 0)
        why.push_back(fmt::format("{} cannot be given it by this device", number(fixed, "participants_without_range")));
    std::vector<std::string> out{fmt::format("{} serves {} of {} virtual participants{}{}.", fixedRange(fixed),
                                             number(fixed, "served"), number(fixed, "participants"),
                                             why.empty() ? "" : ": ", fmt::join(why, ", "))};
    if (number(personal, "served") == 0) {
        out.emplace_back("A range of their own within it serves none of them either.");
        return out;
    }
    out.push_back(fmt::format(
        "A range of their own within it serves {} of {}; {} of these have every pair of conditions 5 just-noticeable "
        "differences apart, and of their answers {} % would be right (median; 5 to 95 % of them).",
        number(personal, "served"), number(personal, "participants"), number(personal, "clearly_separable"),
        percent(personal["accuracy"])));
    const auto people = options.wanted.participants;
    const auto pilot =
        std::ranges::find_if(personal["pilots"], [&](const Json& each) { return each["people"] == people; });
    if (pilot == personal["pilots"].end()) return out;
    out.push_back(
        fmt::format("A pilot of {} {} with such ranges: all are served with {:.0f} % probability; if all are above "
                    "chance, at least "
                    "{:.0f} % of such people can do it (95 %).",
                    people, people == 1 ? "person" : "people", 100 * number(*pilot, "all_served"),
                    100 * number(*pilot, "prevalence_all")));
    return out;
}

/// Returns remarks on the limits of the results: they do not hold for everybody.
std::vector<std::string> remarks(const VariationOptions& options, const Json& found) {
    std::vector<std::string> out{
        "Everything here is simulated: predicted from stated distributions, not measured on people. A condition counts "
        "for a participant only if it is presented, felt and not too strong."};
    if (options.stimulation.source.drive == Drive::Voltage)
        out.emplace_back(
            "A voltage source is refused for people: this shows what it would do, judged as on a bench load.");
    if (found["model"]["electrode_area_cm2"].is_null())
        out.push_back(fmt::format("No electrode area is stated: the skin is that under {} cm².",
                                  number(found["model"], "skin_area_cm2")));
    const double participants = number(found, "participants"), missing = participants - number(found, "served");
    if (missing > 0) {
        std::vector<std::string> withheld;
        for (const auto& each : found["withheld"])
            withheld.push_back(fmt::format("{} times {}", number(each, "count"), textOr(each, "reason")));
        out.push_back(fmt::format(
            "{} of {} virtual participants are not served and are left out of accuracy and confusion.{}{}{}", missing,
            participants, withheld.empty() ? "" : " Conditions that were withheld: ", fmt::join(withheld, ", "),
            withheld.empty() ? "" : "."));
    }
    if (found["trials_needed"].is_null()) out.emplace_back("No one is served, so there is no accuracy to predict.");
    return out;
}

/// Returns `row` with those members of `found` that `keys` lists.
Json some(Json row, const Json& found, std::initializer_list<const char*> keys) {
    for (const char* key : keys) row[key] = found[key];
    return row;
}

Json rangeRow(const std::string& name, const Json& found) {
    return some({{"amplitudes", name}}, found,
                {"served", "participants_refused", "participants_not_feeling", "participants_without_range",
                 "clearly_separable", "accuracy"});
}

/// Returns the aims of a pilot, and how many answers each needs.
Json aimsOf(const Json& needed) {
    const auto aim = [&needed](const std::string& text, const char* key) {
        const Json& pooled = needed["pooled"][key];
        return Json{{"aim", text},
                    {"one_participant", needed["per_participant"][key]},
                    {"pooled_each", pooled["per_participant"]},
                    {"pooled_trials", pooled["total"]},
                    {"design_effect", pooled["design_effect"]},
                    {"participants_at_least", pooled["participants_least"]}};
    };
    return Json::array(
        {aim(fmt::format("95 % interval at most {:.0f} % wide", 100 * number(needed, "width")), "for_width"),
         aim(fmt::format("lower end above chance, {:.0f} %", 100 * number(needed, "chance")), "above_chance")});
}

Result<Json> begin(ScriptSession& session, const Arguments& arguments) {
    const auto options = analysis::variationOptionsFrom(session, arguments);
    if (!options) return failure(options);
    Prediction first{.options = *options};
    const auto chosen = options->stimulation.levels, other = otherThan(chosen);
    auto found = predict(session, *options, chosen, "Virtual participants");
    if (!found) return found;
    auto compared =
        predict(session, *options, other, fmt::format("Virtual participants, {} amplitudes", nameOf(other)));
    if (!compared) return compared;
    first.found = std::move(*found);
    first.other = std::move(*compared);
    return done(session.begin(arguments.object(), std::move(first)));
}

/// The limit of comfort is unknown, so this tells who is served for the lowest, the run's and the highest answer.
Result<Json> readings(ScriptSession& session, const Arguments& arguments) {
    const auto begun = session.begun<Prediction>(arguments.object());
    if (!begun) return failure(begun);
    Prediction& run = **begun;
    const auto& population = run.options.population;
    const std::pair<const char*, double> at[] = {{"the attention threshold", population.attention_ma.median},
                                                 {"the run's setting", population.discomfort_ma},
                                                 {"the intolerance threshold", population.intolerance_ma.median}};
    for (const auto& [name, milliamps] : at) {
        const auto answered = [&](AmplitudeLevels levels, const char* called) -> Result<Json> {
            if (milliamps == population.discomfort_ma) return with(run, levels);
            auto options = run.options;
            options.population.discomfort_ma = milliamps;
            return predict(session, options, levels,
                           fmt::format("Too strong from {} mA, {} amplitudes", milliamps, called));
        };
        const auto shared = answered(AmplitudeLevels::Profile, "fixed");
        if (!shared) return shared;
        const auto own = answered(AmplitudeLevels::Personal, "personal");
        if (!own) return own;
        run.readings.push_back({{"too_strong_from", name},
                                {"median_ma", milliamps},
                                {"fixed_served", shared->at("served")},
                                {"fixed_refused", shared->at("participants_refused")},
                                {"fixed_not_feeling", shared->at("participants_not_feeling")},
                                {"personal_served", own->at("served")},
                                {"accuracy", own->at("accuracy")},
                                {"presented_accuracy", own->at("presented_accuracy")},
                                {"presented_fixed_accuracy", shared->at("presented_accuracy")}});
    }
    return Json();
}

/// Writes who is served before all other findings.
Result<void> write(ScriptSession& session, const Prediction& run, const std::string& said) {
    std::vector<Json> items;
    const auto text = [&items](const std::string& words) { items.push_back({{"kind", "text"}, {"text", words}}); };
    const auto figure = [&items](const char* caption, const Json& found, const char* view) {
        items.push_back({{"kind", "figure"},
                         {"caption", fmt::format("{}, predicted, not measured", caption)},
                         {"figure", predictedFigure(found, view)}});
    };
    text(said);
    figure("Thresholds and currents of the participants", with(run, AmplitudeLevels::Profile), "thresholds");
    text(
        fmt::format("Where comfort ends is not known: somewhere from the attention to the intolerance threshold. The "
                    "run takes {} mA.",
                    run.options.population.discomfort_ma));
    for (const auto& each : remarks(run.options, run.found)) text(each);
    figure("Confusion", run.found, "confusion");
    figure("Accuracy of the served", run.found, "accuracy");
    figure("Width of the interval", run.found, "width");
    for (const auto& item : items) {
        if (auto written = session.reportItem(asScriptsSeeIt(item)); !written) return written;
    }
    return {};
}

Result<Json> conclude(ScriptSession& session, const Arguments& arguments) {
    const auto begun = session.begun<Prediction>(arguments.object());
    if (!begun) return failure(begun);
    const Prediction& run = **begun;
    const auto& stimulation = run.options.stimulation;
    const auto bench = predictBench(session.bench().profile().encoding, stimulation.source.drive, BenchTolerances{},
                                    kBenches, session.request().seed);
    if (!bench) return failure(bench);
    const Json &fixed = with(run, AmplitudeLevels::Profile), &personal = with(run, AmplitudeLevels::Personal);
    const auto said = headline(run.options, fixed, personal);
    const auto together = fmt::format("{}", fmt::join(said, " "));
    if (auto written = write(session, run, together); !written) return failure(written);
    Json results = {{"verdict", nullptr},
                    {"reasons", said},
                    {"headline", together},
                    {"levels", nameOf(stimulation.levels)},
                    {"source", stimulation.source.drive == Drive::Voltage ? "voltage" : "current"},
                    {"profile_served", fixed["served"]},
                    {"personal_served", personal["served"]},
                    {"readings", run.readings}};
    results.update(run.found);
    results["other_levels"] =
        some({{"levels", nameOf(otherThan(stimulation.levels))}}, run.other,
             {"accuracy", "complete", "refused", "not_felt", "served", "participants_refused",
              "participants_not_feeling", "participants_without_range", "presented_accuracy", "conditions", "people"});
    results["bench"] = toJson(*bench);
    results["ranges"] =
        Json::array({rangeRow(fixedRange(fixed), fixed), rangeRow("A range of each participant's own", personal)});
    if (!results["trials_needed"].is_null()) results["trials_needed"]["aims"] = aimsOf(results["trials_needed"]);
    return results;
}

}  // namespace

}  // namespace host::variation

std::vector<HostFunction> variationFunctions() {
    constexpr std::string_view kErrors =
        "Throws when the run is stopped; what was predicted until then is kept as partial.";
    return {
        {.name = "begin",
         .parameters = host::analysis::variationParameters(),
         .text =
             "Predicts as analysis.variation() how virtual participants tell the conditions apart, with the amplitudes "
             "that were chosen and, for the same participants, with the others.",
         .errors = kErrors,
         .call = host::variation::begin},
        {.name = "readings",
         .text = "Where comfort ends is not known: predicts the same where the attention threshold, and where the "
                 "intolerance threshold, is too strong.",
         .errors = kErrors,
         .call = host::variation::readings},
        {.name = "conclude",
         .text =
             "Predicts what different benches within their tolerances would read, and writes who is served, what is "
             "not everybody's result, and the figures into the report, marked as predicted.",
         .returns = "What verdict() takes, without a verdict.",
         .call = host::variation::conclude},
    };
}

}  // namespace tacto
