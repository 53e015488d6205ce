#include "core/analysis/identification/IdentificationJson.h"

#include "core/analysis/statistics/StatisticsJson.h"
#include "core/base/RecordFields.h"

namespace tacto {

using nlohmann::json;

namespace {

json featureJson(const std::optional<FeatureFigures>& feature) {
    if (!feature) return nullptr;
    json out = toJson(feature->figures);
    out["values"] = feature->values;
    out["confusion"] = feature->confusion;
    out["d_prime"] = numberOrNull(feature->dPrime);
    out["criterion"] = numberOrNull(feature->criterion);
    return out;
}

json medianAndRange(const Statistics& of) {
    return {{"median", numberOrNull(of.median)}, {"min", numberOrNull(of.min)}, {"max", numberOrNull(of.max)}};
}

json sequenceJson(const BlockFigures& after) {
    return {{"n", after.n}, {"hits", after.hits}, {"accuracy", toJson(wilsonInterval(after.hits, after.n))}};
}

/// What a result says about a trial.
RecordFields<IdentificationTrial> answerFields() {
    using T = IdentificationTrial;
    RecordFields<T> all;
    all.number("number", &T::number);
    all.word("phase", &T::phase, kTrialPhases);
    all.number("block", &T::block);
    all.text("condition", &T::condition, {.mayBeEmpty = true});
    all.add("response", &T::response, textOrNullKind());
    all.number("attempt", &T::attempt);
    all.number("rt_s", &T::rt_s);
    all.passOverUnknownKeys();
    return all;
}

/// What a session's row says beside.
RecordFields<IdentificationTrial> trialFields() {
    using T = IdentificationTrial;
    auto all = answerFields();
    all.number("current_ma", &T::current);
    all.number("interval_s", &T::interval_s);
    all.number("trains", &T::trains);
    return all;
}

}  // namespace

json toJson(const ConfusionFigures& figures) {
    return {{"n", figures.n},
            {"hits", figures.hits},
            {"accuracy", toJson(figures.accuracy)},
            {"p_chance", numberOrNull(figures.pChance)},
            {"it_bits", numberOrNull(figures.it_bits)},
            {"it_bias_bits", numberOrNull(figures.it_bits - figures.itCorrected_bits.value)},
            {"it_corrected_bits", numberOrNull(figures.itCorrected_bits.value)},
            {"it_corrected_low_bits", numberOrNull(figures.itCorrected_bits.low)},
            {"it_corrected_high_bits", numberOrNull(figures.itCorrected_bits.high)}};
}

Estimate correctedBitsFrom(const json& figures) {
    return {numberOr(figures, "it_corrected_bits"), numberOr(figures, "it_corrected_low_bits"),
            numberOr(figures, "it_corrected_high_bits")};
}

json toJson(const Identification& found) {
    json blocks = json::array(), shares = json::array(), times = json::array();
    for (const auto& block : found.blocks)
        blocks.push_back({{"block", block.block}, {"n", block.n}, {"hits", block.hits}});
    for (const auto& share : found.shares)
        shares.push_back({{"response", share.response}, {"n", share.n}, {"share", toJson(share.share)}});
    for (const double time : found.medianResponseTime_s) times.push_back(numberOrNull(time));
    json out = toJson(found.all);
    out["labels"] = found.labels;
    out["columns"] = found.columns;
    out["confusion"] = found.confusion;
    out["texture"] = featureJson(found.texture);
    out["pressure"] = featureJson(found.pressure);
    out["catch"] = {
        {"n", found.catches.n}, {"false_alarms", found.catches.falseAlarms}, {"rate", toJson(found.catches.rate)}};
    out["no_answer"] = found.noAnswer;
    out["blocks"] = std::move(blocks);
    out["shares"] = std::move(shares);
    out["learning"] = toJson(found.learning);
    out["sequence"] = {{"after_same", sequenceJson(found.afterSame)}, {"after_other", sequenceJson(found.afterOther)}};
    out["median_rt_s"] = std::move(times);
    return out;
}

json toJson(const IdentificationTrial& trial) {
    static const auto fields = answerFields();
    return fields.write(trial);
}

IdentificationTrial identificationTrialFrom(const json& row) {
    static const auto fields = trialFields();
    return fields.read(row, {.lenient = true}).value_or(IdentificationTrial{});
}

json toJson(const FewPeople& people) {
    json rows = json::array();
    for (const auto& person : people.people) {
        json row = toJson(person.figures);
        row["name"] = person.name;
        row["usable"] = person.usable;
        rows.push_back(std::move(row));
    }
    json leftOut = json::array();
    for (const auto& person : people.leftOut) leftOut.push_back({{"name", person.name}, {"reason", person.reason}});
    return {{"people", std::move(rows)},
            {"left_out", std::move(leftOut)},
            {"accuracy", medianAndRange(people.accuracy)},
            {"it_corrected_bits", medianAndRange(people.itCorrected_bits)},
            {"above_chance",
             {{"k", people.aboveChance},
              {"n", people.people.size()},
              {"share", toJson(people.share)},
              {"prevalence", toJson(people.prevalence)},
              {"prevalence_at_least", numberOrNull(people.prevalence.low)}}}};
}

json toJson(const EncodingComparison& compared) {
    json encodings = json::array(), pairs = json::array();
    for (const auto& result : compared.encodings) {
        encodings.push_back({{"encoding", result.encoding},
                             {"n", result.n},
                             {"hits", result.hits},
                             {"accuracy", toJson(wilsonInterval(result.hits, result.n))},
                             {"training_blocks", result.trainingBlocks},
                             {"median_rt_s", numberOrNull(result.medianResponse_s)},
                             {"naturalness", numberOrNull(result.naturalness)}});
    }
    for (const auto& pair : compared.pairs)
        pairs.push_back({{"a", pair.a}, {"b", pair.b}, {"difference", toJson(pair.difference)}});
    return {{"encodings", std::move(encodings)},
            {"pairs", std::move(pairs)},
            {"preferred", compared.preferred.empty() ? json(nullptr) : json(compared.preferred)}};
}

}  // namespace tacto
