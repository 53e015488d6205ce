#include "core/analysis/variation/VariationJson.h"

#include "core/analysis/statistics/StatisticsJson.h"
#include "core/analysis/variation/VariationPremises.h"

namespace tacto {

using nlohmann::json;

namespace {

json medianOf(const Estimate& e) {
    return {{"median", numberOrNull(e.value)}, {"low", numberOrNull(e.low)}, {"high", numberOrNull(e.high)}};
}

json orNull(const std::optional<std::size_t>& value) { return value ? json(*value) : json(nullptr); }

json pooledJson(const PooledTrials& pooled) {
    return {{"total", orNull(pooled.total)},
            {"per_participant", orNull(pooled.perParticipant)},
            {"design_effect", numberOrNull(pooled.designEffect)},
            {"participants_least", orNull(pooled.participantsLeast)}};
}

json trialsJson(const TrialsNeeded& trials, const TrialsWanted& wanted, double chance) {
    json curve = json::array();
    for (const auto& point : trials.curve) {
        curve.push_back({{"trials", point.trials}, {"width", toJson(point.width)}});
    }
    return {
        {"width", wanted.width},
        {"assurance", wanted.assurance},
        {"chance", chance},
        {"per_participant", {{"for_width", orNull(trials.forWidth)}, {"above_chance", orNull(trials.aboveChance)}}},
        {"pooled",
         {{"participants", wanted.participants},
          {"rho", numberOrNull(trials.rho)},
          {"for_width", pooledJson(trials.pooledForWidth)},
          {"above_chance", pooledJson(trials.pooledAboveChance)}}},
        {"curve", curve},
        {"assumptions",
         "Whole blocks of every condition; trials of a participant independent, with the accuracy predicted for "
         "that participant; Wilson's 95 % interval; pooled trials count less by the design effect 1 + (m - 1) rho."}};
}

json pilotsJson(const std::vector<PilotOutlook>& pilots) {
    json out = json::array();
    for (const auto& pilot : pilots) {
        out.push_back({{"people", pilot.people},
                       {"trials", pilot.trials},
                       {"right_from", pilot.rightFrom},
                       {"all_served", pilot.allServed},
                       {"all_above_chance", pilot.allAboveChance},
                       {"prevalence_all", pilot.prevalenceAll},
                       {"prevalence_but_one", pilot.prevalenceButOne},
                       {"width", toJson(pilot.width)}});
    }
    return out;
}

json premisesJson(const VariationOptions& options) {
    json out = json::array();
    for (const auto& premise : premisesOf(options)) {
        out.push_back({{"quantity", premise.quantity},
                       {"value", premise.value},
                       {"spread", premise.spread.empty() ? json(nullptr) : json(premise.spread)},
                       {"mark", nameOf(premise.mark)},
                       {"source", premise.source}});
    }
    return out;
}

json modelJson(const VariationOptions& options) {
    const auto& model = options.population;
    const auto& to = options.stimulation;
    json out = {{"threshold_correlation", model.thresholdCorrelation},
                {"threshold_width_us", model.thresholdWidth.count()},
                {"strength_duration_us", model.strengthDuration.count()},
                {"width_us", to.encoding.train.phaseWidth.count()},
                {"skin_area_cm2", model.skinArea.value()},
                {"electrode_area_cm2", to.electrodeArea ? json(to.electrodeArea->value()) : json(nullptr)},
                {"discomfort_ma", model.discomfort_ma},
                {"lapse_most", model.lapseMost},
                {"noise_jnd", model.noise_jnd},
                {"above_detection", to.aboveDetection},
                {"below_discomfort", to.belowDiscomfort},
                {"load_low_ohm", to.loadLow.value()},
                {"load_high_ohm", to.loadHigh.value()},
                {"trials", options.trials},
                {"guess", nameOf(options.guess)}};
    const std::pair<const char*, const LogNormal&> drawn[] = {
        {"series_ohm", model.series_ohm},          {"parallel_ohm", model.parallel_ohm},
        {"capacitance_nf", model.capacitance_nf},  {"detection_ma", model.detection_ma},
        {"attention_ma", model.attention_ma},      {"intolerance_ma", model.intolerance_ma},
        {"weber_amplitude", model.amplitudeWeber}, {"weber_interval", model.intervalWeber}};
    for (const auto& [name, of] : drawn) out[name] = {{"median", of.median}, {"spread", of.spread}};
    return out;
}

/// A list per column: rows of objects would repeat the names a thousand times.
json peopleJson(const std::vector<ParticipantPrediction>& people) {
    const auto column = [&people](auto value) {
        json out = json::array();
        for (const auto& person : people) out.push_back(value(person));
        return out;
    };
    const auto perCondition = [&column](auto value) {
        return column([value](const ParticipantPrediction& person) {
            json out = json::array();
            for (const auto& stimulus : person.delivery.stimuli) out.push_back(value(stimulus));
            return out;
        });
    };
    using Person = const ParticipantPrediction&;
    using Stimulus = const PredictedStimulus&;
    return {{"series_ohm", column([](Person p) { return p.who.skin.series.value(); })},
            {"parallel_ohm", column([](Person p) { return p.who.skin.parallel.value(); })},
            {"capacitance_nf", column([](Person p) { return p.who.skin.capacitance.value(); })},
            {"impedance_ohm", column([](Person p) { return p.delivery.impedance.value(); })},
            {"detection_ma", column([](Person p) { return p.who.detection.value(); })},
            {"attention_ma", column([](Person p) { return p.who.attention.value(); })},
            {"discomfort_ma", column([](Person p) { return p.who.discomfort.value(); })},
            {"intolerance_ma", column([](Person p) { return p.who.intolerance.value(); })},
            {"weber_amplitude", column([](Person p) { return p.who.amplitudeWeber; })},
            {"weber_interval", column([](Person p) { return p.who.intervalWeber; })},
            {"lapse", column([](Person p) { return p.who.lapse; })},
            {"served", column([](Person p) { return p.served; })},
            {"accuracy", column([](Person p) { return numberOrNull(p.accuracy); })},
            {"information_bits", column([](Person p) { return numberOrNull(p.information); })},
            {"outcome", perCondition([](Stimulus s) { return std::string(nameOf(s.outcome)); })},
            {"felt", perCondition([](Stimulus s) { return s.felt; })},
            {"command_v", perCondition([](Stimulus s) { return s.command.value(); })},
            {"current_ma", perCondition([](Stimulus s) { return s.current.value(); })},
            {"interval_s", perCondition([](Stimulus s) { return s.interval.count(); })}};
}

}  // namespace

json toJson(const Variation& found, const VariationOptions& options) {
    json conditions = json::array(), labels = json::array(), pairs = json::array(), withheld = json::array();
    for (const auto& c : found.conditions) {
        labels.push_back(c.name);
        conditions.push_back({{"name", c.name},
                              {"presented", c.presented},
                              {"refused", c.refused},
                              {"not_felt", c.notFelt},
                              {"counted", c.counted},
                              {"draws_attention", c.drawsAttention},
                              {"too_strong", c.tooStrong},
                              {"not_tolerated", c.notTolerated},
                              {"current_ma", toJson(c.current_ma)},
                              {"voltage_v", toJson(c.voltage_v)},
                              {"interval_s", toJson(c.interval_s)}});
    }
    for (const auto& p : found.pairs) {
        pairs.push_back({{"a", p.a},
                         {"b", p.b},
                         {"participants", p.participants},
                         {"jnd", toJson(p.jnd)},
                         {"amplitude_jnd", toJson(p.amplitude_jnd)},
                         {"interval_jnd", toJson(p.interval_jnd)}});
    }
    for (const auto& [reason, count] : found.withheld) withheld.push_back({{"reason", reason}, {"count", count}});
    json columns = labels;
    columns.push_back("none");
    json trials;
    if (found.trials) {
        trials = trialsJson(*found.trials, options.wanted, 1 / static_cast<double>(found.conditions.size()));
    }
    const auto& encoding = options.stimulation.encoding;
    return {{"simulated", true},
            {"measured", false},
            {"range_v", {encoding.amplitudeMin.value(), encoding.amplitudeMax.value()}},
            {"served", found.served},
            {"participants_refused", found.refusedPeople},
            {"participants_not_feeling", found.unfeltPeople},
            {"participants_without_range", found.withoutRange},
            {"asked", found.asked},
            {"participants", found.participants},
            {"partial", found.partial},
            {"seed", found.seed},
            {"conditions", conditions},
            {"separability", pairs},
            {"labels", labels},
            {"columns", columns},
            {"confusion", found.confusion},
            {"complete", found.complete},
            {"accuracy", medianOf(found.accuracy)},
            {"presented_accuracy", medianOf(found.presentedAccuracy)},
            {"pooled_accuracy", numberOrNull(found.pooledAccuracy)},
            {"information_bits", medianOf(found.information)},
            {"it_bits", numberOrNull(found.pooledInformation)},
            {"it_bias_bits", numberOrNull(found.pooledInformation - found.pooledCorrected)},
            {"it_corrected_bits", numberOrNull(found.pooledCorrected)},
            {"clearly_separable", found.clearlySeparable},
            {"clearly_separable_share",
             static_cast<double>(found.clearlySeparable) / static_cast<double>(found.participants)},
            {"refused", found.refused},
            {"not_felt", found.notFelt},
            {"withheld", withheld},
            {"accuracies", found.accuracies},
            {"impedance_ohm", toJson(found.impedance_ohm)},
            {"detection_ma", toJson(found.detection_ma)},
            {"attention_ma", toJson(found.attention_ma)},
            {"discomfort_ma", toJson(found.discomfort_ma)},
            {"intolerance_ma", toJson(found.intolerance_ma)},
            {"trials_needed", trials},
            {"pilots", pilotsJson(found.pilots)},
            {"premises", premisesJson(options)},
            {"model", modelJson(options)},
            {"people", peopleJson(found.people)}};
}

json toJson(const BenchVariation& found) {
    json conditions = json::array(), pairs = json::array();
    for (const auto& c : found.conditions) {
        conditions.push_back(
            {{"name", c.name}, {"amplitude_v", toJson(c.amplitude_v)}, {"interval_s", toJson(c.interval_s)}});
    }
    for (const auto& p : found.pairs) {
        pairs.push_back({{"a", p.a},
                         {"b", p.b},
                         {"amplitude_jnd", toJson(p.amplitude_jnd)},
                         {"interval_jnd", toJson(p.interval_jnd)}});
    }
    return {{"draws", found.draws}, {"conditions", conditions}, {"pairs", pairs}};
}

}  // namespace tacto
