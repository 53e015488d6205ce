#include "core/analysis/transitions/TransitionsJson.h"

#include "core/analysis/statistics/StatisticsJson.h"
#include "core/base/JsonFields.h"

namespace tacto {

namespace {

nlohmann::json toJson(const LatencyGroup& group) {
    return {{"name", group.name},
            {"n", group.latency_s.n},
            {"not_measured", group.steps - group.latency_s.n},
            {"latency_s", toJson(group.latency_s)},
            {"designed_latency_s", toJson(group.designed_s)},
            {"difference_s", toJson(group.difference_s)},
            {"trains", toJson(group.trains)},
            {"designed_trains", toJson(group.designedTrains)},
            {"verdict", nameOf(group.verdict)}};
}

nlohmann::json toJson(const ChangeGroup& group) {
    return {{"name", group.name},
            {"n", group.changes},
            {"trains_captured", group.captured},
            {"amplitude_jnd", numberOrNull(group.amplitude.jnd)},
            {"amplitude_u_jnd", numberOrNull(group.amplitude.uncertainty)},
            {"interval_jnd", numberOrNull(group.interval.jnd)},
            {"interval_u_jnd", numberOrNull(group.interval.uncertainty)},
            {"completes", group.completes},
            {"complete_s", toJson(statisticsOf(group.complete_s))},
            {"fastest_complete_s", toJson(statisticsOf(group.fastest_s))},
            {"trains", toJson(statisticsOf(group.trains))},
            {"fewest_trains", toJson(statisticsOf(group.fewest))},
            {"late", group.late},
            {"out_of_reach", group.outOfReach},
            {"verdict", nameOf(group.verdict)}};
}

template <class Group>
nlohmann::json rowsOf(const std::vector<Group>& groups) {
    nlohmann::json rows = nlohmann::json::array();
    for (const auto& group : groups) rows.push_back(toJson(group));
    return rows;
}

/// A row of a session from before rows said what they are: a step tells when it was complete.
bool isMovement(const nlohmann::json& row) {
    const auto type = row.find("type");
    return type != row.end() ? *type == "movement" : !row.contains("complete_s");
}

}  // namespace

StepLatency stepLatencyFrom(const nlohmann::json& row) {
    return {.name = row.at("name").get<std::string>(),
            .latency_s = numberOr(row, "latency_s"),
            .designed_s = numberOr(row, "designed_latency_s"),
            .designedLow_s = numberOr(row, "designed_latency_low_s"),
            .designedHigh_s = numberOr(row, "designed_latency_high_s"),
            .trains = numberOr(row, "trains"),
            .designedTrains = numberOr(row, "designed_trains"),
            .designedTrainsHigh = numberOr(row, "designed_trains_high")};
}

CapturedChange capturedChangeFrom(const nlohmann::json& row) {
    CapturedChange change{.name = row.at("name").get<std::string>(),
                          .movement = isMovement(row),
                          .from_v = numberOr(row, "from_v"),
                          .to_v = numberOr(row, "to_v"),
                          .from_s = numberOr(row, "from_s"),
                          .to_s = numberOr(row, "to_s"),
                          .complete_s = numberOr(row, "complete_s"),
                          .trainsTaken = numberOr(row, "trains"),
                          .fastest_s = numberOr(row, "fastest_complete_s"),
                          .fewestTrains = numberOr(row, "fewest_trains")};
    for (const auto& one : row.value("before_v", nlohmann::json::array())) change.before_v.push_back(numberOr(one));
    for (const auto& train : row.at("onsets")) {
        change.trains.push_back({.amplitude_v = numberOr(train, "amplitude_v"),
                                 .interval_s = numberOr(train, "interval_s"),
                                 .onsetUncertainty_s = numberOr(train, "onset_u_s"),
                                 .amplitude_jnd = numberOr(train, "amplitude_jnd"),
                                 .interval_jnd = numberOr(train, "interval_jnd")});
    }
    return change;
}

nlohmann::json toJson(const LatencyJudgement& judgement) {
    return {{"tolerance_s", judgement.tolerance_s},
            {"groups", rowsOf(judgement.groups)},
            {"verdict", nameOf(judgement.verdict)},
            {"reasons", judgement.reasons}};
}

nlohmann::json toJson(const ChangeJudgement& judgement) {
    return {{"wanted_jnd", judgement.limits.perTrain_jnd},
            {"complete_limit_s", judgement.limits.complete_s},
            {"seconds_alone", judgement.limits.secondsAlone},
            {"groups", rowsOf(judgement.groups)},
            {"notes", judgement.notes},
            {"verdict", nameOf(judgement.verdict)},
            {"reasons", judgement.reasons}};
}

}  // namespace tacto
