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

constexpr std::size_t kBenches = 4000;  // number of benches drawn to find their spread

Result<Variation> predict(ScriptSession& session, VariationOptions options, AmplitudeLevels levels,
                          const std::string& label) {
    options.stimulation.levels = levels;
    return analysis::predicted(session, options, label);
}

/// Returns "94.8 (66.7 to 99.2)" in %: the median, 5 % and 95 %. One participant gets no range, none gets no number.
std::string percent(const Estimate& estimate) {
    const auto& [middle, low, high] = estimate;
    if (std::isnan(middle)) return "–";
    if (low == high) return fmt::format("{:.1f}", 100 * middle);
    return fmt::format("{:.1f} ({:.1f} to {:.1f})", 100 * middle, 100 * low, 100 * high);
}

std::string fixedRange(const EncodingProfile& encoding) {
    const double low = encoding.amplitudeMin.value(), high = encoding.amplitudeMax.value();
    const bool papers = low == 10 && high == 40;
    return fmt::format("{} {} to {} V", papers ? "The design paper's" : "The profile's", low, high);
}

/// States the number of participants served before all other findings.
std::vector<std::string> headline(const VariationRun& run) {
    const auto &fixed = run.with(AmplitudeLevels::Profile), &personal = run.with(AmplitudeLevels::Personal);
    const auto& encoding = run.options.stimulation.encoding;
    std::vector<std::string> why;
    if (fixed.refusedPeople > 0) {
        const bool strong = std::ranges::all_of(
            fixed.withheld, [](const auto& each) { return each.first == "too strong for the participant"; });
        why.push_back(
            fmt::format("{} would be refused {}", fixed.refusedPeople,
                        strong ? fmt::format("{} V as too strong", encoding.amplitudeMax.value()) : "part of it"));
    }
    if (fixed.unfeltPeople > 0)
        why.push_back(fmt::format("{} are given all of it and do not feel {} V", fixed.unfeltPeople,
                                  encoding.amplitudeMin.value()));
    if (fixed.withoutRange > 0) why.push_back(fmt::format("{} cannot be given it by this device", fixed.withoutRange));
    std::vector<std::string> out{fmt::format("{} serves {} of {} virtual participants{}{}.", run.fixedRange,
                                             fixed.served, fixed.participants, why.empty() ? "" : ": ",
                                             fmt::join(why, ", "))};
    if (personal.served == 0) {
        out.emplace_back("A range of their own within it serves none of them either.");
        return out;
    }
    out.push_back(fmt::format(
        "A range of their own within it serves {} of {}; {} of these have every pair of conditions 5 just-noticeable "
        "differences apart, and of their answers {} % would be right (median; 5 to 95 % of them).",
        personal.served, personal.participants, personal.clearlySeparable, percent(personal.accuracy)));
    const auto people = run.options.wanted.participants;
    const auto pilot = std::ranges::find(personal.pilots, people, &PilotOutlook::people);
    if (pilot == personal.pilots.end()) return out;
    out.push_back(
        fmt::format("A pilot of {} {} with such ranges: all are served with {:.0f} % probability; if all are above "
                    "chance, at least "
                    "{:.0f} % of such people can do it (95 %).",
                    people, people == 1 ? "person" : "people", 100 * pilot->allServed, 100 * pilot->prevalenceAll));
    return out;
}

/// Returns remarks on the limits of the results: they do not hold for everybody.
std::vector<std::string> remarks(const VariationOptions& options, const Variation& found) {
    std::vector<std::string> out{
        "Everything here is simulated: predicted from stated distributions, not measured on people. A condition counts "
        "for a participant only if it is presented, felt and not too strong."};
    if (options.stimulation.source.drive == Drive::Voltage)
        out.emplace_back(
            "A voltage source is refused for people: this shows what it would do, judged as on a bench load.");
    if (!options.stimulation.electrodeArea)
        out.push_back(fmt::format("No electrode area is stated: the skin is that under {} cm².",
                                  options.population.skinArea.value()));
    if (const auto missing = found.participants - found.served; missing > 0) {
        std::vector<std::string> withheld;
        for (const auto& [reason, count] : found.withheld)
            withheld.push_back(fmt::format("{} times {}", count, reason));
        out.push_back(fmt::format(
            "{} of {} virtual participants are not served and are left out of accuracy and confusion.{}{}{}", missing,
            found.participants, withheld.empty() ? "" : " Conditions that were withheld: ", fmt::join(withheld, ", "),
            withheld.empty() ? "" : "."));
    }
    if (!found.trials) out.emplace_back("No one is served, so there is no accuracy to predict.");
    return out;
}

Result<Json> begin(ScriptSession& session, const Arguments& arguments) {
    const auto options = analysis::variationOptionsFrom(session, arguments);
    if (!options) return failure(options);
    const auto chosen = options->stimulation.levels, other = otherThan(chosen);
    auto found = predict(session, *options, chosen, "Virtual participants");
    if (!found) return failure(found);
    auto compared =
        predict(session, *options, other, fmt::format("Virtual participants, {} amplitudes", nameOf(other)));
    if (!compared) return failure(compared);
    VariationRun first{.options = *options, .found = std::move(*found), .other = std::move(*compared)};
    return done(session.begin(arguments.object(), std::move(first)));
}

/// The limit of comfort is unknown, so this tells who is served for the lowest, the run's and the highest answer.
Result<Json> readings(ScriptSession& session, const Arguments& arguments) {
    const auto begun = session.begun<VariationRun>(arguments.object());
    if (!begun) return failure(begun);
    VariationRun& run = **begun;
    const auto& population = run.options.population;
    const std::pair<const char*, double> at[] = {{"the attention threshold", population.attention_ma.median},
                                                 {"the run's setting", population.discomfort_ma},
                                                 {"the intolerance threshold", population.intolerance_ma.median}};
    for (const auto& [name, milliamps] : at) {
        const auto answered = [&](AmplitudeLevels levels, const char* called) -> Result<Variation> {
            if (milliamps == population.discomfort_ma) return run.with(levels);
            auto options = run.options;
            options.population.discomfort_ma = milliamps;
            return predict(session, options, levels,
                           fmt::format("Too strong from {} mA, {} amplitudes", milliamps, called));
        };
        const auto shared = answered(AmplitudeLevels::Profile, "fixed");
        if (!shared) return failure(shared);
        const auto own = answered(AmplitudeLevels::Personal, "personal");
        if (!own) return failure(own);
        run.readings.push_back(toJson(ComfortReading{name, milliamps, *shared, *own}));
    }
    return Json();
}

/// Writes who is served before all other findings.
Result<void> write(ScriptSession& session, const VariationRun& run, const std::string& said) {
    std::vector<Json> items;
    const auto text = [&items](const std::string& words) { items.push_back({{"kind", "text"}, {"text", words}}); };
    const auto figure = [&items](const char* caption, Json drawn) {
        items.push_back({{"kind", "figure"},
                         {"caption", fmt::format("{}, predicted, not measured", caption)},
                         {"figure", std::move(drawn)}});
    };
    text(said);
    figure("Thresholds and currents of the participants",
           thresholdCurves(run.with(AmplitudeLevels::Profile), run.options.stimulation.encoding));
    text(
        fmt::format("Where comfort ends is not known: somewhere from the attention to the intolerance threshold. The "
                    "run takes {} mA.",
                    run.options.population.discomfort_ma));
    for (const auto& each : remarks(run.options, run.found)) text(each);
    figure("Confusion", predictedConfusion(run.found));
    figure("Accuracy of the served", accuracyCurve(run.found));
    figure("Width of the interval", widthCurve(run.found, run.options.wanted));
    for (const auto& item : items) {
        if (auto written = session.reportItem(asScriptsSeeIt(item)); !written) return written;
    }
    return {};
}

Result<Json> conclude(ScriptSession& session, const Arguments& arguments) {
    const auto begun = session.begun<VariationRun>(arguments.object());
    if (!begun) return failure(begun);
    VariationRun& run = **begun;
    const auto& stimulation = run.options.stimulation;
    auto bench = predictBench(session.bench().profile().encoding, stimulation.source.drive, BenchTolerances{}, kBenches,
                              session.request().seed);
    if (!bench) return failure(bench);
    run.bench = std::move(*bench);
    run.fixedRange = fixedRange(stimulation.encoding);
    run.reasons = headline(run);
    Json results = toJson(run);
    if (auto written = write(session, run, textOr(results, "headline")); !written) return failure(written);
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
         .members = variationRunMembers(),
         .returns = ": what verdict() takes, without a verdict.",
         .call = host::variation::conclude},
    };
}

}  // namespace tacto
