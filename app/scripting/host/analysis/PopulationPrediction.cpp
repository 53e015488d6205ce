// Predictions without a device: virtual participants.
#include <array>
#include <stop_token>

#include "app/scripting/host/analysis/RunAnalysis.h"
#include "core/analysis/variation/VariationJson.h"
#include "core/analysis/variation/VirtualParticipant.h"

namespace tacto::host::analysis {

std::vector<HostParameter> variationParameters() {
    using namespace takes;
    const VariationOptions predicted;
    const auto& people = predicted.population;
    std::vector<HostParameter> all{
        whole("options.participants", "virtual people").range(1, 100'000).otherwise(predicted.participants),
        whole("options.trials", "per condition and participant").range(1, 10'000).otherwise(predicted.trials),
        text("options.levels",
             "personal: from what the participant feels to what is too strong, as far as the profile allows; "
             "profile: the profile's for everybody")
            .oneOf({nameOf(AmplitudeLevels::Personal), nameOf(AmplitudeLevels::Profile)})
            .otherwise(nameOf(predicted.stimulation.levels)),
        text("options.source", "current: A / |Z|; voltage: as on the bench, refused for people")
            .oneOf({"current", "voltage"})
            .otherwise("current"),
        text("options.guess", "what is answered when nothing is felt")
            .oneOf({nameOf(GuessBehaviour::None), nameOf(GuessBehaviour::Uniform)})
            .otherwise(nameOf(predicted.guess)),
        number("options.width", "", "wanted width of the 95 % interval of accuracy")
            .range(0.02, 1)
            .otherwise(predicted.wanted.width),
        number("options.assurance", "", "with which a pilot is to reach it")
            .range(0.5, 0.999)
            .otherwise(predicted.wanted.assurance),
        whole("options.pilot", "participants of the pilot").range(1, 100'000).otherwise(predicted.wanted.participants),
        number("options.area_cm2", "cm2", "electrode area: R_p falls with it and C grows")
            .range(0, 1000)
            .optional("the profile's, or 1 where it has none,")};
    // Parameters keep views of these names, so the names stay in memory.
    static const auto names = [] {
        std::vector<std::array<std::string, 2>> made;
        for (const auto& field : populationFields()) {
            made.push_back({"options." + std::string(field.key), std::string(field.name)});
            if (!field.holdsFor.empty()) made.back()[1] += " " + std::string(field.holdsFor);
        }
        return made;
    }();
    PopulationModel shipped = people;
    for (std::size_t i = 0; i < names.size(); ++i) {
        const auto& field = populationFields()[i];
        all.push_back(number(names[i][0], field.accepted.unit, names[i][1])
                          .range(field.accepted.low, field.accepted.high)
                          .otherwise(field.in(shipped)));
    }
    const std::vector<HostParameter> rest{
        number("options.above_detection", "", "a personal range begins at this times the perception threshold")
            .range(1, 10)
            .otherwise(predicted.stimulation.aboveDetection),
        number("options.below_discomfort", "", "and ends at this times what is too strong")
            .range(0.01, 1)
            .otherwise(predicted.stimulation.belowDiscomfort),
        number("options.skin_spread", "", "geometric standard deviation between people, 1 for none")
            .range(kAcceptedSpread.low, kAcceptedSpread.high)
            .optional("1.5, and for C 1.3,"),
        number("options.threshold_spread", "", "of the three thresholds, likewise")
            .range(kAcceptedSpread.low, kAcceptedSpread.high)
            .otherwise(people.detection_ma.spread),
        number("options.weber_spread", "", "the same of the Weber fractions")
            .range(kAcceptedSpread.low, kAcceptedSpread.high)
            .otherwise(people.amplitudeWeber.spread),
        text("options.label", "what the progress bar says").otherwise("Virtual participants")};
    all.insert(all.end(), rest.begin(), rest.end());
    return all;
}

namespace {

Drive sourceFrom(const Arguments& arguments) {
    return arguments.text("options.source") == "voltage" ? Drive::Voltage : Drive::Current;
}

/// Returns the connected stimulator if it drives as requested, else an ideal one.
SourceTraits traitsFor(Bench& bench, Drive drive) {
    const auto& stimulator = bench.devices().stimulator;
    if (stimulator && stimulator->traits().drive == drive) return stimulator->traits();
    return idealSource(drive);
}

Result<PopulationModel> populationFrom(const Arguments& arguments) {
    PopulationModel model;
    for (const auto& field : populationFields())
        field.in(model) = arguments.number("options." + std::string(field.key));
    const double detection = model.detection_ma.median;
    const double attention = model.attention_ma.median, intolerance = model.intolerance_ma.median;
    const auto above = [&arguments](const char* key, double value, const char* other, double least) {
        return arguments.wrong(key, value, fmt::format("more than the {} threshold of {:g} mA", other, least));
    };
    if (!(model.discomfort_ma > detection)) return above("discomfort_ma", model.discomfort_ma, "perception", detection);
    if (!(attention > detection)) return above("attention_ma", attention, "perception", detection);
    if (!(intolerance > attention)) return above("intolerance_ma", intolerance, "attention", attention);
    for (auto* drawn : {&model.series_ohm, &model.parallel_ohm, &model.capacitance_nf})
        drawn->spread = arguments.number("options.skin_spread", drawn->spread);
    for (auto* drawn : {&model.detection_ma, &model.attention_ma, &model.intolerance_ma})
        drawn->spread = arguments.number("options.threshold_spread");
    model.amplitudeWeber.spread = model.intervalWeber.spread = arguments.number("options.weber_spread");
    return model;
}

}  // namespace

Result<VariationOptions> variationOptionsFrom(ScriptSession& session, const Arguments& arguments) {
    Bench& bench = session.bench();
    const auto& profile = bench.profile();
    VariationOptions out;
    out.seed = session.request().seed;
    auto& to = out.stimulation;
    to.encoding = profile.encoding;
    to.source = traitsFor(bench, sourceFrom(arguments));
    to.limits = bench.limits();
    to.ceilings = profile.ceilings;
    to.electrodeArea = profile.electrodeArea;
    to.loadLow = profile.loadLow;
    to.loadHigh = profile.loadHigh;
    out.participants = static_cast<std::size_t>(arguments.whole("options.participants"));
    out.trials = static_cast<std::size_t>(arguments.whole("options.trials"));
    out.wanted.width = arguments.number("options.width");
    out.wanted.assurance = arguments.number("options.assurance");
    out.wanted.participants = static_cast<std::size_t>(arguments.whole("options.pilot"));
    const double area_cm2 = arguments.number("options.area_cm2", 0);
    if (area_cm2 > 0) to.electrodeArea = SquareCentimetres(area_cm2);
    to.aboveDetection = arguments.number("options.above_detection");
    to.belowDiscomfort = arguments.number("options.below_discomfort");
    auto population = populationFrom(arguments);
    if (!population) return failure(population);
    out.population = *population;
    const auto levels = amplitudeLevelsFrom(arguments.text("options.levels"));
    if (!levels) return failure(levels);
    to.levels = *levels;
    const auto guess = guessBehaviourFrom(arguments.text("options.guess"));
    if (!guess) return failure(guess);
    out.guess = *guess;
    return out;
}

Result<Variation> predicted(ScriptSession& session, const VariationOptions& options, const std::string& label) {
    // Checks for a stop of the bench while the threads work: bench.wait(0) fails after a stop.
    std::stop_source stop;
    std::optional<Error> stopped;
    auto found = predictVariation(options, stop.get_token(), [&](std::size_t done, std::size_t total) {
        session.progress({label, done, total});
        if (stopped) return;
        if (auto waited = session.bench().wait(Seconds(0)); !waited) {
            stopped = waited.error();
            stop.request_stop();
        }
    });
    if (!found && found.error().code != ErrorCode::Stopped) return found;
    if (stopped) {
        // Keeps the work done so far as a partial result, for the run's outcome and its report.
        if (found) session.keepPartial(toJson(*found, options), Json::array());
        return tl::unexpected<Error>(*stopped);
    }
    return found;
}

namespace {

Result<Json> variation(ScriptSession& session, const Arguments& arguments) {
    const auto options = variationOptionsFrom(session, arguments);
    if (!options) return failure(options);
    const auto found = predicted(session, *options, arguments.text("options.label"));
    if (!found) return failure(found);
    return toJson(*found, *options);
}

}  // namespace

}  // namespace tacto::host::analysis

namespace tacto {

std::vector<HostFunction> variationAnalysis() {
    return {
        {.name = "variation",
         .parameters = host::analysis::variationParameters(),
         .text = "Predicts how virtual participants tell the conditions apart, drawn with the run's seed: no person "
                 "and no device takes part. Works on all cores, with the same result whatever their number.",
         .members = variationKind().members,
         .returns = ": low and high are 5 and 95 % of the participants. A condition counts where it is presented, felt "
                    "and not too "
                    "strong; served are those for whom every one counts, and accuracy, confusion and pilots are "
                    "theirs. people holds the first 1000, a list per column.",
         .errors = "Throws for an option out of its range, and when the run is stopped; what was predicted until "
                   "then is kept as partial.",
         .call = host::analysis::variation},
    };
}

}  // namespace tacto
