#include "app/scripting/VariationArguments.h"

namespace tacto {

using Json = nlohmann::json;

Result<void> readNumbers(const Arguments& arguments, const Json& options, std::initializer_list<NumberOption> wanted) {
    for (const auto& [key, target, range] : wanted) {
        auto value = arguments.number(options, key, *target, range);
        if (!value) return failure(value);
        *target = *value;
    }
    return {};
}

Result<Drive> variationSourceFrom(const Arguments& arguments, const Json& options) {
    auto name = arguments.text(options, "source", "current");
    if (!name) return failure(name);
    if (*name == "current") return Drive::Current;
    if (*name == "voltage") return Drive::Voltage;
    return arguments.wrong("source", *name, "\"current\" or \"voltage\"");
}

namespace {

/// The connected stimulator where it drives as asked, else one without flaws.
SourceTraits traitsFor(Bench& bench, Drive drive) {
    const auto& stimulator = bench.devices().stimulator;
    if (stimulator && stimulator->traits().drive == drive) return stimulator->traits();
    return idealSource(drive);
}

Result<void> readPopulation(const Arguments& arguments, const Json& options, PopulationModel& model) {
    double skinSpread = model.series_ohm.spread, thresholdSpread = model.detection_ma.spread;
    double weberSpread = model.amplitudeWeber.spread;
    const bool spreadGiven = options.contains("skin_spread");
    auto read = readNumbers(arguments, options,
                            {{"series_ohm", &model.series_ohm.median, {1, 1e6}},
                             {"parallel_ohm", &model.parallel_ohm.median, {1, 1e8}},
                             {"capacitance_nf", &model.capacitance_nf.median, {0.001, 1e5}},
                             {"detection_ma", &model.detection_ma.median, {0.01, 100}},
                             {"attention_ma", &model.attention_ma.median, {0.01, 1000}},
                             {"discomfort_ma", &model.discomfort_ma, {0.01, 1000}},
                             {"intolerance_ma", &model.intolerance_ma.median, {0.01, 1000}},
                             {"threshold_correlation", &model.thresholdCorrelation, {0, 1}},
                             {"skin_spread", &skinSpread, {1, 10}},
                             {"threshold_spread", &thresholdSpread, {1, 10}},
                             {"weber_spread", &weberSpread, {1, 10}},
                             {"weber_amplitude", &model.amplitudeWeber.median, {0.001, 1}},
                             {"weber_interval", &model.intervalWeber.median, {0.001, 1}},
                             {"lapse_most", &model.lapseMost, {0, 1}},
                             {"noise_jnd", &model.noise_jnd, {0.01, 100}}});
    if (!read) return read;
    const double detection = model.detection_ma.median;
    const auto above = [&arguments](const char* key, double value, const char* other, double least) {
        return arguments.wrong(key, value, fmt::format("more than the {} threshold of {:g} mA", other, least));
    };
    if (!(model.discomfort_ma > detection)) return above("discomfort_ma", model.discomfort_ma, "perception", detection);
    const double attention = model.attention_ma.median, intolerance = model.intolerance_ma.median;
    if (!(attention > detection)) return above("attention_ma", attention, "perception", detection);
    if (!(intolerance > attention)) return above("intolerance_ma", intolerance, "attention", attention);
    if (spreadGiven) {
        for (auto* drawn : {&model.series_ohm, &model.parallel_ohm, &model.capacitance_nf}) drawn->spread = skinSpread;
    }
    for (auto* drawn : {&model.detection_ma, &model.attention_ma, &model.intolerance_ma}) {
        drawn->spread = thresholdSpread;
    }
    model.amplitudeWeber.spread = model.intervalWeber.spread = weberSpread;
    return {};
}

}  // namespace

Result<VariationOptions> variationOptionsFrom(ScriptSession& session, const Arguments& arguments, const Json& given) {
    Bench& bench = session.bench();
    const auto& profile = bench.profile();
    VariationOptions out;
    out.seed = session.request().seed;
    const auto drive = variationSourceFrom(arguments, given);
    if (!drive) return failure(drive);
    auto& to = out.stimulation;
    to.encoding = profile.encoding;
    to.source = traitsFor(bench, *drive);
    to.limits = bench.limits();
    to.ceilings = profile.ceilings;
    to.electrodeArea = profile.electrodeArea;
    to.loadLow = profile.loadLow;
    to.loadHigh = profile.loadHigh;
    double participants = static_cast<double>(out.participants), trials = static_cast<double>(out.trials);
    double pilot = static_cast<double>(out.wanted.participants), area = 0;
    auto read = readNumbers(arguments, given,
                            {{"participants", &participants, {1, 100'000, true}},
                             {"trials", &trials, {1, 10'000, true}},
                             {"width", &out.wanted.width, {0.02, 1}},
                             {"assurance", &out.wanted.assurance, {0.5, 0.999}},
                             {"pilot", &pilot, {1, 100'000, true}},
                             {"area_cm2", &area, {0, 1000}},
                             {"above_detection", &to.aboveDetection, {1, 10}},
                             {"below_discomfort", &to.belowDiscomfort, {0.01, 1}}});
    if (!read) return failure(read);
    out.participants = static_cast<std::size_t>(participants);
    out.trials = static_cast<std::size_t>(trials);
    out.wanted.participants = static_cast<std::size_t>(pilot);
    if (area > 0) to.electrodeArea = SquareCentimetres(area);
    if (auto population = readPopulation(arguments, given, out.population); !population) return failure(population);
    auto levels = arguments.text(given, "levels", nameOf(to.levels));
    if (!levels) return failure(levels);
    const auto known = amplitudeLevelsFrom(*levels);
    if (!known) return failure(known);
    to.levels = *known;
    auto guess = arguments.text(given, "guess", nameOf(out.guess));
    if (!guess) return failure(guess);
    const auto answer = guessBehaviourFrom(*guess);
    if (!answer) return failure(answer);
    out.guess = *answer;
    return out;
}

}  // namespace tacto
