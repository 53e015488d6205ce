#include "core/analysis/VariationJson.h"

#include "core/analysis/ResultJson.h"

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

}  // namespace

json toJson(const Variation& found, const VariationOptions& options) {
    json conditions = json::array(), labels = json::array(), pairs = json::array(), withheld = json::array();
    for (const auto& c : found.conditions) {
        labels.push_back(c.name);
        conditions.push_back({{"name", c.name},
                              {"presented", c.presented},
                              {"refused", c.refused},
                              {"not_felt", c.notFelt},
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
    return {{"simulated", true},
            {"measured", false},
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
            {"pooled_accuracy", numberOrNull(found.pooledAccuracy)},
            {"information_bits", medianOf(found.information)},
            {"it_bits", numberOrNull(found.pooledInformation)},
            {"it_bias_bits", numberOrNull(found.informationBias)},
            {"it_corrected_bits", numberOrNull(found.pooledInformation - found.informationBias)},
            {"clearly_separable_share", numberOrNull(found.clearlySeparable)},
            {"refused", found.refused},
            {"not_felt", found.notFelt},
            {"withheld", withheld},
            {"accuracies", found.accuracies},
            {"impedance_ohm", toJson(found.impedance_ohm)},
            {"detection_ma", toJson(found.detection_ma)},
            {"discomfort_ma", toJson(found.discomfort_ma)},
            {"trials_needed", trials}};
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
