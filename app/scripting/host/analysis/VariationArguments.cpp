#include "app/scripting/host/analysis/VariationArguments.h"

#include "core/analysis/variation/PopulationField.h"

namespace tacto::host::analysis {

Drive variationSourceFrom(const Arguments& arguments) {
    return arguments.text("options.source") == "voltage" ? Drive::Voltage : Drive::Current;
}

namespace {

/// The connected stimulator where it drives as asked, else one without flaws.
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
    to.source = traitsFor(bench, variationSourceFrom(arguments));
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

}  // namespace tacto::host::analysis
